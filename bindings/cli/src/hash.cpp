// SPDX-License-Identifier: BSD-3-Clause
#include "hash.hpp"

#include <fmt/format.h>

namespace cli {

std::uint64_t hash(std::string_view bytes) {
    std::uint64_t h = 0xcbf29ce484222325U;
    for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return h;
}

std::string hash_text(std::string_view bytes) { return fmt::format("{:016x}", hash(bytes)); }

}  // namespace cli
