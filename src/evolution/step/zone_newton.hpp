// SPDX-License-Identifier: BSD-3-Clause
// A leap of the incremental minimisation within the process zone: with the damage eliminated in closed form, each pair
// has the potential
//   phi(j) = min over 0 <= zeta <= zeta_old of  zeta Y(j) + g(zeta),
// and  1/2 x^T S x - theta^T L^T x + sum w phi(j)  over u_n >= 0 is minimised by Newton's method with an active set for
// contact and a line search on the energy. Where a pair softens faster than the bodies unload, the tangent is
// indefinite: the pair is then taken straight to its debonded branch if that lowers the energy; else the step is that
// of alternate minimisation, which always does. No step raises the energy. Where the mixity follows the iterate, it is
// renewed after every step, by pairs that took part in its displacements. Under the variational rule phi holds f(B(j),
// zeta), its tangents are those of variational.hpp, and all pairs that are partly damaged belong to the zone.
#pragma once

#include <optional>
#include <span>

#include "base/monitor.hpp"
#include "evolution/increment/contact.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/mixity_rule.hpp"
#include "evolution/increment/state.hpp"
#include "reduction/jump_operator.hpp"

namespace delam {

struct ZoneNewton {
    JumpOperator& op;
    const PairLaws& pairs;
    const ContactScene& contact;
    Monitor& monitor;
    double tolerance;  // delta
    std::int64_t limit;

    // state: displacements at its adhesion; out: adhesion and contact set after the leap (displacements are left
    // behind; variational: their jumps in the zone are those of its end, for the next displacement step to start from).
    // Returns the energy that new mixities alone have added.
    std::optional<double> leap(State& state, StepMixity& mixity, std::span<const double> adhesion_old) const;
};

}  // namespace delam
