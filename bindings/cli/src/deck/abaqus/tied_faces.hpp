// SPDX-License-Identifier: BSD-3-Clause
// The faces of bodies to which cohesive elements of a mesh of their own are tied.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesh/mesh_data.hpp"
#include "text/error.hpp"

namespace cli::abaqus {

// A tie of the nodes of cohesive elements to the faces of bodies.
struct TiedNodes {
    std::set<std::int64_t> nodes;
    std::string surface;  // the set of these faces
};

using LooseElements = std::map<std::size_t, Place>;  // by their position in the set

// Gives the loose elements of a set, which have nodes of their own, the faces of bodies opposite their middles, and
// adds to `faces` all faces of bodies whose middles lie on a loose element. Throws SceneFailure where a side of a loose
// element is not tied, or lies on no face to which it is.
void tie_to_bodies(const MeshData& mesh, const std::vector<TiedNodes>& ties, const LooseElements& loose,
                   CohesiveSet& set, std::vector<std::array<std::int64_t, 9>>& faces);

}  // namespace cli::abaqus
