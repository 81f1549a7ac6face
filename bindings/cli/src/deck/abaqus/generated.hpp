// SPDX-License-Identifier: BSD-3-Clause
// Nodes and elements that an input file generates from others: *NGEN on straight lines, *NFILL between two sets, *NCOPY
// at a distance, *ELGEN in rows and layers, *ELCOPY.
#pragma once

#include <cstdint>

#include "deck/abaqus/abaqus_model.hpp"
#include "deck/abaqus/inp_cards.hpp"

namespace cli::abaqus {

// Return how many were added. Throw SceneFailure where these are more than `most`.
std::int64_t generate_nodes(const InpCard& card, Part& part, std::int64_t most);
std::int64_t generate_elements(const InpCard& card, Part& part, std::int64_t most);
std::int64_t fill_nodes(const InpCard& card, Part& part, std::int64_t most);
std::int64_t copy_nodes(const InpCard& card, Part& part, std::int64_t most);
std::int64_t copy_elements(const InpCard& card, Part& part, std::int64_t most);

}  // namespace cli::abaqus
