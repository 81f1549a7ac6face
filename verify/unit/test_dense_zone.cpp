// SPDX-License-Identifier: BSD-3-Clause
// The dense zone against its KKT system in quadruple precision.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "random_dense.hpp"
#include "reduction/dense/dense_zone.hpp"
#include "zone_motions.hpp"

using namespace delam;
using namespace unit;

namespace {

__extension__ typedef __float128 Quad;

// Solves A x = b with complete pivoting; entries below `zero` times the largest count as zero (dependent rows).
std::vector<Quad> solve_quad(std::vector<std::vector<Quad>> a, std::vector<Quad> b, Quad zero) {
    const std::size_t n = b.size();
    const auto size = [](Quad v) { return v < 0 ? -v : v; };
    Quad scale = 0;
    for (const auto& row : a)
        for (const Quad v : row) scale = std::max(scale, size(v));
    std::vector<std::size_t> row_used(n, 0), column_used(n, 0);
    std::vector<std::pair<std::size_t, std::size_t>> pivots;
    while (pivots.size() < n) {
        Quad best = zero * scale;
        std::size_t r = n, c = n;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n && row_used[i] == 0; ++j)
                if (column_used[j] == 0 && size(a[i][j]) > best) {
                    best = size(a[i][j]);
                    r = i;
                    c = j;
                }
        if (r == n) break;
        row_used[r] = column_used[c] = 1;
        pivots.emplace_back(r, c);
        for (std::size_t i = 0; i < n; ++i) {
            if (i == r || a[i][c] == 0) continue;
            const Quad f = a[i][c] / a[r][c];
            for (std::size_t j = 0; j < n; ++j) a[i][j] -= f * a[r][j];
            a[i][c] = 0;
            b[i] -= f * b[r];
        }
    }
    std::vector<Quad> x(n, 0);
    for (const auto& [r, c] : pivots) x[c] = b[r] / a[r][c];
    return x;
}

struct ZoneCase {
    DenseEnergy energy;
    std::vector<std::vector<Quad>> stiffness;  // exactly singular along `rigid`
    std::vector<JumpRow> rows;
    DenseMatrix rigid;
    std::vector<Zone::Coupling> couplings;
    std::vector<std::uint8_t> held;
    std::vector<double> theta, row_force;
};

// n unknowns with one row each, and further rows that combine them, some with offsets.
ZoneCase zone_case(Random& random, Index n, Index more, Index motions, bool offsets, double weak) {
    ZoneCase z;
    const Index patterns = 2;
    z.rigid = motions > 0 ? orthonormalised(random.matrix(n, motions)) : DenseMatrix(n, 0);
    // Exact projector of the columns in quadruple precision.
    std::vector<std::vector<Quad>> basis;
    for (Index c = 0; c < motions; ++c) {
        std::vector<Quad> v(at(n));
        for (Index i = 0; i < n; ++i) v[at(i)] = z.rigid(i, c);
        for (const auto& b : basis) {
            Quad along = 0;
            for (Index i = 0; i < n; ++i) along += b[at(i)] * v[at(i)];
            for (Index i = 0; i < n; ++i) v[at(i)] -= along * b[at(i)];
        }
        Quad square = 0;
        for (const Quad x : v) square += x * x;
        Quad root = std::sqrt(static_cast<double>(square));
        for (int k = 0; k < 3; ++k) root = (root + square / root) / 2;
        for (Quad& x : v) x /= root;
        basis.push_back(std::move(v));
    }
    const auto project = [&](std::vector<Quad>& v) {
        for (const auto& b : basis) {
            Quad along = 0;
            for (std::size_t i = 0; i < v.size(); ++i) along += b[i] * v[i];
            for (std::size_t i = 0; i < v.size(); ++i) v[i] -= along * b[i];
        }
    };
    const DenseMatrix s = random.definite(n);
    z.stiffness.assign(at(n), std::vector<Quad>(at(n)));
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) z.stiffness[at(j)][at(i)] = s(i, j);
    for (auto& column : z.stiffness) project(column);
    for (std::size_t i = 0; i < at(n); ++i)
        for (std::size_t j = 0; j < i; ++j) std::swap(z.stiffness[i][j], z.stiffness[j][i]);
    for (auto& column : z.stiffness) project(column);
    z.energy = {DenseMatrix(n, n), random.matrix(n, patterns)};
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i)
            z.energy.stiffness(i, j) = static_cast<double>(z.stiffness[at(std::min(i, j))][at(std::max(i, j))]);
    for (Index i = 0; i < n; ++i) z.rows.push_back({{{i, 1.0}}, {}});
    for (Index r = 0; r < more; ++r) {
        JumpRow row;
        for (Index k = 0; k < 2 + r % 2; ++k) {
            const Index i = random.below(n);
            if (std::none_of(row.unknowns.begin(), row.unknowns.end(), [&](const auto& e) { return e.first == i; }))
                row.unknowns.emplace_back(i, random.one_in(2) ? 1.0 : -0.5);
        }
        std::sort(row.unknowns.begin(), row.unknowns.end());
        if (offsets && random.one_in(2)) row.offset = random.vector(patterns);
        if (row.unknowns.size() > 1 || !row.offset.empty()) z.rows.push_back(std::move(row));
    }
    random.shuffle(z.rows);
    const auto rows = static_cast<Index>(z.rows.size());
    z.held.assign(at(rows), 0);
    for (Index r = 0; r < rows; ++r) z.held[at(r)] = random.one_in(4) ? 1 : 0;
    for (Index r = 0; r + 1 < rows; r += 2) {
        if (random.one_in(5)) continue;
        const double size = weak > 0.0 ? weak : std::pow(10.0, random.real(-2.0, 3.0)),
                     cross = weak > 0.0 ? 0.0 : 0.3 * size * random.real();
        z.couplings.push_back({r, r, size});
        z.couplings.push_back({r + 1, r + 1, 0.7 * size});
        if (cross == 0.0) continue;
        z.couplings.push_back({r, r + 1, cross});
        z.couplings.push_back({r + 1, r, cross});
    }
    z.theta = random.vector(patterns);
    z.row_force = random.vector(rows);
    return z;
}

