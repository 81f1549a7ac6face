// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/projected_cg.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

struct Direction {
    std::vector<double> p;
    std::vector<double> ap;
    double pap;
};

constexpr std::size_t kept_directions = 400;  // beyond that the memory is better used elsewhere
constexpr int rounds = 6;
// Close to rounding the kept directions lose their conjugacy: the residual stops, then grows. A restart from there
// converges again.
constexpr int idle_limit = 100;
constexpr double growth_limit = 1e3;
constexpr double noise_zone = 1e3;          // times the floor of rounding
constexpr double start_rounding = 1e-14;    // of the energy norm of the start
constexpr double stagnation_slack = 100.0;  // times the tolerance or the floor

}  // namespace

CgResult projected_cg(const ProjectedSystem& system, std::span<const double> b, std::span<double> lambda,
                      double tolerance, double floor, std::int64_t limit,
                      const std::function<void(std::int64_t)>& each_iteration) {
    const std::size_t n = b.size();
    CgResult result;
    std::vector<double> a_lambda(n), r(n), z(n), ap(n), best, at_lowest;
    double best_norm = INFINITY;  // sqrt |r^T z| of the best start of a round, a true residual
    for (int round = 0;; ++round) {
        system.balance(lambda);  // long steps near rounding leave the space a little
        system.apply(lambda, a_lambda);
        for (std::size_t i = 0; i < n; ++i) r[i] = b[i] - a_lambda[i];
        system.project_transposed(r);
        if (round == 0) floor = std::max(floor, start_rounding * std::sqrt(std::max(0.0, dot(lambda, a_lambda))));
        std::vector<Direction> directions;
        double lowest = INFINITY;  // of this round's recursion, and how long it has not moved
        int idle = 0;
        while (true) {
            system.precondition(r, z);
            system.project(z);
            // Negative values of r^T z are rounding; their size says how much of it there is.
            const double norm = std::sqrt(std::abs(dot(r, z)));
            const double energy = std::sqrt(std::max(dot(lambda, a_lambda), norm * norm));
            const double target = std::max(tolerance * energy, floor);
            const bool reached = norm <= target;
            idle = norm < 0.99 * lowest ? 0 : idle + 1;
            if (norm < lowest) {
                lowest = norm;
                at_lowest.assign(lambda.begin(), lambda.end());
            }
            if (directions.empty()) {
                const bool stagnated = norm > 0.5 * best_norm;  // a restart that gains nothing has met rounding
                if (norm < best_norm) {
                    best_norm = norm;
                    best.assign(lambda.begin(), lambda.end());
                    result.residual = energy > 0.0 ? norm / energy : 0.0;
                    result.converged =
                        reached || norm <= stagnation_slack * floor || result.residual <= stagnation_slack * tolerance;
                }
                if (reached || stagnated || result.iterations >= limit || round == rounds) {
                    std::copy(best.begin(), best.end(), lambda.begin());
                    return result;
                }
            } else if (reached || result.iterations >= limit ||
                       (lowest <= noise_zone * floor && (idle >= idle_limit || norm > growth_limit * lowest))) {
                break;  // and go on from the lowest point
            }
            for (int pass = 0; pass < 2; ++pass)
                for (const Direction& d : directions) add_scaled(-dot(d.ap, z) / d.pap, d.p, z);
            system.apply(z, ap);
            system.project_transposed(ap);
            const double pap = dot(z, ap);
            if (!(pap > 0.0)) break;  // the space is exhausted
            const double step = dot(z, r) / pap;
            add_scaled(step, z, lambda);
            add_scaled(step, ap, a_lambda);  // up to G^T alpha, to which balanced forces are orthogonal
            add_scaled(-step, ap, r);
            if (directions.size() == kept_directions) directions.erase(directions.begin());
            directions.push_back({z, ap, pap});
            each_iteration(++result.iterations);
        }
        std::copy(at_lowest.begin(), at_lowest.end(), lambda.begin());
    }
}

}  // namespace delam
