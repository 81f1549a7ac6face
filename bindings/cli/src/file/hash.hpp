// SPDX-License-Identifier: BSD-3-Clause
// Hashes distinguish scenes and show damage, but do not resist an attack: FNV-1a, 64 bits, as 16 hexadecimal digits,
// and for whole files one that takes eight bytes at a time, as "w" and 16 digits.
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

// The hash of a file as it is written or read, part by part.
class FileHash {
public:
    // Only the last part may have a length that is no multiple of 8.
    void add(std::string_view bytes);
    [[nodiscard]] Content content() const;

private:
    std::uint64_t hash_ = 0;
    std::int64_t bytes_ = 0;
};
std::string file_hash_of(std::string_view bytes);
// Reads a part of the file at a time. Throws Failure(exit_scene) where it cannot be read.
Content content_of_file(const std::string& path);
// True if the file has this content. Versions before 0.3 wrote FNV-1a of files.
bool has_content(const std::string& path, const Content& expected);
// Returns the hash of the file, of the kind that another hash is of.
std::string hash_like(const std::string& other, const std::string& path);

}  // namespace cli
