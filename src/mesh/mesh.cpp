// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/shape.hpp"

namespace delam {

Mesh::Mesh(int dimension, std::span<const double> nodes) : dimension_(dimension), nodes_(nodes.begin(), nodes.end()) {
    if (dimension != 2 && dimension != 3) fail(DELAM_ERROR_ARGUMENT, "dimension ", dimension, ": must be 2 or 3");
    if (nodes.empty() || nodes.size() % index(dimension) != 0)
        fail(DELAM_ERROR_ARGUMENT, nodes.size(), " node coordinates: must be a positive multiple of ", dimension);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!std::isfinite(nodes[i]))
            fail(DELAM_ERROR_ARGUMENT, "node ", i / index(dimension), ", coordinate ", i % index(dimension), ": ",
                 nodes[i], " is not finite");
    node_label_.assign(index(node_count()), -1);
    node_origin_.resize(index(node_count()));
    std::iota(node_origin_.begin(), node_origin_.end(), std::int64_t{0});
    next_copy_.assign(index(node_count()), -1);
}

namespace {

// Room for `more` entries, growing by half at least, so that cells may come in small portions.
template <class T>
void make_room(std::vector<T>& v, std::size_t more) {
    if (v.capacity() - v.size() < more) v.reserve(std::max(v.size() + more, v.capacity() + v.capacity() / 2));
}

// Refuses a cell that is inverted or degenerate. The Jacobian of a sound cell is comparable with the
// product of its extents; 1e-14 of the largest extent's power leaves room for very flat cells and is far above
// rounding.
void check_jacobian(CellType type, int dimension, std::span<const double> coordinates, std::size_t number,
                    std::int32_t label) {
    double extent = 0.0;
    for (std::size_t k = 0; k < coordinates.size(); ++k)
        extent = std::max(extent, std::abs(coordinates[k] - coordinates[k % index(dimension)]));
    const double jacobian = smallest_jacobian(type, coordinates);
    if (!(jacobian > 1e-14 * std::pow(extent, dimension)))
        fail(DELAM_ERROR_MESH, "cell ", number, " (body ", label, "): smallest Jacobian ", jacobian,
             jacobian > 0.0 ? " is negligible beside its size: degenerate" : " <= 0: inverted or degenerate",
             jacobian < 0.0 && cell_row(type).reference == ReferenceCell::prism
                 ? " (the triangle 012 of a wedge is counter-clockwise seen from outside; Abaqus and Gmsh list 345 "
                   "first)"
                 : "");
}

void insert_label(std::vector<std::int32_t>& labels, std::int32_t label) {
    if (!labels.empty() && labels.back() == label) return;
    const auto place = std::lower_bound(labels.begin(), labels.end(), label);
    if (place == labels.end() || *place != label) labels.insert(place, label);
}

}  // namespace

std::vector<std::int32_t> Mesh::joined_labels() const {
    std::vector<std::int32_t> joined;
    for (const InterfaceGeometry& i : interfaces_)
        for (const std::int32_t body : {i.body_a, i.body_b})
            if (body >= 0) joined.push_back(body_label(body));
    joined.insert(joined.end(), cut_labels_.begin(), cut_labels_.end());
    std::sort(joined.begin(), joined.end());
    return joined;
}

void Mesh::check_label(std::int32_t label, std::span<const std::int32_t> joined, std::size_t number) const {
    if (label < 0) fail(DELAM_ERROR_ARGUMENT, "cell ", number, ": body ", label, ": must be >= 0");
    if (std::binary_search(host_labels_.begin(), host_labels_.end(), label))
        fail(DELAM_ERROR_MESH, "cell ", number, ": body ", label, " was made without cells (delam_mesh_add_host_body)");
    if (std::binary_search(joined.begin(), joined.end(), label))
        fail(DELAM_ERROR_STATE, "cell ", number, ": body ", label,
             " has an interface already, or is cut; add all of its cells first");
}

