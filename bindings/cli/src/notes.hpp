// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are allowed but rarely meant.
#pragma once

#include <string>
#include <vector>

#include "build.hpp"

namespace cli {

// Regions and patches beyond what they are on, interfaces where nothing adheres, loads at the start.
std::vector<std::string> warnings_of(const Model& model, const Scene& scene);
// Meshes whose cells are known to be too stiff for what they model.
std::vector<std::string> notes_of(const Scene& scene);

}  // namespace cli
