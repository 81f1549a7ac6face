// SPDX-License-Identifier: BSD-3-Clause
// The carriers of a node: a body; only constraints, forces and pairs (a control node); or other nodes (a tied node).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "scene/problem.hpp"

namespace delam {

class Carriers {
public:
    explicit Carriers(const Problem& problem);

    enum class Kind : std::uint8_t { nothing, body, control, tied };
    Kind kind(std::int64_t node) const { return kind_[index(node)]; }
    // Nodes of no body to which a constraint, a force or a pair refers, ascending. Their displacements are unknowns
    // without stiffness.
    const std::vector<std::int64_t>& controls() const { return controls_; }
    // The displacement of a node is the sum of weight u over these: for a tied node, the nodes to which it is tied; for
    // any other, the node itself.
    std::span<const std::pair<std::int64_t, double>> of(std::int64_t node) const;

private:
    const Mesh& mesh_;
    std::vector<Kind> kind_;  // [nodes]
    std::vector<std::int64_t> controls_;
    std::vector<std::pair<std::int64_t, double>> self_;  // [nodes]
};

}  // namespace delam
