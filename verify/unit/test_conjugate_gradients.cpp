// SPDX-License-Identifier: BSD-3-Clause
// The iteration against a solution in closed form: how often it asks its preconditioner, that it finds out a recursion
// that drifts away from the true residual, that it stops at what rounding leaves, and that it recognises negative
// curvature.
#include "check.hpp"
#include "reduction/sparse/iterated/conjugate_gradients.hpp"

#include <cmath>
#include <vector>

#include "linalg/dense/dense.hpp"

using namespace delam;

namespace {

// A = diag(1 .. 40), preconditioned by diag(1 .. 40)^-1 but for five entries that are off by factors of 2 to 6.
struct Diagonal {
    std::vector<double> a, m, right;
    double noise = 0.0;  // of A's products, relative
    int preconditioned = 0, products = 0, sizes = 0;
    CgSystem cg;

    Diagonal() : a(40), m(40), right(40) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            a[i] = static_cast<double>(i + 1);
            m[i] = a[i] * (i < 5 ? static_cast<double>(i + 2) : 1.0);
            right[i] = std::sin(a[i]);
        }
        cg.apply = [this](std::span<const double> p, std::span<double> ap) {
            ++products;
            for (std::size_t i = 0; i < a.size(); ++i) ap[i] = a[i] * p[i] * (1.0 + noise * std::cos(7.0 * a[i]));
        };
        cg.precondition = [this](std::span<const double> r, std::span<double> z) {
            ++preconditioned;
            for (std::size_t i = 0; i < m.size(); ++i) z[i] = r[i] / m[i];
        };
        cg.restart = [this](std::span<double> x, std::span<double> r) { residual(x, r); };
        cg.size = [this](std::span<const double> x) {
            ++sizes;
            return size(x);
        };
        cg.rounding = [this](std::span<const double> x) { return 1e-15 * size(x); };
        cg.confirm = [this](std::span<const double> x, std::span<const double> r) {
            std::vector<double> own(r.size());
            residual(x, own);
            bool agrees = true;
            for (std::size_t i = 0; i < r.size(); ++i)
                agrees = agrees && std::abs(own[i] - r[i]) < 4e-15 * (std::abs(right[i]) + std::abs(a[i] * x[i]));
            return agrees;
        };
        cg.each_iteration = [](std::int64_t) {};
    }
    void residual(std::span<const double> x, std::span<double> r) const {
        for (std::size_t i = 0; i < r.size(); ++i) r[i] = right[i] - a[i] * x[i];
    }
    double size(std::span<const double> x) const {
        double energy = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) energy += a[i] * x[i] * x[i];
        return std::sqrt(energy);
    }
    // Error of the solution, in the energy norm.
    double off(std::span<const double> x) const {
        std::vector<double> e(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) e[i] = x[i] - right[i] / a[i];
        return size(e) / size(x);
    }
};

}  // namespace

// Six different eigenvalues: six iterations, and one preconditioned residual more.
TEST(a_confirmed_recursion_is_not_preconditioned_again) {
    Diagonal s;
    s.cg.rounded = 1e-15;
    std::vector<double> x(s.a.size(), 0.0);
    const CgOutcome outcome = conjugate_gradients(s.cg, x, 1e-12, 100);
    ck_assert(outcome.converged && outcome.residual <= 1e-12);
    ck_assert_int_eq(outcome.iterations, 6);
    ck_assert_int_eq(s.preconditioned, 7);
    ck_assert_double_le(s.off(x), 1e-11);
}

// A state that hardly changes keeps its size; one that begins at rest has none before its end.
TEST(the_size_is_found_once_where_it_stays) {
    Diagonal s;
    s.cg.rounded = 1e-15;
    std::vector<double> x(s.a.size(), 0.0);
    const CgOutcome cold = conjugate_gradients(s.cg, x, 1e-12, 100);
    ck_assert_int_eq(s.sizes, 2);
    for (double& v : s.right) v *= 1.01;
    s.sizes = 0;
    const CgOutcome warm = conjugate_gradients(s.cg, x, 1e-12, 100);
    ck_assert(cold.converged && warm.converged && warm.iterations > 0);
    ck_assert_int_eq(s.sizes, 1);
    ck_assert_double_le(s.off(x), 1e-11);
}

TEST(a_recursion_that_drifts_is_found_out) {
    Diagonal s;
    s.noise = 1e-6;
    s.cg.rounded = 1e-15;
    std::vector<double> x(s.a.size(), 0.0);
    const CgOutcome outcome = conjugate_gradients(s.cg, x, 1e-12, 100);
    ck_assert(outcome.converged);
    ck_assert_double_le(s.off(x), 1e-11);
}

// A tolerance that rounding does not allow: the answer is as good as it can be, and nothing is spent on more, neither
// where the level of rounding is known nor where it has to be estimated first.
TEST(stops_at_rounding) {
    for (const double known : {1e-13, 0.0}) {
        Diagonal s;
        s.cg.rounding = [&s](std::span<const double> x) { return 1e-13 * s.size(x); };
        s.cg.rounded = known;
        std::vector<double> x(s.a.size(), 0.0);
        const CgOutcome outcome = conjugate_gradients(s.cg, x, 1e-30, 100);
        ck_assert(outcome.converged && outcome.residual <= 3e-13);
        ck_assert_double_le(std::abs(outcome.rounded - 1e-13), 1e-20);
        ck_assert_double_le(s.off(x), 1e-12);
        // A start that is as good as rounding allows needs nothing.
        s.cg.rounded = outcome.rounded;
        ck_assert_int_eq(conjugate_gradients(s.cg, x, 1e-30, 100).iterations, 0);
    }
}

// A residual that may stay: the iteration ends there, and its true residual is no larger. Less than the tolerance
// allows is no reason to go on.
TEST(ends_where_it_is_enough) {
    std::int64_t before = 100;
    for (const double part : {0.0, 0.03, 0.3}) {
        Diagonal s;
        double begun = 0.0;
        s.cg.enough = [&](double first) { return part * (begun = first); };
        std::vector<double> x(s.a.size(), 0.0);
        const CgOutcome outcome = conjugate_gradients(s.cg, x, 1e-12, 100);
        ck_assert(outcome.converged && begun > 0.0);
        ck_assert_double_eq(outcome.first, begun);
        ck_assert_double_le(outcome.norm, std::max(1e-11, part) * begun);
        ck_assert_int_lt(outcome.iterations, before);
        // No more than its recursion and one check of the true residual.
        ck_assert_int_le(s.preconditioned, outcome.iterations + (part > 0.0 ? 1 : 3));
        before = outcome.iterations;
    }
    Diagonal s;
    s.cg.enough = [](double) { return 1e-30; };
    std::vector<double> x(s.a.size(), 0.0);
    ck_assert_double_le(conjugate_gradients(s.cg, x, 1e-3, 100).residual, 1e-3);
}

TEST(negative_curvature_is_recognised) {
    Diagonal s;
    s.a[3] = -1.0;
    std::vector<double> x(s.a.size(), 0.0);
    ck_assert(!conjugate_gradients(s.cg, x, 1e-12, 100).definite);
}
