// SPDX-License-Identifier: BSD-3-Clause
#include "text/printable.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

namespace cli {

namespace {

struct Character {
    std::uint32_t code = 0;
    std::size_t length = 0;  // in bytes; 0: no UTF-8
};

// The first character of a text that is not empty (Unicode 15, table 3-7: no overlong forms, no surrogates).
Character first_character(std::string_view text) {
    const auto byte = [text](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
    std::uint32_t code = lead & (0xffU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0U) != 0x80) return {};
        code = code << 6U | (byte(i) & 0x3fU);
    }
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (code < least[length] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
    return {code, length};
}

struct Codes {
    std::uint32_t first, last;
};
// C0 without tabulator and end of line, DEL and C1; separators of lines and paragraphs; marks, embeddings, overrides
// and isolates of direction; the mark of the byte order; tags.
constexpr Codes hidden[] = {{0x00, 0x08},     {0x0b, 0x1f},     {0x7f, 0x9f},     {0x061c, 0x061c},  {0x200e, 0x200f},
                            {0x2028, 0x202e}, {0x2066, 0x2069}, {0xfeff, 0xfeff}, {0xe0000, 0xe007f}};

bool is_hidden(std::uint32_t code) {
    return std::any_of(std::begin(hidden), std::end(hidden),
                       [code](const Codes& range) { return code >= range.first && code <= range.last; });
}

}  // namespace

std::string printable(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const Character character = first_character(text);
        const std::string_view bytes = text.substr(0, std::max<std::size_t>(character.length, 1));
        if (character.length > 0 && !is_hidden(character.code))
            out += bytes;
        else
            for (const char byte : bytes) out += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
        text.remove_prefix(bytes.size());
    }
    return out;
}

std::string one_line(std::string_view text) {
    std::string out;
    for (const char c : printable(text))
        if (c == '\n')
            out += "\\x0a";
        else
            out += c;
    return out;
}

}  // namespace cli
