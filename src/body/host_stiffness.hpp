// SPDX-License-Identifier: BSD-3-Clause
// The stiffness of a body as assembled by the host. A connected part of the matrix is a rigid piece: an elastic solid
// whose motions without energy are rigid, either all rigid motions or, with supports of the host, some of them. A part
// that has no motion without energy is one piece, even if it is not connected.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/dense/dense.hpp"
#include "linalg/sparse/sparse.hpp"
#include "mesh/mesh.hpp"

namespace delam {

struct HostPiece {
    std::vector<std::int64_t> nodes;  // mesh nodes, ascending
    DenseMatrix free;                 // motions without energy, [dimension*nodes][..], orthonormal
    // The other rigid motions, orthogonal to them: those that the host's supports resist. Not set if nothing is free.
    DenseMatrix held;

    bool fixed() const { return free.columns == 0; }
};

struct HostStiffness {
    SparseMatrix matrix;  // both triangles, over the body's nodes in ascending order, DOF dimension*i + component
    std::vector<HostPiece> pieces;
};

// Motions without energy declared by the host, over the body's DOFs; columns.
struct ToldKernel {
    bool told = false;
    DenseMatrix motions;
};

// Checks the stiffness that the host gives for one body, and finds its rigid motions. matrix: symmetric, both
// triangles. Error(DELAM_ERROR_ARGUMENT) names the node where something is wrong.
HostStiffness host_stiffness(const Mesh& mesh, std::int32_t body, SparseMatrix matrix, const ToldKernel& kernel,
                             Monitor& monitor);

}  // namespace delam
