// SPDX-License-Identifier: BSD-3-Clause
// Bodies with large rotations of which nothing holds a part: their translations are free of energy in any place, and
// their rotations where no interface or load pushes them, whatever their stresses. Other rotations are held by the
// forces that push (a part that hangs by one pair), or are unstable.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "evolution/contact/contact.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "evolution/step/pairs_of_scene.hpp"
#include "reduction/turned/turned_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

class LooseParts {
public:
    // The arguments must outlive it.
    LooseParts(const Problem& problem, const TurnedOperator& op, const PairLaws& pairs, const ContactScene& contact)
        : problem_(problem), op_(op), pairs_(pairs), contact_(contact) {}

    // True if supports and what adheres in a state hold all bodies, whatever touches.
    bool none_without_contact(const State& state) const;
    // True if the forces of a state are much larger than what is out of balance, or rounding. off: what is out of
    // balance, over the load.
    bool known_forces(const State& state, double off) const;
    // Return TurnedPoint::loose. of: of a state. translating: the bodies that are free to translate, of which a state
    // of a linear scene tells, too. all: those that the supports alone do not hold.
    std::vector<std::uint8_t> of(const State& state) const;
    std::vector<std::uint8_t> translating(const State& state) const { return found(state, false); }
    std::vector<std::uint8_t> all() const;
    // Returns State::free_since of a state that follows another.
    std::vector<std::int64_t> since(const State& next, const State& before) const;
    // True if contact is right at the jumps and forces of a state, but for rounding: the sets of faces that lie on each
    // other without a force need not come to rest.
    bool rightly_touches(const State& state) const {
        return pairs_on_the_wrong_side(op_, contact_, state.theta, state.closed, state.response).empty();
    }
    // Returns forces of the rows without those on these bodies that are not larger than `least`.
    std::vector<double> without(std::span<const std::uint8_t> loose, std::span<const double> row_force,
                                double least = std::numeric_limits<double>::infinity()) const;
    // Returns the forces of the rows of a state without those that may be what a balance leaves of no force: they would
    // push loose bodies far.
    std::vector<double> pressing(std::span<const std::uint8_t> loose, const State& state) const;

private:
    std::vector<std::uint8_t> found(const State& state, bool turning) const;
    std::vector<double> push_of(const State& state) const;
    double balanced(const State& state) const;
    State without_slight_forces(const State& state) const;

    const Problem& problem_;
    const TurnedOperator& op_;
    const PairLaws& pairs_;
    const ContactScene& contact_;
};

}  // namespace delam
