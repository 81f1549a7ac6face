// SPDX-License-Identifier: BSD-3-Clause
// The mesh: nodes, cells, bodies, interfaces. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_MESH_HPP
#define DELAM_CPP_MESH_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "delam/cpp/argument.hpp"
#include "delam/cpp/context.hpp"
#include "delam/cpp/shared.hpp"
#include "delam/cpp/status.hpp"
#include "delam/delam.h"

namespace delam {

// Dimension 2 or 3, and the numbers of nodes, cells, bodies and interfaces.
struct MeshSize {
    std::int32_t dimension;
    std::int64_t nodes, cells, bodies, interfaces;
};
// Tied nodes: nodes[i] moves by the sum of weights[k] times the motion of node of[k], starts[i] <= k < starts[i + 1].
struct Ties {
    std::vector<std::int64_t> nodes, starts, of;
    std::vector<double> weights;
};
// Cells: the nodes of cell i are connectivity[k], k from offsets[i] to offsets[i + 1].
struct Cells {
    std::vector<std::int32_t> types, bodies;
    std::vector<std::int64_t> offsets, connectivity;
};
// The two bodies of an interface, and how many pairs and faces it has.
struct InterfaceSize {
    std::int32_t body_a, body_b;
    std::int64_t pairs, faces;
    std::int32_t nodes_per_face;
};
// The pairs of an interface; frames: [pairs][dimension][dimension], the normal first.
struct Pairs {
    std::vector<std::int64_t> nodes_a, nodes_b;
    std::vector<double> weights, frames;
};
// Nodes of a patch, and the integral of the shape function of each over it.
struct Patch {
    std::vector<std::int64_t> nodes;
    std::vector<double> weights;
};

namespace detail {

// Nodes of a cell, as the library has them; 0 for a number that is no cell type.
inline std::size_t nodes_of(std::int32_t cell_type) {
    for (std::int64_t i = 0; i < delam_cell_type_count(); ++i) {
        std::int32_t number = 0;
        std::int32_t nodes = 0;
        delam_cell_type_info(i, nullptr, &number, nullptr, &nodes, nullptr, nullptr, nullptr, nullptr);
        if (number == cell_type) return static_cast<std::size_t>(nodes);
    }
    return 0;
}

}  // namespace detail

// Nodes, cells, bodies and interfaces.
class Mesh {
public:
    // Makes a mesh without cells; nodes: [nodes][dimension].
    Mesh(const Context& context, std::int32_t dimension, View<double> nodes) : shared_(context.shared()) {
        detail::require(dimension > 0 && nodes.size() % detail::length(dimension) == 0,
                        "nodes: not a whole number of points");
        delam_mesh* made = nullptr;
        const auto status = delam_mesh_create(context.get(), dimension, nodes.count() / dimension, nodes.data(), &made);
        handle_.reset(made);
        shared_->check(status);
    }
    // Makes a stack of layers; lengths and divisions: of the plane of the layers, in the plane one of each.
    static Mesh layers(const Context& context, View<double> lengths, View<std::int64_t> divisions,
                       View<double> thickness, View<std::int64_t> layer_divisions, std::int32_t cell_type) {
        detail::require(lengths.size() == divisions.size() && thickness.size() == layer_divisions.size(),
                        "lengths and divisions, thickness and layer_divisions: unequal sizes");
        Mesh mesh(context.shared());
        delam_mesh* made = nullptr;
        const auto status = delam_mesh_create_layers(context.get(), static_cast<std::int32_t>(lengths.size()) + 1,
                                                     lengths.data(), divisions.data(), thickness.count(),
                                                     thickness.data(), layer_divisions.data(), cell_type, &made);
        mesh.handle_.reset(made);
        mesh.shared_->check(status);
        return mesh;
    }

    // Returns the handle of C.
    delam_mesh* get() const noexcept { return handle_.get(); }