void Mesh::take_node(std::int64_t node, std::int32_t label, std::size_t number, std::vector<std::int64_t>& taken) {
    if (node < 0 || node >= node_count())
        fail(DELAM_ERROR_ARGUMENT, "cell ", number, " (body ", label, "): node ", node, ": must be in 0..",
             node_count() - 1);
    std::int32_t& owner = node_label_[index(node)];
    if (owner == reserved)
        fail(DELAM_ERROR_MESH, "cell ", number, " (body ", label, "): node ", node,
             " is tied to an interface or the control node of an obstacle: it can have no cells");
    if (owner >= 0 && owner != label)
        fail(DELAM_ERROR_MESH, "node ", node, " belongs to bodies ", owner, " and ", label,
             "; each body needs nodes of its own");
    if (owner < 0) taken.push_back(node);
    owner = label;
}

void Mesh::add_cells(CellType type, std::span<const std::int64_t> connectivity, std::span<const std::int32_t> labels) {
    const CellTopology& shape = topology(type);
    const std::size_t per_cell = index(shape.nodes);
    const std::size_t dim = index(dimension_);
    if (shape.dimension != dimension_)
        fail(DELAM_ERROR_ARGUMENT, shape.dimension, "D cells in a ", dimension_, "D mesh");
    if (connectivity.size() % per_cell != 0)
        fail(DELAM_ERROR_ARGUMENT, connectivity.size(), " nodes of cells: must be a multiple of ", per_cell);
    const std::size_t count = connectivity.size() / per_cell;
    if (!labels.empty() && labels.size() != count)
        fail(DELAM_ERROR_ARGUMENT, labels.size(), " body labels for ", count, " cells");

    const std::vector<std::int32_t> joined = joined_labels();
    std::vector<std::int64_t> taken;  // nodes that had no body before, given back on error
    std::vector<std::int32_t> new_labels = labels_;
    std::vector<double> coordinates(per_cell * dim);
    const auto label_of = [&](std::size_t c) { return labels.empty() ? 0 : labels[c]; };
    const auto check_cell = [&](std::size_t c) {
        poll_cancel("mesh");
        const std::size_t number = cell_type_.size() + c;
        check_label(label_of(c), joined, number);
        for (std::size_t k = 0; k < per_cell; ++k) {
            const std::int64_t node = connectivity[c * per_cell + k];
            take_node(node, label_of(c), number, taken);
            std::copy_n(nodes_.begin() + node * dimension_, dim,
                        coordinates.begin() + static_cast<std::ptrdiff_t>(k * dim));
        }
        check_jacobian(type, dimension_, coordinates, number, label_of(c));
        insert_label(new_labels, label_of(c));
    };
    try {
        for (std::size_t c = 0; c < count; ++c) check_cell(c);
        make_room(cell_type_, count);
        make_room(cell_label_, count);
        make_room(cell_offset_, count);
        make_room(connectivity_, connectivity.size());
    } catch (...) {
        for (const std::int64_t node : taken) node_label_[index(node)] = -1;
        throw;
    }

    // Nothing below can fail.
    rename_bodies(new_labels);
    labels_.swap(new_labels);
    for (std::size_t c = 0; c < count; ++c) {
        cell_type_.push_back(type);
        cell_label_.push_back(label_of(c));
        cell_offset_.push_back(cell_offset_.back() + shape.nodes);
    }
    connectivity_.insert(connectivity_.end(), connectivity.begin(), connectivity.end());
}

void Mesh::rename_bodies(const std::vector<std::int32_t>& new_labels) {
    for (InterfaceGeometry& i : interfaces_) {
        for (std::int32_t* body : {&i.body_a, &i.body_b}) {
            if (*body < 0) continue;
            const auto place = std::lower_bound(new_labels.begin(), new_labels.end(), body_label(*body));
            *body = static_cast<std::int32_t>(place - new_labels.begin());
        }
    }
}

bool Mesh::host_body(std::int32_t body) const {
    return std::binary_search(host_labels_.begin(), host_labels_.end(), body_label(body));
}

std::int32_t Mesh::body_of_label(std::int32_t label) const {
    const auto place = std::lower_bound(labels_.begin(), labels_.end(), label);
    return place == labels_.end() || *place != label ? -1 : static_cast<std::int32_t>(place - labels_.begin());
}

std::int32_t Mesh::cell_body(std::int64_t c) const { return body_of_label(cell_label_[index(c)]); }

std::int32_t Mesh::node_body(std::int64_t node) const {
    const std::int32_t label = node_label_[index(node)];
    return label < 0 ? -1 : body_of_label(label);
}

