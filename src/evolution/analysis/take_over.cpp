// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/take_over.hpp"

#include <vector>

namespace delam {

Stepper::Result take_over(Stepper& stepper, const State& before, std::span<const double> displacement, bool rotated,
                          bool rotates) {
    State from = before;
    // Bodies that rotate know their state by its displacements, others by unknowns of their operator.
    if (!rotated || !rotates) {
        from.response.multipliers.clear();
        from.response.rigid.clear();
        from.memory.clear();
        from.search_memory.clear();
        if (rotates) from.response.multipliers.assign(displacement.begin(), displacement.end());
    }
    from.search_energies.clear();
    Stepper::Result result = stepper.equilibrate(from, before.time, {}, {displacement.begin(), displacement.end()});
    State& next = result.state;
    next.mixity = before.mixity;
    next.effort = before.effort;
    next.outcome = before.outcome;
    next.history = before.history;
    next.jump_within = before.jump_within;
    next.jump_before = before.jump_before;
    next.growth = {};
    next.growth.way = before.growth.way;
    next.ledger.initial = before.ledger.initial;
    next.ledger.initial_linear = before.ledger.initial_linear;
    next.ledger.work = before.ledger.work + next.ledger.load_potential - before.ledger.load_potential;
    return result;
}

}  // namespace delam
