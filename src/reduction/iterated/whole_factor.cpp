// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/iterated/whole_factor.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

// Of the diagonal, on variables of constraints: parts that only such constraints hold would leave the factor singular.
// Far below what the bodies feel.
constexpr double shifted = 1e-7;

double times_row(const SparseVector& row, std::span<const double> x) {
    double sum = 0.0;
    for (const auto& [i, c] : row) sum += c * x[index(i)];
    return sum;
}

}  // namespace

WholeFactor::WholeFactor(JumpSystem& system, const Poll& poll)
    : system_(system), factor_(system.matrix(), 0, poll), size_(factor_.size()) {}

void WholeFactor::factorise(std::span<const Triplet> springs) {
    std::vector<Triplet> added(springs.begin(), springs.end());
    double largest = 0.0;
    for (const double d : system_.diagonal()) largest = std::max(largest, d);
    for (const SparseVector& row : system_.equations())
        for (const auto& [i, c] : row) {
            const double d = system_.diagonal()[index(i)];
            added.push_back({i, i, d > 0.0 ? shifted * d : largest});
        }
    bool definite = false;
    system_.with_added(added, [&](const SparseMatrix& matrix) { definite = factor_.factorise(matrix); });
    if (!definite)
        fail(
            DELAM_ERROR_NUMERICAL,
            "the stiffness of bodies and interfaces is not positive definite: check supports, materials and the shapes "
            "of cells");
    const auto n = static_cast<std::int64_t>(system_.equations().size());
    columns_ = DenseMatrix(system_.count(), n);
    gram_ = DenseMatrix(n, n);
    std::vector<double> right(index(system_.count()));
    for (std::int64_t e = 0; e < n; ++e) {
        std::fill(right.begin(), right.end(), 0.0);
        for (const auto& [i, c] : system_.equations()[index(e)]) right[index(i)] += c;
        const auto w = std::span<double>(columns_.value).subspan(index(e * system_.count()), right.size());
        factor_.solve(right, w);
        for (std::int64_t f = 0; f < n; ++f) gram_(f, e) = times_row(system_.equations()[index(f)], w);
    }
    if (!factor_definite(gram_))
        fail(DELAM_ERROR_NUMERICAL, "the ", n, " constraints on many displacements depend on each other");
}

void WholeFactor::apply(std::span<const double> r, std::span<double> z) const {
    factor_.solve(r, z);
    if (system_.equations().empty()) return;
    std::vector<double> y;
    for (const SparseVector& row : system_.equations()) y.push_back(times_row(row, z));
    solve_lower(gram_, y);
    solve_lower_transposed(gram_, y);
    for (std::size_t e = 0; e < y.size(); ++e)
        add_scaled(-y[e], std::span<const double>(columns_.value).subspan(e * z.size(), z.size()), z);
}

}  // namespace delam
