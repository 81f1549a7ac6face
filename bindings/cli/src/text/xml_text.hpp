// SPDX-License-Identifier: BSD-3-Clause
// Texts within XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// Returns the text with everything escaped that would end a text or an attribute.
std::string xml_text(std::string_view text);

}  // namespace cli
