// SPDX-License-Identifier: BSD-3-Clause
#include "scene/carriers.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam {

Carriers::Carriers(const Problem& problem) : mesh_(*problem.mesh) {
    const std::int64_t dim = mesh_.dimension();
    kind_.assign(index(mesh_.node_count()), Kind::nothing);
    for (std::int64_t node = 0; node < mesh_.node_count(); ++node)
        if (mesh_.node_body(node) >= 0) kind_[index(node)] = Kind::body;
    for (const NodeTie& tie : mesh_.ties()) kind_[index(tie.node)] = Kind::tied;
    const auto refer = [&](std::int64_t node) {
        Kind& kind = kind_[index(node)];
        if (kind == Kind::nothing) kind = Kind::control;
    };
    for (const Constraint& constraint : problem.constraints)
        for (const std::int64_t dof : constraint.dof) refer(dof / dim);
    for (const NodalForce& force : problem.forces) refer(force.dof / dim);
    for (const InterfaceGeometry& face : mesh_.interfaces()) {
        for (const std::int64_t node : face.node_a) refer(node);
        for (const std::int64_t node : face.node_b) refer(node);
    }
    for (std::int64_t node = 0; node < mesh_.node_count(); ++node) {
        if (kind(node) == Kind::control) controls_.push_back(node);
        self_.emplace_back(node, 1.0);
    }
}

std::span<const std::pair<std::int64_t, double>> Carriers::of(std::int64_t node) const {
    if (kind(node) != Kind::tied) return {&self_[index(node)], 1};
    const auto& ties = mesh_.ties();
    return std::lower_bound(ties.begin(), ties.end(), node,
                            [](const NodeTie& tie, std::int64_t n) { return tie.node < n; })
        ->of;
}

}  // namespace delam
