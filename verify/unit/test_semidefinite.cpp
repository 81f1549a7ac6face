// SPDX-License-Identifier: BSD-3-Clause
// Independent rows of sparse matrices, and the generalised inverse of their Gram matrices: chains and grids of rigid
// bodies, held and floating, whose rank follows from mechanics; dependent rows at random; what the memory grows with.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "check.hpp"
#include "counting_allocator.hpp"
#include "linalg/sparse/semidefinite.hpp"

using namespace delam;

namespace {

struct Rows {
    std::vector<Triplet> entries;  // of G^T: multiplier, motion, value
    std::int64_t multipliers = 0, motions = 0;

    SparseMatrix g() const {
        std::vector<Triplet> t;
        for (const Triplet& e : entries) t.push_back({e.column, e.row, e.value});
        return from_triplets(motions, multipliers, std::move(t));
    }
};

// Squares of unit side in the plane, three motions each, glued at the corners that they share; `held` corners of the
// first row of squares are fixed.
Rows squares(int along, int across, int held) {
    Rows rows;
    rows.motions = 3 * along * across;
    const auto body = [&](int i, int j) { return static_cast<std::int64_t>(j) * along + i; };
    const auto motion = [&](int i, int j, double x, double y, double sign) {
        for (int c = 0; c < 2; ++c) {
            rows.entries.push_back({rows.multipliers + c, 3 * body(i, j) + c, sign});
            const double arm = c == 0 ? -(y - (j + 0.5)) : x - (i + 0.5);
            rows.entries.push_back({rows.multipliers + c, 3 * body(i, j) + 2, sign * arm});
        }
    };
    const auto glue = [&](int i, int j, int k, int l, double x, double y) {
        motion(i, j, x, y, 1.0);
        motion(k, l, x, y, -1.0);
        rows.multipliers += 2;
    };
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < along; ++i)
            for (int end = 0; end < 2; ++end) {
                if (i + 1 < along) glue(i, j, i + 1, j, i + 1.0, j + end);
                if (j + 1 < across) glue(i, j, i, j + 1, i + end, j + 1.0);
            }
    for (int h = 0; h < held; ++h) {
        motion(h, 0, h, 0.0, 1.0);
        rows.multipliers += 2;
    }
    return rows;
}

void expect_rank(const Rows& rows, std::int64_t rank, const char* what) {
    const SparseMatrix g = rows.g(), gt = transpose(g);
    const std::vector<double> one(static_cast<std::size_t>(g.columns), 1.0);
    const std::vector<std::int64_t> kept = independent_rows(g, gt, one, 1e-11);
    ck_assert_msg(static_cast<std::int64_t>(kept.size()) == rank, "%s: rank %zu instead of %ld of %ld", what,
                  kept.size(), static_cast<long>(rank), static_cast<long>(g.rows));
    ck_assert(std::is_sorted(kept.begin(), kept.end()));
    // A consistent system A x = A y: the solution has the same G^T x as y.
    const SparseMatrix a = weighted_gram(g, gt, one);
    SemidefiniteFactor factor(a, kept);
    factor.factorise(a);
    std::vector<double> y(static_cast<std::size_t>(g.rows)), x(y.size()), s(one.size()), t(one.size());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = 1.0 + static_cast<double>(i % 7);
    multiply(a, y, x);
    factor.solve(x);
    multiply(gt, x, s);
    multiply(gt, y, t);
    for (std::size_t i = 0; i < s.size(); ++i) ck_assert_double_lt(std::abs(s[i] - t[i]), 1e-6);
    for (std::size_t i = 0, k = 0; i < x.size(); ++i) {
        if (k < kept.size() && kept[k] == static_cast<std::int64_t>(i))
            ++k;
        else
            ck_assert(x[i] == 0.0);
    }
}

}  // namespace

