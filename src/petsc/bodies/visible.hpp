// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "petsc/bodies/bodies.hpp"

namespace delam::petsc {

// The variables that the library reads, between a distributed vector and an array on rank 0. All calls are collective;
// the arrays are those of rank 0, and empty elsewhere.
class Visible {
public:
    Visible(const Bodies& bodies, const std::vector<std::int64_t>& homes);

    std::size_t count() const { return number_.size(); }
    PetscInt number(std::int64_t place) const;  // PETSc's
    std::vector<double> read(Vec from) const;
    // out = 0 but for these.
    void write(std::span<const double> values, Vec out) const;

private:
    std::vector<PetscInt> number_;  // PETSc's
    OwnedVec array_;
    OwnedScatter scatter_;
};

// A matrix of a few entries, which rank 0 gives: places in PETSc's numbers, entries at the same place are summed.
class SparseEntries {
public:
    // True if the places differ from those of the last call.
    bool set(const Bodies& bodies, const std::vector<PetscInt>& rows, const std::vector<PetscInt>& columns,
             const std::vector<double>& values);
    Mat matrix() const { return matrix_; }
    void clear() { matrix_.reset(); }

private:
    std::vector<PetscInt> rows_, columns_;
    OwnedMat matrix_;
};

}  // namespace delam::petsc
