// SPDX-License-Identifier: BSD-3-Clause
// A dense zone whose springs and held rows change a little at a time, against a new zone for every change: the same
// solutions, the same verdict on definiteness, and few full factorisations.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/numbers.hpp"
#include "random_dense.hpp"
#include "reduction/dense/dense_zone.hpp"
#include "zone_motions.hpp"

using namespace delam;
using namespace unit;

namespace {

// Rows of one unknown each, then `bound` rows of two; springs and held rows that change.
struct Case {
    DenseEnergy energy;
    std::vector<JumpRow> rows;
    TestMotions motions;
    std::vector<double> spring, cross;  // of all rows; of the rows of one unknown (0, 1), (2, 3) ...
    std::vector<std::uint8_t> held;
    Index plain = 0;

    std::vector<Zone::Coupling> couplings() const {
        std::vector<Zone::Coupling> c;
        for (Index r = 0; r < static_cast<Index>(spring.size()); ++r)
            if (spring[at(r)] != 0.0) c.push_back({r, r, spring[at(r)]});
        for (Index r = 0; r + 1 < plain; r += 2) {
            if (cross[at(r)] == 0.0) continue;
            c.push_back({r, r + 1, cross[at(r)]});
            c.push_back({r + 1, r, cross[at(r)]});
        }
        return c;
    }
    DenseZone zone() { return {energy, rows, {}, motions.of(energy)}; }
};

// S = sum of squares, without resistance to the motions.
Case make_case(Random& random, Index n, Index bound, Index motions) {
    Case c;
    c.plain = n;
    c.motions.rigid = DenseMatrix(n, motions);
    for (double& v : c.motions.rigid.value) v = random.real();
    if (motions > 0) c.motions.rigid = orthonormalised(std::move(c.motions.rigid));
    DenseMatrix g(n, n);
    for (double& v : g.value) v = random.real();
    for (Index row = 0; row < n; ++row)
        for (Index m = 0; m < motions; ++m) {
            double along = 0.0;
            for (Index i = 0; i < n; ++i) along += g(row, i) * c.motions.rigid(i, m);
            for (Index i = 0; i < n; ++i) g(row, i) -= along * c.motions.rigid(i, m);
        }
    c.energy.stiffness = multiply_transposed(g, g);
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) {
            double unit = i == j ? 1.0 : 0.0;
            for (Index m = 0; m < motions; ++m) unit -= c.motions.rigid(i, m) * c.motions.rigid(j, m);
            c.energy.stiffness(i, j) += unit;
        }
    mirror_lower(c.energy.stiffness);
    c.energy.load = DenseMatrix(n, 2);
    for (double& v : c.energy.load.value) v = random.real();
    for (Index i = 0; i < n; ++i) c.rows.push_back({{{i, 1.0}}, {}});
    for (Index b = 0; b < bound; ++b) {
        const Index i = random.below(n - 1);
        c.rows.push_back({{{i, 1.0}, {i + 1, -0.5}}, b % 2 == 0 ? random.vector(2) : std::vector<double>()});
    }
    c.held.assign(c.rows.size(), 0);
    c.spring.assign(c.rows.size(), 0.0);
    c.cross.assign(at(n), 0.0);
    for (double& s : c.spring) s = random.real(1.0, 30.0);
    return c;
}

void change(Case& c, Random& random) {
    for (int k = 0; k < 4; ++k) {
        const auto r = at(random.below(c.plain)), any = at(random.below(static_cast<Index>(c.rows.size())));
        const Index kind = random.below(5);
        if (kind == 0) c.spring[any] = 0.0;
        if (kind == 1) c.spring[any] = random.real(0.0, 200.0);
        if (kind == 2) c.held[r] ^= 1;
        if (kind == 3) c.cross[r & ~std::size_t{1}] = random.real(-0.3, 0.3);
        if (kind == 4 && c.held.size() > at(c.plain))
            c.held[at(c.plain + random.below(static_cast<Index>(c.held.size()) - c.plain))] ^= 1;
    }
}

double compare(const Zone::Solution& a, const Zone::Solution& b) {
    const double size = max_abs(b.unknowns), force = max_abs(b.multiplier);
    double worst = 0.0;
    for (std::size_t i = 0; i < b.unknowns.size(); ++i)
        worst = std::max(worst, std::abs(a.unknowns[i] - b.unknowns[i]) / size);
    for (std::size_t i = 0; force > 0.0 && i < b.multiplier.size(); ++i)
        worst = std::max(worst, std::abs(a.multiplier[i] - b.multiplier[i]) / std::max(force, size));
    return worst;
}

}  // namespace

