// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/contact_work.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/numbers.hpp"

namespace delam {

namespace {

// Holds a part of the way, with the power q . d at its ends and in its middle.
struct Part {
    double from, to;
    double first, middle, last;

    double halved() const { return 0.25 * (to - from) * (first + 2.0 * middle + last); }
    // Returns by how much halving it has changed its work.
    double change() const { return std::abs(0.25 * (to - from) * (first - 2.0 * middle + last)); }
    bool operator<(const Part& other) const { return change() < other.change(); }
};

}  // namespace

double work_along(std::span<const double> d, std::span<const double> first, std::span<const double> last,
                  const std::function<std::vector<double>(double)>& at, double energy, double tolerance,
                  std::int64_t most) {
    std::int64_t asked = 0;
    const auto part = [&](double from, double to, double begin, double end) {
        ++asked;
        return Part{from, to, begin, dot(d, at(0.5 * (from + to))), end};
    };
    std::priority_queue<Part> parts;
    parts.push(part(0.0, 1.0, dot(d, first), dot(d, last)));
    double work = parts.top().halved();
    while (std::abs(work - energy) > tolerance && asked + 2 <= most) {
        const Part worst = parts.top();
        parts.pop();
        const double middle = 0.5 * (worst.from + worst.to);
        work -= worst.halved();
        for (const Part& half :
             {part(worst.from, middle, worst.first, worst.middle), part(middle, worst.to, worst.middle, worst.last)}) {
            work += half.halved();
            parts.push(half);
        }
    }
    return work;
}

void integrate_work(const Minimiser& minimiser, const StepRule& step, State& next) {
    const Limits& limits = minimiser.limits;
    const State& before = step.before();
    const double work = next.ledger.work - before.ledger.work;
    // Not that of the ledger, whose work is in question.
    const double scale =
        std::max({std::abs(next.ledger.energy()), std::abs(next.ledger.increment), std::abs(before.ledger.work)});
    if (next.adhesion != before.adhesion || next.closed == before.closed ||
        std::abs(work - next.ledger.increment) <= limits.work_open * scale)
        return;
    std::vector<double> d(next.theta);
    add_scaled(-1.0, before.theta, d);
    State between = before;
    between.effort = next.effort;
    const auto conjugate = [&](double part) {
        between.theta = before.theta;
        add_scaled(part, d, between.theta);
        minimiser.displace(between, step);
        return between.response.conjugate;
    };
    next.ledger.work =
        before.ledger.work + work_along(d, before.response.conjugate, next.response.conjugate, conjugate,
                                        next.ledger.increment, limits.work_open * scale, limits.work_solves);
    next.effort = between.effort;
}

}  // namespace delam
