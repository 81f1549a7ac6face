// SPDX-License-Identifier: BSD-3-Clause
// Lines for people. These functions never throw, because a failing stream must not stop an analysis: the stream keeps
// the error, and main() turns it into an exit code.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include <fmt/format.h>

namespace cli {

template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
    const std::string text = fmt::format(format, std::forward<T>(values)...);
    std::fwrite(text.data(), 1, text.size(), stdout);
}

template <class... T>
void complain(fmt::format_string<T...> format, T&&... values) {
    const std::string text = fmt::format(format, std::forward<T>(values)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

// "1 step", "2 steps".
inline std::string counted(std::int64_t number, const std::string& noun) {
    return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace cli
