// SPDX-License-Identifier: BSD-3-Clause
// Parts that move rigidly: parts of bodies connected through whole faces, and connected parts of a stiffness given by
// the host.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "scene/problem.hpp"

namespace delam {

struct Pieces {
    std::vector<std::int32_t> body;                // [pieces] body index
    std::vector<std::vector<std::int64_t>> nodes;  // [pieces] ascending
    std::vector<std::int64_t> of_node;             // [mesh nodes] the first piece that contains it, -1: none

    // Cells that share a node but no face: two pieces at one position.
    struct Hinge {
        std::int64_t node, piece_a, piece_b;
    };
    std::vector<Hinge> hinges;

    std::vector<std::uint8_t> fixed;  // [pieces] 1: the host's own supports hold it completely
    // Rigid motions of the other pieces that these supports resist: sum of coefficient u[dof] is zero for free motions.
    using Row = std::vector<std::pair<std::int64_t, double>>;
    std::vector<Row> resisted;

    std::size_t count() const { return body.size(); }
};

// Found once for the stiffness that the bodies have, and kept with the problem and its copies.
const Pieces& rigid_pieces(const Problem& problem);

// True if these displacements [mesh DOFs] are rigid motions of all pieces, but for rounding: their forces are rounding.
// least: smaller displacements are rounding, too, L.
bool without_strain(const Problem& problem, std::span<const double> displacement, double least = 0.0);

// 1 for bodies whose stiffness the host has given, [bodies].
std::vector<std::uint8_t> given_by_host(const Problem& problem);

}  // namespace delam
