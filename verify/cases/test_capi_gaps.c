/* SPDX-License-Identifier: BSD-3-Clause
 * Gaps through the public header: bad input, what they refuse, and what the log hears. */
#include <math.h>

#include "capi_scene.h"

START_TEST(gaps) {
    const double times[2] = {0.0, 1.0};
    const double apart[3] = {1e-3, 0.0, -2e-3};
    const double broken[3] = {0.0, NAN, 0.0};
    const double strain[6] = {0};
    const double y[2] = {0.0, 1.0};
    const double one = 1.0;
    const int64_t top = 9;
    const int64_t first = 0;
    int64_t pattern = -1;
    int64_t other = -1;
    int64_t third = -1;
    fine(delam_problem_add_pattern(problem, "p", 2, times, times, &pattern));
    fine(delam_problem_add_pattern(problem, "q", 2, times, times, &other));
    fine(delam_problem_add_pattern(problem, "r", 2, times, times, &third));
    fine(delam_problem_prescribe_nodes(problem, 1, &top, y, 1, &other, &one, 0));
    remember();
    ck_assert_int_eq(delam_problem_set_gaps(NULL, 0, pattern, apart, 0.0), DELAM_ERROR_HANDLE);
    expect(delam_problem_set_gaps(problem, 1, pattern, apart, 0.0), DELAM_ERROR_ARGUMENT, "interface_index = 1");
    expect(delam_problem_set_gaps(problem, -1, pattern, apart, 0.0), DELAM_ERROR_ARGUMENT, "interface_index = -1");
    expect(delam_problem_set_gaps(problem, 0, 3, apart, 0.0), DELAM_ERROR_ARGUMENT, "pattern = 3 is outside 0 .. 2");
    expect(delam_problem_set_gaps(problem, 0, -1, NULL, 0.0), DELAM_ERROR_ARGUMENT, "pattern = -1");
    expect(delam_problem_set_gaps(problem, 0, pattern, broken, 0.0), DELAM_ERROR_ARGUMENT, "gaps[1] = nan");
    expect(delam_problem_set_gaps(problem, 0, pattern, apart, -1.0), DELAM_ERROR_ARGUMENT, "adjust = -1");
    expect(delam_problem_set_gaps(problem, 0, pattern, NULL, NAN), DELAM_ERROR_ARGUMENT, "adjust = nan");
    expect(delam_problem_set_gaps(problem, 0, pattern, NULL, INFINITY), DELAM_ERROR_ARGUMENT, "adjust = inf");
    expect(delam_problem_set_gaps(problem, 0, other, apart, 0.0), DELAM_ERROR_PROBLEM,
           "pattern 'q' drives prescribed displacements already and cannot also drive gaps");
    unchanged();
    fine(delam_problem_set_gaps(problem, 0, pattern, apart, 0.0));
    fine(delam_problem_add_eigenstrain(problem, third, -1, strain));
    expect(delam_problem_add_eigenstrain(problem, pattern, -1, strain), DELAM_ERROR_PROBLEM,
           "pattern 'p' drives gaps already and cannot also drive eigenstrains");
    expect(delam_problem_set_gaps(problem, 0, third, NULL, 0.0), DELAM_ERROR_PROBLEM,
           "pattern 'r' drives eigenstrains");

    /* Nothing joins faces that are apart. */
    fine(delam_problem_check(problem));
    fine(delam_problem_set_adhesion(problem, 0, 1, &first, &one, 0));
    expect(delam_problem_check(problem), DELAM_ERROR_PROBLEM,
           "interface 0: pair 0 has a gap of 0.001 and an adhesion of 1, must be 0");
    fine(delam_problem_set_gaps(problem, 0, pattern, apart, 2e-3));
    fine(delam_problem_check(problem));
    fine(delam_problem_set_gaps(problem, 0, pattern, apart, 1e-3));
    fine(delam_problem_set_contact(problem, 0));
    fine(delam_problem_set_bonded(problem, 0));
    expect(delam_problem_check(problem), DELAM_ERROR_PROBLEM,
           "interface 0 is bonded permanently, but pair 2 has a gap of -0.002, not 0");
    fine(delam_problem_set_gaps(problem, 0, pattern, NULL, 0.0));
    fine(delam_problem_check(problem));
}

START_TEST(gaps_of_the_mesh) {
    /* Two squares that overlap by a quarter, and an obstacle below the lower one. */
    const double nodes[18] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0.75, 1, 0.75, 1, 2, 0, 2, 5, 5};
    const int64_t cells[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const int32_t bodies[2] = {0, 1};
    const int64_t bottom[2] = {0, 1};
    const double up[4] = {0, 1, 0, 1};
    const double time = 0.0;
    const double factor = 1.0;
    int64_t index = -1;
    int64_t pattern = -1;
    delam_mesh *other = NULL;
    delam_problem *bare = NULL;
    fine(delam_mesh_create(context, 2, 9, nodes, &other));
    fine(delam_mesh_add_cells(other, DELAM_QUAD4, 2, cells, bodies, 0));
    fine(delam_mesh_add_mortar_interface(other, 0, 1, 0.5, &index));
    fine(delam_mesh_add_obstacle(other, 2, bottom, up, NULL, 8, 0, &index));
    fine(delam_problem_create(context, other, &bare));
    fine(delam_problem_add_pattern(bare, "fit", 1, &time, &factor, &pattern));
    expect(delam_problem_set_gaps(bare, 0, pattern, NULL, 0.0), DELAM_ERROR_MESH,
           "interface 0: its faces overlap by up to 0.25, at pair 0 at (0, 0.75)");
    expect(delam_problem_set_gaps(bare, 0, pattern, NULL, 0.125), DELAM_ERROR_MESH, "farther than adjust (0.125)");
    expect(delam_problem_set_gaps(bare, 1, pattern, NULL, 0.0), DELAM_ERROR_ARGUMENT,
           "gaps is NULL, but interface_index = 1 is an obstacle");
    fine(delam_problem_set_gaps(bare, 0, pattern, NULL, 0.25));
    fine(delam_problem_set_gaps(bare, 1, pattern, up, 0.0));
    delam_problem_destroy(&bare);
    delam_mesh_destroy(&other);
}

static void keep_line(int32_t level, const char *text, void *user) {
    if (level == 1) snprintf((char *)user, 200, "%s", text);
}

/* It hears of pairs that adhered before. */
START_TEST(log_hears_of_parted_faces) {
    const double apart[3] = {1e-3, 0.0, 2e-3};
    const double time = 0.0;
    const double factor = 1.0;
    int64_t pattern = -1;
    char line[200] = "";
    fine(delam_problem_add_pattern(problem, "p", 1, &time, &factor, &pattern));
    fine(delam_context_set_log(context, keep_line, line));
    fine(delam_problem_set_gaps(problem, 0, pattern, apart, 0.0));
    ck_assert_str_eq(line, "interface 0: 2 of 3 pairs have a gap at the start, of up to 0.002: they do not adhere");
    line[0] = '\0';
    fine(delam_problem_set_gaps(problem, 0, pattern, apart, 0.0));
    ck_assert_str_eq(line, "");
    fine(delam_context_set_log(context, NULL, NULL));
}

int main(void) {
    const TTest *const all[] = {gaps, gaps_of_the_mesh, log_hears_of_parted_faces};
    return run_tests(all, (int)(sizeof all / sizeof all[0]));
}
