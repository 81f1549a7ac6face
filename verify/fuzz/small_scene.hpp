// SPDX-License-Identifier: BSD-3-Clause
// Valid scenes of a few cells that peel or shear within a few steps, and use different parts of the library.
#pragma once

#include "contract.hpp"
#include "input.hpp"

namespace fuzz {

struct SmallScene {
    delam_mesh* mesh = nullptr;
    delam_law* law = nullptr;
    delam_problem* problem = nullptr;
};

// A block of layers, supported at the left end of the lowest one and loaded at that of the highest; the bytes choose
// cells, law, load and options. The caller destroys the three objects.
SmallScene small_scene(Host& host, Input& in);
void destroy(SmallScene& scene);

}  // namespace fuzz
