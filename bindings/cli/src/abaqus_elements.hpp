// SPDX-License-Identifier: BSD-3-Clause
// The element types of Abaqus that are read.
#pragma once

#include <cstdint>
#include <string_view>

#include "inp_cards.hpp"

namespace cli::abaqus {

struct ElementType {
    std::string_view name;
    std::int32_t cell;
    std::string_view formulation;
    std::string_view plane;
    std::string_view note;
};

// By the TYPE of an *ELEMENT card.
const ElementType& type_named(const InpCard& card);

}  // namespace cli::abaqus
