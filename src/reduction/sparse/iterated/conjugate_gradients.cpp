// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

constexpr int restarts = 8;
constexpr std::size_t most_directions = 60;  // kept conjugate; older ones are forgotten
constexpr double recursion_goal = 0.3;       // of the target, so that the true residual meets it too
constexpr double gained = 0.5;               // a restart that leaves more of the residual has met rounding
constexpr double largest_residual = 1e-5;    // that rounding may excuse: an error of 1e-10 of the energy
constexpr double rounding_slack = 30.0;      // the estimate of rounding is one of its size, not a bound
constexpr double far_from_rounding = 1e-8;   // a residual of which it need not be known
constexpr double at_rounding = 3.0;          // times that estimate: another restart would gain nothing
constexpr std::size_t judged = 5;            // iterations, before their gain says anything about the others
constexpr double accelerates = 1.5;          // conjugate gradients become faster
// An error of less than this part of the size of the state leaves the size as it is.
constexpr double same_size = 0.03;
// Of r^T z: below it a curvature is zero but for rounding.
constexpr double flat = 1e-13;

// Whether what the iterations so far have gained says that the limit will not do.
bool hopeless(double gained_by_now, double needed, std::size_t iterations, std::int64_t limit) {
    if (iterations < judged) return false;
    const double per_iteration = std::log(gained_by_now) / static_cast<double>(iterations);
    return !(per_iteration < 0.0) || std::log(needed) / per_iteration > accelerates * static_cast<double>(limit);
}

// Of the tridiagonal matrix that the recursion implies (Lanczos; G. Golub, C. Van Loan, Matrix Computations, 10.2).
double least_eigenvalue(std::span<const double> steps, std::span<const double> shares) {
    const std::size_t n = std::min(steps.size(), most_directions);
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
    double lowest = infinite, first = 0.0;
    std::vector<double> steps, shares;  // alpha and beta of the recursion
    int idle = 0;
    double rz_before = 0.0;
    const auto conjugate = [&](const Direction& d) { add_scaled(-dot(d.ap, z) / d.pap, d.p, z); };
    while (true) {
        for (int pass = 0; pass < 2; ++pass) {
            for (const Direction& d : system.given) conjugate(d);
            for (const Direction& d : directions) conjugate(d);
        }
        const double rz = dot(r, z), norm = std::sqrt(std::abs(rz));
        idle = norm < 0.9 * lowest ? 0 : idle + 1;
        lowest = std::min(lowest, norm);
        reached = norm;
        if (steps.empty())
            first = norm;
        else
            shares.push_back(rz / rz_before);
        rz_before = rz;
        const bool over = outcome.iterations >= limit || idle > 20 ||
                          (system.attempt && hopeless(norm / first, target / first, steps.size(), limit));
        if (norm <= target || over) {
            outcome.least = std::min(outcome.least, least_eigenvalue(steps, shares));
            return true;
        }
        system.apply(z, ap);
        const double pap = dot(z, ap);
        if (!(pap > 0.0)) return !(pap <= -flat * std::abs(rz));  // what is not finite has no sign
        const double step = rz / pap;
        steps.push_back(step);
        add_scaled(step, z, x);
        add_scaled(-step, ap, r);
        if (directions.size() == most_directions) directions.erase(directions.begin());
        directions.push_back({z, ap, pap});
        system.each_iteration(++outcome.iterations);
        system.precondition(r, z);
    }
}

}  // namespace

CgOutcome conjugate_gradients(const CgSystem& system, std::span<double> x, double tolerance, std::int64_t limit) {
    CgOutcome outcome;
    std::vector<double> r(x.size()), z(x.size()), best;
    double before = infinite;
    outcome.rounded = system.rounded;
    for (int round = 0;; ++round) {
        system.restart(x, r);
        double size = system.size(x);
        system.precondition(r, z);
        const double norm = std::sqrt(std::abs(dot(r, z)));
        const double relative = norm == 0.0 ? 0.0 : norm / std::max(size, norm);
        if (round == 0) {
            outcome.first = norm;
            const double enough = system.enough ? system.enough(norm) : 0.0;
            if (norm > 0.0) tolerance = std::max(tolerance, relative * enough / norm);
        }
        bool reached = relative <= tolerance;
        if (!reached && round > 0 && !(outcome.rounded > 0.0) && size > 0.0)
            outcome.rounded = system.rounding(x) / size;
        const double excused = (round == 0 ? recursion_goal : at_rounding) * outcome.rounded;
        reached = reached || relative <= std::min(largest_residual, excused);
        if (round == 0 || norm < before) {
            outcome.residual = relative;
            outcome.norm = norm;
            best.assign(x.begin(), x.end());
            outcome.correction = z;
        }
        if (reached) {
            outcome.converged = true;
            return outcome;
        }
        if (!(norm <= gained * before) || round == restarts || outcome.iterations >= limit) {
            std::copy(best.begin(), best.end(), x.begin());
            outcome.converged = outcome.residual <= std::min(largest_residual, rounding_slack * outcome.rounded);
            return outcome;
        }
        before = norm;
        const double goal = recursion_goal * std::max(tolerance, outcome.rounded) * std::max(size, norm);
        double left = infinite;
        outcome.definite = descend(system, x, r, z, goal, limit, outcome, left);
        if (!outcome.definite) return outcome;
        const bool rounding_matters = !(outcome.rounded > 0.0) && tolerance < far_from_rounding;
        if (rounding_matters || left > goal) continue;
        if (!system.confirm(x, r)) continue;
        if (norm > same_size * std::sqrt(outcome.least) * size) size = system.size(x);
        const double recursion = std::exchange(left, std::hypot(left, outcome.rounded * size));
        if (left > std::max(tolerance, at_rounding * outcome.rounded) * size) continue;
        outcome.correction = z;
        for (double& c : outcome.correction) c *= recursion > 0.0 ? left / recursion : 0.0;
        outcome.norm = left;
        outcome.residual = left / size;
        outcome.converged = true;
        return outcome;
    }
}

}  // namespace delam
