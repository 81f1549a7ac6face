// SPDX-License-Identifier: BSD-3-Clause
// The parts of the condensed operator against brute force: dense kernels around their block borders, elimination and
// release, the zone against its KKT system in quadruple precision, echelon forms, jump variables, slopes of the damage,
// extrapolation.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "base/error.hpp"
#include "check.hpp"
#include "evolution/contact/extrapolation.hpp"
#include "law/law.hpp"
#include "linalg/dense/dense.hpp"
#include "linalg/dense/echelon.hpp"
#include "linalg/sparse/sparse.hpp"
#include "mesh/layers.hpp"
#include "reduction/dense/dense_energy.hpp"
#include "reduction/dense/dense_zone.hpp"
#include "reduction/dense/rigid_jumps.hpp"
#include "reduction/operator/jump_variables.hpp"
#include "scene/problem.hpp"

using namespace delam;

namespace {

using Index = std::int64_t;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double real(double low = -1.0, double high = 1.0) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(engine_) == 1; }
    Index below(Index n) { return std::uniform_int_distribution<Index>(0, n - 1)(engine_); }
    DenseMatrix matrix(Index rows, Index columns) {
        DenseMatrix a(rows, columns);
        for (double& v : a.value) v = real();
        return a;
    }
    std::vector<double> vector(Index n) {
        std::vector<double> v(at(n));
        for (double& x : v) x = real();
        return v;
    }
    // Positive definite, with eigenvalues of about 1 to n.
    DenseMatrix definite(Index n) {
        const DenseMatrix g = matrix(n, n);
        DenseMatrix s = multiply_transposed(g, g);
        for (Index i = 0; i < n; ++i) s(i, i) += 1.0;
        mirror_lower(s);
        return s;
    }
    template <class T>
    void shuffle(T& list) {
        std::shuffle(list.begin(), list.end(), engine_);
    }

private:
    std::mt19937 engine_;
};

double largest(std::span<const double> v) {
    double m = 0.0;
    for (const double x : v) m = std::max(m, std::abs(x));
    return m;
}

double distance(std::span<const double> a, std::span<const double> b) {
    ck_assert_uint_eq(a.size(), b.size());
    double m = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        m = std::isnan(a[i] - b[i]) ? HUGE_VAL : std::max(m, std::abs(a[i] - b[i]));
    return m;
}

void expect_close(std::span<const double> a, std::span<const double> b, double tolerance, const char* what) {
    const double off = distance(a, b), scale = std::max(largest(b), 1e-20);
    ck_assert_msg(off <= tolerance * scale, "%s: off by %.2e of %.3g", what, off, scale);
}

DenseMatrix plain_product(const DenseMatrix& a, const DenseMatrix& b) {
    DenseMatrix c(a.rows, b.columns);
    for (Index j = 0; j < b.columns; ++j)
        for (Index k = 0; k < a.columns; ++k) {
            // By pointers, because this test is compiled without optimisation.
            const double *column = a.value.data() + k * a.rows, factor = b(k, j);
            double* sum = c.value.data() + j * a.rows;
            for (const double* end = column + a.rows; column != end; ++column) *sum++ += *column * factor;
        }
    return c;
}

DenseMatrix flipped(const DenseMatrix& a) {
    DenseMatrix t(a.columns, a.rows);
    for (Index j = 0; j < a.columns; ++j)
        for (Index i = 0; i < a.rows; ++i) t(j, i) = a(i, j);
    return t;
}

DenseMatrix lower_of(DenseMatrix a) {
    for (Index j = 0; j < a.columns; ++j)
        for (Index i = 0; i < j; ++i) a(i, j) = 0.0;
    return a;
}

DenseMatrix dense_of(const SparseMatrix& s) {
    DenseMatrix d(s.rows, s.columns);
    for (Index i = 0; i < s.rows; ++i)
        for (Index e = s.start[at(i)]; e < s.start[at(i) + 1]; ++e) d(i, s.column[at(e)]) += s.value[at(e)];
    return d;
}

