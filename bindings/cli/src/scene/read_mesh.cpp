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
    out.mesh.file = path;
    out.mesh.chosen = bodies;
    return out;
}

std::vector<FileElement> file_elements(const MeshData& mesh, const std::vector<std::int64_t>& cells) {
    if (mesh.file.empty()) return {};
    const Place place{mesh.file, "", 0};
    try {
        if (is_abaqus_file(mesh.file)) return abaqus_elements(mesh.file, mesh.chosen, place, cells);
        const std::vector<std::size_t> tags = gmsh_module(place).elements(mesh.file, place);
        std::vector<FileElement> out;
        for (const std::int64_t cell : cells)
            out.push_back({std::to_string(tags.at(static_cast<std::size_t>(cell))), place});
        return out;
    } catch (const std::exception&) {
        return {};  // the file is another one by now; what was wrong is said without it
    }
}

}  // namespace cli
