// SPDX-License-Identifier: BSD-3-Clause
// Several fronts of energetic analyses on finer meshes than in the quick tier.
#include "search_beams.hpp"

namespace {

LOOP_TEST(two_fronts_of_a_flexure, 0, 2) { cases::expect_two_fronts(1.5e-3, loop == 1); }
LOOP_TEST(two_interfaces, 0, 2) { cases::expect_two_interfaces(1.5e-3, loop == 1); }

}  // namespace
