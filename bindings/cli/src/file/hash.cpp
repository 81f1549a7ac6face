// SPDX-License-Identifier: BSD-3-Clause
#include "file/hash.hpp"

#include <fmt/format.h>

#include "file/input_file.hpp"

namespace cli {

std::uint64_t hash(std::string_view bytes, std::uint64_t before) {
    std::uint64_t h = before;
    for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return h;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::string hash_text(std::string_view bytes) { return hash_text(hash(bytes)); }

Content content_of(std::string_view bytes) { return {static_cast<std::int64_t>(bytes.size()), hash_text(bytes)}; }

Content content_of_file(const std::string& path) {
    constexpr std::int64_t at_once = std::int64_t{1} << 20;  // no more memory, however long the file
    InputFile file(path);
    Content out;
    std::uint64_t hashed = hash_of_nothing;
    for (std::string bytes = file.read(at_once); !bytes.empty(); bytes = file.read(at_once)) {
        hashed = hash(bytes, hashed);
        out.bytes += static_cast<std::int64_t>(bytes.size());
    }
    out.hash = hash_text(hashed);
    return out;
}

}  // namespace cli
