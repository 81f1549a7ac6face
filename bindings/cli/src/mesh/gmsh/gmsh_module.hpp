// SPDX-License-Identifier: BSD-3-Clause
// All that needs Gmsh, in a module that is loaded when a scene asks for it: Gmsh brings some hundred libraries along,
// and the dynamic linker takes longer for them than a small analysis takes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/gmsh/generate_fibre_cell.hpp"
#include "mesh/gmsh/generate_weave.hpp"
#include "mesh/mesh_file.hpp"

namespace cli {

struct GmshModule {
    const char* version;  // of the program that it belongs to
    MeshFile (*read)(const std::string& path, const Place& place);
    std::vector<std::size_t> (*elements)(const std::string& path, const Place& place);
    MeshData (*fibre_cell)(const FibreCell& cell);
    MeshData (*weave)(const WeaveCell& cell);
};

// Loads the module at the first call, from the folder in which the program searches its libraries. place: of the key
// that needs it. Throws SceneFailure with the linker's words if that fails.
const GmshModule& gmsh_module(const Place& place);

}  // namespace cli
