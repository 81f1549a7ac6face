// SPDX-License-Identifier: BSD-3-Clause
// One incremental problem by alternate minimisation (slides, "Alternate minimization algorithm"): displacements at
// frozen damage, damage at frozen displacements, until the damage would move by no more than delta. The state that is
// kept is the one that was tested: displacements that belong to its adhesion, and a damage step from there that changes
// nothing more than delta.
#pragma once

#include <span>

#include "base/monitor.hpp"
#include "evolution/increment/contact.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/mixity_rule.hpp"
#include "evolution/increment/state.hpp"

namespace delam {

struct Minimiser {
    JumpOperator& op;
    const PairLaws& pairs;
    const ContactScene& contact;
    Monitor& monitor;
    double tolerance;    // delta
    std::int64_t limit;  // alternations
    MixityRule rule = MixityRule::frozen;

    // Displacements and contact at the state's adhesion and theta; counts are added up.
    // False: a limit of the linear or contact iteration was met.
    // cold: the contact set at hand says nothing.
    bool displace(State& state, bool cold = false) const;
    double energy(const State& state, std::span<const double> adhesion_old, const StepMixity& mixity) const;
    // The faster way to the same stopping test, safeguarded by the energy; zone leaps where the operator is condensed.
    bool accelerate(State& state, std::span<const double> adhesion_old) const;
    // Both unknowns; adhesion starts at the state's and stays below `adhesion_old`; B starts as the state's mixity and
    // follows the rule. False: limit.
    bool alternate(State& state, std::span<const double> adhesion_old) const;
    bool record(State& state, std::span<const double> adhesion_old, const StepMixity& mixity, bool converged) const;
};

}  // namespace delam
