// SPDX-License-Identifier: BSD-3-Clause
// FNV-1a, 64 bits, as 16 hexadecimal digits: distinguishes scenes and shows damage, but does not resist an attack.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cli {

constexpr std::uint64_t hash_of_nothing = 0xcbf29ce484222325U;

// hash(b, hash(a)) is the hash of a with b behind it.
std::uint64_t hash(std::string_view bytes, std::uint64_t before = hash_of_nothing);
std::string hash_text(std::uint64_t hash);
std::string hash_text(std::string_view bytes);

// Tells contents of files apart.
struct Content {
    std::int64_t bytes = 0;
    std::string hash;

    bool operator==(const Content&) const = default;
};
struct NamedContent {
    std::string name;
    Content content;
};
Content content_of(std::string_view bytes);
// Reads a part of the file at a time. Throws Failure(exit_scene) where it cannot be read.
Content content_of_file(const std::string& path);

}  // namespace cli