// Minimiser of the zone's energy by its KKT system.
std::vector<double> brute_force(const ZoneCase& z) {
    const std::size_t n = at(z.energy.rows()), rows = z.rows.size();
    std::vector<std::size_t> held;
    for (std::size_t r = 0; r < rows; ++r)
        if (z.held[r] != 0) held.push_back(r);
    const std::size_t size = n + held.size();
    std::vector<std::vector<Quad>> a(size, std::vector<Quad>(size, 0));
    std::vector<Quad> b(size, 0);
    const auto offset = [&](std::size_t r) {
        Quad o = 0;
        for (std::size_t p = 0; p < z.rows[r].offset.size(); ++p)
            o += static_cast<Quad>(z.rows[r].offset[p]) * static_cast<Quad>(z.theta[p]);
        return o;
    };
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) a[i][j] = z.stiffness[i][j];
        for (std::size_t p = 0; p < z.theta.size(); ++p)
            b[i] += static_cast<Quad>(z.energy.load(static_cast<Index>(i), static_cast<Index>(p))) *
                    static_cast<Quad>(z.theta[p]);
    }
    for (const Zone::Coupling& c : z.couplings) {
        if (z.held[at(c.row)] != 0 || z.held[at(c.column)] != 0) continue;
        for (const auto& [i, u] : z.rows[at(c.row)].unknowns) {
            for (const auto& [j, v] : z.rows[at(c.column)].unknowns)
                a[at(i)][at(j)] += static_cast<Quad>(c.value) * u * v;
            b[at(i)] -= static_cast<Quad>(c.value) * u * offset(at(c.column));
        }
    }
    for (std::size_t r = 0; r < rows; ++r)
        if (z.held[r] == 0)
            for (const auto& [i, u] : z.rows[r].unknowns) b[at(i)] += static_cast<Quad>(u) * z.row_force[r];
    for (std::size_t k = 0; k < held.size(); ++k) {
        for (const auto& [i, u] : z.rows[held[k]].unknowns) a[n + k][at(i)] = a[at(i)][n + k] = u;
        b[n + k] = -offset(held[k]);
    }
    const std::vector<Quad> x = solve_quad(std::move(a), std::move(b), static_cast<Quad>(1e-28));
    std::vector<double> out(n);
    for (std::size_t i = 0; i < n; ++i) out[i] = static_cast<double>(x[i]);
    return out;
}

