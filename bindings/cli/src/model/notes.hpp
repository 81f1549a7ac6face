// SPDX-License-Identifier: BSD-3-Clause
// Warnings about scenes that are allowed but rarely intended.
#pragma once

#include <string>
#include <vector>

#include "model/library/model.hpp"
#include "model/library/selection.hpp"

namespace cli {

// Regions and patches that extend beyond their interface or face, interfaces without adhesion, loads at the start.
std::vector<std::string> warnings_of(const Model& model, const Scene& scene);
// Meshes whose cells are known to be too stiff for the model.
std::vector<std::string> notes_of(const Scene& scene);

// Adds to what was said while the model was built where a place was not taken as it was given: a point whose node lies
// elsewhere, a patch of which a mesh has only a part.
void note_place(Model& model, const Scene& scene, const Selection& where, const Selected& taken);

}  // namespace cli
