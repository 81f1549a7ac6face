// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/projected_cg.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"

namespace delam {

namespace {

struct Direction {
    std::vector<double> p;
    std::vector<double> ap;
    double pap;
};

constexpr std::size_t kept_directions = 400;  // beyond that the memory is better used elsewhere
constexpr int restarts = 4;
constexpr double rounding = 1e-14;  // of the energy norm of the start
constexpr double stagnation_slack = 100.0;  // times the tolerance or the floor

}  // namespace

CgResult projected_cg(const ProjectedSystem& system, std::span<const double> b, std::span<double> lambda, double tolerance,
                      double floor, std::int64_t limit, const std::function<void(std::int64_t)>& each_iteration) {
    const std::size_t n = b.size();
    CgResult result;
    std::vector<double> a_lambda(n), r(n), z(n), ap(n);
    double previous = INFINITY;
    for (int round = 0; round < restarts; ++round) {
        system.apply(lambda, a_lambda);
        for (std::size_t i = 0; i < n; ++i) r[i] = b[i] - a_lambda[i];
        system.project_transposed(r);
        if (round == 0) floor = std::max(floor, rounding * std::sqrt(std::max(0.0, dot(lambda, a_lambda))));
        std::vector<Direction> directions;
        while (true) {
            system.precondition(r, z);
            system.project(z);
            const double rz = std::max(0.0, dot(r, z));
            const double energy = std::max(dot(lambda, a_lambda), rz);
            result.residual = energy > 0.0 ? std::sqrt(rz / energy) : 0.0;
            const bool reached = result.residual <= tolerance || std::sqrt(rz) <= floor;
            if (directions.empty()) {  // the residual is a true one here
                // Rounding bounds what can be reached: a restart that gains nothing has met that bound.
                const bool stagnated = result.residual > 0.5 * previous;
                result.converged = reached || (stagnated && (result.residual <= stagnation_slack * tolerance ||
                                                             std::sqrt(rz) <= stagnation_slack * floor));
                if (reached || stagnated || result.iterations >= limit) return result;
                previous = result.residual;
            } else if (reached || result.iterations >= limit) {
                break;
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
    }
    // The last round ended by its recursion; its true residual has not been measured again.
    result.converged = result.residual <= stagnation_slack * tolerance;
    return result;
}

}  // namespace delam
