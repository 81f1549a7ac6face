// SPDX-License-Identifier: BSD-3-Clause
// The JSON Schema of the scene file (draft 4, which Taplo reads), from its tables of keys.
#pragma once

#include <string>

namespace cli {

// Returns the schema of scenes. A schema cannot say that names refer to something, that places lie on the mesh, or that
// lists have an entry for each dimension. Nor can it say that numbers are finite, or that laws and materials are sound
// as a whole.
std::string scene_schema();

}  // namespace cli