constexpr Index sizes[] = {0, 1, 2, 31, 32, 33, 63, 64, 65, 127, 128, 129, 255, 256, 257, 300};
constexpr int size_count = static_cast<int>(std::size(sizes));

}  // namespace

// ---- dense kernels -------------------------------------------------------------------------------------------------

LOOP_TEST(dense_kernels, 0, size_count) {
    const Index n = sizes[loop], m = n / 3 + 1;
    Random random(static_cast<unsigned>(n) + 1U);
    const DenseMatrix a = random.matrix(n, n), b = random.matrix(n, m);
    expect_close(multiply(a, b).value, plain_product(a, b).value, 1e-12, "A B");
    expect_close(multiply_transposed(a, b).value, plain_product(flipped(a), b).value, 1e-12, "A^T B");

    const DenseMatrix lower = lower_of(a);
    const DenseMatrix square = lower_times_transpose(lower);
    expect_close(square.value, plain_product(lower, flipped(lower)).value, 1e-12, "L L^T");
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < j; ++i) ck_assert(square(i, j) == square(j, i));

    DenseMatrix mirrored = a;
    mirror_lower(mirrored);
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) ck_assert(mirrored(i, j) == a(std::max(i, j), std::min(i, j)));

    const std::vector<double> x = random.vector(n);
    std::vector<double> y(at(n)), z(at(n));
    multiply_symmetric(a, x, y);
    multiply(mirrored, x, z);
    expect_close(y, z, 1e-12, "S x from the lower triangle");
    std::vector<double> w(at(m), 7.0);
    multiply_transposed(b, x, w);
    for (Index j = 0; j < m; ++j) {
        double sum = 0.0;
        for (Index i = 0; i < n; ++i) sum += b(i, j) * x[at(i)];
        ck_assert(std::abs(sum - w[at(j)]) <= 1e-12 * static_cast<double>(n + 1));
    }
    if (n == 0) return;

    const DenseMatrix s = random.definite(n);
    DenseMatrix factor = s;
    ck_assert(factor_definite(factor));
    expect_close(lower_times_transpose(lower_of(factor)).value, s.value, 1e-12, "Cholesky");
    DenseMatrix solved = b;
    solve_lower(factor, solved);
    expect_close(multiply(lower_of(factor), solved).value, b.value, 1e-9, "L^-1 B");
    std::vector<double> v = x;
    solve_lower(factor, v);
    solve_lower_transposed(factor, v);
    multiply_symmetric(s, v, y);
    expect_close(y, x, 1e-9, "L^-T L^-1 x");
    const DenseMatrix unit = multiply(inverse_definite(s), s);
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) ck_assert(std::abs(unit(i, j) - (i == j ? 1.0 : 0.0)) < 1e-9);

    DenseMatrix c = s;
    subtract_gram(c, a);
    mirror_lower(c);
    DenseMatrix d = s;
    subtract_product(d, a, a);
    expect_close(c.value, d.value, 1e-12, "C - V^T V");
    const DenseMatrix product = plain_product(flipped(a), a);
    for (std::size_t i = 0; i < d.value.size(); ++i)
        ck_assert(std::abs(s.value[i] - product.value[i] - d.value[i]) < 1e-10 * static_cast<double>(n));
    DenseMatrix indefinite = s;
    indefinite(n - 1, n - 1) = -1.0;
    ck_assert(!factor_definite(indefinite));
}

