// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "petsc/bodies/jump_expansion.hpp"
#include "petsc/bodies/visible.hpp"

namespace delam::petsc {

// The bodies in the variables w (jump_expansion.hpp), unassembled: u = T_w w, so that each rank's matrix T_w^T K T_w is
// that of its part but for supports and ties. Springs between jumps become springs between nodes, on the ranks that
// have all nodes they act on, in equal shares.
class DisplacementSystem {
public:
    DisplacementSystem(const Bodies& bodies, const Visible& visible, const SceneVariables& scene);

    // The stiffness of this rank, T_w^T K T_w: of the bodies alone, without springs.
    LocalMatrix stiffness() const;
    // The local matrix: the stiffness with these entries (on rank 0). A spring that is zero leaves no entry.
    OwnedMat local_matrix(LocalMatrix stiffness, const std::vector<std::int64_t>& rows,
                          const std::vector<std::int64_t>& columns, const std::vector<double>& values) const;
    ISLocalToGlobalMapping mapping() const { return mapping_; }
    // P^-1 in PETSc's numbers: v = P^-1 w.
    Mat expansion() const { return expansion_; }
    // True if all components of a node are variables.
    bool is_whole(std::size_t node) const;
    // Places without a variable.
    OwnedIs empty_places() const;

private:
    struct Term {
        PetscInt place;
        double coefficient;
    };

    void make_transform(const SceneVariables& scene);
    void cover_visible(const Visible& visible, const SceneVariables& scene);
    void number();
    void make_expansion(const SceneVariables& scene);
    std::int64_t dof_of(std::size_t place) const;

    const Bodies& bodies_;
    JumpExpansion jumps_;
    std::vector<std::int64_t> nodes_;
    std::vector<std::uint8_t> is_variable_;   // of each place
    LocalMatrix transform_;                   // T_w
    std::vector<std::vector<Term>> visible_;  // in w, of those that this rank has; else empty
    OwnedMapping mapping_;
    OwnedMat expansion_;
};

}  // namespace delam::petsc
