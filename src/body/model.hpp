// SPDX-License-Identifier: BSD-3-Clause
// What a body is made of and how its cells are computed: all that turns its mesh into a stiffness.
#pragma once

#include <cstdint>

#include "body/material.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// incompatible: quad4 and hex8 with internal bending modes (element.cpp).
enum class Formulation { standard, incompatible };

struct BodyModel {
    Elastic elastic;
    Plane plane = Plane::strain;
    Formulation formulation = Formulation::standard;

    bool operator==(const BodyModel& other) const = default;
};

// Error(status) when a cell of the body has no such formulation.
void require_formulation(const Mesh& mesh, std::int32_t body, Formulation formulation, std::int32_t status);

}  // namespace delam
