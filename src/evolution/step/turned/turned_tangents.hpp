// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of states in balance, in the scenes linearised there, and whether they are stable.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "evolution/step/turned/linearised_scene.hpp"
#include "evolution/step/turned/loose_parts.hpp"
#include "reduction/turned/turned_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// True if a stiffness that is not definite may be the reason.
bool unstable(const Error& error);

class TurnedTangents {
public:
    // The arguments must outlive it.
    TurnedTangents(const Problem& problem, const TurnedOperator& op, const LooseParts& loose, LinearisedScene& linear)
        : problem_(problem), op_(op), loose_(loose), linear_(linear) {}

    using Stresses = TurnedCell::Stresses;
    // Returns what a state remembers.
    TurnedMemory memory_of(const State& state) const;
    // Return where a state was linearised, and the point at its place under its own stresses.
    TurnedPoint point_of(const State& state) const { return memory_of(state).point; }
    TurnedPoint point_at(const State& state, Stresses stresses = Stresses::count) const;

    // A state with the change of its reactions with the loads, [patterns][patterns]; empty: the stiffness under the
    // stresses is not positive definite.
    struct Known {
        std::vector<double> displacement, row_force, adhesion;
        std::vector<std::uint8_t> closed;
        TurnedPoint about;
        std::vector<double> tangent;
        std::vector<std::uint8_t> held;  // [pairs] the contact that counts
        bool stable() const { return about.stresses == Stresses::count; }
        bool of(const State& state) const {
            return displacement == state.response.multipliers && row_force == state.response.force &&
                   adhesion == state.adhesion && closed == state.closed && !displacement.empty();
        }
    };
    Known know(const State& state) const;
    // True if the faces that touch make a state stable, which is then known as such.
    bool held_by_faces(const State& state, Known& known) const;

    // Return d conjugate / d theta at fixed damage and contact, and of a step between two states, [patterns][patterns].
    std::vector<double> of_loads(const State& state) const;
    std::vector<double> of_step(const State& before, const State& state) const;

private:
    // Returns the stepper of the scene linearised about a point and a state, to derive from.
    Stepper& without_loads(const TurnedPoint& about, const State& state) const;
    // Returns the tangent of a state at another contact set, in the scene about a point; empty: there is none.
    std::vector<double> tangent_about(const TurnedPoint& about, const State& state, const State& at) const;
    // Returns a tangent of the linear scene without the row and the column of the additional pattern, and with the
    // energy that eigenstrains store without displacements.
    std::vector<double> of_patterns(std::span<const double> matrix) const;

    const Problem& problem_;
    const TurnedOperator& op_;
    const LooseParts& loose_;
    LinearisedScene& linear_;
};

}  // namespace delam
