// SPDX-License-Identifier: BSD-3-Clause
// The eigenstrains of a scene as loads: nodal forces, and the energy that they store at zero displacement.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/problem.hpp"

namespace delam {

struct StrainLoads {
    std::vector<std::vector<double>> force;  // [patterns][DOFs], empty: none
    std::vector<double> energy;              // [patterns][patterns] W, in 1/2 theta^T W theta
};

// Over all mesh DOFs.
StrainLoads strain_loads(const Problem& problem);
// Returns the loads of some cells of a body, over the DOFs of `nodes` (ascending). A body whose stiffness is given has
// none: who gives it knows what its strains do.
StrainLoads strain_loads(const Problem& problem, std::int32_t body, std::span<const std::int64_t> cells,
                         std::span<const std::int64_t> nodes);
// Scales of the eigenstrains' effect without cancellation, per pattern at factor 1: strain times the extent of the mesh
// (L), and the largest nodal force (F).
struct StrainSizes {
    std::vector<double> displacement, force;  // [patterns]
};
StrainSizes strain_sizes(const Problem& problem);
// A body's eigenstrains at the given factors, in material axes.
Strain strain_at(const Problem& problem, std::int32_t body, std::span<const double> factors);

}  // namespace delam