LOOP_TEST(congruences, 0, 6) {
    Random random(static_cast<unsigned>(loop) + 40U);
    const Index n = 5 + 13 * loop, m = 1 + 9 * loop;
    std::vector<Triplet> entries, columns;
    for (Index k = 0; k < 5 * n; ++k) {
        const Index i = random.below(n), j = random.below(n);
        const double v = random.real();
        entries.push_back({i, j, v});
        if (i != j) entries.push_back({j, i, v});
    }
    for (Index i = 0; i < n; ++i) {
        if (random.one_in(4)) continue;  // rows of T may be empty
        for (int k = 0; k < 1 + i % 3; ++k) columns.push_back({i, random.below(m), random.real()});
    }
    const SparseMatrix k = from_triplets(n, n, entries), t = from_triplets(n, m, columns);
    const SparseMatrix c = congruence(k, t);
    const DenseMatrix dk = dense_of(k), dt = dense_of(t);
    expect_close(dense_of(c).value, plain_product(flipped(dt), plain_product(dk, dt)).value, 1e-13, "T^T K T");
    for (Index r = 0; r < m; ++r)
        for (Index e = c.start[at(r)]; e + 1 < c.start[at(r) + 1]; ++e)
            ck_assert(c.column[at(e)] < c.column[at(e) + 1]);
}

LOOP_TEST(echelons, 0, 60) {
    Random random(static_cast<unsigned>(loop) + 70U);
    const Index rows = 1 + loop % 7, columns = 1 + random.below(9), preferred = random.below(columns + 1);
    DenseMatrix q = random.matrix(rows, columns);
    for (double& v : q.value)
        if (random.one_in(3)) v = 0.0;
    // Dependent rows with very different scales.
    for (Index i = 1; i < rows; ++i) {
        const bool depends = random.one_in(3);
        const double scale = std::pow(10.0, random.real(-6.0, 6.0)), a = random.real(0.5, 1.0);
        for (Index j = 0; j < columns; ++j) q(i, j) = scale * (depends ? a * q(0, j) : q(i, j));
    }
    const Echelon e = reduced_echelon(q, preferred, 1e-10);
    const auto rank = static_cast<Index>(e.pivot.size());
    ck_assert_int_eq(e.rows.rows, rank);
    ck_assert_int_eq(e.operations.rows, rank);
    ck_assert_int_eq(e.operations.columns, rows);
    expect_close(multiply(e.operations, q).value, e.rows.value, 1e-9, "operations Q");
    for (Index i = 0; i < rank; ++i)
        for (Index k = 0; k < rank; ++k) ck_assert(e.rows(i, e.pivot[at(k)]) == (i == k ? 1.0 : 0.0));
    // Preferred columns contain as many pivots as their rank, and all rows of Q are combinations of those of the
    // echelon form.
    DenseMatrix scaled = q;
    for (Index i = 0; i < rows; ++i) {
        double size = 0.0;
        for (Index j = 0; j < columns; ++j) size = std::max(size, std::abs(q(i, j)));
        for (Index j = 0; j < columns; ++j) scaled(i, j) = size > 0.0 ? q(i, j) / size : 0.0;
    }
    DenseMatrix first(rows, preferred);
    std::copy_n(scaled.value.begin(), first.value.size(), first.value.begin());
    const auto rank_of = [](const DenseMatrix& a) {
        return a.columns == 0 || largest(a.value) == 0.0 ? 0 : pivoted_columns(a, 1e-9).rank;
    };
    ck_assert_int_eq(rank, rank_of(scaled));
    ck_assert_int_eq(std::count_if(e.pivot.begin(), e.pivot.end(), [&](Index p) { return p < preferred; }),
                     rank_of(first));
    for (Index i = 0; i < rows; ++i)
        for (Index j = 0; j < columns; ++j) {
            double sum = 0.0;
            for (Index k = 0; k < rank; ++k) sum += scaled(i, e.pivot[at(k)]) * e.rows(k, j);
            ck_assert_msg(std::abs(sum - scaled(i, j)) < 1e-9, "row %d, column %d", static_cast<int>(i),
                          static_cast<int>(j));
        }
}

// ---- condensation --------------------------------------------------------------------------------------------------

