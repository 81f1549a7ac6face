// SPDX-License-Identifier: BSD-3-Clause
// The patch tests of two blocks in the numbers of subdomains that the quick tier leaves out.
#include "patch_blocks.hpp"

namespace {

constexpr int subdomain_counts[] = {2, 4, 6, 7};

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
    Suite* suite = suite_create("patch, more subdomains");
    TCase* tests = tcase_create("two blocks");
    tcase_add_loop_test(tests, bonded_blocks, 0, 9);
    tcase_add_loop_test(tests, bonded_blocks_redundant, 0, 9);
    tcase_add_loop_test(tests, compliant_interface_in_series, 0, 9);
    suite_add_tcase(suite, tests);
    return cases::run_suite(suite);
}
