// SPDX-License-Identifier: BSD-3-Clause
// Keywords, elements and parameters that stay out, with what to do instead.
#pragma once

#include <string>
#include <string_view>

namespace cli::abaqus {

// Returns what to do about a keyword that is not imported; a general hint where none is known.
std::string instead_of_keyword(std::string_view keyword);
// The same for a type of elements; "": nothing is known.
std::string instead_of_element(std::string_view type);

// It says what to do where cohesive elements end within a body, or between bodies that share nodes elsewhere.
constexpr std::string_view sections_of_one_side =
    "give the cells on one side of the cohesive elements an *ELSET and a *SOLID SECTION of their own: bodies that "
    "share nodes are bonded, so that the rest stays whole";

}  // namespace cli::abaqus
