// SPDX-License-Identifier: BSD-3-Clause
// Writes the connections of the bodies of a deck as [[laws]] and [[interfaces]] of a scene.
#pragma once

#include <string>

#include "deck/cards/deck.hpp"
#include "mesh/mesh_data.hpp"

namespace cli::abaqus {

// mesh: split into pieces. Bodies that share nodes are bonded, cohesive elements and contact pairs with *COHESIVE
// BEHAVIOR have laws, and all else that touches is in contact.
std::string interfaces_text(Deck& deck, const Model& model, const MeshData& mesh);

}  // namespace cli::abaqus
