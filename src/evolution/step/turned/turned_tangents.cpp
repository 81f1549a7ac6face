// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/turned/turned_tangents.hpp"

#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/contact/contact.hpp"

namespace delam {

bool unstable(const Error& error) { return error.status() == DELAM_ERROR_NUMERICAL || error.status() == DELAM_LIMIT; }

TurnedMemory TurnedTangents::memory_of(const State& state) const {
    TurnedMemory memory = TurnedMemory::of(state.memory, state.response.multipliers, state.theta);
    memory.point.loose = loose_.of(state);
    return memory;
}

TurnedPoint TurnedTangents::point_at(const State& state, Stresses stresses) const {
    return {state.response.multipliers, {}, {}, stresses, state.theta, loose_.of(state)};
}

// A derivative knows nothing of the forces at which the scene is linearised. Those of rounding would push loose bodies.
Stepper& TurnedTangents::without_loads(const TurnedPoint& about, const State& state) const {
    Stepper& stepper = linear_.about(about, state.response.multipliers, state.response.force);
    return about.loose.empty() ? stepper : linear_.under(std::vector<double>(op_.dofs(), 0.0));
}

std::vector<double> TurnedTangents::tangent_about(const TurnedPoint& about, const State& state, const State& at) const {
    try {
        State from = at;
        from.memory = memory_of(state).of_operator;
        Stepper& stepper = without_loads(about, state);
        return of_patterns(stepper.tangent(linear_.resumed(std::move(from))));
    } catch (const Error& error) {
        if (!unstable(error)) throw;
        return {};
    }
}

// The change of the reactions at fixed damage and contact exists where the stiffness under all stresses is positive
// definite. Faces that touch without a force hold nothing: a flat strip would stay flat. Where nothing but they holds a
// part, whatever the stresses, they do.
TurnedTangents::Known TurnedTangents::know(const State& state) const {
    Known known{
        state.response.multipliers, state.response.force, state.adhesion, state.closed, point_of(state), {}, {}};
    State at = extended(state, problem_.patterns.size());
    at.theta.back() = 1.0;
    State open = at;
    const double load = op_.load_size(state.theta, state.response);
    const auto dim = index(problem_.mesh->dimension());
    for (std::size_t p = 0; p < open.closed.size(); ++p)
        if (!(-state.response.force[p * dim] > problem_.options.limits.turned_balance * load)) open.closed[p] = 0;
    known.held = open.closed;
    if (known.about.stresses == Stresses::count) known.tangent = tangent_about(known.about, state, open);
    if (!known.tangent.empty()) return known;
    known.about = point_at(state);
    known.tangent = tangent_about(known.about, state, open);
    if (!known.tangent.empty()) return known;
    const TurnedPoint unstressed = point_at(state, Stresses::left_out);
    if (open.closed != at.closed && tangent_about(unstressed, state, open).empty()) {
        known.held = at.closed;
        known.tangent = tangent_about(known.about, state, at);
    }
    if (known.tangent.empty()) known.about = unstressed;
    return known;
}

// Faces that touch without a force count as open, until a way along the mode has led back: then they hold the bodies.
bool TurnedTangents::held_by_faces(const State& state, Known& known) const {
    State at = extended(state, problem_.patterns.size());
    at.theta.back() = 1.0;
    const std::vector<std::uint8_t> touching =
        touching_pairs(linear_.stepper().contact(), op_, scene_size(*problem_.mesh), state.response.jump);
    for (std::size_t p = 0; p < at.closed.size(); ++p)
        if (touching[p] != 0) at.closed[p] = 1;
    const TurnedPoint about = point_at(state);
    known.tangent = tangent_about(about, state, at);
    if (known.tangent.empty()) return false;
    known.about = about;
    known.held = at.closed;
    return true;
}

std::vector<double> TurnedTangents::of_patterns(std::span<const double> matrix) const {
    const std::size_t patterns = problem_.patterns.size();
    std::vector<double> own;
    for (std::size_t i = 0; i < patterns; ++i)
        for (std::size_t j = 0; j < patterns; ++j) own.push_back(matrix[i * (patterns + 1) + j]);
    op_.add_strain_energy(own);
    return own;
}

std::vector<double> TurnedTangents::of_loads(const State& state) const {
    State own = extended(state, problem_.patterns.size());
    own.theta.back() = 1.0;
    return of_patterns(without_loads(point_at(state), state).tangent(own));
}

std::vector<double> TurnedTangents::of_step(const State& before, const State& state) const {
    State own = extended(state, problem_.patterns.size());
    own.theta.back() = 1.0;
    const State from = extended(before, problem_.patterns.size());
    Stepper& stepper = without_loads(point_at(state), state);
    return of_patterns(linear_.derived([&] { return stepper.step_tangent(from, own); }));
}

}  // namespace delam
