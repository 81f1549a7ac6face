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

}  // namespace cli::abaqus
