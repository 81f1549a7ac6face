// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_arrays.hpp"

#include <bit>
#include <cstring>
#include <vector>

#include <zlib.h>

#include "text/error.hpp"

namespace cli {

namespace {

constexpr std::size_t bytes_of_a_number = 4;  // of both types

std::string base64(std::span<const unsigned char> bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < count ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k) out += k <= count ? digits[word >> (18 - 6 * k) & 63U] : '=';
    }
    return out;
}

// The first bytes of all numbers, then the second ones, ..: like follows like.
std::vector<unsigned char> by_place(std::span<const unsigned char> bytes) {
    std::vector<unsigned char> out(bytes.size());
    const std::size_t count = bytes.size() / bytes_of_a_number;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < bytes_of_a_number; ++k) out[k * count + i] = bytes[bytes_of_a_number * i + k];
    return out;
}

std::vector<unsigned char> deflated(std::span<const unsigned char> bytes) {
    uLongf length = compressBound(static_cast<uLong>(bytes.size()));
    std::vector<unsigned char> out(length);
    if (compress2(out.data(), &length, bytes.data(), static_cast<uLong>(bytes.size()), 6) != Z_OK)
        throw std::bad_alloc();  // the only failure that room for the bound leaves
    out.resize(length);
    return out;
}

template <class T>
std::span<const unsigned char> bytes_in(const std::vector<T>& values) {
    static_assert(sizeof(T) == bytes_of_a_number && std::endian::native == std::endian::little);
    return {reinterpret_cast<const unsigned char*>(values.data()), bytes_of_a_number * values.size()};
}

}  // namespace

float rounded_to(float value, int bits) {
    auto word = std::bit_cast<std::uint32_t>(value);
    constexpr std::uint32_t exponent = 0x7f800000U;
    if (bits >= 24 || (word & exponent) == exponent) return value;  // infinite, or no number
    const auto dropped = static_cast<std::uint32_t>(24 - bits);
    const std::uint32_t unit = 1U << dropped;
    word += unit / 2 - 1 + (word >> dropped & 1U);  // ties to even
    return std::bit_cast<float>(word & ~(unit - 1));
}

nlohmann::json ViewArrays::add(std::span<const double> values, int bits) {
    std::vector<float> single;
    single.reserve(values.size());
    for (const double value : values) single.push_back(rounded_to(static_cast<float>(value), bits));
    return add_bytes("float32", bytes_in(single));
}

nlohmann::json ViewArrays::add(std::span<const std::int32_t> values) {
    return add_bytes("int32", bytes_in(std::vector<std::int32_t>(values.begin(), values.end())));
}

nlohmann::json ViewArrays::add_bytes(const char* type, std::span<const unsigned char> bytes) {
    const std::string id = "array-" + std::to_string(count_++);
    elements_ += "<script type=\"text/plain\" id=\"" + id + "\">" + base64(deflated(by_place(bytes))) + "</script>\n";
    return {{"id", id}, {"type", type}, {"count", bytes.size() / bytes_of_a_number}};
}

}  // namespace cli
