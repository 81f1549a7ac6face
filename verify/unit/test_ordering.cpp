// SPDX-License-Identifier: BSD-3-Clause
// The order of a sparse factor: nested dissection where it needs fewer operations than minimum degree, the trailing
// variables last, the same bits whatever the host did before, and the host's signal handlers and random numbers left
// alone.
#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "box_matrix.hpp"
#include "check.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "linalg/sparse/dissection.hpp"
#include "linalg/sparse/elimination_order.hpp"
#include "linalg/sparse/equal_rows.hpp"

using namespace delam;
using unit::box;
using unit::wave;

namespace {

// The matrix with its variables in another order.
SparseMatrix reordered(const SparseMatrix& m, const std::vector<std::int64_t>& order) {
    std::vector<std::int64_t> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        place[static_cast<std::size_t>(order[i])] = static_cast<std::int64_t>(i);
    std::vector<Triplet> t;
    for (std::size_t r = 0; r < order.size(); ++r)
        for (std::int64_t e = m.start[r]; e < m.start[r + 1]; ++e)
            t.push_back({place[r], place[static_cast<std::size_t>(m.column[static_cast<std::size_t>(e)])],
                         m.value[static_cast<std::size_t>(e)]});
    return from_triplets(m.rows, m.columns, std::move(t));
}

std::vector<double> solution(const SparseMatrix& m) {
    SparseCholesky factor(m);
    ck_assert(factor.factorise(m));
    std::vector<double> b = wave(m.rows), x(b.size());
    factor.solve(b, x);
    return x;
}

volatile std::sig_atomic_t handled = 0;
void own_handler(int) { handled = handled + 1; }

}  // namespace

// The count of a cube's factor is that of the order that nested dissection gives, and half of what minimum degree
// needs; a plate, where dissection costs operations, has the other order.
TEST(dissection_is_taken_where_it_orders_better) {
    const SparseMatrix cube = box(17, 17, 17);
    const std::vector<std::int64_t> order = dissection_order(cube, cube.rows);
    std::vector<std::int64_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::int64_t> all(sorted.size());
    std::iota(all.begin(), all.end(), 0);
    ck_assert(sorted == all && static_cast<std::int64_t>(all.size()) == cube.rows);
    const FactorSize chosen = SparseCholesky(cube).size();
    const FactorSize given = SparseCholesky(reordered(cube, order), cube.rows).size();
    ck_assert(chosen.flops == given.flops && chosen.entries == given.entries);
    ck_assert_double_lt(chosen.flops, 0.5 * 9.22e9);  // of cholmod_l_camd's count; 0.42, and 0.70 of the entries
    ck_assert_double_lt(chosen.entries, 0.8 * 8.47e6);

    const SparseMatrix plate = box(60, 6, 2);
    const FactorSize small = SparseCholesky(plate).size();
    const FactorSize dissected =
        SparseCholesky(reordered(plate, dissection_order(plate, plate.rows)), plate.rows).size();
    ck_assert_double_lt(small.flops, dissected.flops);
}

// Trailing variables: the Schur complement onto them, in their given order, against products with the matrix; and a
// solve of the whole.
TEST(trailing_variables_stay_last) {
    const std::int64_t trailing = 3 * 17 * 17;
    const SparseMatrix m = box(17, 17, 12, true);
    const std::int64_t leading = m.rows - trailing;
    SparseCholesky factor(m, trailing);
    std::vector<std::int64_t> order = dissection_order(m, leading);
    for (std::int64_t i = leading; i < m.rows; ++i) order.push_back(i);
    ck_assert(factor.size().flops == SparseCholesky(reordered(m, order), m.rows).size().flops);
    ck_assert_double_lt(factor.size().flops, 0.6 * 6.77e9);  // of cholmod_l_camd's count; 0.50
    ck_assert(factor.factorise(m));
    const DenseMatrix lower = factor.trailing_factor();
    for (const std::int64_t column : {std::int64_t{0}, trailing / 2 + 1, trailing - 1}) {
        // u = (-A_ll^-1 A_lt e, e): A u = (0, S e)
        std::vector<double> u(static_cast<std::size_t>(m.rows), 0.0), au(u.size());
        u[static_cast<std::size_t>(leading + column)] = 1.0;
        multiply(m, u, au);
        std::vector<double> inside(au.begin(), au.begin() + leading), x(inside.size());
        factor.solve_leading(inside, x);
        for (std::size_t i = 0; i < x.size(); ++i) u[i] = -x[i];
        multiply(m, u, au);
        for (std::int64_t i = 0; i < leading; ++i)
            ck_assert_double_lt(std::abs(au[static_cast<std::size_t>(i)]), 1e-10);
        for (std::int64_t i = 0; i < trailing; ++i) {
            double s = 0.0;
            for (std::int64_t k = 0; k <= std::min(i, column); ++k) s += lower(i, k) * lower(column, k);
            ck_assert_double_lt(std::abs(s - au[static_cast<std::size_t>(leading + i)]), 1e-10);
        }
    }
    const std::vector<double> b = wave(m.rows);
    std::vector<double> x(b.size()), back(b.size());
    factor.solve(b, x);
    multiply(m, x, back);
    for (std::size_t i = 0; i < b.size(); ++i) ck_assert_double_lt(std::abs(back[i] - b[i]), 1e-9);
}

