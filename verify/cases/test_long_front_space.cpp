// SPDX-License-Identifier: BSD-3-Clause
// Circular fronts in space that grow, in all types of cells that resolve them.
#include "growing_fronts.hpp"

#include "support.hpp"

using namespace growing_fronts;

LOOP_TEST(circular_front_grows, 0, 3) { grow_circular(circular_kinds[loop]); }
