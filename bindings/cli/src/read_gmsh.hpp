// SPDX-License-Identifier: BSD-3-Clause
// Meshes of Gmsh through libgmsh: .msh 2 and 4, ASCII and binary (Gmsh reference manual, "MSH file format").
#pragma once

#include "mesh_file.hpp"

namespace cli {

// Physical groups of the highest dimension are the bodies; where there are none, every entity is one, "surface-1" or
// "volume-1". Groups below are node sets, those of one dimension less face sets too. Nothing is printed.
MeshFile read_gmsh(const std::string& path, const Place& place);
// The same of the model that Gmsh holds, in a session of the caller's. subject: what messages begin with.
MeshData read_gmsh_model(const std::string& subject, const Place& place);

}  // namespace cli