LOOP_TEST(small_changes, 0, 48) {
    Random random(static_cast<unsigned>(loop) + 70U);
    Case c = make_case(random, 40 + 40 * (loop % 4), loop % 3 == 2 ? 3 : 0, loop % 3);
    DenseZone zone = c.zone();
    const std::vector<double> theta = random.vector(2);
    const int changes = 60;
    Index compared = 0;
    for (int k = 0; k < changes; ++k) {
        change(c, random);
        const std::vector<double> pull =
            k % 3 == 0 ? random.vector(static_cast<Index>(c.rows.size())) : std::vector<double>();
        DenseZone unused = c.zone();
        const bool definite = unused.factor(c.couplings(), c.held);
        ck_assert_int_eq(zone.factor(c.couplings(), c.held), definite);
        if (!definite) continue;
        const Zone::Solution expected = unused.solve(theta, pull), found = zone.solve(theta, pull);
        ck_assert_int_eq(found.balanced, expected.balanced);
        if (!expected.balanced) continue;
        ++compared;
        const double off = compare(found, expected);
        ck_assert_msg(off <= 1e-11, "change %d: unknowns differ by %.2e", k, off);
        std::vector<double> force(c.rows.size(), 0.0), other(c.rows.size(), 0.0);
        zone.complete_forces(theta, found, force);
        unused.complete_forces(theta, expected, other);
        for (std::size_t r = 0; r < force.size(); ++r)
            ck_assert_msg(std::abs(force[r] - other[r]) <= 1e-10 * max_abs(other), "change %d: force of row %zu", k, r);
    }
    ck_assert_int_ge(compared, changes / 2);
    // A matrix of 160 and more rows is factored once for several changes of four; those of small ones are cheap.
    if (c.rows.size() >= 160 && loop % 3 != 2) ck_assert_int_le(zone.factorisations(), changes / 3);
}

// Tangents of softening rows make the matrix indefinite, and definite again.
LOOP_TEST(definiteness, 0, 12) {
    Random random(static_cast<unsigned>(loop) + 170U);
    Case c = make_case(random, 50, 0, loop % 2);
    DenseZone zone = c.zone();
    ck_assert(zone.factor(c.couplings(), c.held));
    int indefinite = 0;
    for (int k = 0; k < 40; ++k) {
        const auto r = at(random.below(c.plain));
        const double before = c.spring[r];
        c.spring[r] = -random.real(1.0, 60.0);
        DenseZone unused = c.zone();
        const bool definite = unused.factor(c.couplings(), c.held);
        ck_assert_int_eq(zone.factor(c.couplings(), c.held), definite);
        if (!definite) ++indefinite;
        if (!definite || k % 2 == 0) c.spring[r] = before;
    }
    ck_assert_int_ge(indefinite, 3);
    ck_assert(zone.factor(c.couplings(), c.held));
}

// A spring that hides the bodies is never subtracted: nothing is lost when it breaks.
LOOP_TEST(stiff_springs, 0, 10) {
    Random random(static_cast<unsigned>(loop) + 270U);
    Case c = make_case(random, 40, 0, 0);
    for (int k = 0; k < 6; ++k) c.spring[at(random.below(c.plain))] = std::pow(10.0, 4.0 + 2.0 * (loop % 5));
    DenseZone zone = c.zone();
    const std::vector<double> theta = random.vector(2);
    ck_assert(zone.factor(c.couplings(), c.held));
    for (double& s : c.spring)
        if (s > 1e3) s = 0.0;
    ck_assert(zone.factor(c.couplings(), c.held));
    DenseZone unused = c.zone();
    ck_assert(unused.factor(c.couplings(), c.held));
    const double off = compare(zone.solve(theta, {}), unused.solve(theta, {}));
    ck_assert_msg(off <= 1e-11, "unknowns differ by %.2e", off);
}

// A zone that forgets its past continues with the bits of a new zone.
LOOP_TEST(forgets, 0, 12) {
    Random random(static_cast<unsigned>(loop) + 370U);
    Case c = make_case(random, 40, 0, loop % 3);
    DenseZone used = c.zone(), unused = c.zone();
    const std::vector<double> theta = random.vector(2);
    for (int k = 0; k < 5; ++k) {
        ck_assert(used.factor(c.couplings(), c.held));
        (void)used.solve(theta, {});
        change(c, random);
    }
    used.forget();
    for (int k = 0; k < 5; ++k) {
        ck_assert_int_eq(used.factor(c.couplings(), c.held), unused.factor(c.couplings(), c.held));
        const Zone::Solution a = used.solve(theta, {}), b = unused.solve(theta, {});
        ck_assert(a.balanced == b.balanced && a.unknowns == b.unknowns);
        change(c, random);
    }
}

// The work of forces on the jumps of others is that of solutions with these forces alone.
LOOP_TEST(flexibility, 0, 12) {
    Random random(static_cast<unsigned>(loop) + 470U);
    Case c = make_case(random, 30, loop % 2 == 0 ? 3 : 0, loop % 3);
    DenseZone zone = c.zone();
    const std::vector<double> theta(2, 0.0);
    for (int k = 0; k < 6; ++k) {
        change(c, random);
        if (!zone.factor(c.couplings(), c.held)) continue;
        std::vector<std::vector<Zone::RowForce>> sets(4);
        std::vector<std::vector<double>> jumps;
        for (auto& set : sets) {
            std::vector<double> pull(c.rows.size(), 0.0);
            for (int f = 0; f < 2; ++f) {
                const Index row = random.below(static_cast<Index>(pull.size()));
                set.push_back({row, random.real()});
                pull[at(row)] += set.back().value;
            }
            jumps.push_back(zone.jumps(theta, zone.solve(theta, pull).unknowns));
        }
        const auto work = zone.flexibility(sets);
        ck_assert(work.has_value());
        for (Index i = 0; i < 4; ++i)
            for (Index j = 0; j < 4; ++j) {
                double expected = 0.0;
                for (const Zone::RowForce& f : sets[at(i)])
                    if (c.held[at(f.row)] == 0) expected += f.value * jumps[at(j)][at(f.row)];
                ck_assert_msg(std::abs((*work)(i, j) - expected) <= 1e-10 * max_abs(work->value), "work (%d, %d)",
                              static_cast<int>(i), static_cast<int>(j));
            }
    }
}
