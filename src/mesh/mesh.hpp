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

// A node that some cells of a body, at least one, take instead of one of the body's.
struct DoubledNode {
    std::int64_t node;
    std::vector<std::int64_t> cells;
};

class Mesh {
public:
    Mesh(int dimension, std::span<const double> nodes);

    // Labels >= 0; checks indices, orientation and that no node serves two bodies. Leaves the mesh unchanged on error.
    void add_cells(CellType type, std::span<const std::int64_t> connectivity, std::span<const std::int32_t> labels);
    // The same, but a node that another body has is doubled: a node of this body's own is appended at its place, one
    // for each body and original node.
    void add_conforming_cells(CellType type, std::span<const std::int64_t> connectivity,
                              std::span<const std::int32_t> labels);
    // A body without cells, whose stiffness the host gives.
    void add_host_body(std::int32_t label, std::span<const std::int64_t> nodes);
    // Appends an interface that pairing/interfaces.hpp has made, with tied nodes and their places; returns its index.
    // originals: of tied nodes that stand for others (rule/mid_sides.hpp), -1: itself; empty: all themselves.
    std::int64_t append(InterfaceGeometry interface, std::vector<NodeTie> ties = {},
                        std::span<const double> places = {}, std::span<const std::int64_t> originals = {});
    // Appends all of them or, when memory ends, none.
    void append_all(std::vector<InterfaceGeometry>& interfaces);
    // Makes a node of no body the control node of an obstacle, which no body takes any more.
    void reserve(std::int64_t node) { node_label_[index(node)] = reserved; }

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
    // The node that a node was doubled from, or for which it stands in a pair; itself otherwise.
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
    // Replaces the frames of the pairs of an interface, [pairs][dimension][dimension].
    friend void turn_frames(Mesh& mesh, std::size_t interface, std::vector<double> frames) {
        mesh.interfaces_[interface].frame = std::move(frames);
    }
    // Moves these nodes by displacements, [mesh DOFs].
    friend void move_nodes(Mesh& mesh, std::span<const std::int64_t> nodes, std::span<const double> displacement) {
        const auto dim = index(mesh.dimension_);
        for (const std::int64_t node : nodes)
            for (std::size_t k = 0; k < dim; ++k)
                mesh.nodes_[index(node) * dim + k] += displacement[index(node) * dim + k];
    }
    // Moves pairs of an interface into a new one (pairing/interfaces.hpp).
    friend std::int64_t split_interface(Mesh& mesh, std::int64_t interface, std::span<const std::int64_t> pairs);
    // Doubles the nodes of faces within a body (faces.hpp).
    friend std::int64_t cut(Mesh& mesh, std::span<const std::int64_t> faces, std::size_t per_face);
    // Appends a copy of each of these nodes and gives it to its cells. The bodies, which must have no interface yet,
    // take no more cells.
    void double_nodes(std::span<const DoubledNode> copies);
    // Labels of the bodies that have an interface or are cut, ascending.
    std::vector<std::int32_t> joined_labels() const;
    // Check cell `number`: check_label refuses a label that takes no more cells; take_node refuses a node that the
    // label cannot have, and lists in `taken` the nodes that had no body.
    void check_label(std::int32_t label, std::span<const std::int32_t> joined, std::size_t number) const;
    void take_node(std::int64_t node, std::int32_t label, std::size_t number, std::vector<std::int64_t>& taken);
    // Room for a label in labels_: indices of bodies above it move up by one.
    void rename_bodies(const std::vector<std::int32_t>& new_labels);
    std::int64_t node_for(std::int64_t node, std::int32_t label, std::vector<std::int64_t>& taken);

    int dimension_;
    std::vector<double> nodes_;
    std::vector<CellType> cell_type_;
    std::vector<std::int32_t> cell_label_;
    std::vector<std::int64_t> cell_offset_{0};
    std::vector<std::int64_t> connectivity_;
    std::vector<std::int32_t> labels_;       // distinct labels, ascending
    std::vector<std::int32_t> host_labels_;  // of bodies without cells, ascending
    std::vector<std::int32_t> cut_labels_;   // of bodies whose nodes were doubled
    static constexpr std::int32_t reserved = -2;
    std::vector<std::int32_t> node_label_;  // -1: none; reserved: tied, or the control node of an obstacle
    std::vector<std::int64_t> node_origin_;
    std::vector<std::int64_t> next_copy_;  // of the same origin, -1: none
    std::vector<InterfaceGeometry> interfaces_;
    std::vector<NodeTie> ties_;
};

// Returns the diagonal of the box around a mesh.
double scene_size(const Mesh& mesh);

}  // namespace delam
