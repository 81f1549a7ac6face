// SPDX-License-Identifier: BSD-3-Clause
// The steps of a deck as [[patterns]], [[supports]], [[loads]], [[forces]] and [time] of a scene.
#pragma once

#include <string>

#include "deck/cards/deck.hpp"
#include "deck/deck_references.hpp"
#include "mesh/mesh_data.hpp"

namespace cli::abaqus {

// model, mesh: of the same file, with the same numbers of nodes. Throws SceneFailure at lines that cannot be taken.
// references: learns what the loads prescribe.
std::string loads_text(Deck& deck, const Model& model, const MeshData& mesh, References& references);

}  // namespace cli::abaqus
