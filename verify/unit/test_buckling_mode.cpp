// SPDX-License-Identifier: BSD-3-Clause
// Buckling modes of a strut of masses and springs, whose modes are known in closed form.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "check.hpp"
#include "reduction/turned/buckling_mode.hpp"

using namespace delam;

namespace {

constexpr double pi = 3.141592653589793;

// D v, the negative second differences of a chain between supports.
std::vector<double> differences(std::span<const double> v) {
    std::vector<double> d(v.size());
    for (std::size_t i = 0; i < v.size(); ++i)
        d[i] = 2.0 * v[i] - (i > 0 ? v[i - 1] : 0.0) - (i + 1 < v.size() ? v[i + 1] : 0.0);
    return d;
}

// D^-1 f, by Green's function of the chain.
std::vector<double> inverse(std::span<const double> f) {
    const auto n = static_cast<double>(f.size() + 1);
    std::vector<double> v(f.size(), 0.0);
    for (std::size_t i = 0; i < f.size(); ++i)
        for (std::size_t j = 0; j < f.size(); ++j) {
            const auto a = static_cast<double>(std::min(i, j) + 1), b = static_cast<double>(std::max(i, j) + 1);
            v[i] += a * (n - b) / n * f[j];
        }
    return v;
}

std::vector<double> reversed(std::span<const double> v) { return {v.rbegin(), v.rend()}; }

// K = D^2 is the stiffness of a strut, G = load D what a force along it takes from it: the factors are load / (4 sin^2
// (j pi / (2 n + 2))), their modes sines.
BucklingMode mode_of(std::size_t n, double load, bool backwards) {
    const auto turned = [&](std::span<const double> v) {
        return backwards ? reversed(v) : std::vector<double>(v.begin(), v.end());
    };
    return buckling_mode(
        n, [&](std::span<const double> f) { return turned(inverse(inverse(turned(f)))); },
        [&](std::span<const double> v) {
            std::vector<double> g = differences(v);
            for (double& x : g) x *= load;
            return g;
        });
}

double factor_of(std::size_t n, double load, double j) {
    const double s = std::sin(j * pi / (2.0 * static_cast<double>(n) + 2.0));
    return load / (4.0 * s * s);
}

}  // namespace

// The largest, whatever its size, and also of a strut that has one mode or two.
LOOP_TEST(the_first_mode_is_a_sine, 0, 5) {
    constexpr std::size_t sizes[] = {1, 2, 3, 20, 60};
    const std::size_t n = sizes[loop];
    for (const double load : {1e-6, 1.0, 1e6}) {
        const BucklingMode mode = mode_of(n, load, false);
        ck_assert(mode.converged);
        ck_assert_double_eq_tol(mode.factor / factor_of(n, load, 1.0), 1.0, 1e-10);
        const double middle = std::sin(pi * std::floor(0.5 * static_cast<double>(n + 1)) / static_cast<double>(n + 1));
        for (std::size_t i = 0; i < n; ++i)
            ck_assert_double_eq_tol(mode.displacement[i],
                                    std::sin(pi * static_cast<double>(i + 1) / static_cast<double>(n + 1)) / middle,
                                    1e-5);
    }
}

// Tension stabilises: no factor is positive, and the largest is that of the shortest wave.
TEST(pulled_struts_have_no_positive_factor) {
    const BucklingMode few = mode_of(5, -1.0, false), many = mode_of(60, -1.0, false);
    ck_assert(few.converged);
    ck_assert_double_eq_tol(few.factor / factor_of(5, -1.0, 5.0), 1.0, 1e-9);
    ck_assert(many.factor <= factor_of(60, -1.0, 60.0) * (1.0 - 1e-9));
}

TEST(numbering_changes_nothing) {
    const BucklingMode a = mode_of(31, 1.0, false), b = mode_of(31, 1.0, true);
    ck_assert_double_eq_tol(a.factor, b.factor, 1e-10 * a.factor);
    for (std::size_t i = 0; i < 31; ++i) ck_assert_double_eq_tol(a.displacement[i], b.displacement[30 - i], 1e-5);
}

// Two equal waves of opposite signs: the first one is positive, whatever rounding makes the larger one.
TEST(rounding_does_not_decide_a_sign) {
    for (const double more : {-1e-15, 0.0, 1e-15})
        for (const double sign : {-1.0, 1.0}) {
            std::vector<double> mode{0.1 * sign, (1.0 + more) * sign, -1.0 * sign, -0.1 * sign};
            orient(mode);
            ck_assert(mode[1] > 0.0 && mode[2] < 0.0);
        }
}