namespace {

void expect_same_energy(const Condensation& c, const DenseEnergy& parent, const std::vector<double>& stiffness,
                        const std::vector<Index>& eliminated, Random& random, double tolerance) {
    std::vector<Index> rest;
    for (const Index e : eliminated)
        if (std::find(c.kept().begin(), c.kept().end(), e) == c.kept().end()) rest.push_back(e);
    const Condensation scratch(parent, c.kept(), rest, stiffness);
    expect_close(c.energy().stiffness.value, scratch.energy().stiffness.value, tolerance, "stiffness");
    expect_close(c.energy().load.value, scratch.energy().load.value, tolerance, "load");
    const std::vector<double> theta = random.vector(parent.load.columns),
                              kept = random.vector(static_cast<Index>(c.kept().size()));
    std::vector<double> a(at(parent.rows()), 0.0), b(a);
    c.recover(theta, kept, a);
    scratch.recover(theta, kept, b);
    expect_close(a, b, tolerance, "recovered");
    // Minimal: the derivative of the energy with springs vanishes for the eliminated unknowns.
    std::vector<double> image(a.size()), load(a.size());
    multiply_symmetric(parent.stiffness, a, image);
    multiply(parent.load, theta, load);
    for (const Index e : rest) {
        const double left = image[at(e)] + stiffness[at(e)] * a[at(e)] - load[at(e)];
        const double scale = largest(image) + largest(load) + std::abs(stiffness[at(e)] * a[at(e)]);
        ck_assert_msg(std::abs(left) <= 100.0 * tolerance * scale, "derivative %.2e of %.2e", left, scale);
    }
}

}  // namespace

// loop: size and kind of springs.
LOOP_TEST(condensations, 0, 18) {
    Random random(static_cast<unsigned>(loop) + 200U);
    const Index n = std::array<Index, 6>{3, 12, 33, 64, 129, 200}[at(loop % 6)];
    const int kind = loop / 6;
    DenseEnergy parent{random.definite(n), random.matrix(n, 1 + loop % 3)};
    if (kind == 2) {  // floats as a whole: only springs hold it
        for (Index i = 0; i < n; ++i) {
            double sum = 0.0;
            for (Index j = 0; j < n; ++j)
                if (j != i) {
                    parent.stiffness(i, j) = -std::abs(parent.stiffness(i, j));
                    sum -= parent.stiffness(i, j);
                }
            parent.stiffness(i, i) = sum;
        }
    }
    std::vector<double> stiffness(at(n));
    for (double& s : stiffness)
        s = kind == 0 ? random.real(0.0, 1.0)
                      : std::pow(10.0, random.real(-3.0, kind == 1 ? 4.0 : 1.0)) * static_cast<double>(n);
    std::vector<Index> order(at(n));
    for (Index i = 0; i < n; ++i) order[at(i)] = i;
    random.shuffle(order);
    const Index keep = n / 5, hold = n / 4;
    std::vector<Index> kept(order.begin(), order.begin() + keep),
        held(order.begin() + keep, order.begin() + keep + hold), eliminated(order.begin() + keep + hold, order.end());
    Condensation c(parent, kept, eliminated, stiffness);
    const double tolerance = kind == 1 ? 1e-9 : 1e-10;
    expect_same_energy(c, parent, stiffness, eliminated, random, tolerance);
}

TEST(indefinite_elimination) {
    DenseEnergy parent{DenseMatrix(2, 2), DenseMatrix(2, 1)};
    parent.stiffness(0, 0) = 1.0;
    parent.stiffness(1, 1) = -1.0;
    bool refused = false;
    try {
        const Condensation c(parent, {0}, {1}, std::vector<double>{0.0, 0.5});
    } catch (const Error&) {
        refused = true;
    }
    ck_assert(refused);
}

