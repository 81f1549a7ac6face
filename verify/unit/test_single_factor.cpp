// SPDX-License-Identifier: BSD-3-Clause
// A factor in single precision: its solutions against those in double precision, in any unit, until the next
// factorisation; and where it is refused.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/numbers.hpp"
#include "box_matrix.hpp"
#include "check.hpp"
#include "linalg/sparse/cholesky.hpp"

using namespace delam;
using unit::box;
using unit::wave;

namespace {

SparseMatrix scaled(SparseMatrix m, int power) {
    scale_by_power(m.value, power);
    return m;
}

std::vector<double> solution(const SparseCholesky& factor, const std::vector<double>& b) {
    std::vector<double> x(b.size());
    factor.solve(b, x);
    return x;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double d = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, std::abs(a[i] - b[i]));
    return d;
}

}  // namespace

TEST(has_the_digits_of_single_precision) {
    const SparseMatrix m = box(12, 11, 9);
    SparseCholesky factor(m);
    ck_assert(factor.factorise(m));
    const std::vector<double> b = wave(m.rows), exact = solution(factor, b);
    factor.keep_single();
    const std::vector<double> single = solution(factor, b);
    const double error = largest_difference(single, exact);
    ck_assert_double_lt(error, 1e-5 * max_abs(exact));
    ck_assert_double_gt(error, 1e-9 * max_abs(exact));  // in double precision there would be none
    factor.keep_single();
    ck_assert(solution(factor, b) == single);
    // Two right-hand sides, one after the other.
    std::vector<double> two = b;
    for (const double v : b) two.push_back(-3.0 * v + 1.0);
    const std::vector<double> both = solution(factor, two);
    ck_assert(std::equal(single.begin(), single.end(), both.begin()));
    ck_assert(solution(factor, {two.begin() + m.rows, two.end()}) ==
              std::vector<double>(both.begin() + m.rows, both.end()));
    // The next factorisation has all digits again.
    ck_assert(factor.factorise(m));
    ck_assert(solution(factor, b) == exact);
}

// Units are powers of two here: not a bit changes. Single precision itself ends at 2^128.
TEST(is_the_same_in_any_unit) {
    const SparseMatrix m = box(12, 11, 9);
    SparseCholesky factor(m);
    ck_assert(factor.factorise(m));
    factor.keep_single();
    const std::vector<double> b = wave(m.rows), x = solution(factor, b);
    for (const int power : {-600, -300, 300, 600})
        for (const int load : {-250, 0, 250}) {
            const SparseMatrix other = scaled(m, power);
            ck_assert(factor.factorise(other));
            factor.keep_single();
            std::vector<double> loaded = b;
            scale_by_power(loaded, load);
            std::vector<double> y = solution(factor, loaded);
            scale_by_power(y, power - load);
            ck_assert_msg(y == x, "matrix times 2^%d, load times 2^%d", power, load);
        }
    ck_assert(max_abs(solution(factor, std::vector<double>(b.size(), 0.0))) == 0.0);
}

// Rows far stiffer than the rest, as held rows are; and so much stiffer that single precision cannot hold both.
TEST(is_refused_where_pivots_are_too_far_apart) {
    const std::vector<double> b = wave(box(12, 11, 9).rows);
    for (const double stiff : {1e10, 1e30}) {
        SparseMatrix m = box(12, 11, 9);
        for (std::int64_t r = 0; r < m.rows; r += 7)
            for (std::int64_t e = m.start[index(r)]; e < m.start[index(r + 1)]; ++e)
                if (m.column[index(e)] == r) m.value[index(e)] += stiff;
        SparseCholesky factor(m);
        ck_assert(factor.factorise(m));
        const std::vector<double> exact = solution(factor, b);
        factor.keep_single();
        const double error = largest_difference(solution(factor, b), exact);
        if (stiff < 1e20)
            ck_assert(error > 0.0 && error < 1e-5 * max_abs(exact));
        else
            ck_assert(error == 0.0);
    }
}
