// SPDX-License-Identifier: BSD-3-Clause
// Finds all that a deck asks for and does not get, before any of its cards is taken.
#pragma once

#include <vector>

#include "deck/abaqus/inp_cards.hpp"

namespace cli::abaqus {

// Throws Refusals with the keywords, parameters, values of parameters and types of elements that are not imported, as
// their tables say. What belongs to a material, an interaction, an amplitude, an orientation or a surface counts if a
// card asks for it by name.
void require_importable(const std::vector<InpCard>& cards);

}  // namespace cli::abaqus
