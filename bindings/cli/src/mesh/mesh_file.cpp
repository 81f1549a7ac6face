// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mesh/cell_shape.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

void drop_orphans(MeshData& mesh) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    std::vector<std::int64_t> number(mesh.nodes.size() / dimension, -1);
    const auto keep = [&](std::int64_t node) { number[static_cast<std::size_t>(node)] = 0; };
    for (const CellBlock& block : mesh.blocks)
        for (const std::int64_t node : block.connectivity) keep(node);
    for (const auto& [name, nodes] : mesh.node_sets)
        for (const std::int64_t node : nodes) keep(node);
    std::int64_t kept = 0;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] < 0) continue;
        std::copy_n(mesh.nodes.begin() + static_cast<std::ptrdiff_t>(i * dimension), dimension,
                    mesh.nodes.begin() + kept * static_cast<std::ptrdiff_t>(dimension));
        number[i] = kept++;
    }
    const auto dropped = static_cast<std::int64_t>(number.size()) - kept;
    if (dropped == 0) return;
    mesh.notes.push_back(fmt::format("{} without cells dropped", counted(dropped, "node")));
    mesh.nodes.resize(static_cast<std::size_t>(kept) * dimension);
    const auto renumber = [&](std::int64_t& node) { node = number[static_cast<std::size_t>(node)]; };
    for (CellBlock& block : mesh.blocks) std::for_each(block.connectivity.begin(), block.connectivity.end(), renumber);
    for (auto& [name, nodes] : mesh.node_sets) std::for_each(nodes.begin(), nodes.end(), renumber);
    for (auto& [name, faces] : mesh.face_sets)
        for (auto& face : faces)
            for (std::int64_t& node : face)
                if (node >= 0) renumber(node);
    for (CohesiveSet& set : mesh.cohesive)
        for (auto* faces : {&set.lower, &set.upper})
            for (auto& face : *faces)
                for (std::int64_t& node : face)
                    if (node >= 0) renumber(node);
}

// Twice the area of the polygon of the corners, positive if they run counter-clockwise.
double twice_area(const MeshData& mesh, const std::int64_t* cell, std::size_t corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners; ++i) {
        const double* a = &mesh.nodes[2 * static_cast<std::size_t>(cell[i])];
        const double* b = &mesh.nodes[2 * static_cast<std::size_t>(cell[(i + 1) % corners])];
        sum += a[0] * b[1] - a[1] * b[0];
    }
    return sum;
}

// A surface of Gmsh has the orientation of its boundary loop, so each cell is checked separately.
void turn_clockwise_cells(MeshData& mesh) {
    std::int64_t turned = 0;
    for (CellBlock& block : mesh.blocks) {
        const CellShape& shape = shape_of(block.type);
        for (std::size_t c = 0; c < block.bodies.size(); ++c) {
            std::int64_t* cell = block.connectivity.data() + c * shape.nodes;
            if (!(twice_area(mesh, cell, shape.corners) < 0)) continue;
            std::reverse(cell + 1, cell + shape.corners);
            if (shape.nodes > shape.corners) std::reverse(cell + shape.corners, cell + 2 * shape.corners);
            ++turned;
        }
    }
    if (turned > 0) mesh.notes.push_back(fmt::format("{} clockwise: turned round", counted(turned, "cell")));
}

}  // namespace

double shortest_edge(const MeshData& mesh, std::int64_t* cell) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    double least = std::numeric_limits<double>::infinity();
    std::int64_t number = 0;
    for (const CellBlock& block : mesh.blocks) {
        const CellShape& shape = shape_of(block.type);
        for (std::size_t c = 0; c < block.bodies.size(); ++c, ++number)
            for (const auto& side : shape.sides) {
                const std::size_t corners = shape.corners_of(side).size();
                for (std::size_t i = 0; i < corners; ++i) {
                    const auto node = [&](std::size_t k) {
                        return mesh.nodes.data() +
                               dimension * static_cast<std::size_t>(block.connectivity[c * shape.nodes + side[k]]);
                    };
                    double square = 0;
                    for (std::size_t a = 0; a < dimension; ++a)
                        square += std::pow(node(i)[a] - node((i + 1) % corners)[a], 2);
                    if (!(std::sqrt(square) < least)) continue;
                    least = std::sqrt(square);
                    if (cell != nullptr) *cell = number;
                }
            }
    }
    return least;
}

void tidy(MeshData& mesh) {
    drop_orphans(mesh);
    if (mesh.dimension == 2) turn_clockwise_cells(mesh);
}

void require_mesh_size(const std::string& path, std::int64_t bytes, const Place& place) {
    if (bytes > most_mesh_bytes)
        throw SceneFailure(place, fmt::format("{}: with it the mesh has {} bytes, and at most {} are allowed", path,
                                              bytes, most_mesh_bytes));
}

}  // namespace cli
