// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "petsc/base/objects.hpp"

namespace delam::petsc {

// A matrix of this process in CSR, with ascending columns, as PETSc wants it: `borrow` makes a Mat of the same arrays,
// which must outlive it.
struct LocalMatrix {
    PetscInt rows = 0;
    PetscInt columns = 0;
    std::vector<PetscInt> start{0};
    std::vector<PetscInt> column;
    std::vector<double> value;

    void multiply(std::span<const double> x, std::span<double> y) const;                   // y = A x
    void add_multiplied_transposed(std::span<const double> x, std::span<double> y) const;  // y += A^T x
    void multiply_sizes(std::span<const double> x, std::span<double> y) const;             // y = |A| |x|
    void add_multiplied_transposed_sizes(std::span<const double> x, std::span<double> y) const;
    OwnedMat borrow();
    void sort_rows();  // and sums the entries at the same place
};

// Copies a sequential AIJ matrix, with a diagonal entry in every row that has none.
LocalMatrix with_diagonal(Mat matrix, std::span<const double> missing);

}  // namespace delam::petsc
