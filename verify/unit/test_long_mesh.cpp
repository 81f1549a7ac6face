// SPDX-License-Identifier: BSD-3-Clause
// Partitions of every cell type into each number of parts up to 64, each computed twice.
#include <cstdlib>

#include "partitions.hpp"

#include "quiet_check.hpp"  // last: it has a macro named fail

START_TEST(partitions) {
    const auto always = [](std::int64_t) { return true; };
    unit::check_partitions(all_types[static_cast<std::size_t>(_i)], always, always);
}
END_TEST

int main() {
    Suite* suite = suite_create("mesh, all partitions");
    TCase* cases = tcase_create("mesh");
    tcase_add_loop_test(cases, partitions, 0, static_cast<int>(all_types.size()));
    suite_add_tcase(suite, cases);
    SRunner* runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
