// SPDX-License-Identifier: BSD-3-Clause
// Stiffness matrix of a set of cells, and stresses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "body/eigenstrain.hpp"
#include "body/equal/centre_gradients.hpp"
#include "body/model.hpp"
#include "linalg/sparse/sparse.hpp"
#include "mesh/mesh.hpp"

namespace delam {

class CellElasticity;

// Full symmetric stiffness (both triangles) of some cells over the DOFs of `nodes` (ascending mesh nodes that include
// all nodes of the cells): DOF dimension*i + component of nodes[i]. models: by body index. No digit depends on the
// threads.
SparseMatrix assemble_stiffness(const Mesh& mesh, std::span<const std::int64_t> cells,
                                std::span<const std::int64_t> nodes, std::span<const BodyModel> models,
                                std::int64_t threads = 1, const Poll& poll = {});
// The same of cells of one body.
SparseMatrix assemble_stiffness(const Mesh& mesh, std::span<const std::int64_t> cells,
                                std::span<const std::int64_t> nodes, const BodyModel& model, std::int64_t threads = 1,
                                const Poll& poll = {});

// The stiffness of a cell, row-major, [size][size]; coordinates: [nodes][dimension]; elasticity: of its body.
void cell_stiffness(CellType type, std::span<const double> coordinates, std::int64_t cell, Formulation formulation,
                    CellElasticity& elasticity, std::span<double> matrix);

// Entries of this matrix, without its values.
std::int64_t stiffness_entries(const Mesh& mesh, std::span<const std::int64_t> cells,
                               std::span<const std::int64_t> nodes);

// Stresses at cell centres, [cells][4 or 6]: xx, yy, zz, xy (2D, zz from the plane assumption) or xx, yy, zz, xy, yz,
// zx: C (eps - e*). displacement: [mesh nodes][dimension]; models by body index; eigenstrains e* by body index too, in
// material axes (none if the list is empty).
std::vector<double> centre_stress(const Mesh& mesh, std::span<const BodyModel> models,
                                  std::span<const double> displacement, std::span<const Strain> eigenstrain = {});
// Returns the same where the displacement gradients at the centres are known (CentreGradients::slopes).
std::vector<double> centre_stress(const Mesh& mesh, std::span<const BodyModel> models,
                                  std::span<const double> displacement, std::span<const double> slopes,
                                  std::span<const Strain> eigenstrain);
std::vector<double> centre_stress(const Mesh& mesh, std::span<const BodyModel> models,
                                  const DisplacementOfCell& displacement, std::span<const double> slopes,
                                  std::span<const Strain> eigenstrain);

}  // namespace delam
