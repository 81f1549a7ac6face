// SPDX-License-Identifier: BSD-3-Clause
// The stiffness of a body as the host has assembled it. What hangs together in the matrix is a rigid piece: an elastic
// solid whose motions without energy are rigid ones, all of them or, where the host has supports of its own, some. What
// nothing moves without energy is one piece, also where it does not hang together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/dense.hpp"
#include "linalg/sparse.hpp"
#include "mesh/mesh.hpp"

namespace delam {

struct HostPiece {
    std::vector<std::int64_t> nodes;  // mesh nodes, ascending
    DenseMatrix free;                 // motions without energy, [dimension*nodes][..], orthonormal
    DenseMatrix held;  // the other rigid motions, orthogonal to them: what the host's supports resist. Not set where
                       // nothing is free

    bool fixed() const { return free.columns == 0; }
};

struct HostStiffness {
    SparseMatrix matrix;  // both triangles, over the body's nodes in ascending order, DOF dimension*i + component
    std::vector<HostPiece> pieces;
};

// Motions without energy that the host tells, over the body's DOFs; columns.
struct ToldKernel {
    bool told = false;
    DenseMatrix motions;
};

// Of one body. matrix: symmetric, both triangles. Error(DELAM_ERROR_ARGUMENT) names the node where something is wrong.
HostStiffness host_stiffness(const Mesh& mesh, std::int32_t body, SparseMatrix matrix, const ToldKernel& kernel,
                             Monitor& monitor);

}  // namespace delam
