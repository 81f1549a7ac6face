// SPDX-License-Identifier: BSD-3-Clause
// Meshes of Abaqus input files. SCENE.md lists what is read, what is ignored and what is refused.
#pragma once

#include "mesh_file.hpp"

namespace cli {

// bodies: the element sets that are the bodies, by the names they have in the scene; empty: those of the
// *SOLID SECTIONs, where there are none those of the *ELEMENT lines.
MeshFile read_abaqus(const std::string& path, const std::vector<std::string>& bodies, const Place& place);

}  // namespace cli
