// SPDX-License-Identifier: BSD-3-Clause
// FNV-1a, 64 bits, as 16 hexadecimal digits: distinguishes scenes, but does not resist an attack.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cli {

std::uint64_t hash(std::string_view bytes);
std::string hash_text(std::string_view bytes);

}  // namespace cli
