// SPDX-License-Identifier: BSD-3-Clause
// The active set of unilateral contact on dense systems: it ends, also where all violators moved at once would cycle,
// and its result is the one contact set that an exhaustive search finds.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "check.hpp"
#include "evolution/contact/active_set.hpp"
#include "linalg/dense/dense.hpp"

using namespace delam;

namespace {

// minimise 1/2 x^T S x - f^T x over x >= 0; the force of a held row is what holds it.
struct DenseSystem {
    DenseMatrix stiffness;
    std::vector<double> load;
    std::vector<double> x, reaction;
    bool definite = true, balanced = true;
    std::int64_t solves = 0;

    ContactSolve solve(const std::vector<std::uint8_t>& closed) {
        ++solves;
        if (!definite) return ContactSolve::failed;
        bool held = false;
        for (const std::uint8_t c : closed) held = held || c != 0;
        if (!balanced && !held) return ContactSolve::unbalanced;
        const std::int64_t n = stiffness.rows;
        DenseMatrix a = stiffness, b(n, 1);
        for (std::int64_t i = 0; i < n; ++i) {
            b(i, 0) = closed[index(i)] != 0 ? 0.0 : load[index(i)];
            if (closed[index(i)] == 0) continue;
            for (std::int64_t j = 0; j < n; ++j) a(i, j) = a(j, i) = i == j ? 1.0 : 0.0;
        }
        ck_assert(solve_general(a, b, 1e-14));
        x.assign(b.value.begin(), b.value.end());
        reaction.assign(index(n), 0.0);
        for (std::int64_t i = 0; i < n; ++i) {
            if (closed[index(i)] == 0) continue;
            reaction[index(i)] = load[index(i)];
            for (std::int64_t j = 0; j < n; ++j) reaction[index(i)] -= stiffness(i, j) * x[index(j)];
        }
        return ContactSolve::solved;
    }
    std::span<const double> jump() const { return x; }
    std::span<const double> force() const { return reaction; }
    double jump_floor() const { return 0.0; }
    double force_floor() const { return 0.0; }
    bool softens() const { return true; }
};

// Nearly of rank 3: rows that are coupled as closely as these are what makes simultaneous moves cycle.
DenseSystem some_system(std::mt19937& random, std::int64_t n) {
    std::normal_distribution<double> normal;
    DenseMatrix g(n, 3);
    for (double& v : g.value) v = normal(random);
    DenseSystem s;
    s.stiffness = DenseMatrix(n, n);
    for (std::int64_t i = 0; i < n; ++i)
        for (std::int64_t j = 0; j < n; ++j) {
            double sum = i == j ? 1e-3 : 0.0;
            for (std::int64_t k = 0; k < 3; ++k) sum += g(i, k) * g(j, k);
            s.stiffness(i, j) = sum;
        }
    for (std::int64_t i = 0; i < n; ++i) s.load.push_back(normal(random));
    return s;
}

ContactRows all_rows(std::int64_t n) {
    ContactRows rows;
    for (std::int64_t i = 0; i < n; ++i) rows.row.push_back(index(i));
    return rows;
}

// The only set without a violator, by trying all of them.
std::vector<std::uint8_t> exhaustive(DenseSystem s, const ContactRows& rows) {
    const std::size_t n = rows.row.size();
    std::vector<std::uint8_t> found;
    int count = 0;
    for (std::size_t code = 0; code < (std::size_t{1} << n); ++code) {
        std::vector<std::uint8_t> closed(n);
        for (std::size_t i = 0; i < n; ++i) closed[i] = (code >> i) & 1U;
        s.solve(closed);
        if (!contact_violators(s, rows, closed, 0).empty()) continue;
        ++count;
        found = closed;
    }
    ck_assert_int_eq(count, 1);
    return found;
}

// Does moving all violators at once come back to a set that it has left?
bool cycles(DenseSystem s, const ContactRows& rows) {
    std::vector<std::uint8_t> closed(rows.row.size(), 0);
    std::set<std::string> seen;
    while (seen.emplace(closed.begin(), closed.end()).second) {
        s.solve(closed);
        const std::vector<std::size_t> wrong = contact_violators(s, rows, closed, 0);
        if (wrong.empty()) return false;
        for (const std::size_t i : wrong) closed[i] ^= 1;
    }
    return true;
}

}  // namespace

TEST(the_set_is_the_only_one) {
    std::mt19937 random(1);
    int cycled = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const std::int64_t n = 4 + trial % 5;
        DenseSystem s = some_system(random, n);
        const ContactRows rows = all_rows(n);
        std::vector<std::uint8_t> closed(index(n), trial % 2 == 0 ? 0 : 1);
        const ActiveSet found = find_active_set(s, rows, closed, 10000);
        ck_assert(found.settled && found.last == ContactSolve::solved);
        ck_assert_int_eq(found.solves, s.solves);
        ck_assert(closed == exhaustive(s, rows));
        if (cycles(s, rows)) {
            ++cycled;
            ck_assert(trial % 2 != 0 || found.descended);
        }
    }
    // Else the test shows nothing about cycles.
    ck_assert_int_ge(cycled, 5);
}

