// SPDX-License-Identifier: BSD-3-Clause
// What of a state is saved: a row for each member, in the order of the bytes, in the group of the version of the format
// that it came with (snapshot.cpp). A further member is a further row at the end, in a group of a further version.
#pragma once

#include <tuple>

#include "base/archive.hpp"
#include "evolution/increment/state.hpp"

namespace delam {

// One row a line.
// clang-format off
template <>
inline constexpr auto saved_fields<Response> = std::tuple_cat(
    saved_since(5,
        &Response::jump,
        &Response::force,
        &Response::conjugate,
        &Response::multipliers,
        &Response::rigid,
        &Response::stored_bulk,
        &Response::load_potential,
        &Response::residual,
        &Response::iterations),
    saved_since(unsaved,  // a committed state is balanced and converged
        &Response::balanced,
        &Response::converged));

template <>
inline constexpr auto saved_fields<Ledger> = saved_since(5,
    &Ledger::stored_bulk,
    &Ledger::stored_interface,
    &Ledger::load_potential,
    &Ledger::stored_interface_slides,
    &Ledger::dissipated,
    &Ledger::dissipated_slides,
    &Ledger::work,
    &Ledger::lower,
    &Ledger::increment,
    &Ledger::upper,
    &Ledger::increment_lower,
    &Ledger::initial,
    &Ledger::initial_slides,
    &Ledger::mixity_error);

template <>
inline constexpr auto saved_fields<Counts> = saved_since(5,
    &Counts::am_iterations,
    &Counts::displacement_solves,
    &Counts::contact_iterations,
    &Counts::contact_iterations_first,
    &Counts::contact_iterations_max,
    &Counts::contact_fallbacks,
    &Counts::linear_iterations,
    &Counts::newton_solves,
    &Counts::debond_moves,
    &Counts::mixity_held,
    &Counts::backtracks,
    &Counts::revisions,
    &Counts::revised_from,
    &Counts::search_candidates,
    &Counts::search_margin,
    &Counts::search_gap,
    &Counts::substeps,
    &Counts::refused_steps,
    &Counts::jumps,
    &Counts::released,
    &Counts::damage_change,
    &Counts::linear_residual);

template <>
inline constexpr auto saved_fields<State> = saved_since(5,
    &State::step,
    &State::time,
    &State::theta,
    &State::adhesion,
    &State::mixity,
    &State::mixity_before,
    &State::closed,
    &State::loaded,
    &State::response,
    &State::memory,
    &State::search_memory,
    &State::ledger,
    &State::counts);
// clang-format on

static_assert(complete<Response>(saved_fields<Response>) && complete<Ledger>(saved_fields<Ledger>) &&
                  complete<Counts>(saved_fields<Counts>) && complete<State>(saved_fields<State>),
              "a member of a saved struct has no row");

}  // namespace delam
