// SPDX-License-Identifier: BSD-3-Clause
// Selecting nodes and boundary patches by boxes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

// Nodes of a body (index; -1: all) inside the closed box, ascending; the box is widened by 1e-9 of the mesh's size.
std::vector<std::int64_t> find_nodes(const Mesh& mesh, std::int32_t body, std::span<const double> lower,
                                     std::span<const double> upper);

struct Patch {
    std::vector<std::int64_t> nodes;  // ascending
    // Integral of the node's shape function over the part of the boundary in the box: on quadratic cells some are < 0.
    std::vector<double> weights;
};
// Body as above; of all bodies, faces at their interfaces count too.
Patch find_patch(const Mesh& mesh, std::int32_t body, std::span<const double> lower, std::span<const double> upper,
                 std::span<const double> direction);

// An end of a box that lies between two pairs, so that what begins or ends there does so at the next pair outside.
struct MovedEnd {
    std::size_t axis;
    bool upper;
    double end;
    double next;
};
struct PairsInBox {
    std::vector<std::int64_t> pairs;  // ascending
    std::vector<MovedEnd> moved;
};
// Returns the pairs of an interface inside the closed box. A pair on a side of the box, to 1e-6 of the shortest edge of
// the two bodies, counts unless the interface continues beyond that side. There it is the tip of the part in the box.
// The interface continues where a face at the pair reaches beyond; without faces, where any pair lies beyond.
PairsInBox find_pairs(const Mesh& mesh, std::int64_t interface, std::span<const double> lower,
                      std::span<const double> upper);

}  // namespace delam
