// SPDX-License-Identifier: BSD-3-Clause
// The work of present stresses on further displacements, to second order: with their gradients H and the stresses s, it
// is 1/2 int s : H^T H dV, which strains that are linear in the displacements leave out (O. Zienkiewicz, R. Taylor, The
// Finite Element Method 2, 2000, section 10.4). Stresses and gradients are those of the middle of each cell.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/equal/row_table.hpp"
#include "mesh/mesh.hpp"

namespace delam {

class InitialStress {
public:
    // The mesh must outlive it. stress: at the centres of the cells, [cells][4 or 6] (body/assembly.hpp); NaN where it
    // is not known, and taken as zero there.
    InitialStress(const Mesh& mesh, std::vector<double> stress);
    // Returns the forces by which the stresses press on along displacements [mesh DOFs], -int s : H^T dH dV. Their
    // product with the displacements is minus twice the work.
    std::vector<double> softening(std::span<const double> displacement) const;
    // Returns the work on the rotations of these displacements alone, 1/2 int s : W^T W dV with the skew part W of H.
    double work_on_rotations(std::span<const double> displacement) const;
    // Returns the nodal forces of the stresses, [mesh DOFs]: their product with displacements is int s : H dV.
    std::vector<double> forces() const;

private:
    // The mean gradients of a cell's shape functions, [nodes][dimension], and its volume.
    struct Cell {
        std::vector<double> gradient;
        double volume = 0.0;
    };
    static Cell integrated(CellType type, std::span<const double> coordinates);
    // Returns the stress of a cell, [dimension][dimension].
    std::array<double, 9> stress(std::int64_t cell) const;
    // Calls use(cell, its gradients and volume, its mean slope H [dimension][dimension]) for one cell after another.
    template <class Use>
    void each(std::span<const double> displacement, const Use& use) const;

    const Mesh& mesh_;
    std::vector<double> stress_;
    ByRow<Cell> cells_;
    std::vector<std::int32_t> which_;  // [cells]; -1: not kept
};

}  // namespace delam
