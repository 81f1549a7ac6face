// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "petsc/bodies/constraints.hpp"

namespace delam::petsc {

// The matrix of the free variables, S^T (A + C) S, for PETSc's iterations: never formed.
class Operator {
public:
    Operator(const Bodies& bodies, const Visible& visible, const Constraints& constraints);
    Operator(const Operator&) = delete;
    Operator& operator=(const Operator&) = delete;

    struct Entries {  // places in `visible`, on rank 0
        std::vector<std::int64_t> rows;
        std::vector<std::int64_t> columns;
        std::vector<double> values;
    };
    void set_couplings(const Entries& couplings);

    Mat shell() const { return shell_; }
    // av = A v and cv = C v of all variables.
    void apply_bodies(Vec v, Vec av) const { bodies_.apply(v, av); }
    void apply_couplings(Vec v, Vec cv) const;
    void apply(Vec y, Vec out) const;
    // sum of |v_i C_ij v_j|
    double coupled(Vec v) const;
    // out += |C| |v|
    void add_coupling_sizes(Vec v, Vec out) const;
    // x.A x of the last x that the shell was applied to.
    double last_curvature() const { return last_curvature_; }

private:
    const Bodies& bodies_;
    const Visible& visible_;
    const Constraints& constraints_;
    Entries entries_;
    SparseEntries couplings_;
    OwnedMat shell_;
    OwnedVec spread_, image_, of_couplings_;
    mutable double last_curvature_ = 0.0;  // the KSP may overwrite both vectors
};

}  // namespace delam::petsc
