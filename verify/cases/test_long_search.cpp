// SPDX-License-Identifier: BSD-3-Clause
// Several fronts of energetic analyses on finer meshes than in the quick tier.
#include "search_beams.hpp"

namespace {

CASE_TEST(two_fronts_of_a_flexure) { cases::expect_two_fronts(1.5e-3, loop == 1); }
CASE_TEST(two_interfaces) { cases::expect_two_interfaces(1.5e-3, loop == 1); }

}  // namespace

int main() {
    Suite* suite = suite_create("search, fine");
    TCase* tests = tcase_create("search");
    tcase_add_loop_test(tests, two_fronts_of_a_flexure, 0, 2);
    tcase_add_loop_test(tests, two_interfaces, 0, 2);
    suite_add_tcase(suite, tests);
    return cases::run_suite(suite);
}
