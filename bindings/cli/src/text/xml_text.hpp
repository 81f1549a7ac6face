// SPDX-License-Identifier: BSD-3-Clause
// Texts within XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// With what would end a text or an attribute escaped.
std::string xml_text(std::string_view text);

}  // namespace cli
