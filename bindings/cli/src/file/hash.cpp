// SPDX-License-Identifier: BSD-3-Clause
#include "file/hash.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

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

// Multiplicative hashing (D. Knuth, The Art of Computer Programming 3, section 6.4) of each word and what was before
// it.
void FileHash::add(std::string_view bytes) {
    constexpr std::uint64_t multiplier = 0x9e3779b97f4a7c15U;
    const char* at = bytes.data();
    for (std::size_t left = bytes.size(); left > 0;) {
        const std::size_t now = std::min<std::size_t>(left, 8);
        std::uint64_t word = 0;
        std::memcpy(&word, at, now);
        hash_ = (std::rotl(hash_, 29) ^ word) * multiplier;
        at += now;
        left -= now;
    }
    bytes_ += static_cast<std::int64_t>(bytes.size());
}

Content FileHash::content() const {
    FileHash with_length = *this;
    const auto length = static_cast<std::uint64_t>(bytes_);
    with_length.add({reinterpret_cast<const char*>(&length), sizeof length});
    return {bytes_, "w" + hash_text(with_length.hash_ ^ (with_length.hash_ >> 32U))};
}

std::string file_hash_of(std::string_view bytes) {
    FileHash hash;
    hash.add(bytes);
    return hash.content().hash;
}

namespace {

// Calls use(bytes) for one part of a file after another, so that no more memory is needed however long the file.
void each_part(const std::string& path, const auto& use) {
    std::array<char, std::size_t{1} << 16> bytes;
    InputFile file(path);
    const auto next = [&] { return static_cast<std::size_t>(file.read_into(bytes.data(), std::ssize(bytes))); };
    for (std::size_t count = next(); count > 0; count = next()) use(std::string_view(bytes.data(), count));
}

}  // namespace

Content content_of_file(const std::string& path) {
    FileHash hash;
    each_part(path, [&hash](std::string_view bytes) { hash.add(bytes); });
    return hash.content();
}

namespace {

Content content_like(const std::string& hash_of_kind, const std::string& path) {
    if (hash_of_kind.empty() || hash_of_kind.starts_with("w")) return content_of_file(path);
    Content out;
    std::uint64_t hashed = hash_of_nothing;
    each_part(path, [&](std::string_view bytes) {
        hashed = hash(bytes, hashed);
        out.bytes += static_cast<std::int64_t>(bytes.size());
    });
    out.hash = hash_text(hashed);
    return out;
}

}  // namespace

bool has_content(const std::string& path, const Content& expected) {
    return content_like(expected.hash, path) == expected;
}

std::string hash_like(const std::string& other, const std::string& path) { return content_like(other, path).hash; }

}  // namespace cli
