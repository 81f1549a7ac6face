// SPDX-License-Identifier: BSD-3-Clause
// One incremental problem by the staggered scheme (Zeman, Kruzik, Gruber, PANM 15 (2010), "Alternate minimization
// algorithm"): displacements at frozen damage alternate with damage at frozen displacements. They end when no traction
// would change by more than the tolerance (Increment::change). The state that is kept is the one that was tested:
// displacements that belong to its adhesion, and a damage step from there that changes no traction by more.
#pragma once

#include <span>

#include "base/monitor.hpp"
#include "evolution/contact/contact.hpp"
#include "evolution/increment/rule/step_rule.hpp"
#include "scene/limits.hpp"

namespace delam {

class Extrapolation;

struct Minimiser {
    JumpOperator& op;
    const ContactScene& contact;
    Monitor& monitor;
    const Limits& limits;
    double tolerance;      // of the tractions (Increment::change)
    std::int64_t limit;    // of alternations
    PlacesBefore* places;  // of the state before the load step
    bool lowest;           // the lowest state is sought, not the one that the load reaches first

    // Displacements and contact at the state's adhesion and theta; effort is added up. cold: the contact set at hand
    // says nothing. False: a limit of the linear or contact iteration was met.
    bool displace(State& state, const Increment& increment, bool cold = false) const;
    // Both unknowns, by plain alternation. The adhesion starts at the state's, the mixity at the increment's. False: a
    // limit was met, or the mixity of some pairs does not settle. displaced: the displacements of the state belong to
    // its adhesion.
    bool alternate(State& state, StepRule& increment, bool displaced = false) const;
    // The same to the same stopping test, sped up and safeguarded by the energy: between two alternations Newton's
    // method moves ahead in a zone of the operator (zone_newton.hpp), or plain steps are extrapolated.
    bool accelerate(State& state, StepRule& increment, bool displaced = false) const;

private:
    // E + D of a state whose displacements belong to its adhesion, up to a constant of the step.
    double energy(const State& state, const Increment& increment) const;
    // Extrapolates plain damage steps; the adhesion stays between 0 and that before the step.
    void extrapolate(State& state, const StepRule& increment, std::span<const double> plain,
                     Extrapolation& extrapolation) const;
    bool end(State& state, const StepRule& increment, bool converged) const;
};

}  // namespace delam
