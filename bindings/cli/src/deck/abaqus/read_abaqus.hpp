// SPDX-License-Identifier: BSD-3-Clause
// Meshes of Abaqus input files. SCENE.md lists what the program reads, ignores and refuses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/file_element.hpp"
#include "mesh/mesh_file.hpp"

namespace cli {

// Decides by the ending of the name.
bool is_abaqus_file(const std::string& path);

// bodies: the element sets that are the bodies, under their names in the scene; if empty, those of the *SOLID SECTIONs;
// if there are none, those of the *ELEMENT lines.
MeshFile read_abaqus(const std::string& path, const std::vector<std::string>& bodies, const Place& place);
// Reads the file again and returns the elements of which these cells were made.
std::vector<FileElement> abaqus_elements(const std::string& path, const std::vector<std::string>& bodies,
                                         const Place& place, const std::vector<std::int64_t>& cells);

}  // namespace cli
