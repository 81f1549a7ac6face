// SPDX-License-Identifier: BSD-3-Clause
// Loads of prescribed eigenstrains e*, constant in a cell's material axes:
//   1/2 int (eps - e*) : C : (eps - e*)  =  1/2 u^T K u - u^T f + 1/2 int e* : C : e*,      f = int B^T C e*.
// Internal bending modes have no mean gradient, and the mean dilatation is one of the projected functions, so f is the
// same in each formulation.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/model.hpp"
#include "mesh/mesh.hpp"

namespace delam {

using Strain = std::array<double, 6>;  // xx, yy, zz, 2xy, 2yz, 2zx

struct EigenstrainLoads {
    std::vector<std::vector<double>> force;  // [strains][DOFs of the nodes]
    std::vector<double> energy;              // [strains][strains]: int e*_i : C : e*_j
};

// Returns the loads of some cells of one body, over the DOFs of `nodes` (assembly.hpp), for each of the strains (in
// material axes) separately. Plane stress: an out-of-plane strain is free and causes no load.
EigenstrainLoads eigenstrain_loads(const Mesh& mesh, std::span<const std::int64_t> cells,
                                   std::span<const std::int64_t> nodes, const BodyModel& model,
                                   std::span<const Strain> strains);

}  // namespace delam
