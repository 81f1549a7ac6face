// SPDX-License-Identifier: BSD-3-Clause
// A body that is cut along faces within it: both sides have nodes of their own but for the edge of the cut, and the
// seam has their pairs and, where the cut has no edge within the body, the area of its faces.
#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "all_types.hpp"
#include "check.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "projection.hpp"

using namespace delam;
using namespace unit;

namespace {

using Inside = std::function<bool(std::span<const double>)>;

// A block of one body with a face between cells at half of its height, x to 4 and thickness 1.
Mesh block(CellType type) {
    const bool plane = topology(type).dimension == 2;
    return plane ? blocks({{type, {0, 0}, {4, 1}, {4, 2}}}) : blocks({{type, {0, 0, 0}, {4, 1, 1}, {4, 2, 2}}});
}

bool at_half(const Mesh& mesh, std::int64_t node) { return std::abs(mesh.node(node).back() - 0.5) < 1e-9; }

struct Faces {
    Indices nodes;
    std::size_t per_face = 0, count = 0;
};

// The faces at half of the height whose nodes all lie inside, by their corners or all nodes; the triangles of cells
// with several kinds of faces repeat a node.
Faces faces_at_half(const Mesh& mesh, const Inside& inside, bool corners) {
    std::set<std::set<std::int64_t>> met;
    std::vector<Indices> lists;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        for (std::size_t f = 0; f < index(topology(mesh.cell_type(c)).faces); ++f) {
            const BoundaryFace face = face_of(mesh, c, f);
            bool all = true;
            for (const std::int64_t n : face.all()) all = all && at_half(mesh, n) && inside(mesh.node(n));
            const std::span<const std::int64_t> listed = corners ? face.corner() : face.all();
            if (all && met.insert({face.corner().begin(), face.corner().end()}).second)
                lists.emplace_back(listed.begin(), listed.end());
        }
    Faces faces;
    for (const Indices& list : lists) faces.per_face = std::max(faces.per_face, list.size());
    for (Indices list : lists) {
        while (list.size() < faces.per_face) list.push_back(list.back());
        faces.nodes.insert(faces.nodes.end(), list.rbegin(), list.rend());
    }
    faces.count = lists.size();
    return faces;
}

std::int64_t count_at_half(const Mesh& mesh, const Inside& inside) {
    std::set<std::int64_t> used;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) used.insert(mesh.cell(c).begin(), mesh.cell(c).end());
    return std::count_if(used.begin(), used.end(),
                         [&](std::int64_t n) { return at_half(mesh, n) && inside(mesh.node(n)); });
}

// From the side of the block to a tip within it, whose nodes stay one.
TEST(to_a_tip) {
    for (const CellType type : all_types)
        for (const bool corners : {true, false}) {
            Mesh mesh = block(type);
            const Faces faces = faces_at_half(
                mesh, [](auto x) { return x[0] < 2.0 + 1e-9; }, corners);
            const auto outer = boundary_faces(mesh, 0).size();
            const std::int64_t before = mesh.node_count();
            const std::int64_t opened = count_at_half(mesh, [](auto x) { return x[0] < 2.0 - 1e-9; });
            ck_assert_int_eq(cut(mesh, faces.nodes, faces.per_face), opened);
            ck_assert_int_eq(mesh.node_count(), before + opened);
            ck_assert_uint_eq(boundary_faces(mesh, 0).size(), outer + 2 * faces.count);
            for (std::int64_t n = before; n < mesh.node_count(); ++n) {
                ck_assert_int_lt(mesh.node_origin(n), before);
                ck_assert(at_half(mesh, n) && mesh.node(n)[0] == mesh.node(mesh.node_origin(n))[0]);
            }
            ck_assert_int_eq(add_seams(mesh, 0.0), 1);
            ck_assert_int_eq(static_cast<std::int64_t>(mesh.interfaces()[0].weight.size()), opened);
            ck_assert_refused(DELAM_ERROR_MESH, "no two cells of one body share it",
                              cut(mesh, faces.nodes, faces.per_face));
        }
}

