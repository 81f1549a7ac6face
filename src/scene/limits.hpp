// SPDX-License-Identifier: BSD-3-Clause
// Numbers that steer the numerical methods: results agree within the tolerances of the options whatever they are, at
// another cost. No scene sets them and no hash has them; tests change them.
#pragma once

#include <cstdint>

#include "base/restarts.hpp"

namespace delam {

struct Limits : RestartLimits {
#define DELAM_STEERING(type, name, value, reason) type name = value;
#include "scene/limits.inc"
#undef DELAM_STEERING
};

}  // namespace delam
