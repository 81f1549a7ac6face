// SPDX-License-Identifier: BSD-3-Clause
// The subcommands and their options as plain texts, for the manual page and the completion of shells.
#pragma once

#include <string>
#include <vector>

namespace cli {

struct OptionText {
    std::vector<std::string> names;  // "--out", "-o"; of an argument: "scene"
    std::string value;               // the kind of value, e.g. "FOLDER"; "" of a flag
    std::string meaning;
    std::vector<std::string> choices;
    bool needed = false;
    bool argument = false;
    bool several = false;  // takes more than one value, or may be given again
};

struct CommandText {
    std::string name;
    std::string meaning;
    std::vector<OptionText> options;
};

// The program as a whole; its own options are in `options`.
struct ProgramText {
    std::string name, meaning, footer;
    std::vector<OptionText> options;
    std::vector<CommandText> commands;
};

// The kinds of values; completion offers such files.
inline constexpr const char* scene_value = "SCENE";
inline constexpr const char* deck_value = "DECK";
inline constexpr const char* folder_value = "FOLDER";
inline constexpr const char* file_value = "FILE";
inline constexpr const char* setting_value = "KEY=VALUE";

}  // namespace cli
