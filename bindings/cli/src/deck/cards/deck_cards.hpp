// SPDX-License-Identifier: BSD-3-Clause
// From the cards of an Abaqus input file to what they say beside the mesh.
#pragma once

#include <string>
#include <vector>

#include "deck/abaqus/inp_cards.hpp"
#include "deck/cards/deck.hpp"

namespace cli::abaqus {

// root: the scope of the sets that steps name. Throws SceneFailure with file, line and keyword at a card that would
// change the result and cannot be taken; cards that ask for output, or for what quasi-static steps do not need, are
// listed in `left_out`.
Deck read_deck(const std::vector<InpCard>& cards, const std::string& path, const Part& root);

}  // namespace cli::abaqus
