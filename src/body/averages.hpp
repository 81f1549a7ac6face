// SPDX-License-Identifier: BSD-3-Clause
// Mean strain and stress of bodies over their volume.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "body/assembly.hpp"
#include "body/cell_elasticity.hpp"
#include "body/eigenstrain.hpp"
#include "body/model.hpp"
#include "body/orientation.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// xx, yy, zz, xy, yz, zx, shear strains doubled.
struct VolumeAverage {
    double volume = 0.0;  // L2 or L3
    std::array<double, 6> strain{};
    std::array<double, 6> stress{};
};
// Integrates over the cells of a body (-1: of all). Exact, because the quadrature gives a cell's mean gradient exactly,
// internal modes do not contribute to it, and the elasticity is constant in a cell. Out of the plane: no strain, or in
// plane stress no stress. models by body index; displacement: [mesh nodes][dimension]; eigenstrain by body index, in
// material axes, or empty: stresses are C (eps - e*), strains the whole eps.
VolumeAverage volume_average(const Mesh& mesh, std::span<const BodyModel> models, std::span<const double> displacement,
                             std::span<const Strain> eigenstrain, std::int32_t body);
// Returns the same of cells that turn: displacements are those in the frame of the cell, whose strains and stresses are
// turned with it, and then summed. axes: of a cell's frame, by row.
using AxesOfCell = std::function<Axes(std::int64_t cell)>;
VolumeAverage volume_average(const Mesh& mesh, std::span<const BodyModel> models,
                             const DisplacementOfCell& displacement, const AxesOfCell& axes,
                             std::span<const Strain> eigenstrain, std::int32_t body);

// The same averages as sums over displacements and eigenstrains.
struct AverageWeights {
    double volume = 0.0;
    // [6] each [mesh DOFs]; empty: the component does not depend on displacements
    std::array<std::vector<double>, 6> strain, stress;
    std::vector<SpaceElasticity> strain_of_eigenstrain, stress_of_eigenstrain;  // [bodies], [6][6]

    // strain, stress: the sums over the displacements.
    VolumeAverage with(const std::array<double, 6>& strain_of_displacement,
                       const std::array<double, 6>& stress_of_displacement, std::span<const Strain> eigenstrain) const;
};
AverageWeights average_weights(const Mesh& mesh, std::span<const BodyModel> models, std::int32_t body);

}  // namespace delam
