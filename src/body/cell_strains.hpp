// SPDX-License-Identifier: BSD-3-Clause
// Strains of a cell at its Gauss points, as its formulation has them: with its internal modes, or with the dilatation
// that it projects.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "body/model.hpp"
#include "mesh/cell_type.hpp"
#include "mesh/shape.hpp"

namespace delam {

inline constexpr std::size_t most_gauss_points = 27, most_strains = 6;

struct CellStrains {
    // [points][strains] of the displacements and the internal modes, in the order of elasticity_matrix().
    std::array<double, most_gauss_points * most_strains> strain{};
    // [points] what the projection adds to each of the strains xx, yy and zz.
    std::array<double, most_gauss_points> dilatation{};
    std::array<double, most_gauss_points> volume{};  // [points]
    // Energy, F L, that internal modes would take off a standard cell at these displacements; 0 for other cells.
    double excess = 0.0;
};

// displacement: [nodes][dimension]; elasticity as for elasticity_matrix(). Eigenstrains are not subtracted.
CellStrains cell_strains(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                         Formulation formulation, std::span<const double> displacement);

}  // namespace delam
