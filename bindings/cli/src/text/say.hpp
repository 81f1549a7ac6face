// SPDX-License-Identifier: BSD-3-Clause
// Lines for people, or for programs: one JSON object each. These functions never throw, because a failing stream must
// not stop an analysis: the stream keeps the error, and program() turns it into an exit code.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "text/printable.hpp"

namespace cli {

// Makes each further line of standard output an object with an "event"; a line that is said as text is {"event":
// "line", "text": ..}.
void say_json_lines(bool yes);
bool says_json_lines();

// Prints the text as printable() has it, because texts of files and of people are in it.
void say_text(std::string_view text);
// Prints the bytes as they are: whole objects, files, commands to the terminal.
void say_raw(std::string_view text);
// An object of the event with members that are JSON already, e.g. "\"step\": 3"; nothing unless lines are JSON.
void say_event(std::string_view event, const std::string& members);
// A text as JSON, with its quotes; bytes that are not UTF-8 are replaced.
std::string json_text(const std::string& text);

template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
    say_text(fmt::format(format, std::forward<T>(values)...));
}

template <class... T>
void complain(fmt::format_string<T...> format, T&&... values) {
    const std::string text = printable(fmt::format(format, std::forward<T>(values)...));
    std::fflush(stdout);  // where both streams go to one file, what was said before stands before, in whole lines
    std::fwrite(text.data(), 1, text.size(), stderr);
}

// "1 step", "2 steps".
inline std::string counted(std::int64_t number, const std::string& noun) {
    return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace cli