void check_zone(ZoneCase& z, double tolerance, const char* what) {
    TestMotions motions(z.rigid);
    DenseZone zone(z.energy, z.rows, {}, motions.of(z.energy));
    // Twice, after another held set and other couplings: these must have no effect.
    std::vector<std::uint8_t> none(z.held.size(), 0);
    std::vector<Zone::Coupling> springs;
    for (std::size_t r = 0; r < z.rows.size(); ++r)
        springs.push_back({static_cast<Index>(r), static_cast<Index>(r), 3.0});
    ck_assert(zone.factor(springs, none));
    ck_assert(zone.solve(z.theta, {}).balanced);
    ck_assert_msg(zone.factor(z.couplings, z.held), "%s: not definite", what);
    const Zone::Solution solution = zone.solve(z.theta, z.row_force);
    ck_assert_msg(solution.balanced, "%s: not balanced", what);
    const std::vector<double> exact = brute_force(z);
    expect_close(solution.unknowns, exact, tolerance, what);

    const std::vector<double> jump = zone.jumps(z.theta, solution.unknowns);
    std::vector<double> force(jump.size());
    for (std::size_t r = 0; r < jump.size(); ++r) force[r] = -z.row_force[r];
    for (const Zone::Coupling& c : z.couplings)
        if (z.held[at(c.column)] == 0) force[at(c.row)] += c.value * jump[at(c.column)];
    zone.complete_forces(z.theta, solution, force);
    std::vector<double> left(exact.size()), image(exact.size());
    multiply(z.energy.load, z.theta, left);
    multiply_symmetric(z.energy.stiffness, solution.unknowns, image);
    // Where almost nothing resists a motion, S times it is rounding of large numbers.
    const double scale = largest(left) + largest(image) + largest(force) +
                         largest(z.energy.stiffness.value) * largest(solution.unknowns);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= image[i];
    for (std::size_t r = 0; r < jump.size(); ++r) {
        if (z.held[r] != 0)
            ck_assert_msg(std::abs(jump[r]) <= tolerance * std::max(1.0, largest(exact)), "%s: held row moves by %.2e",
                          what, jump[r]);
        for (const auto& [i, n] : z.rows[r].unknowns) left[at(i)] -= n * force[r];
    }
    ck_assert_msg(largest(left) <= 1e-9 * scale, "%s: forces out of balance by %.2e of %.2e", what, largest(left),
                  scale);
}

// Held rows of random cases may contradict each other through their offsets; then there is no solution to compare with.
void drop_contradictions(ZoneCase& z) {
    for (std::size_t r = 0; r < z.rows.size(); ++r) {
        if (z.held[r] == 0 || z.rows[r].offset.empty()) continue;
        const bool pinned = std::all_of(z.rows[r].unknowns.begin(), z.rows[r].unknowns.end(), [&](const auto& e) {
            for (std::size_t q = 0; q < z.rows.size(); ++q)
                if (q != r && z.held[q] != 0)
                    for (const auto& f : z.rows[q].unknowns)
                        if (f.first == e.first) return true;
            return false;
        });
        if (pinned) z.held[r] = 0;
    }
}

}  // namespace

LOOP_TEST(zones, 0, 60) {
    Random random(static_cast<unsigned>(loop) + 500U);
    ZoneCase z = zone_case(random, 2 + loop % 25, loop % 9, 0, loop % 2 == 1, 0.0);
    drop_contradictions(z);
    check_zone(z, 1e-9, "held by its bodies");
}

// Motions resisted only by springs and held rows, with springs down to 1e-13 of the bodies'.
LOOP_TEST(floating_zones, 0, 48) {
    Random random(static_cast<unsigned>(loop) + 900U);
    const double weak = std::array{0.0, 1e-2, 1e-7, 1e-13}[at(loop % 4)];
    const Index motions = 1 + loop % 3;
    ZoneCase z = zone_case(random, 8 + loop % 17, loop % 5, motions, loop / 4 % 2 == 1, weak);
    std::fill(z.held.begin(), z.held.end(), std::uint8_t{0});
    if (weak == 0.0)
        for (std::size_t r = 0; r < z.held.size(); ++r) z.held[r] = random.one_in(6) ? 1 : 0;
    drop_contradictions(z);
    // Enough springs to hold all motions.
    if (weak > 0.0)
        for (Index r = 0; r < 2 * motions; ++r) z.couplings.push_back({r, r, weak});
    std::fill(z.row_force.begin(), z.row_force.end(), 0.0);
    check_zone(z, weak > 0.0 && weak < 1e-10 ? 1e-6 : 1e-8, "floating");
}

LOOP_TEST(unbalanced_zones, 0, 5) {
    Random random(static_cast<unsigned>(loop) + 1300U);
    ZoneCase z = zone_case(random, 10, 0, 2, false, 0.0);
    std::fill(z.held.begin(), z.held.end(), std::uint8_t{0});
    TestMotions motions(z.rigid);
    DenseZone zone(z.energy, z.rows, {}, motions.of(z.energy));
    ck_assert(zone.factor({}, z.held));
    ck_assert(!zone.solve(z.theta, {}).balanced);
    // The same load without its part along the motions has an equilibrium.
    for (Index p = 0; p < z.energy.load.columns; ++p)
        for (int pass = 0; pass < 2; ++pass)
            for (Index c = 0; c < z.rigid.columns; ++c) {
                double along = 0.0;
                for (Index i = 0; i < z.rigid.rows; ++i) along += z.rigid(i, c) * z.energy.load(i, p);
                for (Index i = 0; i < z.rigid.rows; ++i) z.energy.load(i, p) -= along * z.rigid(i, c);
            }
    motions.of(z.energy);
    const Zone::Solution carried = zone.solve(z.theta, {});
    ck_assert(carried.balanced);
    std::vector<double> image(10), load(10);
    multiply_symmetric(z.energy.stiffness, carried.unknowns, image);
    multiply(z.energy.load, z.theta, load);
    expect_close(image, load, 1e-9, "S x");
}
