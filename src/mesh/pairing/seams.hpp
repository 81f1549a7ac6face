// SPDX-License-Identifier: BSD-3-Clause
// Finds outer faces that meet others without an interface: seams of doubled nodes within a body, bodies that touch, and
// walls of one body that face each other (add_seams, add_self_contact of interfaces.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/box_tree.hpp"
#include "mesh/mesh.hpp"

namespace delam {

struct Seam {
    std::int32_t body, other;  // equal for a seam within a body
    std::int64_t faces = 0;    // of both
    Box box;                   // around their centres
};

// Returns the faces that lie on others with opposite normals, at a distance that is rounding (1e-6 of the shortest
// edge), sorted by bodies. A face all of whose nodes have pairs is left out.
std::vector<Seam> find_seams(const Mesh& mesh);

}  // namespace delam
