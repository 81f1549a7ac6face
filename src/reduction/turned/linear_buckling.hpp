// SPDX-License-Identifier: BSD-3-Clause
// Linear buckling: by how much stresses of small rotations exceed those at which the bodies buckle, with the present
// springs on the interfaces.
#pragma once

#include <cstdint>
#include <span>

#include "base/monitor.hpp"
#include "body/turned/initial_stress.hpp"
#include "reduction/turned/held_bodies.hpp"

namespace delam {

// Returns the largest factor of  G v = factor (K + springs) v,  with G from the stresses: above 1 they are beyond the
// critical ones. touching: normal rows of faces that touch without a force, [rows]; they hold nothing, unless the mode
// would press some of them into each other whichever its sign: then all of them hold, with a factorisation of their
// own. 0: the stresses soften nothing.
double critical_ratio(const HeldBodies& held, std::span<const std::uint8_t> touching, const InitialStress& stress,
                      const Poll& poll);

}  // namespace delam
