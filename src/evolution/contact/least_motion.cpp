// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/contact/least_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// A row whose normal has less than this part outside the span of others depends on them. (Measured by
// verify/bench/constants.py on 250 random scenes: from a hundredth to a hundred times all decide alike.)
constexpr double dependent = 1e-9;

// The part of a vector outside the span of unit vectors, and the coefficients of the rest.
struct Split {
    std::vector<double> outside, coefficient;
};

Split split(std::span<const double> vector, const std::vector<std::span<const double>>& others) {
    Split result{{vector.begin(), vector.end()}, std::vector<double>(others.size(), 0.0)};
    const auto n = static_cast<std::int64_t>(others.size());
    if (n == 0) return result;
    for (int pass = 0; pass < 2; ++pass) {
        DenseMatrix gram(n, n), right(n, 1);
        for (std::int64_t i = 0; i < n; ++i) {
            right(i, 0) = dot(others[index(i)], result.outside);
            for (std::int64_t j = 0; j < n; ++j) gram(i, j) = dot(others[index(i)], others[index(j)]);
        }
        if (!solve_general(gram, right, 0.0)) break;
        for (std::int64_t i = 0; i < n; ++i) {
            result.coefficient[index(i)] += right(i, 0);
            add_scaled(-right(i, 0), others[index(i)], result.outside);
        }
    }
    return result;
}

// The row that is open least, by less than -slack; `rows`: there is none.
template <class Opening>
std::size_t deepest(const Opening& opening, std::size_t rows, double slack) {
    std::size_t worst = rows;
    double least = -slack;
    for (std::size_t r = 0; r < rows; ++r)
        if (const double own = opening(r); own < least) {
            least = own;
            worst = r;
        }
    return worst;
}

}  // namespace

LeastMotion least_motion(const DenseMatrix& gram, std::span<const double> pull, const DenseMatrix& normals,
                         std::span<const double> gap, double slack) {
    // In b = L^T a, G = L L^T, the objective is 1/2 |b - L^-1 p|^2; rows have unit normals there.
    DenseMatrix lower = gram;
    if (!factor_definite(lower)) fail(DELAM_ERROR_NUMERICAL, "motions of free parts depend on each other");
    const auto motions = index(gram.rows), rows = gap.size();
    std::vector<double> b(pull.begin(), pull.end());
    solve_lower(lower, b);
    std::vector<std::vector<double>> normal(rows);
    std::vector<double> length(rows, 0.0);
    double longest = 0.0;
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < motions; ++c)
            normal[r].push_back(normals(static_cast<std::int64_t>(r), static_cast<std::int64_t>(c)));
        solve_lower(lower, normal[r]);
        length[r] = std::sqrt(dot(normal[r], normal[r]));
        longest = std::max(longest, length[r]);
    }
    const auto moved = [&](std::size_t r) { return length[r] > 0.0 && length[r] > dependent * longest; };
    for (std::size_t r = 0; r < rows; ++r)
        for (double& n : normal[r]) n /= moved(r) ? length[r] : 1.0;

    LeastMotion result;
    std::vector<std::size_t> active;
    std::vector<double> multiplier;  // of the active rows
    const auto leave = [&](std::size_t k) {
        active.erase(active.begin() + static_cast<std::ptrdiff_t>(k));
        multiplier.erase(multiplier.begin() + static_cast<std::ptrdiff_t>(k));
    };
    const std::size_t most = 50 * (rows + motions);  // far above what exact arithmetic needs
    for (std::size_t step = 0; step < most && result.blocked.empty(); ++step) {
        const std::size_t worst = deepest(
            [&](std::size_t r) {
                const bool passed = !moved(r) || std::find(active.begin(), active.end(), r) != active.end();
                return passed ? 0.0 : gap[r] + length[r] * dot(normal[r], b);
            },
            rows, slack);
        if (worst == rows) break;
        double own = 0.0;  // multiplier of the row that enters
        while (true) {
            std::vector<std::span<const double>> others;
            for (const std::size_t r : active) others.emplace_back(normal[r]);
            const Split toward = split(normal[worst], others);
            std::size_t first = active.size();
            double until = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < active.size(); ++k)
                if (toward.coefficient[k] > dependent && multiplier[k] / toward.coefficient[k] < until) {
                    until = multiplier[k] / toward.coefficient[k];
                    first = k;
                }
            const double slope = dot(toward.outside, toward.outside);
            const bool moves = slope > dependent * dependent;
            if (!moves && first == active.size()) {
                result.blocked = active;
                result.blocked.push_back(worst);
                break;
            }
            const double opening = gap[worst] / length[worst] + dot(normal[worst], b);
            const double whole = moves ? -opening / slope : std::numeric_limits<double>::infinity();
            const double taken = std::min(whole, until);
            if (moves) add_scaled(taken, toward.outside, b);
            for (std::size_t k = 0; k < active.size(); ++k) multiplier[k] -= taken * toward.coefficient[k];
            own += taken;
            if (whole <= until) {
                active.push_back(worst);
                multiplier.push_back(own);
                break;
            }
            leave(first);
        }
    }
    solve_lower_transposed(lower, b);
    result.motion = std::move(b);
    std::sort(result.blocked.begin(), result.blocked.end());
    result.touched = std::move(active);
    std::sort(result.touched.begin(), result.touched.end());
    return result;
}

}  // namespace delam
