// SPDX-License-Identifier: BSD-3-Clause
#include "scene/read_mesh.hpp"

#include <fmt/format.h>

#include "deck/abaqus/read_abaqus.hpp"
#include "mesh/gmsh/gmsh_module.hpp"
#include "text/wording.hpp"

namespace cli {

MeshFile read_mesh(const std::string& path, const std::vector<std::string>& bodies, const Place& place) {
    const bool abaqus = is_abaqus_file(path);
    if (!abaqus && !path.ends_with(".msh"))
        throw SceneFailure(place, path + ": a mesh of Gmsh (.msh) or of Abaqus (.inp) is expected");
    if (!abaqus && !bodies.empty())
        throw SceneFailure(place, "bodies is for .inp alone: in a .msh physical groups are the bodies");
    MeshFile out = abaqus ? read_abaqus(path, bodies, place) : gmsh_module(place).read(path, place);
    for (const std::string& name : out.mesh.body_names)
        if (name.size() > most_text_bytes)
            throw SceneFailure(place, fmt::format("{}: the name of a body, \"{}\", has {} bytes, and at most {} are "
                                                  "allowed",
                                                  path, shortened(name), name.size(), most_text_bytes));
    tidy(out.mesh);
    return out;
}

}  // namespace cli