    // bodies: a label for each cell; empty: all 0.
    void add_cells(std::int32_t cell_type, View<std::int64_t> connectivity, View<std::int32_t> bodies = {}) {
        const auto count = cells_in(cell_type, connectivity, bodies);
        shared_->check(delam_mesh_add_cells(get(), cell_type, count, connectivity.data(),
                                            bodies.size() == 0 ? nullptr : bodies.data(), 0));
    }
    void add_conforming_cells(std::int32_t cell_type, View<std::int64_t> connectivity, View<std::int32_t> bodies = {}) {
        const auto count = cells_in(cell_type, connectivity, bodies);
        shared_->check(delam_mesh_add_conforming_cells(get(), cell_type, count, connectivity.data(),
                                                       bodies.size() == 0 ? nullptr : bodies.data(), 0));
    }
    std::int64_t add_interface(std::int32_t body_a, std::int32_t body_b, double tolerance = 0.0) {
        std::int64_t made = -1;
        shared_->check(delam_mesh_add_interface(get(), body_a, body_b, tolerance, &made));
        return made;
    }
    std::int64_t add_all_interfaces(double tolerance = 0.0) {
        std::int64_t count = 0;
        shared_->check(delam_mesh_add_all_interfaces(get(), tolerance, &count));
        return count;
    }
    // Returns the number of new interfaces: one for each seam of doubled nodes within a body.
    std::int64_t add_seams(double tolerance = 0.0) {
        std::int64_t count = 0;
        shared_->check(delam_mesh_add_seams(get(), tolerance, &count));
        return count;
    }
    // Returns the number of new interfaces: between walls of a body that face each other, up to `gap` apart.
    std::int64_t add_self_contact(double gap) {
        std::int64_t count = 0;
        shared_->check(delam_mesh_add_self_contact(get(), gap, &count));
        return count;
    }
    std::int64_t add_projected_interface(std::int32_t body_a, std::int32_t body_b, double gap = 0.0) {
        std::int64_t made = -1;
        shared_->check(delam_mesh_add_projected_interface(get(), body_a, body_b, gap, &made));
        return made;
    }
    std::int64_t add_mortar_interface(std::int32_t body_a, std::int32_t body_b, double gap = 0.0) {
        std::int64_t made = -1;
        shared_->check(delam_mesh_add_mortar_interface(get(), body_a, body_b, gap, &made));
        return made;
    }
    // weights: empty for the nodal ones.
    std::int64_t add_obstacle(View<std::int64_t> nodes, View<double> normals, std::int64_t control_node,
                              View<double> weights = {}) {
        detail::require(normals.size() == nodes.size() * detail::length(dimension()), "normals: not one for each node");
        detail::require(weights.size() == 0 || weights.size() == nodes.size(), "weights: not one for each node");
        std::int64_t made = -1;
        shared_->check(delam_mesh_add_obstacle(get(), nodes.count(), nodes.data(), normals.data(),
                                               weights.size() == 0 ? nullptr : weights.data(), control_node, 0, &made));
        return made;
    }
    // A body without cells, whose stiffness is given by Problem::set_stiffness.
    void add_host_body(std::int32_t body, View<std::int64_t> nodes) {
        shared_->check(delam_mesh_add_host_body(get(), body, nodes.count(), nodes.data(), 0));
    }
    // normals: [pairs][dimension], from a to b; faces: [faces][nodes per face], as pair indices.
    std::int64_t add_pairs(std::int32_t body_a, std::int32_t body_b, View<std::int64_t> nodes_a,
                           View<std::int64_t> nodes_b, View<double> normals, View<double> weights,
                           View<std::int64_t> faces = {}, std::int32_t nodes_per_face = 0) {
        detail::require(nodes_b.size() == nodes_a.size() && weights.size() == nodes_a.size() &&
                            normals.size() == nodes_a.size() * detail::length(dimension()),
                        "nodes_b, normals and weights: not one for each node of a");
        detail::require(nodes_per_face > 0 ? faces.count() % nodes_per_face == 0 : faces.size() == 0,
                        "faces: not a whole number of them");
        const std::int64_t face_count = nodes_per_face > 0 ? faces.count() / nodes_per_face : 0;
        std::int64_t made = -1;
        shared_->check(delam_mesh_add_pairs(get(), body_a, body_b, nodes_a.count(), nodes_a.data(), nodes_b.data(),
                                            normals.data(), weights.data(), face_count, nodes_per_face, faces.data(), 0,
                                            &made));
        return made;
    }

