// SPDX-License-Identifier: BSD-3-Clause
#include "scene/read_mesh.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "deck/abaqus/read_abaqus.hpp"
#include "mesh/gmsh/gmsh_module.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {

// Files of other programs by the endings of their names, and how a mesh that is read comes from them.
struct OtherFormat {
    std::string_view endings;  // each between blanks
    std::string_view what;
    std::string_view advice;  // {0}: the file, {1}: its name with .msh
};

constexpr std::string_view by_gmsh = "gmsh {0} -save -o {1} converts it";
constexpr std::string_view by_meshio =
    "meshio converts it, in Python: meshio.read(\"{0}\").write(\"{1}\", \"gmsh22\"); how its bodies stay "
    "apart: SCENE.md, [mesh]";
constexpr std::string_view no_volume =
    "it has no cells; fill its volume with cells by Gmsh or another mesher, and save {1}";
constexpr std::string_view by_preprocessor =
    "let its preprocessor write the mesh for Abaqus (.inp) or Nastran (.bdf), which Gmsh converts";
constexpr OtherFormat other_formats[] = {
    {" bdf nas fem dat ", "a mesh of Nastran", by_gmsh},
    {" unv ", "a mesh of I-DEAS", by_gmsh},
    {" mesh ", "a mesh of Medit", by_gmsh},
    {" vtk vtu ", "a mesh of VTK", by_meshio},
    {" xdmf xmf ", "a mesh of XDMF", by_meshio},
    {" med rmed ", "a mesh of Salome", by_meshio},
    {" e ex2 exo ", "a mesh of Exodus", by_meshio},
    {" cgns ", "a mesh of CGNS", by_meshio},
    {" cdb ", "a mesh of ANSYS", by_preprocessor},
    {" k key ", "a mesh of LS-DYNA", by_preprocessor},
    {" stl obj ply off ", "a surface", no_volume},
    {" geo step stp iges igs brep ", "a geometry", "gmsh {0} -3 -o {1} makes a mesh of it, in the plane with -2"},
};

// Returns what a file of another program is, and how a mesh that is read comes from it, as the rest of a sentence; "":
// it is not known.
std::string instead_of_format(const std::string& path) {
    const std::filesystem::path file(path);
    std::string ending = file.extension().string();
    if (ending.empty()) return "";
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const OtherFormat& format : other_formats)
        if (format.endings.find(" " + ending.substr(1) + " ") != std::string_view::npos)
            return fmt::format(
                ", and this is {}: {}", format.what,
                fmt::format(fmt::runtime(format.advice), file.filename().string(), file.stem().string() + ".msh"));
    return "";
}

}  // namespace

MeshFile read_mesh(const std::string& path, const std::vector<std::string>& bodies, const Place& place) {
    const bool abaqus = is_abaqus_file(path);
    if (!abaqus && !path.ends_with(".msh"))
        throw SceneFailure(place,
                           path + ": a mesh of Gmsh (.msh) or of Abaqus (.inp) is expected" + instead_of_format(path));
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
