// SPDX-License-Identifier: BSD-3-Clause
// Tells how far the energy of the bodies is off because the mesh is coarse or its cells lock.
#pragma once

#include <string>

#include "model/library/model.hpp"
#include "result/fields/bulk_facts.hpp"

namespace cli {

// Estimates the error of the state that the solver shows.
MeshError mesh_error_of(const Model& model, delam_solver* solver);
// "" where it was not estimated.
std::string mesh_error_line(const MeshError& error, const Scene& scene);

}  // namespace cli
