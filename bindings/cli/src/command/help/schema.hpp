// SPDX-License-Identifier: BSD-3-Clause
// The JSON Schema of the scene file (draft 4, which Taplo reads), from its tables of keys.
#pragma once

#include <string>

namespace cli {

// What a schema cannot say: that names refer to something, places lie on the mesh, lists have as many entries as there
// are dimensions, numbers are finite, laws and materials are sound as a whole.
std::string scene_schema();

}  // namespace cli
