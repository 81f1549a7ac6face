// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/projected_cg.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense/dense.hpp"
#include "reduction/feti/descent.hpp"

namespace delam {

namespace {

// The directions of a recursion, with their images: A-orthogonal to each other.
class Directions {
public:
    explicit Directions(const Limits& limits) : limits_(limits) {}
    bool empty() const { return kept_.empty(); }
    // z <- z - sum_k (p_k^T A z / p_k^T A p_k) p_k, twice, because the first time leaves rounding.
    void orthogonalise(std::span<double> z) const {
        for (int pass = 0; pass < 2; ++pass)
            for (const Direction& d : kept_) add_scaled(-dot(d.ap, z) / d.pap, d.p, z);
    }
    void keep(std::span<const double> p, std::span<const double> ap, double pap) {
        if (kept_.size() == static_cast<std::size_t>(limits_.feti_kept)) kept_.erase(kept_.begin());
        kept_.push_back({{p.begin(), p.end()}, {ap.begin(), ap.end()}, pap});
    }

private:
    struct Direction {
        std::vector<double> p, ap;
        double pap;
    };
    const Limits& limits_;
    std::vector<Direction> kept_;
};

}  // namespace

// A round:      r = P^T (b - A lambda)
// An iteration: z = P M r,  p = z made A-orthogonal to all directions before,  s = p^T r / p^T A p,
//               lambda <- lambda + s p,  r <- r - s P^T A p
CgResult projected_cg(const ProjectedSystem& system, std::span<const double> b, std::span<double> lambda,
                      const CgGoal& goal, const std::function<void(std::int64_t)>& each_iteration) {
    const Limits& limits = goal.limits;
    const std::size_t n = b.size();
    CgResult result;
    std::vector<double> a_lambda(n), r(n), z(n), ap(n), best, at_lowest;
    double floor = goal.floor;
    Rounds rounds(limits);
    while (true) {
        system.balance(lambda);  // long steps near rounding leave the space a little
        system.apply(lambda, a_lambda);
        for (std::size_t i = 0; i < n; ++i) r[i] = b[i] - a_lambda[i];
        system.project_transposed(r);
        if (rounds.begun() == 0)
            floor = std::max(floor, limits.feti_rounding * std::sqrt(std::max(0.0, dot(lambda, a_lambda))));
        Directions directions(limits);
        Lowest lowest(limits.feti_noticed);
        while (true) {
            system.precondition(r, z);
            system.project(z);
            // Negative values of r^T z are rounding; their size says how much of it there is.
            const double norm = std::sqrt(std::abs(dot(r, z)));
            const double energy = std::sqrt(std::max(dot(lambda, a_lambda), norm * norm));
            const bool reached = norm <= std::max(goal.tolerance * energy, floor);
            if (lowest.take(norm)) at_lowest.assign(lambda.begin(), lambda.end());
            if (directions.empty()) {
                if (rounds.begin(norm)) {
                    best.assign(lambda.begin(), lambda.end());
                    result.residual = energy > 0.0 ? norm / energy : 0.0;
                    result.converged = reached || norm <= limits.feti_slack * floor ||
                                       result.residual <= limits.feti_slack * goal.tolerance;
                }
                if (reached || rounds.over() || result.iterations >= goal.limit) {
                    std::copy(best.begin(), best.end(), lambda.begin());
                    return result;
                }
            } else if (reached || result.iterations >= goal.limit ||
                       (lowest.norm() <= limits.feti_near_rounding * floor &&
                        (lowest.idle() >= limits.feti_idle || norm > limits.feti_growth * lowest.norm()))) {
                break;  // and go on from the lowest point
            }
            directions.orthogonalise(z);
            system.apply(z, ap);
            system.project_transposed(ap);
            const double pap = dot(z, ap);
            if (!(pap > 0.0)) break;  // the space is exhausted
            const double step = dot(z, r) / pap;
            add_scaled(step, z, lambda);
            add_scaled(step, ap, a_lambda);  // up to G^T alpha, to which balanced forces are orthogonal
            add_scaled(-step, ap, r);
            directions.keep(z, ap, pap);
            each_iteration(++result.iterations);
        }
        std::copy(at_lowest.begin(), at_lowest.end(), lambda.begin());
    }
}

}  // namespace delam
