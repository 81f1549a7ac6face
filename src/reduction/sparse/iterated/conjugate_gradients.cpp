// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "base/restarts.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

// True if the gain of the iterations so far shows that the limit will not suffice.
bool hopeless(double gained_by_now, double needed, std::size_t iterations, std::int64_t limit, const Limits& limits) {
    if (iterations < index(limits.cg_judged)) return false;
    const double per_iteration = std::log(gained_by_now) / static_cast<double>(iterations);
    return !(per_iteration < 0.0) ||
           std::log(needed) / per_iteration > limits.cg_accelerates * static_cast<double>(limit);
}

// Returns the least eigenvalue of the tridiagonal matrix that the recursion implies (Lanczos; G. Golub, C. Van Loan,
// Matrix Computations, 10.2).
double least_eigenvalue(std::span<const double> steps, std::span<const double> shares, std::int64_t most) {
    const std::size_t n = std::min(steps.size(), index(most));
    if (n == 0) return 1.0;
    DenseMatrix t(static_cast<std::int64_t>(n), static_cast<std::int64_t>(n));
    for (std::size_t j = 0; j < n; ++j) {
        const auto at = static_cast<std::int64_t>(j);
        t(at, at) = 1.0 / steps[j] + (j > 0 ? shares[j - 1] / steps[j - 1] : 0.0);
        if (j + 1 < n) t(at, at + 1) = t(at + 1, at) = std::sqrt(std::abs(shares[j])) / steps[j];
    }
    const double least = eigen_symmetric(std::move(t)).value.front();
    return least > 0.0 ? least : 1.0;
}

// One run of the recursion from the residual r to the target; leaves the residual that the recursion has reached in r
// and its norm in `reached`. False: negative curvature.
bool descend(const CgSystem& system, std::span<double> x, std::vector<double>& r, std::vector<double>& z, double target,
             std::int64_t limit, CgOutcome& outcome, double& reached) {
    std::vector<Direction> directions;
    std::vector<double> ap(r.size());
    double first = 0.0;
    Lowest lowest(system.limits.restart_noticed);
    std::vector<double> steps, shares;  // alpha and beta of the recursion
    double rz_before = 0.0;
    const auto conjugate = [&](const Direction& d) { add_scaled(-dot(d.ap, z) / d.pap, d.p, z); };
    while (true) {
        for (int pass = 0; pass < 2; ++pass) {
            for (const Direction& d : system.given) conjugate(d);
            for (const Direction& d : directions) conjugate(d);
        }
        const double rz = dot(r, z), norm = std::sqrt(std::abs(rz));
        lowest.take(norm);
        reached = norm;
        if (steps.empty())
            first = norm;
        else
            shares.push_back(rz / rz_before);
        rz_before = rz;
        const bool over =
            outcome.iterations >= limit || lowest.idle() > system.limits.restart_idle ||
            (system.attempt && hopeless(norm / first, target / first, steps.size(), limit, system.limits));
        if (norm <= target || over) {
            outcome.least = std::min(outcome.least, least_eigenvalue(steps, shares, system.limits.cg_directions));
            return true;
        }
        system.apply(z, ap);
        const double pap = dot(z, ap);
        if (!(pap > 0.0))
            return !(pap <= -system.limits.restart_flat * std::abs(rz));  // a number that is not finite has no sign
        const double step = rz / pap;
        steps.push_back(step);
        add_scaled(step, z, x);
        add_scaled(-step, ap, r);
        if (directions.size() == index(system.limits.cg_directions)) directions.erase(directions.begin());
        directions.push_back({z, ap, pap});
        system.each_iteration(++outcome.iterations);
        system.precondition(r, z);
    }
}

}  // namespace

CgOutcome conjugate_gradients(const CgSystem& system, std::span<double> x, double tolerance, std::int64_t limit) {
    CgOutcome outcome;
    Restarts restarts(tolerance, system.rounded, system.limits);
    std::vector<double> r(x.size()), z(x.size()), best;
    while (true) {
        system.restart(x, r);  // r = b - A x
        double size = system.size(x);
        system.precondition(r, z);
        const double norm = std::sqrt(std::abs(dot(r, z)));
        restarts.begin(norm, size);
        if (restarts.first()) {
            outcome.first = norm;
            restarts.allow(system.enough ? system.enough(norm) : 0.0);
        }
        if (restarts.needs_rounding()) restarts.set_rounded(system.rounding(x) / size);
        outcome.rounded = restarts.rounded();
        if (restarts.best()) {
            outcome.residual = restarts.relative();
            outcome.norm = norm;
            best.assign(x.begin(), x.end());
            outcome.correction = z;
        }
        outcome.converged = restarts.reached();
        if (outcome.converged) return outcome;
        if (restarts.over() || outcome.iterations >= limit) {
            std::copy(best.begin(), best.end(), x.begin());
            // The rounding of an earlier state may be too little for this one.
            if (!restarts.excused() && system.rounded > 0.0 && size > 0.0)
                restarts.set_rounded(std::max(restarts.rounded(), system.rounding(x) / size));
            outcome.rounded = restarts.rounded();
            outcome.converged = restarts.excused();
            return outcome;
        }
        const double goal = restarts.goal();
        double recursion = infinite;
        outcome.definite = descend(system, x, r, z, goal, limit, outcome, recursion);
        if (!outcome.definite) return outcome;
        // The recursion's residual is taken for the true one where both agree to rounding.
        if (!restarts.may_end() || recursion > goal || !system.confirm(x, r)) continue;
        if (norm > system.limits.cg_same_size * std::sqrt(outcome.least) * size) size = system.size(x);
        const double left = restarts.left(recursion, size);
        if (!restarts.accepts(left, size)) continue;
        outcome.correction = z;
        for (double& c : outcome.correction) c *= recursion > 0.0 ? left / recursion : 0.0;
        outcome.norm = left;
        outcome.residual = left / size;
        outcome.converged = true;
        return outcome;
    }
}

}  // namespace delam