// Through the block: the seam has the whole area.
TEST(through) {
    for (const CellType type : all_types) {
        Mesh mesh = block(type);
        const Faces faces = faces_at_half(
            mesh, [](auto) { return true; }, true);
        cut(mesh, faces.nodes, faces.per_face);
        ck_assert_int_eq(add_seams(mesh, 0.0), 1);
        double size = 0.0;
        for (const double weight : mesh.interfaces()[0].weight) size += weight;
        ck_assert(std::abs(size - 4.0) < 1e-12);
    }
}

// A cut within the body opens its inner nodes alone; two cuts that cross give each of four parts a node.
TEST(within_and_crossing) {
    Mesh mesh = blocks({{CellType::quad4, {0, 0}, {4, 4}, {4, 4}}});
    const auto node = [&](double x, double y) {
        for (std::int64_t n = 0; n < mesh.node_count(); ++n)
            if (std::abs(mesh.node(n)[0] - x) + std::abs(mesh.node(n)[1] - y) < 1e-9) return n;
        return std::int64_t{-1};
    };
    const Indices along{node(1, 2), node(2, 2), node(2, 2), node(3, 2)};
    Mesh one = mesh;
    ck_assert_refused(DELAM_ERROR_MESH, "open nothing", cut(one, std::span(along).first(2), 2));
    ck_assert_int_eq(cut(one, along, 2), 1);
    const Indices cross{node(1, 2), node(2, 2), node(2, 2), node(3, 2), node(2, 1), node(2, 2), node(2, 2), node(2, 3)};
    Mesh at_once = mesh;
    ck_assert_int_eq(cut(at_once, cross, 2), 3);
    ck_assert_int_eq(cut(one, std::span(cross).subspan(4), 2), 2);  // the original stands for its copy
    for (Mesh* crossed : {&at_once, &one}) {
        ck_assert_int_eq(crossed->node_count(), mesh.node_count() + 3);
        add_seams(*crossed, 0.0);
        double length = 0.0;
        for (const InterfaceGeometry& i : crossed->interfaces())
            for (const double weight : i.weight) length += weight;
        // Each arm is a face from the crossing to a tip, whose half of it has no pair.
        ck_assert_msg(std::abs(length - 2.0) < 1e-12, "%g, %zu interfaces", length, crossed->interfaces().size());
    }
}

TEST(refused) {
    Mesh mesh = blocks(stack(CellType::quad4, CellType::quad4, 2, 2));
    const std::int64_t nodes = mesh.node_count();
    const BoundaryFace outer = boundary_faces(mesh, 0).front();
    const Indices side{outer.all()[0], outer.all()[1]};
    ck_assert_refused(DELAM_ERROR_MESH, "no two cells of one body share it", cut(mesh, side, 2));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "must be in 0", cut(mesh, Indices{0, nodes}, 2));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "at least one", cut(mesh, Indices{}, 2));
    const Faces within = faces_at_half(
        blocks({{CellType::quad4, {0, 0}, {1, 1}, {2, 2}}}), [](auto) { return true; }, true);
    Mesh joined = blocks({{CellType::quad4, {0, 0}, {1, 1}, {2, 2}}, {CellType::quad4, {0, 1}, {1, 1}, {2, 2}}});
    Mesh opened = joined;
    add_interface(joined, 0, 1, 0.0);
    ck_assert_refused(DELAM_ERROR_STATE, "has an interface already", cut(joined, within.nodes, 2));
    ck_assert_int_eq(cut(opened, within.nodes, 2), 3);
    ck_assert_refused(DELAM_ERROR_STATE, "or is cut",
                      opened.add_cells(CellType::quad4, Indices{0, 1, 4, 3}, Labels{0}));
    add_interface(opened, 0, 1, 0.0);  // the other body does not touch the cut
    ck_assert_int_eq(mesh.node_count(), nodes);
}

}  // namespace
