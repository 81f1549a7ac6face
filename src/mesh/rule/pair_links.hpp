// SPDX-License-Identifier: BSD-3-Clause
// Pairs of quadratic faces with the next ones of their kind: corner to corner, mid-side node to that of a parallel
// side, centre to centre. Weights and tractions of the kinds differ, so that only such pairs show what a crack does
// that advances by a cell: its energy then falls by 1/2 sum w t.[u], with the tractions ahead and the jumps a cell
// behind.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

// A sum over pairs, int grad f dA of a field f, is the sum of  area (f(to) - f(from))  over the links.
struct PairLink {
    std::int64_t from, to;
    std::array<double, 3> area;
};

// The links of an interface in space; none if its faces have no mid-side nodes. The gradient at a pair is that of the
// linear function that fits its links best; a sum over pairs takes it times their weights. Pairs whose links have one
// direction (of a triangle with two sides on the rim) count along it only, and those beside a face of another shape,
// which have none, not at all.
std::vector<PairLink> pair_links(const Mesh& mesh, const InterfaceGeometry& interface);

}  // namespace delam
