// SPDX-License-Identifier: BSD-3-Clause
// Energetic analyses of the brittle ENF against the exhaustive scan of fronts: after every step no more energy than the
// scan, the jump in the same step and, when located, at the load where the scan's energies cross; no bound violated.
// Finer meshes are in the long tier.
#include "energetic_scan.hpp"

namespace {

// With exponents 1 the toughness does not depend on the mixity, and the two histories cannot differ in it.
constexpr cases::ScanRun runs[] = {{1.5e-3, 0.0, 2.0}, {1.5e-3, 3e-3, 1.0}, {1e-3, 2e-3, 2.0}};

LOOP_TEST(no_step_above_the_scan, 0, std::size(runs)) { cases::expect_no_step_above_the_scan(runs[loop]); }
LOOP_TEST(jump_is_located_where_the_energies_cross, 0, std::size(runs)) {
    cases::expect_jump_where_the_energies_cross(runs[loop]);
}

}  // namespace