// ---- zone ----------------------------------------------------------------------------------------------------------

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
    DenseZone zone(z.energy, z.rows, {}, z.rigid);
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
    ZoneCase z = zone_case(random, 8 + loop % 17, loop % 5, motions, loop % 2 == 1, weak);
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
    DenseZone zone(z.energy, z.rows, {}, z.rigid);
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
    const Zone::Solution carried = zone.solve(z.theta, {});
    ck_assert(carried.balanced);
    std::vector<double> image(10), load(10);
    multiply_symmetric(z.energy.stiffness, carried.unknowns, image);
    multiply(z.energy.load, z.theta, load);
    expect_close(image, load, 1e-9, "S x");
}

// ---- jump variables ------------------------------------------------------------------------------------------------

namespace {

// A block of quads, whose nodes are mapped linearly so that frames are oblique.
void add_block(std::vector<double>& nodes, std::vector<Index>& cells, std::vector<std::int32_t>& bodies,
               std::int32_t body, double x0, double y0, Index nx, Index ny, bool slanted) {
    const auto first = static_cast<Index>(nodes.size() / 2);
    for (Index j = 0; j <= ny; ++j)
        for (Index i = 0; i <= nx; ++i) {
            const double x = x0 + static_cast<double>(i), y = y0 + static_cast<double>(j);
            nodes.push_back(slanted ? 0.9 * x - 0.35 * y : x);
            nodes.push_back(slanted ? 0.4 * x + 0.8 * y : y);
        }
    for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) {
            const Index corner = first + j * (nx + 1) + i;
            cells.insert(cells.end(), {corner, corner + 1, corner + nx + 2, corner + nx + 1});
            bodies.push_back(body);
        }
}

Problem junction(int kind, bool slanted) {
    std::vector<double> nodes{50.0, 50.0};  // the first belongs to no cell
    std::vector<Index> cells;
    std::vector<std::int32_t> bodies;
    std::vector<std::pair<std::int32_t, std::int32_t>> faces;
    if (kind == 0) {  // tee
        add_block(nodes, cells, bodies, 0, -3, -2, 6, 2, slanted);
        add_block(nodes, cells, bodies, 1, -3, 0, 3, 2, slanted);
        add_block(nodes, cells, bodies, 2, 0, 0, 3, 2, slanted);
        faces = {{0, 1}, {0, 2}, {1, 2}};
    } else {  // cross
        for (std::int32_t b = 0; b < 4; ++b)
            add_block(nodes, cells, bodies, b, b % 2 == 0 ? -2 : 0, b / 2 == 0 ? -2 : 0, 2, 2, slanted);
        faces = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    }
    auto mesh = std::make_shared<Mesh>(2, nodes);
    mesh->add_cells(CellType::quad4, cells, bodies);
    for (const auto& [a, b] : faces) mesh->add_interface(a, b, 1e-6);
    return Problem(mesh);
}

Problem plies(int dimension, std::size_t layers) {
    const std::vector<double> lengths{4.0, 2.0};
    const std::vector<Index> divisions{4, 2};
    const auto axes = static_cast<std::size_t>(dimension - 1);
    auto mesh = std::make_shared<Mesh>(make_layers(
        dimension, std::span(lengths).first(axes), std::span(divisions).first(axes), std::vector<double>(layers, 1.0),
        std::vector<Index>(layers, 1), dimension == 2 ? CellType::quad8 : CellType::hex8));
    for (std::size_t i = 0; i + 1 < layers; ++i)
        mesh->add_interface(static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1), 1e-6);
    return Problem(mesh);
}

