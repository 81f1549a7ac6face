// SPDX-License-Identifier: BSD-3-Clause
// Cuts and seams within bodies, and contact that needs more than an entry: wherever outer faces have no interface,
// across gaps.
#pragma once

#include <cstddef>
#include <functional>

#include "model/library/model.hpp"

namespace cli {

// Doubles the nodes of bodies along the sets of faces that entries name (cut), before any interface is made.
void cut_bodies(Model& model, const Scene& scene);

// Adds the interfaces of seams within bodies for which the scene has entries, in all bodies; seams of others are in
// contact.
void add_seams(Model& model, const Scene& scene);

// Adds interfaces of contact between bodies that have none and whose faces lie within the gap of [contact], and between
// the two sides of seams within a body. has_entry: whether the scene has an entry for two bodies.
void add_general_contact(Model& model, const Scene& scene,
                         const std::function<bool(std::size_t, std::size_t)>& has_entry);

// Lets the distances of open interfaces count, with a pattern of their own.
void set_gaps(Model& model, const Scene& scene);

}  // namespace cli
