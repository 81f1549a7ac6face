// SPDX-License-Identifier: BSD-3-Clause
// Large dense operations run in panels, with a poll in between: the same matrices, the same digits with any number of
// threads, and an exception passes through at each panel.
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "base/team.hpp"
#include "check.hpp"
#include "linalg/dense/dense.hpp"

using namespace delam;

namespace {

constexpr std::int64_t n = 1400;  // a whole number of panels and a remainder

// Definite, with a decaying coupling.
DenseMatrix definite(std::int64_t size = n) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    DenseMatrix a(size, size);
    for (std::int64_t j = 0; j < size; ++j)
        for (std::int64_t i = j; i < size; ++i) a(i, j) = i == j ? 60.0 : value(random);
    mirror_lower(a);
    return a;
}

void clear_upper(DenseMatrix& a) {
    for (std::int64_t j = 0; j < a.columns; ++j)
        for (std::int64_t i = 0; i < j; ++i) a(i, j) = 0.0;
}

double distance(const DenseMatrix& a, const DenseMatrix& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.value.size(); ++i) largest = std::max(largest, std::abs(a.value[i] - b.value[i]));
    return largest;
}

TEST(factor) {
    const DenseMatrix a = definite();
    DenseMatrix lower = a, again = a;
    int polls = 0;
    ck_assert(factor_definite(lower, [&] { ++polls; }));
    ck_assert(factor_definite(again));
    ck_assert_int_gt(polls, 3);
    ck_assert(lower.value == again.value);
    clear_upper(lower);
    ck_assert(distance(lower_times_transpose(lower), a) <= 1e-11);
    DenseMatrix indefinite = a;
    indefinite(n - 1, n - 1) = -1.0;
    ck_assert(!factor_definite(indefinite));
}

TEST(inverse) {
    const DenseMatrix a = definite();
    const DenseMatrix product = multiply(inverse_definite(a), a);
    DenseMatrix unit(n, n);
    for (std::int64_t i = 0; i < n; ++i) unit(i, i) = 1.0;
    ck_assert(distance(product, unit) <= 1e-11);
}

TEST(products) {
    DenseMatrix lower = definite(), v = definite();
    ck_assert(factor_definite(lower));
    int polls = 0;
    DenseMatrix gram(n, n);
    add_gram(gram, v, [&] { ++polls; });
    ck_assert_int_gt(polls, 1);
    mirror_lower(gram);
    ck_assert(distance(gram, multiply(v, v)) <= 1e-9);
    polls = 0;
    solve_lower(lower, v, 0, [&] { ++polls; });
    ck_assert_int_gt(polls, 1);
    clear_upper(lower);
    ck_assert(distance(multiply(lower, v), definite()) <= 1e-11);
}

// All that is shared, in the order of a condensation.
std::vector<DenseMatrix> computed(std::int64_t threads) {
    constexpr std::int64_t rows = 800;
    const TeamScope team(threads);
    DenseMatrix lower = definite(rows), v = definite(rows), c = definite(rows), sum = definite(rows);
    ck_assert(factor_definite(lower));
    solve_lower(lower, v);
    DenseMatrix few = definite(rows);
    solve_lower(lower, few, rows / 3);
    subtract_gram(c, v);
    add_gram(sum, v);
    DenseMatrix left = lower;
    clear_upper(left);
    std::vector<DenseMatrix> all = {multiply(v, c), multiply_transposed(v, c, rows / 3), lower_times_transpose(left)};
    for (DenseMatrix* a : {&lower, &v, &few, &c, &sum}) all.push_back(std::move(*a));
    return all;
}

TEST(any_number_of_threads) {
    const std::vector<DenseMatrix> one = computed(1);
    for (const std::int64_t threads : {2, 3}) {
        const std::vector<DenseMatrix> more = computed(threads);
        for (std::size_t i = 0; i < one.size(); ++i) ck_assert_msg(more[i].value == one[i].value, "%zu", i);
    }
    DenseMatrix indefinite = definite();
    indefinite(n - 1, n - 1) = -1.0;
    const TeamScope team(2);
    ck_assert(!factor_definite(indefinite));
}

TEST(stopped) {
    int polls = 0;
    DenseMatrix a = definite();
    bool left = false;
    try {
        factor_definite(a, [&] {
            if (++polls == 2) throw std::runtime_error("enough");
        });
    } catch (const std::runtime_error&) {
        left = true;
    }
    ck_assert(left);
    ck_assert_int_eq(polls, 2);
}

}  // namespace
