// SPDX-License-Identifier: BSD-3-Clause
// Strains of a cell at its Gauss points, as its formulation has them: with its internal modes, or with the dilatation
// that it projects.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "body/model.hpp"
#include "mesh/cell_type.hpp"
#include "mesh/shape.hpp"

namespace delam {

inline constexpr std::size_t most_gauss_points = 27, most_strains = 6;

// Strains of a displacement gradient du_i/dx_j [dim][dim], in the order of elasticity_matrix().
template <std::size_t dim>
std::array<double, most_strains> strain_of(const double* slope) {
    if constexpr (dim == 2)
        return {slope[0], slope[3], slope[1] + slope[2]};
    else
        return {slope[0], slope[4], slope[8], slope[1] + slope[3], slope[5] + slope[7], slope[2] + slope[6]};
}

struct CellStrains {
    // [points][strains] of the displacements and the internal modes, in the order of elasticity_matrix().
    std::array<double, most_gauss_points * most_strains> strain{};
    // [points] what the projection adds to each of the strains xx, yy and zz.
    std::array<double, most_gauss_points> dilatation{};
    std::array<double, most_gauss_points> volume{};  // [points]
    // Energy, F L, that internal modes would take off a standard cell at these displacements; 0 for other cells.
    double excess = 0.0;
};

// A cell as its strains need it: what they take besides its displacements, computed once for all displacements.
class StrainedCell {
public:
    // coordinates: [nodes][dimension]; elasticity as for elasticity_matrix().
    StrainedCell(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                 Formulation formulation);
    // displacement: [nodes][dimension]. Eigenstrains are not subtracted. Entries of points that the cell has not are
    // undefined.
    void find(std::span<const double> displacement, CellStrains& cell) const;

private:
    template <std::size_t dim>
    void take_modes(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                    std::span<const double> jacobian);
    void take_projection(CellType type, std::span<const double> coordinates);
    template <std::size_t dim>
    void find_in(std::span<const double> displacement, CellStrains& cell) const;
    template <std::size_t dim>
    void bend(CellStrains& cell) const;

    std::size_t dimension_, nodes_, points_;
    bool adds_modes_ = false;               // or else counts the energy that they would take off
    std::vector<double> gradient_;          // [points][nodes][dimension]
    std::vector<double> volume_;            // [points]
    std::vector<double> mode_;              // [points][dimension]: the number of mode m at a point; empty: no modes
    std::vector<double> mode_strain_;       // [modes][strains]
    std::vector<double> mode_stress_;       // [modes][strains]
    std::vector<double> mode_flexibility_;  // [modes][modes]: K_aa^-1
    std::vector<double> projection_;        // [points][points]: of dilatations; empty: they are not projected
};

// Returns what StrainedCell finds for one cell and one displacement.
CellStrains cell_strains(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                         Formulation formulation, std::span<const double> displacement);

}  // namespace delam