// Equal bits after other calls of METIS and rand(), and in other threads; the host's sequence goes on and its handlers
// are there.
TEST(the_host_notices_nothing) {
    const SparseMatrix m = box(13, 13, 13), other = box(9, 30, 8);
    std::signal(SIGTERM, own_handler);
    std::srand(7);
    std::array<int, 4> expected{}, seen{};
    for (int& r : expected) r = std::rand();
    std::srand(7);
    seen[0] = std::rand();
    const std::vector<std::int64_t> order = dissection_order(m, m.rows);
    seen[1] = std::rand();
    ck_assert(!dissection_order(other, other.rows).empty());
    seen[2] = std::rand();
    ck_assert(dissection_order(m, m.rows) == order);
    seen[3] = std::rand();
    ck_assert(seen == expected);
    ck_assert(std::signal(SIGTERM, SIG_DFL) == own_handler);
    std::array<std::vector<std::int64_t>, 3> parallel;
    std::vector<std::thread> threads;
    for (auto& result : parallel) threads.emplace_back([&] { result = dissection_order(m, m.rows); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& result : parallel) ck_assert(result == order);
}

// METIS would take them for errors of its own.
TEST(requests_to_end_wait_for_the_order) {
    const SparseMatrix m = box(20, 20, 20);
    const std::vector<std::int64_t> order = dissection_order(m, m.rows);
    std::signal(SIGTERM, own_handler);
    handled = 0;
    std::atomic<bool> ordered = false;
    const pthread_t host = pthread_self();
    std::thread asks([&] {
        while (!ordered) {
            pthread_kill(host, SIGTERM);
            std::this_thread::sleep_for(std::chrono::microseconds(50));
        }
    });
    const std::vector<std::int64_t> asked = dissection_order(m, m.rows);
    ordered = true;
    asks.join();
    ck_assert(asked == order);
    ck_assert_int_gt(handled, 1);  // within the call and after it
    ck_assert(std::signal(SIGTERM, SIG_DFL) == own_handler);
}

TEST(solutions_have_equal_bits) {
    const SparseMatrix m = box(16, 16, 16);
    const std::vector<double> first = solution(m);
    std::srand(12345);
    ck_assert(!dissection_order(box(8, 8, 8), 1000).empty());
    ck_assert(solution(m) == first);
}

// Blocks without coupling, variables without any, and a dense block.
TEST(graphs_in_pieces) {
    std::vector<Triplet> t;
    const SparseMatrix cube = box(13, 13, 13);
    for (int copy = 0; copy < 2; ++copy)
        for (std::int64_t r = 0; r < cube.rows; ++r)
            for (std::int64_t e = cube.start[static_cast<std::size_t>(r)];
                 e < cube.start[static_cast<std::size_t>(r) + 1]; ++e)
                t.push_back({copy * cube.rows + r, copy * cube.rows + cube.column[static_cast<std::size_t>(e)],
                             cube.value[static_cast<std::size_t>(e)]});
    const std::int64_t n = 2 * cube.rows + 500;
    for (std::int64_t r = 2 * cube.rows; r < n; ++r) t.push_back({r, r, 2.0});
    const SparseMatrix m = from_triplets(n, n, std::move(t));
    std::vector<std::int64_t> order = dissection_order(m, n);
    ck_assert_int_eq(static_cast<std::int64_t>(order.size()), n);
    std::sort(order.begin(), order.end());
    for (std::int64_t i = 0; i < n; ++i) ck_assert_int_eq(order[static_cast<std::size_t>(i)], i);
    const std::vector<double> x = solution(m), b = wave(n);
    std::vector<double> back(b.size());
    multiply(m, x, back);
    for (std::size_t i = 0; i < b.size(); ++i) ck_assert_double_lt(std::abs(back[i] - b[i]), 1e-9);

    std::vector<Triplet> alone, dense;
    for (std::int64_t r = 0; r < 400; ++r) alone.push_back({r, r, 1.0});
    for (std::int64_t r = 0; r < 300; ++r)
        for (std::int64_t c = 0; c < 300; ++c) dense.push_back({r, c, r == c ? 301.0 : 1.0});
    ck_assert_int_eq(static_cast<int>(dissection_order(from_triplets(400, 400, std::move(alone)), 400).size()), 400);
    ck_assert(dissection_order(from_triplets(300, 300, std::move(dense)), 300).empty());  // one vertex
}

// The three variables of a node are one group unless some of them must come last, and groups are connected as their
// nodes are.
TEST(variables_with_equal_rows_are_one) {
    const std::int64_t nodes = 5 * 4 * 3;
    const SparseMatrix m = box(5, 4, 3);
    const EqualRows groups = equal_rows(m, m.rows, m.rows);
    ck_assert_int_eq(static_cast<int>(groups.count()), static_cast<int>(nodes));
    for (std::int64_t i = 0; i < m.rows; ++i) {
        ck_assert_int_eq(static_cast<int>(groups.of[static_cast<std::size_t>(i)]), static_cast<int>(i / 3));
        ck_assert_int_eq(static_cast<int>(groups.member[static_cast<std::size_t>(i)]), static_cast<int>(i));
    }
    ck_assert_int_eq(static_cast<int>(9 * pattern_of_groups(m, groups).entries()), static_cast<int>(m.entries()));
    const EqualRows apart = equal_rows(m, m.rows, m.rows - 1);
    ck_assert_int_eq(static_cast<int>(apart.count()), static_cast<int>(nodes + 1));
    ck_assert(apart.of.back() == nodes && apart.of[apart.of.size() - 2] == nodes - 1);
}

// On the groups, operations are those that CHOLMOD counts for the whole matrix, and the postorder does not change them.
TEST(operations_are_estimated_from_groups) {
    for (const SparseMatrix& m : {box(9, 8, 7), box(30, 20, 1)}) {
        const SparseCholesky factor(m);
        const EqualRows groups = equal_rows(m, m.rows, m.rows);
        const SparseMatrix pattern = pattern_of_groups(m, groups);
        std::vector<std::int64_t> order = factor.order();
        for (int i = 0; i < 2; ++i)
            ck_assert_double_eq_tol(estimated_operations(groups, pattern, 0, order) / factor.size().flops, 1.0, 1e-12);
        std::vector<std::int64_t> worse(order.size());
        std::iota(worse.begin(), worse.end(), std::int64_t{0});
        ck_assert_double_gt(estimated_operations(groups, pattern, 0, worse), factor.size().flops);
        std::sort(worse.begin(), worse.end());
        for (std::size_t i = 0; i < worse.size(); ++i)
            ck_assert_int_eq(static_cast<int>(worse[i]), static_cast<int>(i));
        // One variable that comes last is a group of its own.
        const EqualRows apart = equal_rows(m, m.rows, m.rows - 1);
        order = SparseCholesky(m, 1).order();
        const double near = estimated_operations(apart, pattern_of_groups(m, apart), 1, order);
        ck_assert_double_eq_tol(near / SparseCholesky(m, 1).size().flops, 1.0, 0.02);
        ck_assert_int_eq(static_cast<int>(order.back()), static_cast<int>(m.rows - 1));
    }
}

// Where every variable comes last, few or many, there is nothing to order.
TEST(nothing_but_trailing_variables) {
    for (const std::int64_t n : {1, 3, 40}) {
        std::vector<Triplet> dense;
        for (std::int64_t r = 0; r < n; ++r)
            for (std::int64_t c = 0; c < n; ++c) dense.push_back({r, c, r == c ? static_cast<double>(n) + 1.0 : 1.0});
        const SparseMatrix m = from_triplets(n, n, std::move(dense));
        SparseCholesky factor(m, n);
        ck_assert(factor.factorise(m));
        const std::vector<std::int64_t> order = factor.order();
        ck_assert(std::is_sorted(order.begin(), order.end()));
        ck_assert_double_eq_tol(factor.trailing_factor()(0, 0), std::sqrt(static_cast<double>(n) + 1.0), 1e-14 * 7.0);
    }
}
