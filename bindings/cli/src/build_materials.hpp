// SPDX-License-Identifier: BSD-3-Clause
// What a body is made of, from the scene into the problem.
#pragma once

#include "delam/delam.h"
#include "scene.hpp"

namespace cli {

// place: of the layer or body in the scene. axes: of all its cells.
void set_material(const delam_context* owner, delam_problem* problem, std::int32_t body, const Material& material,
                  const std::optional<std::array<double, 6>>& axes, const Place& place);

}  // namespace cli
