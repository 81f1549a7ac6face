// SPDX-License-Identifier: BSD-3-Clause
// NLGEOM of a deck as the kinematics of a scene.
#pragma once

#include <string>

#include "deck/cards/deck.hpp"
#include "deck/deck_references.hpp"

namespace cli::abaqus {

// Returns the key of [solver]; empty: that of the library, small rotations. Adds to Deck::changed what was decided, and
// why. references: after all constraints of the deck.
std::string kinematics_key(Deck& deck, const References& references);

}  // namespace cli::abaqus
