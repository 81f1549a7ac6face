// SPDX-License-Identifier: BSD-3-Clause
// Patch tests of two blocks: a linear displacement on the boundary of perfectly bonded blocks gives its constant
// stress; a compliant interface under uniform tension opens by exactly t/k. Both for any number of subdomains. Up to 8
// subdomains, the other numbers in the long tier.
#include "patch_blocks.hpp"

namespace {

constexpr int subdomain_counts[] = {1, 3, 5, 8};

CASE_TEST(bonded_blocks) {
    for (const int n : subdomain_counts) patch::linear_field(patch::shapes[loop], n, false);
}

// Both nodes of a bonded pair are prescribed: the bond there is redundant.
CASE_TEST(bonded_blocks_redundant) {
    for (const int n : subdomain_counts) patch::linear_field(patch::shapes[loop], n, true);
}

CASE_TEST(compliant_interface_in_series) {
    for (const int n : subdomain_counts) patch::compliant_interface_in_series(patch::shapes[loop], n);
}

}  // namespace

int main() {
    Suite* suite = suite_create("patch");
    TCase* tests = tcase_create("two blocks");
    tcase_add_loop_test(tests, bonded_blocks, 0, 9);
    tcase_add_loop_test(tests, bonded_blocks_redundant, 0, 9);
    tcase_add_loop_test(tests, compliant_interface_in_series, 0, 9);
    suite_add_tcase(suite, tests);
    return cases::run_suite(suite);
}
