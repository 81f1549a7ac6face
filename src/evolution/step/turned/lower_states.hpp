// SPDX-License-Identifier: BSD-3-Clause
// States of lower energy than a balance of bodies with large rotations. A search ranks candidates in the scene
// linearised about the balance, where energies are true to second order. The lowest comes to a balance of its own, and
// is kept if its true energy is lower; then the search goes on from there.
#pragma once

#include <functional>

#include "evolution/step/stepper.hpp"

namespace delam {

struct LowerStates {
    // Returns the lowest state that a search finds in the scene linearised about a balance.
    std::function<Stepper::Result(const State& balance)> search;
    // Returns the balance to which linear steps lead that may also begin at `start`, from the places of a balance.
    std::function<Stepper::Result(const State& balance, const Stepper::Start& start)> settle;

    // Returns the lowest balance. least: energies that differ by less of their size are alike; damage_tolerance:
    // adhesions that do.
    Stepper::Result lowest(Stepper::Result best, double least, double damage_tolerance) const;
};

// Returns the jump within a step from its local balance to a lower state, at the end of the step: bisection finds the
// load at which the one is as high as the other.
JumpWithin jump_to_lower(const PairLaws& pairs, const State& local, const State& lower);

}  // namespace delam
