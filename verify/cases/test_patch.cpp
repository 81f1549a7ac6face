// SPDX-License-Identifier: BSD-3-Clause
// Patch tests of two blocks: a linear displacement on the boundary of perfectly bonded blocks gives its constant
// stress; a compliant interface under uniform tension opens by exactly t/k. Both for any number of subdomains. Up to 8
// subdomains, the other numbers in the long tier.
#include "patch_blocks.hpp"

namespace {

constexpr int subdomain_counts[] = {1, 3, 5, 8};

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