    MeshSize size() const {
        MeshSize size{};
        shared_->check(
            delam_mesh_size(get(), &size.dimension, &size.nodes, &size.cells, &size.bodies, &size.interfaces));
        return size;
    }
    // Returns 2 or 3.
    std::int32_t dimension() const { return size().dimension; }
    std::vector<double> nodes() const {
        const MeshSize now = size();
        std::vector<double> nodes(detail::length(now.nodes * now.dimension));
        shared_->check(delam_mesh_nodes(get(), now.nodes * now.dimension, nodes.data()));
        return nodes;
    }
    std::vector<std::int32_t> node_bodies() const {
        std::vector<std::int32_t> bodies(detail::length(size().nodes));
        shared_->check(delam_mesh_node_bodies(get(), static_cast<std::int64_t>(bodies.size()), bodies.data()));
        return bodies;
    }
    std::vector<std::int64_t> node_origins() const {
        std::vector<std::int64_t> origins(detail::length(size().nodes));
        shared_->check(delam_mesh_node_origins(get(), static_cast<std::int64_t>(origins.size()), origins.data()));
        return origins;
    }
    Ties node_ties() const {
        std::int64_t count = 0;
        std::int64_t entries = 0;
        shared_->check(delam_mesh_node_ties(get(), &count, &entries, nullptr, nullptr, nullptr, nullptr));
        Ties ties;
        ties.nodes.resize(detail::length(count));
        ties.starts.resize(detail::length(count) + 1);
        ties.of.resize(detail::length(entries));
        ties.weights.resize(detail::length(entries));
        shared_->check(delam_mesh_node_ties(get(), nullptr, nullptr, ties.nodes.data(), ties.starts.data(),
                                            ties.of.data(), ties.weights.data()));
        return ties;
    }
    Cells cells() const {
        const auto count = detail::length(size().cells);
        std::int64_t needed = 0;
        shared_->check(delam_mesh_cells(get(), nullptr, nullptr, nullptr, 0, nullptr, &needed));
        Cells cells;
        cells.types.resize(count);
        cells.bodies.resize(count);
        cells.offsets.resize(count + 1);
        cells.connectivity.resize(detail::length(needed));
        shared_->check(delam_mesh_cells(get(), cells.types.data(), cells.bodies.data(), cells.offsets.data(), needed,
                                        cells.connectivity.data(), nullptr));
        return cells;
    }
    InterfaceSize interface_size(std::int64_t interface_index) const {
        InterfaceSize size{};
        shared_->check(delam_mesh_interface_size(get(), interface_index, &size.body_a, &size.body_b, &size.pairs,
                                                 &size.faces, &size.nodes_per_face));
        return size;
    }
    Pairs interface_pairs(std::int64_t interface_index) const {
        const auto count = detail::length(interface_size(interface_index).pairs);
        const auto space = detail::length(dimension());
        Pairs pairs;
        pairs.nodes_a.resize(count);
        pairs.nodes_b.resize(count);
        pairs.weights.resize(count);
        pairs.frames.resize(count * space * space);
        shared_->check(delam_mesh_interface_pairs(get(), interface_index, pairs.nodes_a.data(), pairs.nodes_b.data(),
                                                  pairs.weights.data(), pairs.frames.data()));
        return pairs;
    }
    // [faces][nodes per face], as pair indices.
    std::vector<std::int64_t> interface_faces(std::int64_t interface_index) const {
        const InterfaceSize size = interface_size(interface_index);
        std::vector<std::int64_t> faces(detail::length(size.faces * size.nodes_per_face));
        shared_->check(delam_mesh_interface_faces(get(), interface_index, faces.data()));
        return faces;
    }
    // body -1: of all bodies, here and below.
    std::vector<std::int64_t> find_nodes(std::int32_t body, View<double> lower, View<double> upper) const {
        const auto space = detail::length(dimension());
        detail::require(lower.size() == space && upper.size() == space,
                        "lower and upper must have the mesh's dimension");
        std::int64_t count = 0;
        shared_->check(delam_mesh_find_nodes(get(), body, lower.data(), upper.data(), 0, nullptr, &count));
        std::vector<std::int64_t> nodes(detail::length(count));
        shared_->check(delam_mesh_find_nodes(get(), body, lower.data(), upper.data(), count, nodes.data(), &count));
        return nodes;
    }
    Patch find_patch(std::int32_t body, View<double> lower, View<double> upper, View<double> direction) const {
        const auto space = detail::length(dimension());
        detail::require(lower.size() == space && upper.size() == space && direction.size() == space,
                        "lower, upper and direction must have the mesh's dimension");
        std::int64_t count = 0;
        shared_->check(delam_mesh_find_patch(get(), body, lower.data(), upper.data(), direction.data(), 0, nullptr,
                                             nullptr, &count));
        Patch patch;
        patch.nodes.resize(detail::length(count));
        patch.weights.resize(detail::length(count));
        shared_->check(delam_mesh_find_patch(get(), body, lower.data(), upper.data(), direction.data(), count,
                                             patch.nodes.data(), patch.weights.data(), &count));
        return patch;
    }

private:
    explicit Mesh(std::shared_ptr<detail::Shared> shared) : shared_(std::move(shared)) {}
    // The library reports unknown cell types by name.
    static std::int64_t cells_in(std::int32_t cell_type, View<std::int64_t> connectivity, View<std::int32_t> bodies) {
        const std::size_t nodes = detail::nodes_of(cell_type);
        if (nodes == 0) return 0;
        detail::require(connectivity.size() % nodes == 0, "connectivity: not a whole number of cells");
        const std::size_t count = connectivity.size() / nodes;
        detail::require(bodies.size() == 0 || bodies.size() == count, "bodies: not one for each cell");
        return static_cast<std::int64_t>(count);
    }

    std::shared_ptr<detail::Shared> shared_;
    detail::Handle<delam_mesh, delam_mesh_destroy> handle_;
};

}  // namespace delam

#endif
