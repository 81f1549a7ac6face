// SPDX-License-Identifier: BSD-3-Clause
// Settings of the command line, `--set KEY=VALUE`. They change a scene after it was read and before it is checked, so
// that a wrong setting gets the same message as a wrong line of the file, with "--set" as its place.
#pragma once

#include <string>
#include <string_view>

#include "scene/table/toml.hpp"

namespace cli {

// The file name in the places of values from a setting.
inline constexpr std::string_view setting_source = "--set";

// KEY: the path as in messages, e.g. geometry.h or laws[0].normal_onset. VALUE: as in TOML; a word that is no TOML
// value and begins with a letter is a text. Missing tables on the path are created. Throws SceneFailure.
void apply_setting(toml::table& root, const std::string& setting);

}  // namespace cli
