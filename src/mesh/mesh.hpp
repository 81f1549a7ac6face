// SPDX-License-Identifier: BSD-3-Clause
// Nodes, cells and bodies: the geometry that a host hands over, in 2D or 3D.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "mesh/cell_type.hpp"
#include "mesh/interface_geometry.hpp"

namespace delam {

// A node of no body whose displacement is a combination of others': sum of weight u_node, weights summing to 1.
struct NodeTie {
    std::int64_t node;
    std::vector<std::pair<std::int64_t, double>> of;
};

class Mesh {
public:
    Mesh(int dimension, std::span<const double> nodes);

    // Labels >= 0; checks indices, orientation and that no node serves two bodies. Leaves the mesh unchanged on error.
    void add_cells(CellType type, std::span<const std::int64_t> connectivity, std::span<const std::int32_t> labels);
    // The same, but a node that another body has is doubled: a node of this body's own is appended at its place, one
    // for each body and original node (conforming.cpp).
    void add_conforming_cells(CellType type, std::span<const std::int64_t> connectivity,
                              std::span<const std::int32_t> labels);
    // Pairs matching boundary faces of two bodies (pairing.cpp); returns the index of the interface.
    std::int64_t add_interface(std::int32_t label_a, std::int32_t label_b, double tolerance);
    // Adds an interface between every two bodies that share matching faces and have none yet, in the order of their
    // labels; returns how many it has added.
    std::int64_t add_all_interfaces(double tolerance);
    // Ties the nodes of b's faces to their projections on a's faces, within `gap`; appends a tied node for each
    // (projected_interface.cpp).
    std::int64_t add_projected_interface(std::int32_t label_a, std::int32_t label_b, double gap);
    // Pairs of a control node of no body with nodes of one body (obstacle.cpp). normals: [nodes][dimension] into the
    // body, any length; weights empty: those of the faces whose nodes are all there.
    std::int64_t add_obstacle(std::span<const std::int64_t> nodes, std::span<const double> normals,
                              std::span<const double> weights, std::int64_t control);

    // A body without cells, whose stiffness the host gives, and interfaces of pairs that the host knows
    // (host_body.cpp).
    void add_host_body(std::int32_t label, std::span<const std::int64_t> nodes);
    // normals: [pairs][dimension] from a to b, any length; face: indices of pairs, [faces][nodes_per_face].
    std::int64_t add_pairs(std::int32_t label_a, std::int32_t label_b, std::span<const std::int64_t> nodes_a,
                           std::span<const std::int64_t> nodes_b, std::span<const double> normals,
                           std::span<const double> weights, int nodes_per_face, std::span<const std::int64_t> face);

    int dimension() const { return dimension_; }
    std::int64_t node_count() const { return static_cast<std::int64_t>(nodes_.size()) / dimension_; }
    std::span<const double> nodes() const { return nodes_; }
    std::span<const double> node(std::int64_t i) const {
        return std::span<const double>(nodes_).subspan(index(i * dimension_), index(dimension_));
    }

    std::int64_t cell_count() const { return static_cast<std::int64_t>(cell_type_.size()); }
    CellType cell_type(std::int64_t c) const { return cell_type_[index(c)]; }
    // Nodes of a cell.
    std::span<const std::int64_t> cell(std::int64_t c) const {
        const auto i = index(c);
        return std::span<const std::int64_t>(connectivity_)
            .subspan(index(cell_offset_[i]), index(cell_offset_[i + 1] - cell_offset_[i]));
    }
    // Index of the body of a cell, 0 .. body_count-1, in ascending order of labels.
    std::int32_t cell_body(std::int64_t c) const;
    std::int32_t body_count() const { return static_cast<std::int32_t>(labels_.size()); }
    std::int32_t body_label(std::int32_t body) const { return labels_[index(body)]; }
    // Index of the body with a label; -1 when there is none.
    std::int32_t body_of_label(std::int32_t label) const;
    // True if the body has no cells.
    bool host_body(std::int32_t body) const;
    // Body index of a node, -1 for a node of none.
    std::int32_t node_body(std::int64_t node) const;
    // The node that a node was doubled from, itself otherwise.
    std::int64_t node_origin(std::int64_t node) const { return node_origin_[index(node)]; }
    // Nodes of a body, ascending.
    std::vector<std::int64_t> body_nodes(std::int32_t body) const;
    // Cells of a body (-1: of all), ascending.
    std::vector<std::int64_t> body_cells(std::int32_t body) const;

    const std::vector<InterfaceGeometry>& interfaces() const { return interfaces_; }
    // Tied nodes, ascending.
    const std::vector<NodeTie>& ties() const { return ties_; }
    // Largest extent of the bounding box: the length that absolute tolerances are measured by.
    double size() const;

private:
    // Body indices of two labels that differ and have no interface.
    std::pair<std::int32_t, std::int32_t> require_unjoined(std::int32_t label_a, std::int32_t label_b) const;
    // Error(DELAM_ERROR_MESH) where a body has no faces.
    void require_cells(std::int32_t body) const;
    // Labels of the bodies that have an interface, ascending.
    std::vector<std::int32_t> joined_labels() const;
    // Check cell `number`: check_label refuses a label that takes no more cells; take_node refuses a node that the
    // label cannot have, and lists in `taken` the nodes that had no body.
    void check_label(std::int32_t label, std::span<const std::int32_t> joined, std::size_t number) const;
    void take_node(std::int64_t node, std::int32_t label, std::size_t number, std::vector<std::int64_t>& taken);
    // Room for a label in labels_: indices of bodies above it move up by one.
    void rename_bodies(const std::vector<std::int32_t>& new_labels);
    // Tied nodes with their places, and the interface that pairs them; unchanged when memory ends.
    void append_tied(std::vector<NodeTie> ties, std::span<const double> places, InterfaceGeometry interface);
    std::int64_t node_for(std::int64_t node, std::int32_t label, std::vector<std::int64_t>& taken);

    int dimension_;
    std::vector<double> nodes_;
    std::vector<CellType> cell_type_;
    std::vector<std::int32_t> cell_label_;
    std::vector<std::int64_t> cell_offset_{0};
    std::vector<std::int64_t> connectivity_;
    std::vector<std::int32_t> labels_;       // distinct labels, ascending
    std::vector<std::int32_t> host_labels_;  // of bodies without cells, ascending
    static constexpr std::int32_t reserved = -2;
    std::vector<std::int32_t> node_label_;  // -1: none; reserved: tied, or the control node of an obstacle
    std::vector<std::int64_t> node_origin_;
    std::vector<std::int64_t> next_copy_;  // of the same origin, -1: none
    std::vector<InterfaceGeometry> interfaces_;
    std::vector<NodeTie> ties_;
};

}  // namespace delam
