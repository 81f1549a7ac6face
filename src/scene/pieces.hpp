// SPDX-License-Identifier: BSD-3-Clause
// What moves rigidly: parts of bodies that hang together through whole faces, and parts of a stiffness that the host
// gave.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scene/problem.hpp"

namespace delam {

struct Pieces {
    std::vector<std::int32_t> body;                // [pieces] body index
    std::vector<std::vector<std::int64_t>> nodes;  // [pieces] ascending
    std::vector<std::int64_t> of_node;             // [mesh nodes] the first piece that has it, -1: none

    // Cells that meet in a node but no face: two pieces at one place.
    struct Hinge {
        std::int64_t node, piece_a, piece_b;
    };
    std::vector<Hinge> hinges;

    std::vector<std::uint8_t> fixed;  // [pieces] 1: the host's own supports hold it altogether
    // Rigid motions of the others that they resist: sum of coefficient u[dof] would be zero on what is free.
    using Row = std::vector<std::pair<std::int64_t, double>>;
    std::vector<Row> resisted;

    std::size_t count() const { return body.size(); }
};

Pieces rigid_pieces(const Problem& problem);

// 1 for bodies whose stiffness the host gave, [bodies].
std::vector<std::uint8_t> given_by_host(const Problem& problem);

}  // namespace delam
