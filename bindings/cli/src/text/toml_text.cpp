// SPDX-License-Identifier: BSD-3-Clause
#include "text/toml_text.hpp"

#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace cli {

namespace {

template <class T, class Write>
std::string list_of(const std::vector<T>& values, Write&& write) {
    std::string out;
    for (const T& value : values) out += (out.empty() ? "" : ", ") + write(value);
    return "[" + out + "]";
}

}  // namespace

std::string toml_text(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            out += c;
    }
    return out + "\"";
}

std::string as_utf8(const std::string& text) {
    std::size_t left = 0;  // bytes of a character that follow
    bool right = true;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (left > 0) {
            right = right && (byte & 0xc0U) == 0x80U;
            --left;
        } else if (byte >= 0x80U) {
            left = byte >= 0xf0U ? 3 : byte >= 0xe0U ? 2 : 1;
            right = right && byte >= 0xc2U && byte <= 0xf4U;
        }
    }
    if (right && left == 0) return text;
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80U) {
            out += c;
        } else {
            out += static_cast<char>(0xc0U | (byte >> 6U));
            out += static_cast<char>(0x80U | (byte & 0x3fU));
        }
    }
    return out;
}

std::string toml_number(double value) {
    // Moduli as 1.26e+11, not with all their zeros.
    constexpr double large = 1e6;
    std::string text = fmt::format("{}", value);
    if (std::abs(value) >= large) {
        char buffer[32];
        text.assign(buffer, std::to_chars(std::begin(buffer), std::end(buffer), value).ptr);
    }
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

std::string toml_list(const std::vector<double>& values) { return list_of(values, toml_number); }
std::string toml_list(const std::vector<std::string>& texts) { return list_of(texts, toml_text); }

}  // namespace cli
