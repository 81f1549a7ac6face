/* SPDX-License-Identifier: BSD-3-Clause
 * A small scene through the public header in C, made anew for each test. */
#ifndef CAPI_SCENE_H
#define CAPI_SCENE_H
#include <check.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "delam/delam.h"

static delam_context *context;
static delam_mesh *mesh;
static delam_law *law;
static delam_problem *problem;

static inline void expect(int32_t status, int32_t expected, const char *part) {
    const char *message = delam_context_message(context);
    ck_assert_msg(status == expected, "%s instead of %s: %s", delam_status_name(status), delam_status_name(expected),
                  message);
    ck_assert_msg(strstr(message, part) != NULL, "'%s' is not in '%s'", part, message);
}

static inline void fine(int32_t status) {
    ck_assert_msg(status == DELAM_OK, "%s: %s", delam_status_name(status), delam_context_message(context));
}

/* Two layers of 2 x 1 with 2 x 1 quads, one interface, materials, a law, supports at the bottom. */
static inline void set_up(void) {
    static const char *const keys[] = {"normal_stiffness", "tangential_stiffness", "normal_onset",
                                       "tangential_onset", "normal_toughness",     "tangential_toughness"};
    static const double values[] = {125e9, 125e9, 100.0, 100.0, 250.0, 250.0};
    const double length = 2.0;
    const int64_t cells = 2;
    const double thickness[2] = {1.0, 1.0};
    const int64_t layer_cells[2] = {1, 1};
    const double x[2] = {1.0, 0.0};
    const double y[2] = {0.0, 1.0};
    const int64_t corners[2] = {0, 2};
    int64_t index = -1;
    int i;
    fine(delam_context_create(&context));
    fine(delam_mesh_create_layers(context, 2, &length, &cells, 2, thickness, layer_cells, DELAM_QUAD4, &mesh));
    fine(delam_mesh_add_interface(mesh, 0, 1, 0.0, &index));
    ck_assert_int_eq(index, 0);
    fine(delam_law_create(context, "piecewise-linear", &law));
    for (i = 0; i < 6; ++i) fine(delam_law_set(law, keys[i], values[i]));
    fine(delam_problem_create(context, mesh, &problem));
    fine(delam_problem_set_elastic(problem, -1, 75e9, 0.3));
    fine(delam_problem_set_law(problem, 0, law));
    fine(delam_problem_prescribe_nodes(problem, 2, corners, y, 0, NULL, NULL, 0));
    fine(delam_problem_prescribe_nodes(problem, 1, corners, x, 0, NULL, NULL, 0));
    fine(delam_problem_check(problem));
}

static inline void tear_down(void) {
    delam_problem_destroy(&problem);
    delam_law_destroy(&law);
    delam_mesh_destroy(&mesh);
    delam_context_destroy(&context);
    ck_assert(problem == NULL && law == NULL && mesh == NULL && context == NULL);
}

/* Is the scene what it was? */
static char before[17];
static inline void remember(void) { fine(delam_problem_hash(problem, before)); }
static inline void unchanged(void) {
    char now[17];
    fine(delam_problem_hash(problem, now));
    ck_assert_str_eq(before, now);
}

/* The main program: runs these tests. */
static inline int run_tests(const TTest *const *tests, int count) {
    Suite *suite = suite_create("capi");
    TCase *all = tcase_create("capi");
    SRunner *runner = srunner_create(suite);
    int i, failed;
    tcase_add_checked_fixture(all, set_up, tear_down);
    for (i = 0; i < count; ++i) tcase_add_test(all, tests[i]);
    suite_add_tcase(suite, all);
    srunner_run_all(runner, CK_ENV);
    failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
#endif
