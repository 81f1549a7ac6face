// SPDX-License-Identifier: BSD-3-Clause
// The operator of a scene whose bodies another solver has condensed already.
#pragma once

#include <optional>

#include "reduction/choice/choose.hpp"
#include "scene/problem.hpp"

namespace delam {

// True if an operator of the problem may share the condensed bodies of another solver's design: it has some, bodies,
// supports and loads are equal (hash_of_bodies), and the options ask for no other operator.
bool shares_bodies(const Problem& problem, const Design& other);
// Returns the design of an operator that shares them; none where it may not.
std::optional<Design> shared_design(const Problem& problem, const Design& other);

}  // namespace delam
