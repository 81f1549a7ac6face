// SPDX-License-Identifier: BSD-3-Clause
// The stress-free motions of a connected solid: 3 in the plane, 6 in space.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

// Orthonormal basis of the rigid motions sampled at `nodes`, column-major [dimension*nodes][3 or 6]. Built about the
// centroid, with rotations scaled by the size of the point set, so that the result does not depend on units or
// position. Fewer columns if the nodes cannot distinguish all motions (in space: all on one line).
std::vector<double> rigid_modes(const Mesh& mesh, std::span<const std::int64_t> nodes);

}  // namespace delam