std::vector<std::int64_t> Mesh::body_nodes(std::int32_t body) const {
    std::vector<std::int64_t> nodes;
    for (std::int64_t n = 0; n < node_count(); ++n)
        if (node_label_[index(n)] == body_label(body)) nodes.push_back(n);
    return nodes;
}

std::vector<std::int64_t> Mesh::body_cells(std::int32_t body) const {
    std::vector<std::int64_t> cells;
    for (std::int64_t c = 0; c < cell_count(); ++c)
        if (body < 0 || cell_label_[index(c)] == body_label(body)) cells.push_back(c);
    return cells;
}

double Mesh::size() const {
    double largest = 0.0;
    const std::size_t dim = index(dimension_);
    for (std::size_t axis = 0; axis < dim; ++axis) {
        double low = nodes_[axis];
        double high = low;
        for (std::size_t i = axis; i < nodes_.size(); i += dim) {
            low = std::min(low, nodes_[i]);
            high = std::max(high, nodes_[i]);
        }
        largest = std::max(largest, high - low);
    }
    return largest;
}

// The node that represents this one in a body: itself, an existing copy, or a new one.
std::int64_t Mesh::node_for(std::int64_t node, std::int32_t label, std::vector<std::int64_t>& taken) {
    const std::int64_t origin = node_origin_[index(node)];
    if (node_label_[index(origin)] == -1) {
        taken.push_back(origin);
        node_label_[index(origin)] = label;
    }
    std::int64_t last = origin;
    for (std::int64_t n = origin; n >= 0; n = next_copy_[index(n)]) {
        if (node_label_[index(n)] == label) return n;
        last = n;
    }
    const std::int64_t copy = node_count();
    for (int k = 0; k < dimension_; ++k) nodes_.push_back(nodes_[index(origin * dimension_ + k)]);
    node_label_.push_back(label);
    node_origin_.push_back(origin);
    next_copy_.push_back(-1);
    next_copy_[index(last)] = copy;
    return copy;
}

void Mesh::add_conforming_cells(CellType type, std::span<const std::int64_t> connectivity,
                                std::span<const std::int32_t> labels) {
    const std::size_t per_cell = index(topology(type).nodes);
    const std::int64_t before = node_count();
    std::vector<std::int64_t> taken;  // nodes that had no body before
    std::vector<std::int64_t> own(connectivity.begin(), connectivity.end());
    try {
        for (std::size_t i = 0; i < own.size(); ++i) {
            const std::size_t c = i / per_cell;
            if (i % per_cell == 0) poll_cancel("mesh");
            const std::int32_t label = c < labels.size() ? labels[c] : 0;
            // Other errors stay, so that add_cells reports them.
            if (label < 0) continue;
            if (own[i] < 0 || own[i] >= before)
                fail(DELAM_ERROR_ARGUMENT, "cell ", cell_type_.size() + c, " (body ", label, "): node ", own[i],
                     ": must be in 0..", before - 1);
            if (node_label_[index(own[i])] != reserved) own[i] = node_for(own[i], label, taken);
        }
        add_cells(type, own, labels);
    } catch (...) {
        for (const std::int64_t node : taken) node_label_[index(node)] = -1;
        node_label_.resize(index(before));
        node_origin_.resize(index(before));
        next_copy_.resize(index(before));
        nodes_.resize(index(before * dimension_));
        for (std::int64_t& next : next_copy_)
            if (next >= before) next = -1;
        throw;
    }
}

void Mesh::double_nodes(std::span<const DoubledNode> copies) {
    std::set<std::int32_t> labels;
    for (const DoubledNode& copy : copies) labels.insert(node_label_[index(copy.node)]);
    for (const InterfaceGeometry& i : interfaces_)
        for (const std::int32_t body : {i.body_a, i.body_b})
            if (body >= 0 && labels.contains(body_label(body)))
                fail(DELAM_ERROR_STATE, "body ", body_label(body), " has an interface already; cut it before");
    const std::size_t count = copies.size();
    make_room(nodes_, count * index(dimension_));
    make_room(node_label_, count);
    make_room(node_origin_, count);
    make_room(next_copy_, count);
    make_room(cut_labels_, labels.size());

    // Nothing below can fail.
    for (const DoubledNode& copy : copies) {
        const std::int64_t made = node_count();
        for (int k = 0; k < dimension_; ++k) nodes_.push_back(nodes_[index(copy.node * dimension_ + k)]);
        node_label_.push_back(node_label_[index(copy.node)]);
        node_origin_.push_back(node_origin_[index(copy.node)]);
        next_copy_.push_back(next_copy_[index(copy.node)]);
        next_copy_[index(copy.node)] = made;
        for (const std::int64_t cell : copy.cells) {
            const auto begin = connectivity_.begin() + cell_offset_[index(cell)];
            std::replace(begin, connectivity_.begin() + cell_offset_[index(cell) + 1], copy.node, made);
        }
    }
    cut_labels_.insert(cut_labels_.end(), labels.begin(), labels.end());
}

