// SPDX-License-Identifier: BSD-3-Clause
// Energetic analyses of the brittle ENF against the exhaustive scan of fronts on finer meshes than in the quick tier.
#include "energetic_scan.hpp"

namespace {

constexpr cases::ScanRun runs[] = {{1e-3, 0.0, 2.0}, {1e-3, 2e-3, 1.0}, {0.75e-3, 2e-3, 2.0}, {0.5e-3, 2e-3, 2.0}};

LOOP_TEST(no_step_above_the_scan, 0, std::size(runs)) { cases::expect_no_step_above_the_scan(runs[loop]); }
LOOP_TEST(jump_is_located_where_the_energies_cross, 0, std::size(runs)) {
    cases::expect_jump_where_the_energies_cross(runs[loop]);
}

}  // namespace
