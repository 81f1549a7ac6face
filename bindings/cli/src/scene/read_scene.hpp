// SPDX-License-Identifier: BSD-3-Clause
// Reads and checks a scene file or a deck.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cli {

// settings: KEY=VALUE, applied in turn (scene/table/setting.hpp). Throws SceneFailure with file, line, key, value and
// allowed range.
Scene read_scene(const std::string& file, const std::vector<std::string>& settings);

}  // namespace cli
