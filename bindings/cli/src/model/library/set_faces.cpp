// SPDX-License-Identifier: BSD-3-Clause
#include "model/library/set_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "mesh/cell_shape.hpp"
#include "model/library/call.hpp"

namespace cli {

namespace {

using Key = std::vector<std::int64_t>;  // corners of a face, ascending, as nodes of the file

struct Face {
    std::int32_t body;
    std::vector<std::int64_t> nodes;  // of the mesh, corners first, seen from inside counter-clockwise
};

struct MeshArrays {
    std::size_t dimension = 0;
    std::vector<double> nodes;
    std::vector<std::int64_t> origins;
    std::vector<std::int32_t> types;
    std::vector<std::int32_t> bodies;
    std::vector<std::int64_t> offsets;
    std::vector<std::int64_t> connectivity;
};

MeshArrays arrays_of(const delam_context* context, const delam_mesh* mesh, const Place& place) {
    std::int32_t dimension = 0;
    std::int64_t nodes = 0;
    std::int64_t cells = 0;
    std::int64_t entries = 0;
    call(context, delam_mesh_size(mesh, &dimension, &nodes, &cells, nullptr, nullptr), place);
    call(context, delam_mesh_cells(mesh, nullptr, nullptr, nullptr, 0, nullptr, &entries), place);
    MeshArrays out;
    out.dimension = static_cast<std::size_t>(dimension);
    out.nodes.resize(static_cast<std::size_t>(nodes * dimension));
    out.origins.resize(static_cast<std::size_t>(nodes));
    out.types.resize(static_cast<std::size_t>(cells));
    out.bodies.resize(static_cast<std::size_t>(cells));
    out.offsets.resize(static_cast<std::size_t>(cells) + 1);
    out.connectivity.resize(static_cast<std::size_t>(entries));
    call(context, delam_mesh_nodes(mesh, nodes * dimension, out.nodes.data()), place);
    call(context, delam_mesh_node_origins(mesh, nodes, out.origins.data()), place);
    call(context,
         delam_mesh_cells(mesh, out.types.data(), out.bodies.data(), out.offsets.data(), entries,
                          out.connectivity.data(), &entries),
         place);
    return out;
}

// Returns the number of corners of a side by its number of nodes: in space it is a plane cell.
std::size_t corner_count(std::size_t dimension, std::size_t nodes) {
    if (dimension == 2) return 2;
    for (const CellShape& shape : all_shapes())
        if (shape.dimension == 2 && shape.nodes == nodes) return shape.corners;
    throw Failure(exit_numerical, fmt::format("no cell has sides of {} nodes", nodes));
}

// A side of a solid cell, walked the other way round from the same corner: inwards.
std::vector<std::size_t> turned(const std::vector<std::size_t>& side, std::size_t corners) {
    std::vector<std::size_t> out = side;
    const auto middles = static_cast<std::ptrdiff_t>(corners);
    std::reverse(out.begin() + 1, out.begin() + middles);
    if (side.size() > corners) std::reverse(out.begin() + middles, out.begin() + 2 * middles);  // a centre stays last
    return out;
}

// Sides of cells by their corners, of the given faces or between the given nodes.
std::map<Key, std::vector<Face>> sides_in(const MeshArrays& mesh, const std::set<Key>& wanted,
                                          const std::vector<bool>& in) {
    std::map<Key, std::vector<Face>> out;
    for (std::size_t c = 0; c < mesh.types.size(); ++c) {
        const std::int64_t* cell = mesh.connectivity.data() + mesh.offsets[c];
        const CellShape& shape = shape_of(mesh.types[c]);
        for (const auto& outward : shape.sides) {
            const std::span<const std::size_t> corners = shape.corners_of(outward);
            const auto side = mesh.dimension == 2 ? outward : turned(outward, corners.size());
            Key key;
            for (const std::size_t i : corners) key.push_back(mesh.origins[static_cast<std::size_t>(cell[i])]);
            std::sort(key.begin(), key.end());
            const bool chosen = wanted.empty()
                                    ? std::all_of(key.begin(), key.end(),
                                                  [&](std::int64_t n) { return in[static_cast<std::size_t>(n)]; })
                                    : wanted.contains(key);
            if (!chosen) continue;
            Face face{mesh.bodies[c], {}};
            for (const std::size_t i : side) face.nodes.push_back(cell[i]);
            out[key].push_back(std::move(face));
        }
    }
    return out;
}

// Shape functions and their derivatives at a point of the reference face.
struct Shape {
    std::array<double, 9> value{};
    std::array<double, 9> by_xi{};
    std::array<double, 9> by_eta{};
};

Shape line_shape(std::size_t nodes, double x) {
    if (nodes == 2) return {{(1 - x) / 2, (1 + x) / 2}, {-0.5, 0.5}, {}};
    return {{x * (x - 1) / 2, x * (x + 1) / 2, 1 - x * x}, {x - 0.5, x + 0.5, -2 * x}, {}};
}

Shape triangle_shape(std::size_t nodes, double x, double y) {
    const double z = 1 - x - y;
    if (nodes == 3) return {{z, x, y}, {-1, 1, 0}, {-1, 0, 1}};
    return {{z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * z * x, 4 * x * y, 4 * y * z},
            {1 - 4 * z, 4 * x - 1, 0, 4 * (z - x), 4 * y, -4 * y},
            {1 - 4 * z, 0, 4 * y - 1, -4 * x, 4 * x, 4 * (z - y)}};
}

// Products of those of 3-node lines: corners, middles of sides, centre.
Shape biquadratic_shape(double x, double y) {
    constexpr std::size_t on_x[] = {0, 1, 1, 0, 2, 1, 2, 0, 2};  // node of the line along x, then of that along y
    constexpr std::size_t on_y[] = {0, 0, 1, 1, 0, 2, 1, 2, 2};
    const Shape along_x = line_shape(3, x);
    const Shape along_y = line_shape(3, y);
    Shape out;
    for (std::size_t i = 0; i < 9; ++i) {
        out.value[i] = along_x.value[on_x[i]] * along_y.value[on_y[i]];
        out.by_xi[i] = along_x.by_xi[on_x[i]] * along_y.value[on_y[i]];
        out.by_eta[i] = along_x.value[on_x[i]] * along_y.by_xi[on_y[i]];
    }
    return out;
}

Shape quadrilateral_shape(std::size_t nodes, double x, double y) {
    if (nodes == 9) return biquadratic_shape(x, y);
    constexpr double cx[] = {-1, 1, 1, -1};
    constexpr double cy[] = {-1, -1, 1, 1};
    Shape out;
    for (std::size_t i = 0; i < 4; ++i) {
        const double a = 1 + cx[i] * x;
        const double b = 1 + cy[i] * y;
        if (nodes == 4) {
            out.value[i] = a * b / 4;
            out.by_xi[i] = cx[i] * b / 4;
            out.by_eta[i] = cy[i] * a / 4;
        } else {
            const double s = cx[i] * x + cy[i] * y - 1;
            out.value[i] = a * b * s / 4;
            out.by_xi[i] = cx[i] * b * (s + a) / 4;
            out.by_eta[i] = cy[i] * a * (s + b) / 4;
        }
    }
    if (nodes == 4) return out;
    for (std::size_t i : {0U, 2U}) {
        const double side = i == 0 ? -1 : 1;
        out.value[4 + i] = (1 - x * x) * (1 + side * y) / 2;
        out.by_xi[4 + i] = -x * (1 + side * y);
        out.by_eta[4 + i] = side * (1 - x * x) / 2;
        out.value[5 + i] = (1 - y * y) * (1 - side * x) / 2;
        out.by_xi[5 + i] = -side * (1 - y * y) / 2;
        out.by_eta[5 + i] = -y * (1 - side * x);
    }
    return out;
}

struct Point3 {
    double x, y, weight;
};

// Three points per direction, exact to degree 5; on triangles Strang's six points, degree 4.
std::vector<Point3> points_of(std::size_t dimension, std::size_t nodes) {
    static const double g = std::sqrt(0.6);
    const std::array<std::pair<double, double>, 3> line{{{-g, 5.0 / 9}, {0, 8.0 / 9}, {g, 5.0 / 9}}};
    std::vector<Point3> out;
    if (dimension == 2) {
        for (const auto& [x, w] : line) out.push_back({x, 0, w});
    } else if (corner_count(3, nodes) == 4) {
        for (const auto& [x, w] : line)
            for (const auto& [y, v] : line) out.push_back({x, y, w * v});
    } else {
        for (const auto& [a, w] : {std::pair{0.445948490915965, 0.223381589678011 / 2},
                                   std::pair{0.091576213509771, 0.109951743655322 / 2}}) {
            out.push_back({a, a, w});
            out.push_back({1 - 2 * a, a, w});
            out.push_back({a, 1 - 2 * a, w});
        }
    }
    return out;
}

// Adds the face's integrals to those of its nodes: weight, then components of the normal.
void integrate(const MeshArrays& mesh, const Face& face, std::map<std::int64_t, std::array<double, 4>>& out) {
    const std::size_t n = face.nodes.size();
    for (const Point3& point : points_of(mesh.dimension, n)) {
        const Shape shape = mesh.dimension == 2       ? line_shape(n, point.x)
                            : corner_count(3, n) == 3 ? triangle_shape(n, point.x, point.y)
                                                      : quadrilateral_shape(n, point.x, point.y);
        std::array<double, 3> t{};
        std::array<double, 3> s{};
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t a = 0; a < mesh.dimension; ++a) {
                const double x = mesh.nodes[static_cast<std::size_t>(face.nodes[i]) * mesh.dimension + a];
                t[a] += shape.by_xi[i] * x;
                s[a] += shape.by_eta[i] * x;
            }
        // Plane cells run counter-clockwise, so the outward normal is to the right of a side; the sides of solid cells
        // face inwards.
        const std::array<double, 3> normal =
            mesh.dimension == 2 ? std::array<double, 3>{t[1], -t[0], 0}
                                : std::array<double, 3>{s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2],
                                                        s[0] * t[1] - s[1] * t[0]};
        const double area = std::hypot(normal[0], normal[1], normal[2]);
        for (std::size_t i = 0; i < n; ++i) {
            auto& sum = out[face.nodes[i]];
            const double weight = point.weight * shape.value[i];
            sum[0] += weight * area;
            for (std::size_t a = 0; a < 3; ++a) sum[a + 1] += weight * normal[a];
        }
    }
}

}  // namespace

