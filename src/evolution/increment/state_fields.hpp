// SPDX-License-Identifier: BSD-3-Clause
// The saved members of a state. Each member has a row, in the order of the bytes. It stands in the group of the version
// of the format that introduced it (snapshot.cpp). To save another member, add a row at the end, in the group of a new
// version. A state is refused if an array differs in size from the solver's own or a number is not finite, unless the
// row allows it.
#pragma once

#include <tuple>

#include "base/archive.hpp"
#include "evolution/increment/state.hpp"

namespace delam {

// The version with shares of the second shear; scenes without two toughnesses in shear have none, and save the one
// before.
inline constexpr std::uint32_t since_second_shares = 18;
// The version with the state whose rotations were judged last, for kinematics = auto.
inline constexpr std::uint32_t since_rotation_checks = 19;
// The version with the relief of rotations among these.
inline constexpr std::uint32_t since_rotation_relief = 20;

// One row a line.
// clang-format off
template <>
inline constexpr auto saved_fields<SupportError> =
    saved_since(unsaved, &SupportError::constraint, &SupportError::error, &SupportError::size);

template <>
inline constexpr auto saved_fields<SolveError> = saved_since(unsaved, &SolveError::jump, &SolveError::force);

template <>
inline constexpr auto saved_fields<JumpWithin> = saved_since(unsaved,
    &JumpWithin::known, &JumpWithin::load, &JumpWithin::released, &JumpWithin::debonded, &JumpWithin::drop,
    &JumpWithin::interface, &JumpWithin::conjugate_before, &JumpWithin::conjugate_after);

template <>
inline constexpr auto saved_fields<Buckling> =
    saved_since(17, &Buckling::modes, &Buckling::time, &Buckling::node, &Buckling::released);

template <>
inline constexpr auto saved_fields<RotationCheck> = saved_since(since_rotation_checks,
    &RotationCheck::value, any_size(&RotationCheck::loads), any_size(&RotationCheck::damaged),
    any_size(&RotationCheck::touching));

template <>
inline constexpr auto saved_fields<Sensitivity> = saved_since(unsaved,
    &Sensitivity::conjugate, &Sensitivity::adhesion, &Sensitivity::mixity, &Sensitivity::second,
    &Sensitivity::unknown);

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
    saved_since(unsaved,  // a committed state is balanced and converged, and meets its supports
        &Response::error,
        &Response::support,
        &Response::balanced,
        &Response::converged));

template <>
inline constexpr auto saved_fields<Ledger> = std::tuple_cat(
    saved_since(5,
        &Ledger::stored_bulk,
        &Ledger::stored_interface,
        &Ledger::load_potential,
        &Ledger::stored_interface_linear,
        &Ledger::dissipated,
        &Ledger::dissipated_linear,
        &Ledger::work,
        &Ledger::lower,
        &Ledger::increment,
        &Ledger::upper,
        &Ledger::increment_lower,
        &Ledger::initial,
        &Ledger::initial_linear,
        &Ledger::mixity_error),
    saved_since(8,
        &Ledger::released));

template <>
inline constexpr auto saved_fields<State> = std::tuple_cat(
    saved_since(5,
        &State::step,
        &State::time,
        &State::theta,
        &State::adhesion,
        member_of(&State::mixity, &PairMixities::shear),
        member_of(&State::mixity_before, &PairMixities::shear),
        &State::closed,
        &State::loaded,
        &State::response,
        any_size(&State::memory),         // that the operator has: JumpOperator::require_memory
        any_size(&State::search_memory),
        &State::ledger,
        member_of(&State::effort, &Effort::am_iterations),
        member_of(&State::effort, &Effort::displacement_solves),
        member_of(&State::effort, &Effort::contact_iterations),
        member_of(&State::effort, &Effort::contact_iterations_first),
        member_of(&State::effort, &Effort::contact_iterations_max),
        member_of(&State::effort, &Effort::contact_fallbacks),
        member_of(&State::effort, &Effort::linear_iterations),
        member_of(&State::effort, &Effort::newton_solves),
        member_of(&State::effort, &Effort::debond_moves),
        member_of(&State::outcome, &StepOutcome::mixity_held),
        member_of(&State::history, &StepHistory::backtracks),
        member_of(&State::history, &StepHistory::revisions),
        member_of(&State::history, &StepHistory::revised_from),
        member_of(&State::effort, &Effort::search_candidates),
        member_of(&State::outcome, &StepOutcome::search_margin),
        may_be_infinite(member_of(&State::outcome, &StepOutcome::search_gap)),
        member_of(&State::history, &StepHistory::substeps),
        member_of(&State::history, &StepHistory::refused_steps),
        member_of(&State::outcome, &StepOutcome::jumps),
        member_of(&State::outcome, &StepOutcome::released),
        member_of(&State::outcome, &StepOutcome::damage_change),
        member_of(&State::effort, &Effort::linear_residual)),
    saved_since(unsaved,  // told when the step ends
        &State::jump_within,
        member_of(&State::effort, &Effort::linearisations),
        member_of(&State::outcome, &StepOutcome::turned_off)),
    saved_since(11,
        any_size(&State::search_energies)),
    saved_since(unsaved,  // followed from the initial state on
        &State::sensitivity),
    saved_since(12,
        &State::free_since),
    saved_since(13,
        member_of(&State::growth, &Growth::rate),
        member_of(&State::growth, &Growth::part_time),
        member_of(&State::growth, &Growth::pop_time),
        member_of(&State::outcome, &StepOutcome::pops),
        member_of(&State::outcome, &StepOutcome::popped)),
    saved_since(14,
        member_of(&State::growth, &Growth::told_pairs),
        member_of(&State::growth, &Growth::told_dissipated),
        member_of(&State::growth, &Growth::told_released)),
    saved_since(15,
        member_of(&State::growth, &Growth::way)),
    saved_since(16,
        any_size(&State::jump_before)),
    saved_since(17,
        member_of(&State::outcome, &StepOutcome::buckling)),
    saved_since(since_second_shares,
        member_of(&State::mixity, &PairMixities::second),
        member_of(&State::mixity_before, &PairMixities::second)),
    saved_since(since_rotation_checks,
        member_of(&State::rotations, &RotationChecks::rotation),
        member_of(&State::rotations, &RotationChecks::energy),
        member_of(&State::rotations, &RotationChecks::stresses)),
    saved_since(since_rotation_relief,
        member_of(&State::rotations, &RotationChecks::relief)));
// clang-format on

static_assert(complete<Response>(saved_fields<Response>) && complete<Ledger>(saved_fields<Ledger>) &&
                  complete<State>(saved_fields<State>),
              "a member of a saved struct has no row");

}  // namespace delam
