// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/whole_factor.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

WholeFactor::WholeFactor(JumpSystem& system, const Poll& poll)
    : system_(system), factor_(system.matrix(), 0, poll), size_(factor_.size()) {}

void WholeFactor::factorise(std::span<const Triplet> springs, const Poll& poll) {
    std::vector<Triplet> added(springs.begin(), springs.end());
    double largest = 0.0;
    for (const double d : system_.diagonal()) largest = std::max(largest, d);
    for (const SparseVector& row : system_.rows().equations())
        for (const auto& [i, c] : row) {
            const double d = system_.diagonal()[index(i)];
            added.push_back({i, i, constraint_shift * (d > 0.0 ? d : largest)});
        }
    bool definite = false;
    system_.with_added(added, [&](const SparseMatrix& matrix) { definite = factor_.factorise(matrix); });
    if (!definite)
        fail(
            DELAM_ERROR_NUMERICAL,
            "the stiffness of bodies and interfaces is not positive definite: check supports, materials and the shapes "
            "of cells");
    const auto solve = [&](std::span<const double> b, std::span<double> x) { factor_.solve(b, x); };
    if (!constraints_.set(system_.rows().equations(), system_.count(), solve, poll))
        fail(DELAM_ERROR_NUMERICAL, "the ", system_.rows().equations().size(),
             " constraints on many displacements depend on each other");
    factor_.keep_single();  // every iteration reads it twice
}

void WholeFactor::apply(std::span<const double> r, std::span<double> z) const {
    factor_.solve(r, z);
    constraints_.apply(z);
}

}  // namespace delam