Selected select_faces(const delam_context* context, const delam_mesh* mesh_handle, const Scene& scene,
                      const Selection& selection, const std::string& name) {
    const MeshArrays mesh = arrays_of(context, mesh_handle, selection.place);
    std::set<Key> wanted;
    std::vector<bool> in(mesh.origins.size(), false);
    const auto set = scene.mesh->face_sets.find(name);
    const std::vector<std::int64_t>& nodes = scene.mesh->node_sets.at(name);
    if (set != scene.mesh->face_sets.end())
        for (const auto& face : set->second) {
            const auto count = static_cast<std::size_t>(std::find(face.begin(), face.end(), -1) - face.begin());
            Key key(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(corner_count(mesh.dimension, count)));
            std::sort(key.begin(), key.end());
            wanted.insert(std::move(key));
        }
    else
        for (const std::int64_t node : nodes) in[static_cast<std::size_t>(node)] = true;

    std::map<std::int64_t, std::array<double, 4>> sums;
    std::size_t found = 0;
    for (const auto& [key, faces] : sides_in(mesh, wanted, in)) {
        std::vector<const Face*> own;
        for (const Face& face : faces)
            if (selection.body < 0 || face.body == selection.body) own.push_back(&face);
        ++found;
        if (own.size() == 1) integrate(mesh, *own.front(), sums);
        // The nodes of a set may also span sides inside a body; these are ignored.
        if (own.size() < 2 || wanted.empty()) continue;
        throw SceneFailure(selection.place,
                           own[0]->body == own[1]->body
                               ? fmt::format("a face of the set \"{}\" lies inside of body \"{}\"", name,
                                             scene.layers[static_cast<std::size_t>(own[0]->body)].name)
                               : fmt::format("a face of the set \"{}\" lies between \"{}\" and \"{}\"; name one with "
                                             "body = \"..\"",
                                             name, scene.layers[static_cast<std::size_t>(own[0]->body)].name,
                                             scene.layers[static_cast<std::size_t>(own[1]->body)].name));
    }
    if (found < wanted.size())
        throw SceneFailure(selection.place, fmt::format("{} of the {} faces of the set \"{}\" are no sides of cells",
                                                        wanted.size() - found, wanted.size(), name));
    Selected out;
    const std::string body =
        selection.body < 0 ? "a body" : "\"" + scene.layers[static_cast<std::size_t>(selection.body)].name + "\"";
    if (sums.empty()) {
        Selected single;
        for (std::size_t i = 0; i < mesh.origins.size(); ++i)
            if (mesh.origins[i] == nodes.front()) single.nodes.push_back(static_cast<std::int64_t>(i));
        if (nodes.size() == 1 && single.nodes.size() == 1) return single;
        throw SceneFailure(selection.place,
                           fmt::format("the set \"{}\" has no face on the boundary of {}", name, body));
    }
    for (const auto& [node, sum] : sums) {
        out.nodes.push_back(node);
        out.weights.push_back(sum[0]);
        out.normals.insert(out.normals.end(), sum.begin() + 1,
                           sum.begin() + 1 + static_cast<std::ptrdiff_t>(mesh.dimension));
    }
    return out;
}

}  // namespace cli
