// SPDX-License-Identifier: BSD-3-Clause
// Names what changes in a scene that is linearised again and again.
#pragma once

#include <cstdint>

namespace delam {

// loads: forces and offsets of jumps; all: also the stiffness of the bodies and the frames of the interfaces.
enum class Renewed : std::uint8_t { loads, all };

}  // namespace delam