TEST(limits_and_failures_are_reported) {
    std::mt19937 random(2);
    const ContactRows rows = all_rows(6);
    DenseSystem s = some_system(random, 6);
    s.load.assign(6, -1.0);  // everything wants to close
    std::vector<std::uint8_t> closed(6, 0);
    const ActiveSet stopped = find_active_set(s, rows, closed, 1);
    ck_assert(!stopped.settled && stopped.last == ContactSolve::solved && stopped.solves == 1);
    s.definite = false;
    const ActiveSet failed = find_active_set(s, rows, closed, 100);
    ck_assert(!failed.settled && failed.last == ContactSolve::failed && failed.solves == 1);
}

// The first of two rows softens faster than the rest unloads: held it is pulled, free it penetrates. A search would
// have no end, but two solves show it.
TEST(negative_curvature_is_seen_in_two_sets) {
    DenseSystem s;
    s.stiffness = DenseMatrix(2, 2);
    s.stiffness(0, 0) = -1.0;
    s.stiffness(1, 1) = 2.0;
    s.stiffness(0, 1) = s.stiffness(1, 0) = 0.1;
    s.load = {1.0, 1.0};
    for (const std::uint8_t first : {std::uint8_t{0}, std::uint8_t{1}}) {
        std::vector<std::uint8_t> closed{first, 0};
        s.solves = 0;
        const ActiveSet found = find_active_set(s, all_rows(2), closed, 1000);
        ck_assert(!found.settled && found.last == ContactSolve::failed && found.solves == 2);
    }
}

// A part that only contact can hold: these rows stop it.
struct CaughtSystem : DenseSystem {
    std::vector<std::size_t> stops;
    std::vector<std::size_t> settle(const ContactRows&, std::vector<std::uint8_t>&, std::uint8_t, const SolveError&) {
        return {};
    }
    std::vector<std::size_t> caught(const ContactRows&, const std::vector<std::uint8_t>&) const { return stops; }
};

// Nothing balances the load while all rows are open; contact does.
TEST(contact_may_hold_what_floats) {
    std::mt19937 random(4);
    const ContactRows rows = all_rows(5);
    CaughtSystem s{some_system(random, 5), {}};
    s.load.assign(5, -1.0);
    s.balanced = false;
    std::vector<std::uint8_t> closed(5, 0);
    ck_assert(find_active_set(s, rows, closed, 100).last == ContactSolve::unbalanced);
    s.stops = {1, 3};
    closed.assign(5, 0);
    const ActiveSet found = find_active_set(s, rows, closed, 100);
    ck_assert(found.settled);
    s.balanced = true;
    ck_assert(closed == exhaustive(s, rows));
}

// The search from coarse rows to all of them finds the same set.
TEST(levels_lead_to_the_same_set) {
    std::mt19937 random(6);
    for (int trial = 0; trial < 100; ++trial) {
        DenseSystem s = some_system(random, 8);
        ContactRows rows = all_rows(8);
        rows.level = {3, 0, 1, 0, 2, 0, 1, 0};
        rows.first = 3;
        std::vector<std::uint8_t> closed(8, 0);
        ck_assert(find_active_set(s, rows, closed, 10000).settled);
        ck_assert(closed == exhaustive(s, rows));
    }
}

// Answers are exact, and say that they may be off by ten times what they are: every sign is in doubt, none is wrong.
template <std::int64_t N>
struct CautiousSystem : DenseSystem {
    static constexpr std::int64_t guesses = N;
    bool tightened = false;

    SolveError error() const { return {10.0 * max_abs(x), 10.0 * max_abs(reaction)}; }
    bool rough() const { return false; }
    bool tighten() {
        const bool first = !tightened;
        tightened = true;
        return first;
    }
};

// Once no tighter answer can be had, so many sets follow from signs in doubt, and the last of them is accepted.
TEST(signs_in_doubt_are_followed_for_a_few_sets) {
    std::mt19937 random(8);
    int left_wrong = 0, found_right = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const std::int64_t n = 4 + trial % 5;
        const DenseSystem s = some_system(random, n);
        const ContactRows rows = all_rows(n);
        const std::vector<std::uint8_t> right = exhaustive(s, rows);
        CautiousSystem<0> never{s};
        std::vector<std::uint8_t> closed(index(n), 0);
        const ActiveSet stayed = find_active_set(never, rows, closed, 10000);
        ck_assert(stayed.settled && stayed.solves <= 2);
        ck_assert(std::count(closed.begin(), closed.end(), 0) == n);
        left_wrong += closed != right ? 1 : 0;
        CautiousSystem<3> often{s};
        const ActiveSet followed = find_active_set(often, rows, closed, 10000);
        ck_assert(followed.settled && followed.solves <= 5);
        ck_assert_int_ge(followed.doubts + 1, followed.solves);
        found_right += closed == right ? 1 : 0;
    }
    ck_assert_int_ge(left_wrong, 150);
    ck_assert_int_ge(found_right, 150);
}
