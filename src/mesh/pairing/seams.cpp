// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/pairing/seams.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "mesh/face_point.hpp"
#include "mesh/faces.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// True at nodes that have a pair, by themselves or through nodes tied to them.
std::vector<std::uint8_t> paired_nodes(const Mesh& mesh) {
    std::vector<std::uint8_t> paired(index(mesh.node_count()), 0);
    for (const InterfaceGeometry& interface : mesh.interfaces()) {
        for (const std::int64_t node : interface.node_a) paired[index(node)] = 1;
        for (const std::int64_t node : interface.node_b) paired[index(node)] = 1;
    }
    for (const NodeTie& tie : mesh.ties())
        for (const auto& [node, weight] : tie.of) paired[index(node)] = 1;
    return paired;
}

Point centre_of(const Mesh& mesh, const BoundaryFace& face) {
    Point centre{};
    for (const std::int64_t node : face.corner())
        for (std::size_t i = 0; i < index(mesh.dimension()); ++i)
            centre[i] += mesh.node(node)[i] / static_cast<double>(face.corners);
    return centre;
}

}  // namespace

std::vector<Seam> find_seams(const Mesh& mesh) {
    std::vector<BoundaryFace> faces = boundary_faces(mesh, -1);
    const std::vector<std::uint8_t> paired = paired_nodes(mesh);
    std::erase_if(faces, [&](const BoundaryFace& face) {
        return std::all_of(face.all().begin(), face.all().end(), [&](std::int64_t n) { return paired[index(n)] != 0; });
    });
    if (faces.empty()) return {};
    std::vector<std::int64_t> cells(index(mesh.cell_count()));
    std::iota(cells.begin(), cells.end(), std::int64_t{0});
    const double rounding = 1e-6 * shortest_edge(mesh, cells);
    std::vector<Box> boxes;
    std::vector<Point> normal;
    for (const BoundaryFace& face : faces) {
        boxes.push_back(box_of(mesh, face, rounding));
        normal.push_back(area_vector(mesh, face.all()));
    }
    const BoxTree tree(boxes);
    std::map<std::pair<std::int32_t, std::int32_t>, Seam> found;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        poll_cancel("pairs");
        const Point centre = centre_of(mesh, faces[f]);
        std::int64_t on = -1;
        tree.containing(centre, [&](std::int64_t g) {
            const double along = dot(normal[f], normal[index(g)]);
            if (on >= 0 || along > -0.5 * length(normal[f]) * length(normal[index(g)])) return;
            if (length(closest_point(mesh, faces[index(g)], centre).place - centre) <= rounding) on = g;
        });
        if (on < 0) continue;
        const auto bodies = std::pair<std::int32_t, std::int32_t>(
            std::minmax({mesh.cell_body(faces[f].cell), mesh.cell_body(faces[index(on)].cell)}));
        Seam& seam = found.try_emplace(bodies, Seam{bodies.first, bodies.second, 0, {centre, centre}}).first->second;
        ++seam.faces;
        for (std::size_t i = 0; i < 3; ++i) {
            seam.box.low[i] = std::min(seam.box.low[i], centre[i]);
            seam.box.high[i] = std::max(seam.box.high[i], centre[i]);
        }
    }
    std::vector<Seam> seams;
    for (const auto& [bodies, seam] : found) seams.push_back(seam);
    return seams;
}

}  // namespace delam
