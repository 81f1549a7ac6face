// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/gmsh/generator_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmsh.h>

#include "mesh/cell_jacobian.hpp"

namespace cli {

namespace {

// Bounding boxes of OpenCASCADE exceed their contents by its tolerance.
constexpr double slack = 1e-5;

struct Bounds {
    std::array<double, 3> lower{};
    std::array<double, 3> upper{};
};

Bounds box_of(int dimension, int tag) {
    Bounds box;
    gmsh::model::getBoundingBox(dimension, tag, box.lower[0], box.lower[1], box.lower[2], box.upper[0], box.upper[1],
                                box.upper[2]);
    return box;
}

std::array<double, 3> centre_of(int dimension, int tag) {
    std::array<double, 3> centre{};
    if (dimension == 0) {
        const Bounds box = box_of(0, tag);
        for (std::size_t k = 0; k < 3; ++k) centre[k] = 0.5 * (box.lower[k] + box.upper[k]);
    } else {
        gmsh::model::occ::getCenterOfMass(dimension, tag, centre[0], centre[1], centre[2]);
    }
    return centre;
}

std::vector<double> coordinates_of(const MeshData& mesh, const std::int64_t* cell, std::size_t nodes) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    std::vector<double> x;
    for (std::size_t i = 0; i < nodes; ++i) {
        const auto at = mesh.nodes.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(cell[i]) * dimension);
        x.insert(x.end(), at, at + mesh.dimension);
    }
    return x;
}

}  // namespace

GeneratorModel::GeneratorModel(int dimension, const std::array<double, 3>& lower, const std::array<double, 3>& upper)
    : dimension_(dimension), lower_(lower), upper_(upper) {
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
}

std::vector<int> GeneratorModel::on_plane(int dimension, int axis, double at) const {
    const auto a = static_cast<std::size_t>(axis);
    gmsh::vectorpair all;
    gmsh::model::getEntities(all, dimension);
    std::vector<int> found;
    for (const auto& [d, tag] : all) {
        const Bounds box = box_of(d, tag);
        if (std::abs(box.lower[a] - at) < slack && std::abs(box.upper[a] - at) < slack) found.push_back(tag);
    }
    return found;
}

void GeneratorModel::tie_borders(int axis) const {
    const auto a = static_cast<std::size_t>(axis);
    const double period = upper_[a] - lower_[a];
    const std::vector<int> masters = on_plane(dimension_ - 1, axis, lower_[a]);
    const std::vector<int> copies = on_plane(dimension_ - 1, axis, upper_[a]);
    if (masters.empty() || masters.size() != copies.size())
        throw fmt::format("{} parts of the border at {} = 0, {} opposite", masters.size(), "xyz"[axis], copies.size());
    std::vector<double> moved{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    moved[4 * a + 3] = period;
    for (const int copy : copies) {
        std::array<double, 3> wanted = centre_of(dimension_ - 1, copy);
        wanted[a] -= period;
        const auto master = std::find_if(masters.begin(), masters.end(), [&](int tag) {
            const std::array<double, 3> centre = centre_of(dimension_ - 1, tag);
            double far = 0;
            for (std::size_t k = 0; k < 3; ++k) far = std::max(far, std::abs(centre[k] - wanted[k]));
            return far < slack;
        });
        if (master == masters.end())
            throw fmt::format("a part of the border around ({:.6g}, {:.6g}, {:.6g}) has none opposite", wanted[0],
                              wanted[1], wanted[2]);
        gmsh::model::mesh::setPeriodic(dimension_ - 1, {copy}, {*master}, moved);
    }
}

void GeneratorModel::drop_loose_parts() const {
    for (int dimension = dimension_ - 1; dimension >= 0; --dimension) {
        gmsh::vectorpair all;
        gmsh::model::getEntities(all, dimension);
        gmsh::vectorpair loose;
        for (const auto& [d, tag] : all) {
            std::vector<int> up;
            std::vector<int> down;
            gmsh::model::getAdjacencies(d, tag, up, down);
            if (up.empty()) loose.emplace_back(d, tag);
        }
        gmsh::model::occ::remove(loose);
        gmsh::model::occ::synchronize();
    }
}

void GeneratorModel::name_body(const std::vector<int>& entities, const std::string& name) const {
    gmsh::model::setPhysicalName(dimension_, gmsh::model::addPhysicalGroup(dimension_, entities), name);
}

void GeneratorModel::name_borders() const {
    const auto name = [&](int axis, const char* lower, const char* upper) {
        const int d = dimension_ - 1;
        const auto a = static_cast<std::size_t>(axis);
        gmsh::model::setPhysicalName(d, gmsh::model::addPhysicalGroup(d, on_plane(d, axis, lower_[a])), lower);
        gmsh::model::setPhysicalName(d, gmsh::model::addPhysicalGroup(d, on_plane(d, axis, upper_[a])), upper);
    };
    name(0, "left", "right");
    if (dimension_ == 3) name(1, "front", "back");
    name(dimension_ - 1, "bottom", "top");
    gmsh::vectorpair points;
    gmsh::model::getEntities(points, 0);
    std::vector<int> corners;
    std::vector<int> origin;
    for (const auto& [d, tag] : points) {
        const std::array<double, 3> at = centre_of(d, tag);
        bool corner = true;
        bool first = true;
        for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
            const bool low = std::abs(at[k] - lower_[k]) < slack;
            corner = corner && (low || std::abs(at[k] - upper_[k]) < slack);
            first = first && low;
        }
        if (corner) corners.push_back(tag);
        if (first) origin.push_back(tag);
    }
    gmsh::model::setPhysicalName(0, gmsh::model::addPhysicalGroup(0, corners), "corners");
    gmsh::model::setPhysicalName(0, gmsh::model::addPhysicalGroup(0, origin), "origin");
}