DenseMatrix jumps_of(const Problem& problem) {
    const Index dim = problem.mesh->dimension();
    DenseMatrix b(problem.jump_count(), dim * problem.mesh->node_count());
    Index row = 0;
    for (const InterfaceGeometry& face : problem.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            for (Index r = 0; r < dim; ++r, ++row)
                for (Index k = 0; k < dim; ++k) {
                    const double q = face.frame[(p * at(dim) + at(r)) * at(dim) + at(k)];
                    b(row, face.node_b[p] * dim + k) += q;
                    b(row, face.node_a[p] * dim + k) -= q;
                }
    return b;
}

// Random constraints of all kinds: on single components, oblique, means over several nodes, on nodes of pairs and
// others.
void constrain(Problem& problem, Random& random, int count) {
    problem.patterns.push_back({"a", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::displacement});
    problem.patterns.push_back({"b", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::displacement});
    const Index dim = problem.mesh->dimension();
    std::vector<Index> alive, faces;
    for (Index n = 0; n < problem.mesh->node_count(); ++n)
        if (problem.mesh->node_body(n) >= 0) alive.push_back(n);
    for (const InterfaceGeometry& face : problem.mesh->interfaces()) {
        faces.insert(faces.end(), face.node_a.begin(), face.node_a.end());
        faces.insert(faces.end(), face.node_b.begin(), face.node_b.end());
    }
    std::vector<Index> used;
    for (int k = 0; k < count; ++k) {
        const auto& list = random.one_in(2) ? faces : alive;
        Constraint c;
        const int nodes = random.one_in(3) ? 3 : 1;
        const bool slanted = random.one_in(3);
        const Index axis = random.below(dim);
        for (int i = 0; i < nodes; ++i) {
            const Index node = list[at(random.below(static_cast<Index>(list.size())))];
            if (std::find(used.begin(), used.end(), node) != used.end()) continue;  // independent rows
            used.push_back(node);
            for (Index d = 0; d < dim; ++d) {
                if (!slanted && d != axis) continue;
                c.dof.push_back(node * dim + d);
                c.coefficient.push_back(slanted ? random.real(0.2, 1.0) : 1.0 / nodes);
            }
        }
        if (c.dof.empty()) continue;
        c.prescribed = random.one_in(2) ? std::vector<double>{} : random.vector(2);
        problem.constraints.push_back(std::move(c));
    }
}

}  // namespace

