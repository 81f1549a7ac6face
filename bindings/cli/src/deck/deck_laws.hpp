// SPDX-License-Identifier: BSD-3-Clause
// Interface laws of a deck as [[laws]] of a scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "deck/cards/deck.hpp"

namespace cli::abaqus {

// True if the two shears have different stiffnesses.
bool two_shears(const Numbers& stiffness, std::int32_t dimension);
// stiffness: Knn, Kss, Ktt, force per volume. thickness: by which nominal strains become jumps. Differences between the
// law of the deck and that of the scene are added to `changed`.
std::string law_text(const std::string& name, const Numbers& stiffness, double thickness, const DamageCards& damage,
                     std::int32_t dimension, const Place& place, std::vector<std::string>& changed);

}  // namespace cli::abaqus
