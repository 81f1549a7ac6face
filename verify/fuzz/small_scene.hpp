// SPDX-License-Identifier: BSD-3-Clause
// Scenes of a few cells that are correct, peel or shear within a few steps, and differ in what they make the library
// do.
#pragma once

#include "contract.hpp"
#include "input.hpp"

namespace fuzz {

struct SmallScene {
    delam_mesh* mesh = nullptr;
    delam_law* law = nullptr;
    delam_problem* problem = nullptr;
};

// A block of layers, held at the left end of the lowest one and loaded at that of the highest; the bytes choose cells,
// law, load and options. The caller destroys the three.
SmallScene small_scene(Host& host, Input& in);
void destroy(SmallScene& scene);

}  // namespace fuzz
