// SPDX-License-Identifier: BSD-3-Clause
//
// A conforming mesh of touching bodies has one node where each body needs its own. Copies of a node form a list that
// starts at the original, so that a body finds its own copy again in whichever call adds its next cell.
#include <algorithm>
#include <numeric>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"

namespace delam {

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

}  // namespace delam
