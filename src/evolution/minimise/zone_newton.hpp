// SPDX-License-Identifier: BSD-3-Clause
// The incremental minimisation within a zone of the jump operator. With the damage eliminated in closed form, each pair
// has the potential
//
//   phi(j) = min over 0 <= zeta <= zeta_before of  zeta Y(j) + g(zeta)      (Increment::minimum),
//
// and  1/2 x^T S x - theta^T L^T x + sum w phi(j)  over u_n >= 0 is minimised by Newton's method with the active set of
// active_set.hpp and a line search on the energy. The tangent is indefinite where a pair softens faster than the bodies
// unload. The pair is then taken straight to its debonded branch as far as the energy falls on the way, or, where the
// lowest state is sought, if the end is lower. Otherwise a damped step uses so much of the tangents that they remain
// definite. If this fails, too, the step is that of the staggered scheme, which always lowers the energy. No step
// raises the energy. Where the mixity follows the iterates, every step renews it, from the pairs that took part in its
// displacements.
#pragma once

#include <optional>

#include "base/monitor.hpp"
#include "evolution/contact/contact.hpp"
#include "evolution/increment/increment.hpp"
#include "evolution/increment/step_mixities.hpp"
#include "scene/limits.hpp"

namespace delam {

struct ZoneNewton {
    JumpOperator& op;
    Zones* zones;  // of the operator
    const ContactScene& contact;
    Monitor& monitor;
    const Limits& limits;
    double tolerance;  // of the adhesion
    std::int64_t limit;
    bool lowest;  // moves may pass over other equilibria, as long as they end lower

    // state: displacements at its adhesion in; adhesion, contact set and the jumps of the zone out. Returns the energy
    // that new mixities alone have added; none where there is no zone this time.
    std::optional<double> run(State& state, const Increment& increment, StepMixities& mixities) const;
};

}  // namespace delam
