// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_shape.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "delam/delam.h"
#include "text/error.hpp"

namespace cli {

namespace {

CellShape listed(std::int64_t index) {
    const char* name = nullptr;
    std::int32_t type = 0;
    std::int32_t dimension = 0;
    std::int32_t nodes = 0;
    std::int32_t corners = 0;
    std::int32_t faces = 0;
    std::int32_t face_nodes = 0;
    delam_cell_type_info(index, &name, &type, &dimension, &nodes, &corners, &faces, &face_nodes, nullptr);
    CellShape shape{type, name, dimension, static_cast<std::size_t>(nodes), static_cast<std::size_t>(corners), {}, {}};
    std::vector<std::int32_t> face(static_cast<std::size_t>(faces * face_nodes));
    std::vector<std::int32_t> middle(2 * (shape.nodes - shape.corners));
    delam_cell_type_topology(index, face.data(), middle.data());
    for (auto at = face.begin(); at != face.end(); at += face_nodes)
        shape.sides.emplace_back(at, std::find(at, at + face_nodes, -1));
    for (std::size_t m = 0; m < middle.size(); m += 2)
        shape.middles.push_back({static_cast<std::size_t>(middle[m]), static_cast<std::size_t>(middle[m + 1])});
    return shape;
}

}  // namespace

std::span<const std::size_t> CellShape::corners_of(const std::vector<std::size_t>& side) const {
    const auto end = std::find_if(side.begin(), side.end(), [this](std::size_t node) { return node >= corners; });
    return std::span(side).first(static_cast<std::size_t>(end - side.begin()));
}

std::span<const CellShape> all_shapes() {
    static const std::vector<CellShape> shapes = [] {
        std::vector<CellShape> all;
        for (std::int64_t i = 0; i < delam_cell_type_count(); ++i) all.push_back(listed(i));
        return all;
    }();
    return shapes;
}

const CellShape& shape_of(std::int32_t type) {
    for (const CellShape& shape : all_shapes())
        if (shape.type == type) return shape;
    throw Failure(exit_numerical, fmt::format("{} is no cell type of the library", type));
}

// The quadratic cell with the same corners; of the pyramid there is none.
const CellShape& instead_of(const CellShape& shape) {
    for (const CellShape& other : all_shapes())
        if (!other.linear() && other.dimension == shape.dimension && other.corners == shape.corners) return other;
    return shape_of(DELAM_TET10);
}

const CellShape& shape_named(const std::string& name) {
    for (const CellShape& shape : all_shapes())
        if (shape.name == name) return shape;
    throw Failure(exit_numerical, fmt::format("\"{}\" is no cell type of the library", name));
}

std::vector<std::string> shape_names(bool (*wanted)(const CellShape&)) {
    std::vector<std::string> names;
    for (const CellShape& shape : all_shapes())
        if (wanted(shape)) names.push_back(shape.name);
    return names;
}

std::vector<std::string> shape_names(std::int32_t dimension) {
    std::vector<std::string> names;
    for (const CellShape& shape : all_shapes())
        if (shape.dimension == dimension) names.push_back(shape.name);
    return names;
}

// make_quadratic() adds no node in the middle of a cell.
std::vector<std::string> fibre_cell_shapes() {
    return shape_names([](const CellShape& shape) { return shape.dimension == 2 && shape.nodes <= 2 * shape.corners; });
}

std::vector<std::string> weave_shapes() {
    return shape_names([](const CellShape& shape) { return shape.dimension == 3 && shape.simplex(); });
}

}  // namespace cli