LOOP_TEST(variables, 0, 60) {
    Random random(static_cast<unsigned>(loop) + 1700U);
    const int kind = loop % 6;
    Problem problem = kind < 4 ? junction(kind / 2, kind % 2 == 1) : plies(kind == 4 ? 2 : 3, kind == 4 ? 4 : 3);
    constrain(problem, random, 1 + loop / 2);
    const JumpVariables v = make_jump_variables(problem);
    const Index dofs = problem.mesh->dimension() * problem.mesh->node_count();
    ck_assert_int_eq(v.transform.rows, dofs);
    ck_assert_int_eq(v.transform.columns, v.count());
    ck_assert_int_eq(static_cast<Index>(v.row.size()), problem.jump_count());
    const DenseMatrix t = dense_of(v.transform), b = jumps_of(problem);

    // B T = [0 | rows], B U = offsets: the jump variables are the jumps, and nothing else moves them.
    DenseMatrix expected(problem.jump_count(), v.count());
    for (std::size_t r = 0; r < v.row.size(); ++r)
        for (const auto& [j, c] : v.row[r]) expected(static_cast<Index>(r), v.leading + v.kept + j) += c;
    const DenseMatrix product = multiply(b, t);
    ck_assert_msg(distance(product.value, expected.value) < 1e-13, "B T: %.2e",
                  distance(product.value, expected.value));
    ck_assert_uint_eq(v.lift.size(), problem.patterns.size());
    for (std::size_t p = 0; p < v.lift.size(); ++p) {
        std::vector<double> jump(at(b.rows));
        multiply(b, v.lift[p], jump);
        for (std::size_t r = 0; r < jump.size(); ++r)
            if (!v.row_offset[r].empty()) jump[r] -= v.row_offset[r][p];
        ck_assert_msg(largest(jump) < 1e-12, "B U: %.2e", largest(jump));
    }

    // Trailing variables that satisfy the equations at some theta give displacements that satisfy the constraints,
    // whatever the leading variables are.
    const std::vector<double> theta = random.vector(2);
    const auto equations = static_cast<Index>(v.equations.size());
    std::vector<double> values = random.vector(v.count());
    if (equations > 0) {
        DenseMatrix q(equations, v.trailing());
        std::vector<double> off(at(equations));
        for (Index i = 0; i < equations; ++i) {
            off[at(i)] = dot(v.equations[at(i)].prescribed, theta);
            for (const auto& [k, c] : v.equations[at(i)].entries) {
                ck_assert(k >= 0 && k < v.trailing());
                q(i, k) += c;
                off[at(i)] -= c * values[at(v.leading + k)];
            }
        }
        const Eigen eigen = eigen_symmetric(multiply(q, flipped(q)));
        for (Index e = 0; e < equations; ++e) {
            if (eigen.value[at(e)] < 1e-10 * eigen.value.back()) continue;
            double along = 0.0;
            for (Index i = 0; i < equations; ++i) along += eigen.vector(i, e) * off[at(i)];
            for (Index i = 0; i < equations; ++i)
                for (Index k = 0; k < v.trailing(); ++k)
                    values[at(v.leading + k)] += q(i, k) * eigen.vector(i, e) * along / eigen.value[at(e)];
        }
    }
    std::vector<double> u(at(dofs));
    multiply(v.transform, values, u);
    for (std::size_t p = 0; p < theta.size(); ++p) add_scaled(theta[p], v.lift[p], u);
    DenseMatrix d(static_cast<Index>(problem.constraints.size()), dofs);
    for (std::size_t c = 0; c < problem.constraints.size(); ++c) {
        const Constraint& row = problem.constraints[c];
        double value = 0.0;
        for (std::size_t i = 0; i < row.dof.size(); ++i) {
            value += row.coefficient[i] * u[at(row.dof[i])];
            d(static_cast<Index>(c), row.dof[i]) += row.coefficient[i];
        }
        double wanted = 0.0;
        for (std::size_t p = 0; p < row.prescribed.size(); ++p) wanted += row.prescribed[p] * theta[p];
        ck_assert_msg(std::abs(value - wanted) < 1e-11, "constraint %d: %.2e", static_cast<int>(c), value - wanted);
    }
    // The number of free variables is right: nothing is lost.
    Index alive = 0;
    for (Index n = 0; n < problem.mesh->node_count(); ++n)
        alive += problem.mesh->node_body(n) >= 0 ? problem.mesh->dimension() : 0;
    const auto rank = d.rows == 0 ? Index{0} : pivoted_columns(flipped(d), 1e-10).rank;
    ck_assert_int_eq(v.count() - equations, alive - rank);
    const Eigen gram = eigen_symmetric(multiply_transposed(t, t));
    ck_assert_msg(gram.value.front() > 1e-6, "columns of T depend on each other: %.2e", gram.value.front());
}

// Motions that no support resists, as seen at the interfaces: the freedoms of the bodies less those of the whole.
LOOP_TEST(rigid_motions, 0, 2) {
    Problem problem = junction(1, loop == 1);
    DenseMatrix z = rigid_jumps(problem);
    ck_assert_int_eq(z.columns, 9);  // four bodies of three motions; the common ones open nothing
    const DenseMatrix unit = multiply_transposed(z, z);
    for (Index j = 0; j < unit.columns; ++j)
        for (Index i = 0; i < unit.rows; ++i) ck_assert(std::abs(unit(i, j) - (i == j ? 1.0 : 0.0)) < 1e-10);
    for (const Index dof : {2, 3, 5}) problem.constraints.push_back({{dof}, {1.0}, {}});  // body 0 is held
    ck_assert_int_eq(rigid_jumps(problem).columns, 9);
    std::vector<std::uint8_t> active(at(z.rows), 0);
    ck_assert_int_eq(split_motions(z, active).free.columns, 9);
    std::fill(active.begin(), active.end(), std::uint8_t{1});
    ck_assert_int_eq(split_motions(z, active).free.columns, 0);
    ck_assert_int_eq(split_motions(z, active).held.columns, 9);
}