TEST(rank_of_rigid_bodies) {
    expect_rank(squares(1, 1, 1), 2, "one square that turns about a corner");
    expect_rank(squares(1, 1, 0), 0, "one square without a row");
    for (const int n : {2, 10, 100, 400}) {
        expect_rank(squares(n, 1, 0), 3 * n - 3, "a floating chain");
        expect_rank(squares(n, 1, 1), 3 * n - 1, "a chain that turns about a corner");
        expect_rank(squares(n, 1, 2), 3 * n, "a chain held at two corners");
    }
    expect_rank(squares(20, 20, 0), 1197, "a floating grid");
    expect_rank(squares(20, 20, 3), 1200, "a grid held at three corners");
    expect_rank(squares(100, 6, 0), 1797, "a long floating grid");
}

// Columns that do not carry: pieces come off, each with its own motions; nothing is left of all.
TEST(rows_that_carry_nothing_are_out) {
    const int n = 30;
    const Rows rows = squares(n, 1, 2);
    const SparseMatrix g = rows.g(), gt = transpose(g);
    std::vector<double> carries(static_cast<std::size_t>(g.columns), 1.0);
    for (const int cut : {10, 20})
        for (int k = 0; k < 4; ++k) carries[static_cast<std::size_t>(4 * cut + k)] = 0.0;
    ck_assert_int_eq(static_cast<int>(independent_rows(g, gt, carries, 1e-11).size()), 3 * n - 6);
    carries[static_cast<std::size_t>(4 * 10)] = 1.0;  // a hinge in one direction
    ck_assert_int_eq(static_cast<int>(independent_rows(g, gt, carries, 1e-11).size()), 3 * n - 5);
    std::fill(carries.begin(), carries.end(), 0.0);
    ck_assert(independent_rows(g, gt, carries, 1e-11).empty());
}

// Rows that are sums of others among rows of very different sizes, in an arbitrary order. The pivots of the Gram matrix
// alone do not tell their rank: cancellation leaves more than 1e-11.
TEST(rank_of_random_rows) {
    std::mt19937 random(20261123);
    const auto uniform = [&] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
    for (std::size_t round = 0; round < 20; ++round) {
        const std::size_t base = 30 + round, extra = 5 + round % 7;
        std::vector<std::vector<double>> row(base + extra, std::vector<double>(200, 0.0));
        for (std::size_t r = 0; r < base; ++r) {
            const double size = std::pow(10.0, 2.5 * uniform());
            row[r][3 * r] = size;
            for (int k = 0; k < 5; ++k) row[r][150 + random() % 50] = 0.4 * size * uniform();
        }
        for (std::size_t r = base; r < row.size(); ++r)
            for (int k = 0; k < 3; ++k) {
                const std::vector<double>& other = row[random() % base];
                for (std::size_t c = 0; c < 200; ++c) row[r][c] += other[c] * (k + 1);
            }
        std::shuffle(row.begin(), row.end(), random);
        Rows rows;
        rows.motions = static_cast<std::int64_t>(row.size());
        rows.multipliers = 200;
        for (std::size_t r = 0; r < row.size(); ++r)
            for (std::size_t c = 0; c < 200; ++c)
                if (row[r][c] != 0.0)
                    rows.entries.push_back({static_cast<std::int64_t>(c), static_cast<std::int64_t>(r), row[r][c]});
        const SparseMatrix g = rows.g();
        const std::vector<double> one(200, 1.0);
        ck_assert_int_eq(static_cast<int>(independent_rows(g, transpose(g), one, 1e-11).size()),
                         static_cast<int>(base));
    }
}

// Memory grows with the motions, not with their square.
TEST(memory_grows_with_the_rows) {
    if (!unit::counting) return;
    const auto peak = [](int n) {
        const Rows rows = squares(n, n, 0);
        const SparseMatrix g = rows.g(), gt = transpose(g);
        const std::vector<double> one(static_cast<std::size_t>(g.columns), 1.0);
        const long before = unit::live_bytes;
        unit::peak_bytes = before;
        const SparseMatrix a = weighted_gram(g, gt, one);
        SemidefiniteFactor factor(a, independent_rows(g, gt, one, 1e-11));
        factor.factorise(a);
        return static_cast<double>(unit::peak_bytes - before);
    };
    const double small = peak(16), large = peak(48);  // 768 and 6912 motions: nine times, a dense matrix 81 times
    ck_assert_double_lt(large, 18.0 * small);
    ck_assert_double_lt(large, 0.1 * 16.0 * 6912.0 * 6912.0);
}
