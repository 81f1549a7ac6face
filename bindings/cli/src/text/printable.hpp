// SPDX-License-Identifier: BSD-3-Clause
// Texts of files and of people, as a terminal and a log may get them.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// Returns the text with \xNN for each byte that could command a terminal or disguise a line. These are control
// characters other than newline and tabulator, separators of lines, marks of direction, and bytes that are no UTF-8.
std::string printable(std::string_view text);
// The same for what must stay on one line, such as a comment: ends of lines, too.
std::string one_line(std::string_view text);

}  // namespace cli