void Mesh::add_host_body(std::int32_t label, std::span<const std::int64_t> nodes) {
    if (label < 0) fail(DELAM_ERROR_ARGUMENT, "body = ", label, ": must be >= 0");
    if (nodes.empty()) fail(DELAM_ERROR_ARGUMENT, "nodes: a body needs at least one");
    if (body_of_label(label) >= 0) fail(DELAM_ERROR_MESH, "body ", label, " exists already");
    std::set<std::int64_t> listed;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        poll_cancel("mesh");
        const std::int64_t node = nodes[i];
        if (node < 0 || node >= node_count())
            fail(DELAM_ERROR_ARGUMENT, "nodes[", i, "] = ", node, ": must be in 0..", node_count() - 1);
        if (!listed.insert(node).second) fail(DELAM_ERROR_ARGUMENT, "nodes[", i, "] = ", node, " occurs twice");
        if (node_label_[index(node)] == reserved)
            fail(DELAM_ERROR_MESH, "nodes[", i, "] = ", node,
                 " is tied to an interface or the control node of an obstacle");
        if (node_label_[index(node)] >= 0)
            fail(DELAM_ERROR_MESH, "nodes[", i, "] = ", node, " belongs to body ", node_label_[index(node)]);
    }
    std::vector<std::int32_t> labels = labels_, host = host_labels_;
    labels.insert(std::lower_bound(labels.begin(), labels.end(), label), label);
    host.insert(std::lower_bound(host.begin(), host.end(), label), label);
    // Nothing below can fail.
    rename_bodies(labels);
    labels_.swap(labels);
    host_labels_.swap(host);
    for (const std::int64_t node : nodes) node_label_[index(node)] = label;
}

std::int64_t Mesh::append(InterfaceGeometry interface, std::vector<NodeTie> ties, std::span<const double> places,
                          std::span<const std::int64_t> originals) {
    nodes_.reserve(nodes_.size() + places.size());
    node_label_.reserve(node_label_.size() + ties.size());
    node_origin_.reserve(node_origin_.size() + ties.size());
    next_copy_.reserve(next_copy_.size() + ties.size());
    ties_.reserve(ties_.size() + ties.size());
    interfaces_.push_back(std::move(interface));
    // From here on nothing can fail.
    nodes_.insert(nodes_.end(), places.begin(), places.end());
    for (std::size_t i = 0; i < ties.size(); ++i) {
        NodeTie& t = ties[i];
        node_label_.push_back(reserved);
        node_origin_.push_back(i < originals.size() && originals[i] >= 0 ? originals[i] : t.node);
        next_copy_.push_back(-1);
        ties_.push_back(std::move(t));
    }
    return static_cast<std::int64_t>(interfaces_.size()) - 1;
}

void Mesh::append_all(std::vector<InterfaceGeometry>& interfaces) {
    interfaces_.reserve(interfaces_.size() + interfaces.size());
    std::move(interfaces.begin(), interfaces.end(), std::back_inserter(interfaces_));
}

double scene_size(const Mesh& mesh) {
    const auto dim = index(mesh.dimension());
    const std::span<const double> nodes = mesh.nodes();
    double square = 0.0;
    for (std::size_t k = 0; k < dim; ++k) {
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (std::size_t i = k; i < nodes.size(); i += dim) {
            least = std::min(least, nodes[i]);
            most = std::max(most, nodes[i]);
        }
        square += (most - least) * (most - least);
    }
    return std::sqrt(square);
}

}  // namespace delam
