// SPDX-License-Identifier: BSD-3-Clause
// The patch tests of two blocks in the numbers of subdomains that the quick tier leaves out.
#include "patch_blocks.hpp"

namespace {

constexpr int subdomain_counts[] = {2, 4, 6, 7};

LOOP_TEST(bonded_blocks, 0, 9) {
    for (const int n : subdomain_counts) patch::linear_field(patch::shapes[loop], n, false);
}

// Both nodes of a bonded pair are prescribed: the bond there is redundant.
LOOP_TEST(bonded_blocks_redundant, 0, 9) {
    for (const int n : subdomain_counts) patch::linear_field(patch::shapes[loop], n, true);
}

LOOP_TEST(compliant_interface_in_series, 0, 9) {
    for (const int n : subdomain_counts) patch::compliant_interface_in_series(patch::shapes[loop], n);
}

}  // namespace