// ---- damage, extrapolation -----------------------------------------------------------------------------------------

LOOP_TEST(slopes, 0, 40) {
    Random random(static_cast<unsigned>(loop) + 2500U);
    const double onset = std::pow(10.0, random.real(-3.0, 3.0)), ratio = 1.0 + std::pow(10.0, random.real(-3.0, 4.0));
    const LinearSoftening shape;
    const Toughness t{onset, onset * ratio};
    const double end = t.total * ratio;  // Gc^2/Go: there the adhesion is gone
    for (int k = 1; k < 60; ++k) {
        const double driving = onset * std::pow(end / onset, k / 60.0), old = random.real(0.3, 1.0);
        const double step = 1e-5 * (driving - onset < end - driving ? driving - onset : end - driving);
        const double zeta = shape.minimiser(t, driving, old);
        const double low = shape.minimiser(t, driving - step, old), high = shape.minimiser(t, driving + step, old);
        const double slope = shape.slope(t, driving, old);
        if (zeta >= old || zeta <= 0.0) {
            ck_assert(slope == 0.0);
            continue;
        }
        if (low >= old) continue;  // the kink
        const double difference = (high - low) / (2.0 * step);
        ck_assert_msg(slope < 0.0 && std::abs(slope - difference) <= 1e-4 * std::abs(slope) + 1e-13 / step,
                      "ratio %.3g, Y/Go %.6g: %.9g, difference %.9g", ratio, driving / onset, slope, difference);
    }
    ck_assert(shape.slope(t, 0.5 * onset, 1.0) == 0.0);
    ck_assert(shape.slope(t, 2.0 * end, 1.0) == 0.0);
    ck_assert(shape.slope({onset, onset}, onset, 1.0) == 0.0);
    ck_assert(shape.slope({onset, onset}, 3.0 * onset, 1.0) == 0.0);
}

// z -> A z + b with few distinct eigenvalues: extrapolation from k differences is exact after k eigenvalues have been
// seen.
LOOP_TEST(extrapolated_contraction, 0, 5) {
    const int distinct = 1 + loop;
    Random random(static_cast<unsigned>(loop) + 3000U);
    const Index n = 12;
    const DenseMatrix q = orthonormalised(random.matrix(n, n));
    DenseMatrix a(n, n);
    for (Index k = 0; k < n; ++k) {
        const double value = 0.2 + 0.75 * static_cast<double>(k % distinct) / static_cast<double>(distinct);
        for (Index j = 0; j < n; ++j)
            for (Index i = 0; i < n; ++i) a(i, j) += value * q(i, k) * q(j, k);
    }
    const std::vector<double> b = random.vector(n);
    const auto map = [&](const std::vector<double>& z) {
        std::vector<double> y(z.size());
        multiply(a, z, y);
        add_scaled(1.0, b, y);
        return y;
    };
    Extrapolation extrapolation;
    std::vector<double> z(at(n), 0.0);
    for (int pass = 0; pass < 2; ++pass) {
        for (int k = 0; k <= distinct + 1; ++k) z = extrapolation.next(z, map(z));
        const double left = distance(map(z), z);
        ck_assert_msg(left < 1e-7 * largest(z), "pass %d: residual %.2e", pass, left);
        extrapolation.forget();
        for (double& v : z) v += random.real();
    }
    // The first step is plain, and a fixed point stays one.
    Extrapolation fresh;
    ck_assert(fresh.next(z, map(z)) == map(z));
    for (int k = 0; k < 4; ++k) {
        const std::vector<double> kept = fresh.next(z, z);
        ck_assert(k == 0 || distance(kept, z) < 1e-6 * largest(z));
    }
}
