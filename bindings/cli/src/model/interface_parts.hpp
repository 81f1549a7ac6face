// SPDX-License-Identifier: BSD-3-Clause
// Gives parts of one interface an entry each, with laws of their own.
#pragma once

#include <cstdint>
#include <vector>

#include "model/library/model.hpp"
#include "scene/scene.hpp"

namespace cli {

// Entries of the scene for the interface between two layers or bodies, in their order.
using InterfaceEntries = std::vector<const InterfaceData*>;

// Appends the last interface of the mesh to the model. With several entries, or one with a part, it is split: the first
// of them in whose part a face of a pair lies has the pair, and one without a part has the rest. Throws SceneFailure
// where an entry has no pair, or a pair no entry.
void push_parts(Model& model, const Scene& scene, const InterfaceEntries& entries, std::size_t a, std::size_t b);

}  // namespace cli
