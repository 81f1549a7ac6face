// SPDX-License-Identifier: BSD-3-Clause
// The text of an Abaqus input file, and after each line "== NAME.inp" that of a file that others may include. A bad
// mesh must end in the program's own failure with a message; a good one refers to its own nodes alone.
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "contract.hpp"
#include "folder.hpp"
#include "mesh/cell_shape.hpp"
#include "scene/read_mesh.hpp"
#include "text/error.hpp"

namespace {

using fuzz::expect;

// Only files of the folder are written.
bool harmless(std::string_view name) {
    return name.size() > 4 && name.size() < 40 && name.ends_with(".inp") &&
           std::all_of(name.begin(), name.end() - 4, [](unsigned char c) { return std::isalnum(c) != 0; });
}

void expect_whole(const cli::MeshData& mesh) {
    const auto nodes = static_cast<std::int64_t>(mesh.nodes.size()) / mesh.dimension;
    const auto known = [nodes](std::int64_t node) { return node >= 0 && node < nodes; };
    for (const cli::CellBlock& block : mesh.blocks) {
        expect(block.connectivity.size() == block.bodies.size() * cli::shape_of(block.type).nodes, "whole cells", "");
        expect(std::all_of(block.connectivity.begin(), block.connectivity.end(), known), "nodes of cells", "");
        for (const std::int32_t body : block.bodies)
            expect(body >= 0 && static_cast<std::size_t>(body) < mesh.body_names.size(), "bodies of cells", "");
    }
    for (const auto& [name, members] : mesh.node_sets)
        expect(std::all_of(members.begin(), members.end(), known), "nodes of sets", name.c_str());
    for (const auto& [name, faces] : mesh.face_sets)
        for (const auto& face : faces)
            expect(std::all_of(face.begin(), face.end(), [&](std::int64_t n) { return n == -1 || known(n); }),
                   "nodes of faces", name.c_str());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::Folder folder;
    constexpr std::string_view mark = "\n== ";
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    const std::string main = folder.write("main.inp", rest.substr(0, rest.find(mark)));
    std::vector<std::string> names;
    for (std::size_t at = rest.find(mark); at != std::string_view::npos; at = rest.find(mark)) {
        rest.remove_prefix(at + mark.size());
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string name(rest.substr(0, end));
        rest.remove_prefix(end);
        if (!harmless(name)) continue;
        if (name != "main.inp") names.push_back(name);
        folder.write(name, rest.substr(0, rest.find(mark)));
    }
    try {
        expect_whole(cli::read_mesh(main, {}, {"scene.toml", "mesh.file", 3}).mesh);
    } catch (const cli::SceneFailure& failure) {
        expect(!std::string_view(failure.what()).empty(), "a failure has a text", "mesh");
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& e) {
        expect(false, "a mesh fails by the program's own failure", e.what());
    }
    for (const std::string& name : names) folder.remove(name);
    return 0;
}
