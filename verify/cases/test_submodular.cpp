// SPDX-License-Identifier: BSD-3-Clause
// The minimum-norm point against enumeration: cuts of random graphs and coverages with prices, for which the dual bound
// is exact.
#include <algorithm>
#include <random>

#include "submodular.hpp"
#include "support.hpp"

namespace {

using reference::Set;

constexpr std::size_t n = 12;

// Sum of the capacities between a set and its complement, plus a price of either sign for each member: submodular.
struct Cut {
    std::vector<double> capacity = std::vector<double>(n * n, 0.0);
    std::vector<double> price = std::vector<double>(n, 0.0);
    double operator()(const Set& set) const {
        double value = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            if (set[i] == 0) continue;
            value += price[i];
            for (std::size_t j = 0; j < n; ++j) value += set[j] == 0 ? capacity[i * n + j] : 0.0;
        }
        return value;
    }
};

Cut make_cut(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Cut cut;
    for (double& c : cut.capacity) c = uniform(random) < 0.4 ? uniform(random) : 0.0;
    for (double& p : cut.price) p = 4.0 * uniform(random) - 2.5;
    return cut;
}

template <class Function>
double enumerate(const Function& f) {
    double least = 0.0;
    for (unsigned code = 0; code < (1U << n); ++code) {
        Set set(n, 0);
        for (std::size_t i = 0; i < n; ++i) set[i] = (code >> i) & 1U;
        least = std::min(least, f(set));
    }
    return least;
}

LOOP_TEST(cuts, 0, 20) {
    const Cut cut = make_cut(static_cast<unsigned>(loop));
    const auto found = reference::minimise_submodular(n, cut, 1000);
    const double exact = enumerate(cut);
    cases::expect(found.converged, "not converged");
    cases::expect_near(found.value, exact, 1e-12, 10.0, "least value");
    cases::expect_near(found.bound, exact, 1e-8, 10.0, "dual bound");
    cases::expect_near(cut(found.best), found.value, 1e-14, 10.0, "value of the set");
}

// Minus part * sqrt(|A|), whose marginals -part (sqrt(m+1) - sqrt(m)) grow from -part to 0: violations smaller than
// `part`, so that the corrected bound holds.
LOOP_TEST(correction_for_violations, 0, 20) {
    const Cut cut = make_cut(static_cast<unsigned>(loop));
    const double part = 0.3;
    const auto f = [&](const Set& set) {
        const auto size = static_cast<double>(std::count(set.begin(), set.end(), std::uint8_t{1}));
        return cut(set) - part * std::sqrt(size);
    };
    const auto found = reference::minimise_submodular(n, f, 200);
    cases::expect_below(reference::dual_bound(found.dual, part), enumerate(f) + 1e-12, "corrected bound");
}

}  // namespace
