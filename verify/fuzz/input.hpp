// SPDX-License-Identifier: BSD-3-Clause
// Reads the bytes of a fuzzer as the arguments of a host: mostly plausible, sometimes hostile. Past the end, all are 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <list>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace fuzz {

class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

    [[nodiscard]] bool empty() const { return at_ == end_; }
    std::uint8_t byte() { return empty() ? std::uint8_t{0} : *at_++; }
    bool flag() { return (byte() & 1) != 0; }
    // True one time in sixteen.
    bool seldom() { return (byte() & 15) == 15; }
    // 0 .. count-1
    std::int64_t below(std::int64_t count) { return count > 0 ? byte() % count : 0; }

    template <class T>
    T raw() {
        T value{};
        const auto left = static_cast<std::size_t>(end_ - at_);
        std::memcpy(&value, at_, left < sizeof(T) ? left : sizeof(T));
        at_ += left < sizeof(T) ? left : sizeof(T);
        return value;
    }
    std::vector<std::uint8_t> rest() {
        std::vector<std::uint8_t> bytes(at_, end_);
        at_ = end_;
        return bytes;
    }

    // Non-finite numbers, numbers that overflow when multiplied, and numbers that round to nothing.
    double hostile_real() {
        using limit = std::numeric_limits<double>;
        static const double values[] = {limit::quiet_NaN(),
                                        limit::infinity(),
                                        -limit::infinity(),
                                        limit::max(),
                                        -limit::max(),
                                        limit::min(),
                                        limit::denorm_min(),
                                        -0.0,
                                        0.0,
                                        1e300,
                                        -1e300,
                                        1e-300,
                                        1e154,
                                        1e-154,
                                        1e16,
                                        -1.0,
                                        1.0,
                                        0.5,
                                        1e-9,
                                        1.0 + 1e-15,
                                        2147483648.0,
                                        9223372036854775808.0,
                                        -9223372036854775808.0};
        const std::uint8_t which = byte();
        return which < 240 ? values[which % std::size(values)] : raw<double>();
    }
    // A number near 1 on a grid of halves, quarters, .., or a hostile one.
    double real() {
        const std::uint8_t which = byte();
        if (which >= 232) return hostile_real();
        return static_cast<double>(which % 29) / static_cast<double>(std::int64_t{1} << (which / 29));
    }
    double signed_real() { return flag() ? -real() : real(); }
    // A number in [0, 1], or a hostile one.
    double fraction() {
        const std::uint8_t which = byte();
        return which >= 244 ? hostile_real() : static_cast<double>(which % 61) / 60.0;
    }

    std::int64_t hostile_whole() {
        static const std::int64_t values[] = {-1,
                                              0,
                                              1,
                                              2,
                                              3,
                                              7,
                                              100,
                                              -2147483648,
                                              2147483647,
                                              2147483648,
                                              4294967296,
                                              std::int64_t{1} << 48,
                                              (std::int64_t{1} << 48) + 1,
                                              std::numeric_limits<std::int64_t>::max(),
                                              std::numeric_limits<std::int64_t>::min(),
                                              std::numeric_limits<std::int64_t>::max() / 3};
        const std::uint8_t which = byte();
        return which < 240 ? values[which % std::size(values)] : raw<std::int64_t>();
    }
    // An index below `count`, or a hostile one.
    std::int64_t index(std::int64_t count) { return seldom() ? hostile_whole() : below(count); }
    std::int32_t small_label(std::int64_t count) { return static_cast<std::int32_t>(index(count)); }
    // A body's label or -1, or a hostile one.
    std::int32_t body() { return static_cast<std::int32_t>(seldom() ? hostile_whole() : below(4) - 1); }
    // 0 or 1, rarely neither.
    std::int32_t base() { return seldom() ? static_cast<std::int32_t>(hostile_whole()) : flag() ? 1 : 0; }

    std::vector<double> reals(std::size_t count) {
        std::vector<double> out(count);
        for (double& v : out) v = signed_real();
        return out;
    }
    std::vector<std::int64_t> indices(std::size_t count, std::int64_t size, std::int32_t index_base = 0) {
        std::vector<std::int64_t> out(count);
        for (std::int64_t& v : out) {
            v = index(size);
            if (v >= 0 && v < size) v += index_base;
        }
        return out;
    }
    // One of the words, rarely another text or NULL.
    const char* word(std::span<const char* const> words) {
        const std::uint8_t which = byte();
        if (which == 255) return nullptr;
        if (which == 254) return "";
        if (which == 253) return "no such word | at all: \xff\x01 %s %n 0123456789012345678901234567890123456789";
        return words[which % words.size()];
    }

private:
    const std::uint8_t* at_;
    const std::uint8_t* end_;
};

// Calls a function. Every compiler evaluates arguments in braces from left to right, but not those in parentheses.
struct in_order {
    template <class Function, class... Arguments>
    explicit in_order(Function function, Arguments&&... arguments)
        : status(function(std::forward<Arguments>(arguments)...)) {}
    std::int32_t status;
};
#define IN_ORDER(...) (fuzz::in_order{__VA_ARGS__}.status)

// The words of a text.
inline std::vector<const char*> words_of(const char* text) {
    static std::list<std::string> kept;
    std::vector<const char*> words;
    std::istringstream all(text);
    for (std::string word; all >> word;) words.push_back(kept.emplace_back(word).c_str());
    return words;
}

// Rarely NULL in place of an array.
template <class T>
T* maybe(Input& in, std::vector<T>& values) {
    return in.seldom() ? nullptr : values.data();
}

}  // namespace fuzz