void GeneratorModel::order_bodies(MeshData& mesh, const std::vector<std::string>& names) {
    std::vector<std::int32_t> label;
    for (const std::string& name : mesh.body_names)
        label.push_back(static_cast<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin()));
    for (CellBlock& block : mesh.blocks)
        for (std::int32_t& body : block.bodies) body = label[static_cast<std::size_t>(body)];
    if (names.size() != mesh.body_names.size()) throw std::string("a body has no cells");
    mesh.body_names = names;
}

std::vector<double> GeneratorModel::measures(const MeshData& mesh) {
    std::vector<double> sum(mesh.body_names.size(), 0.0);
    for (const CellBlock& block : mesh.blocks) {
        const std::size_t nodes = shape_of(block.type).nodes;
        for (std::size_t c = 0; c < block.bodies.size(); ++c)
            sum[static_cast<std::size_t>(block.bodies[c])] +=
                cell_measure(block.type, coordinates_of(mesh, block.connectivity.data() + c * nodes, nodes).data());
    }
    return sum;
}

void require_sound_cells(const MeshData& mesh, double flattest, const Place& place) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    for (const CellBlock& block : mesh.blocks) {
        const CellShape& shape = shape_of(block.type);
        // Area of an equilateral triangle, volume of a regular tetrahedron with edge 1, area of a square.
        const double regular = shape.corners == 3    ? std::numbers::sqrt3 / 4
                               : mesh.dimension == 3 ? 1.0 / (6.0 * std::numbers::sqrt2)
                                                     : 1.0;
        for (std::size_t c = 0; c < block.bodies.size(); ++c) {
            const std::vector<double> x =
                coordinates_of(mesh, block.connectivity.data() + c * shape.nodes, shape.nodes);
            double longest = 0;
            for (std::size_t i = 0; i < shape.corners; ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    double square = 0;
                    for (std::size_t k = 0; k < dimension; ++k)
                        square += std::pow(x[i * dimension + k] - x[j * dimension + k], 2);
                    longest = std::max(longest, square);
                }
            const double quality =
                cell_measure(block.type, x.data()) / (regular * std::pow(longest, mesh.dimension / 2.0));
            const double jacobian = smallest_jacobian(block.type, x.data());
            if (jacobian > 0.0 && quality >= flattest) continue;
            std::string at;
            for (std::size_t k = 0; k < dimension; ++k) {
                double mean = 0;
                for (std::size_t i = 0; i < shape.corners; ++i) mean += x[i * dimension + k];
                at += fmt::format("{}{:.6g}", k == 0 ? "" : ", ", mean / static_cast<double>(shape.corners));
            }
            throw SceneFailure(
                place, fmt::format("a {} of {} around ({}) is {}: {:.2g} of a regular one; a smaller h or larger gaps "
                                   "help",
                                   shape.name, mesh.body_names[static_cast<std::size_t>(block.bodies[c])], at,
                                   jacobian > 0.0 ? "too flat" : "inverted", quality));
        }
    }
}

const CellShape& required_shape(std::int32_t type, const std::vector<std::string>& allowed, const Place& table) {
    for (const std::string& name : allowed)
        if (shape_named(name).type == type) return shape_named(name);
    throw SceneFailure(key_of(table, "cell"), fmt::format("must be one of {}", fmt::join(allowed, ", ")));
}

}  // namespace cli
