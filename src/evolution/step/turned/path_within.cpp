// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/turned/path_within.hpp"

#include "base/numbers.hpp"
#include "evolution/step/load_path.hpp"

namespace delam {

namespace {

// Returns the linear scene at the begin of a step: at the loads and the damage of the state before.
State begin_of(Stepper& stepper, const State& from) {
    State still = stepper.equilibrate(from, from.time, from.adhesion).state;
    still.mixity = from.mixity;
    still.step = from.step;
    still.effort = {};
    still.ledger.initial = from.ledger.initial;
    still.ledger.initial_linear = from.ledger.initial_linear;
    return still;
}

// Returns the work of the path less that of the trapezoidal rule between its ends.
double beyond_trapezoid(const State& begin, const State& end) {
    double work = end.ledger.work - begin.ledger.work;
    for (std::size_t p = 0; p < end.theta.size(); ++p)
        work -= 0.5 * (end.theta[p] - begin.theta[p]) * (begin.response.conjugate[p] + end.response.conjugate[p]);
    return work;
}

}  // namespace

Stepper::Result follow_within(Stepper& stepper, const PairGraph& graph, const State& from, double time,
                              const Options& options, PathWithin& within) {
    within = {};
    if (!(from.time < time)) return stepper.step(from, time);
    const State begin = begin_of(stepper, from);
    const double base = from.ledger.energy() - begin.ledger.energy();
    Stepper::Result followed = followed_step(stepper, graph, begin, time, options, base).result;
    State& next = followed.state;
    within.beyond = beyond_trapezoid(begin, next);
    within.released = next.ledger.released - from.ledger.released;
    next.outcome.jumps = 0;
    return followed;
}

}  // namespace delam
