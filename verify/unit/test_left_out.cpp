// SPDX-License-Identifier: BSD-3-Clause
// The bound of the positions of a front that a sweep has not sampled, against all of them: energies that fall and costs
// that grow with each ring, some of which a path has told.
#include <algorithm>
#include <random>

#include "base/numbers.hpp"
#include "check.hpp"
#include "evolution/search/search_result.hpp"

using namespace delam;

namespace {

constexpr std::size_t rings = 40, in_ring = 3, base = 5;

struct Growth {
    std::vector<double> energy;  // [rings and 1]
    LeftOut left;
    PathCosts path;
    std::vector<double> cost;  // [pairs] that hold
};

Growth make_growth(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Growth g;
    g.energy.assign(1, 0.0);
    for (std::size_t n = 0; n < rings; ++n) g.energy.push_back(g.energy.back() - 4.0 * uniform(random));
    const std::size_t pairs = base + rings * in_ring;
    g.path.cost.assign(pairs, 0.0);
    g.path.broken.assign(pairs, 0);
    for (std::size_t p = 0; p < pairs; ++p) {
        g.cost.push_back(0.5 + uniform(random));
        g.path.broken[p] = uniform(random) < 0.6 ? 1 : 0;
        // What is not broken has cost less than it will.
        g.path.cost[p] = g.path.broken[p] != 0 ? g.cost[p] : 0.3 * g.cost[p];
    }
    // Those that the path has not broken cost no less than what holds for them; the others are known badly.
    const auto least = [&](std::size_t p) { return g.path.broken[p] != 0 ? 3.0 * uniform(random) : g.cost[p]; };
    g.left.least.assign(pairs, 0.0);
    for (std::size_t p = 0; p < base; ++p) g.left.least[p] = least(p);
    for (std::size_t n = 0, p = base; n < rings; ++n) {
        g.left.ring.emplace_back();
        g.left.ring_least.emplace_back();
        for (std::size_t i = 0; i < in_ring; ++i, ++p) {
            g.left.ring.back().push_back(static_cast<std::int64_t>(p));
            g.left.ring_least.back().push_back(least(p));
        }
    }
    return g;
}

double total(const Growth& g, std::size_t n) {
    double sum = g.energy[n];
    for (std::size_t p = 0; p < base + n * in_ring; ++p) sum += g.cost[p];
    return sum;
}

// Samples every `apart` rings; returns the lowest state between them.
double sample(Growth& g, std::size_t apart) {
    double lowest = infinite;
    for (std::size_t low = 0; low + apart <= rings; low += apart) {
        g.left.places.push_back({low + 1, g.energy[low + apart]});
        for (std::size_t n = low + 1; n <= low + apart; ++n) lowest = std::min(lowest, total(g, n));
    }
    return lowest;
}

}  // namespace

LOOP_TEST(a_bound_is_below_all_positions, 0, 50) {
    for (const std::size_t apart : {2U, 4U, 8U, 40U}) {
        Growth g = make_growth(static_cast<unsigned>(loop));
        const double lowest = sample(g, apart);
        ck_assert(g.left.bound(g.path) <= lowest + 1e-12);
    }
}

LOOP_TEST(every_ring_a_place, 0, 50) {
    Growth g = make_growth(static_cast<unsigned>(loop));
    const double lowest = sample(g, 1);
    ck_assert_double_eq_tol(g.left.bound(g.path), lowest, 1e-12);
}

TEST(several_sweeps) {
    SearchResult result;
    ck_assert(result.bound({}) == infinite);
    result.left_out.push_back({2.0, {}, {}, {}, {{0, 1.0}}});
    result.left_out.push_back({0.0, {0.0, 0.5}, {{0}}, {{0.25}}, {{0, 3.0}, {1, 1.0}}});
    ck_assert_double_eq_tol(result.bound({}), 1.75, 1e-15);
    // Pair 0 costs 2 along a path.
    ck_assert_double_eq_tol(result.bound({{2.0, 9.0}, {1, 0}}), 3.0, 1e-15);
}
