// SPDX-License-Identifier: BSD-3-Clause
// Settings of the command line, `--set KEY=VALUE`: they change a scene after it was read and before it is checked, so
// that a wrong one gets the same message as a wrong line of the file, with "--set" as its place.
#pragma once

#include <string>
#include <string_view>

#include "toml.hpp"

namespace cli {

// The file name in places of values that come from a setting.
inline constexpr std::string_view setting_source = "--set";

// KEY: the path as the messages write it, e.g. geometry.h or laws[0].normal_onset. VALUE: as in TOML; what is no TOML
// value and begins with a letter is a text. Missing tables on the way are made. Throws SceneFailure.
void apply_setting(toml::table& root, const std::string& setting);

}  // namespace cli
