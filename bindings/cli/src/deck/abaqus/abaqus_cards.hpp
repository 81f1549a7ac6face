// SPDX-License-Identifier: BSD-3-Clause
// Builds the model from the cards of an Abaqus input file.
#pragma once

#include <string>
#include <vector>

#include "deck/abaqus/abaqus_model.hpp"
#include "deck/abaqus/inp_cards.hpp"

namespace cli::abaqus {

// model: empty; it must not be moved, because parts refer to it. Throws SceneFailure with file and line.
void take_cards(const std::vector<InpCard>& cards, const std::string& path, Model& model);

// The surface of a *DLOAD, which the cards of the mesh add outside of parts; empty: the side is none of P1 .. P6.
std::string pressed_surface(const std::string& elements, const std::string& side);

}  // namespace cli::abaqus
