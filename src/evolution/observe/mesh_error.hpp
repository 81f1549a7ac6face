// SPDX-License-Identifier: BSD-3-Clause
// Estimates how far the stored energy is off because the mesh is coarse or its cells lock:
//
//   eta^2 = 1/2 int (s* - s) : C^-1 : (s* - s) dx
//
// (O. Zienkiewicz, J. Zhu, Int. J. Numer. Meth. Eng. 24 (1987) 337-357), where s are the stresses at the Gauss points,
// of all modes that a cell has. s* are continuous stresses: nodal means of s within a body and among cells of about the
// same elasticity, since stresses of different materials differ with reason.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "body/eigenstrain.hpp"
#include "body/model.hpp"
#include "body/turned/turned_bodies.hpp"
#include "mesh/mesh.hpp"

namespace delam {

struct MeshError {
    std::vector<double> of_cell;  // [cells] eta^2, F L; NaN where no material is known
    std::vector<double> excess;   // [cells] what incompatible modes would take off standard cells, F L
};

// The cells and nodes of a mesh as all estimates need them.
class MeshErrorEstimate {
public:
    virtual ~MeshErrorEstimate() = default;
    // displacement: [mesh nodes][dimension]. eigenstrain: by body index, in material axes, or empty.
    MeshError of(std::span<const double> displacement, std::span<const Strain> eigenstrain) {
        return estimate({displacement, nullptr}, eigenstrain);
    }
    // Estimates the same of cells with frames: nodal means are those of stresses that have turned with the cells.
    MeshError of(const TurnedBodies& bodies, std::span<const Strain> eigenstrain) {
        return estimate({{}, &bodies}, eigenstrain);
    }

protected:
    struct Moved {
        std::span<const double> displacement;
        const TurnedBodies* turned;  // null: rotations are small
    };
    virtual MeshError estimate(const Moved& cells, std::span<const Strain> eigenstrain) = 0;
};

// models, known: by body index; models where known is 0 are not read. The mesh must outlive what is returned.
std::unique_ptr<MeshErrorEstimate> mesh_error_estimate(const Mesh& mesh, std::vector<BodyModel> models,
                                                       std::vector<std::uint8_t> known);

}  // namespace delam
