// SPDX-License-Identifier: BSD-3-Clause
// The material of a body and the formulation of its cells: everything that turns its mesh into a stiffness.
#pragma once

#include <cstdint>
#include <memory>

#include "body/material.hpp"
#include "body/orientation.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// incompatible: quad4 and hex8 with internal bending modes. mean_dilatation: the dilatation projected onto few
// functions of the cell, for nearly incompressible bodies (element.cpp).
enum class Formulation { standard, incompatible, mean_dilatation };
const char* name_of(Formulation formulation);

struct BodyModel {
    Material material;
    Plane plane = Plane::strain;
    Formulation formulation = Formulation::standard;
    std::shared_ptr<const Orientation> orientation{};  // of the whole mesh's cells; null: none

    bool operator==(const BodyModel& other) const = default;
};

// Error(status) if a cell of the body has no such formulation.
void require_formulation(const Mesh& mesh, std::int32_t body, Formulation formulation, std::int32_t status);

}  // namespace delam
