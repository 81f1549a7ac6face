// SPDX-License-Identifier: BSD-3-Clause
// Distances of paired faces before they move.
#pragma once

#include <vector>

#include "mesh/interface_geometry.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// Returns n . (x_b - x_a) of each pair, L; negative where the faces overlap. The interface must not be an obstacle,
// whose place nobody knows.
std::vector<double> pair_distances(const Mesh& mesh, const InterfaceGeometry& interface);

// Returns these distances, and 0 where the mesh cannot tell them from it: within the rounding of coordinates, and
// within the height of the arcs that facets of curved faces cut off.
std::vector<double> face_gaps(const Mesh& mesh, const InterfaceGeometry& interface);

}  // namespace delam
