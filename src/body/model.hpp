// SPDX-License-Identifier: BSD-3-Clause
// The material of a body and the formulation of its cells: everything that turns its mesh into a stiffness.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "body/material.hpp"
#include "body/orientation.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// incompatible: quad4 and hex8 with internal bending modes; other cells of the body are standard. mean_dilatation: the
// dilatation projected onto few functions of the cell, for nearly incompressible bodies (element.cpp).
enum class Formulation { standard, incompatible, mean_dilatation };
const char* name_of(Formulation formulation);

struct BodyModel {
    Material material;
    Plane plane = Plane::strain;
    Formulation formulation = Formulation::standard;
    std::shared_ptr<const Orientation> orientation{};  // of the whole mesh's cells; null: none

    bool operator==(const BodyModel& other) const = default;
};

// Returns the formulations of bodies for which nobody chooses one, [bodies]: incompatible if a body has cells with such
// modes.
std::vector<Formulation> default_formulations(const Mesh& mesh);
// Error(status) if the body has no cell with incompatible modes, or has a cell whose dilatation cannot be projected.
void require_formulation(const Mesh& mesh, std::int32_t body, Formulation formulation, std::int32_t status);

}  // namespace delam
