// SPDX-License-Identifier: BSD-3-Clause
// Projection of curved faces on meshes as fine along the axis of the cylinder as around it.
#include <cstdlib>

#include "projection.hpp"

#include "quiet_check.hpp"  // last: it has a macro named fail

using delam::CellType;

START_TEST(curved) {
    for (const CellType type :
         {CellType::quad4, CellType::quad8, CellType::tri6, CellType::hex8, CellType::hex20, CellType::tet10})
        for (const std::int64_t n : {4, 8}) unit::expect_curved(type, n, unit::stack(type, type, n, 2 * n + 1));
}
END_TEST

int main() {
    Suite* suite = suite_create("projection, square cylinders");
    TCase* tests = tcase_create("interfaces");
    tcase_add_test(tests, curved);
    suite_add_tcase(suite, tests);
    SRunner* runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
