// SPDX-License-Identifier: BSD-3-Clause
// The library speaks of labels and numbers, a scene of names and places.
#pragma once

#include <string>

#include "build.hpp"

namespace cli {

// `message` with the names of bodies and control nodes, and the places of constraints, in the place of their numbers.
std::string named(const std::string& message, const Scene& scene, const Model& model);

}  // namespace cli
