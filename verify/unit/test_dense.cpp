// SPDX-License-Identifier: BSD-3-Clause
// The parts of dense operators against brute force: kernels around their block borders, echelon forms, elimination;
// slopes of the damage, extrapolation.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "evolution/contact/extrapolation.hpp"
#include "law/law.hpp"
#include "linalg/dense/echelon.hpp"
#include "random_dense.hpp"
#include "reduction/dense/dense_energy.hpp"

using namespace delam;
using namespace unit;

namespace {

constexpr Index sizes[] = {0, 1, 2, 31, 32, 33, 63, 64, 65, 127, 128, 129, 255, 256, 257, 300};
constexpr int size_count = static_cast<int>(std::size(sizes));

}  // namespace

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

// The sum has the entries of both, in the order that the triplets of both give.
LOOP_TEST(sums_of_sparse_matrices, 0, 6) {
    Random random(static_cast<unsigned>(loop) + 50U);
    const Index rows = 1 + 7 * loop, columns = 2 + 5 * loop;
    std::vector<Triplet> first, second;
    for (Index k = 0; k < 2 * rows * loop; ++k) {
        std::vector<Triplet>& to = random.one_in(3) ? first : second;
        to.push_back({random.below(rows), random.below(columns), random.real()});
    }
    const SparseMatrix a = from_triplets(rows, columns, first), b = from_triplets(rows, columns, second);
    const SparseMatrix both = sum(a, b);
    DenseMatrix expected = dense_of(a);
    add_scaled(1.0, dense_of(b).value, expected.value);
    expect_close(dense_of(both).value, expected.value, 1e-15, "A + B");
    first.insert(first.end(), second.begin(), second.end());
    const SparseMatrix at_once = from_triplets(rows, columns, std::move(first));
    ck_assert(both.start == at_once.start);
    ck_assert(both.column == at_once.column);
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
    Extrapolation unused;
    ck_assert(unused.next(z, map(z)) == map(z));
    for (int k = 0; k < 4; ++k) {
        const std::vector<double> kept = unused.next(z, z);
        ck_assert(k == 0 || distance(kept, z) < 1e-6 * largest(z));
    }
}
