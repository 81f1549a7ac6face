// SPDX-License-Identifier: BSD-3-Clause
// Contact that needs more than an entry of its own: wherever outer faces have no interface, and across gaps.
#pragma once

#include <cstddef>
#include <functional>

#include "model/model.hpp"

namespace cli {

// Adds interfaces of contact between bodies that have none and whose faces lie within the gap of [contact], and between
// the two sides of seams within a body. has_entry: whether the scene has an entry for two bodies.
void add_general_contact(Model& model, const Scene& scene,
                         const std::function<bool(std::size_t, std::size_t)>& has_entry);

// Lets the distances of open interfaces count, with a pattern of their own.
void set_gaps(Model& model, const Scene& scene);

}  // namespace cli
