/* SPDX-License-Identifier: BSD-3-Clause
 *
 * calls_c CALLS STEPS: prints nanoseconds of processor time of a call of delam_solver_value for a key that costs
 * nothing (time), and of a step (advance, commit) of a small analysis that damages nothing; behind them, not timed,
 * what ten more steps that do damage end with: reaction, energies and the adhesion of all pairs, in digits that give
 * every bit back, for all hosts alike.
 */
#define _POSIX_C_SOURCE 199309L
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "delam/delam.h"

static delam_context *context;

static void must(int32_t status) {
    if (status == DELAM_OK) return;
    fprintf(stderr, "calls: %s\n", delam_context_message(context));
    exit(1);
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static void prescribe(delam_problem *problem, int64_t node, double x, double y, int64_t patterns,
                      const int64_t *pattern) {
    const double direction[2] = {x, y};
    const double one = 1.0;
    must(delam_problem_prescribe_nodes(problem, 1, &node, direction, patterns, pattern, &one, 0));
}

static int64_t node_at(const delam_mesh *mesh, double x, double y) {
    const double place[2] = {x, y};
    int64_t node = -1, count = 0;
    must(delam_mesh_find_nodes(mesh, -1, place, place, 1, &node, &count));
    return node;
}

static delam_solver *make_solver(void) {
    const double lengths[1] = {0.1};
    const int64_t divisions[1] = {20};
    const double thickness[2] = {2e-3, 2e-3};
    const int64_t layer_divisions[2] = {1, 1};
    const double times[3] = {0.0, 1.0, 2.0}, values[3] = {0.0, 1e-6, 4e-3};
    delam_mesh *mesh;
    delam_law *law;
    delam_problem *problem;
    delam_solver *solver;
    int64_t glue, pull;
    must(delam_context_create(&context));
    must(delam_mesh_create_layers(context, 2, lengths, divisions, 2, thickness, layer_divisions, DELAM_QUAD4, &mesh));
    must(delam_mesh_add_interface(mesh, 0, 1, 0.0, &glue));
    must(delam_law_create(context, "piecewise-linear", &law));
    must(delam_law_set(law, "normal_stiffness", 1e12));
    must(delam_law_set(law, "tangential_stiffness", 1e12));
    must(delam_law_set(law, "normal_onset", 50.0));
    must(delam_law_set(law, "tangential_onset", 50.0));
    must(delam_law_set(law, "normal_toughness", 250.0));
    must(delam_law_set(law, "tangential_toughness", 250.0));
    must(delam_problem_create(context, mesh, &problem));
    must(delam_problem_set_elastic(problem, -1, 70e9, 0.3));
    must(delam_problem_set_law(problem, glue, law));
    must(delam_problem_add_pattern(problem, "pull", 3, times, values, &pull));
    prescribe(problem, node_at(mesh, 0.0, 0.0), 1.0, 0.0, 0, NULL);
    prescribe(problem, node_at(mesh, 0.0, 0.0), 0.0, 1.0, 0, NULL);
    prescribe(problem, node_at(mesh, 0.1, 0.0), 0.0, 1.0, 0, NULL);
    prescribe(problem, node_at(mesh, 0.05, 4e-3), 0.0, -1.0, 1, &pull);
    must(delam_solver_create(problem, 0.0, &solver));
    delam_problem_destroy(&problem);
    delam_law_destroy(&law);
    delam_mesh_destroy(&mesh);
    return solver;
}

static void print_state(delam_solver *solver) {
    static const char *const keys[5] = {"reaction:pull", "stored_bulk", "stored_interface", "dissipated", "work"};
    double adhesion[64], value;
    int64_t rows = 0, columns = 0, i;
    for (i = 0; i < 5; ++i) {
        must(delam_solver_value(solver, keys[i], &value));
        printf(" %.17g", value);
    }
    must(delam_solver_field_shape(solver, "adhesion", -1, &rows, &columns));
    must(delam_solver_field(solver, "adhesion", -1, 64, adhesion));
    for (i = 0; i < rows * columns; ++i) printf(" %.17g", adhesion[i]);
    printf("\n");
}

int main(int argc, char **argv) {
    const int calls = argc > 2 ? atoi(argv[1]) : 1;
    const int steps = argc > 2 ? atoi(argv[2]) : 1;
    delam_solver *solver = make_solver();
    double value = 0.0, sum = 0.0, begin, per_call, per_step;
    int i;
    begin = now();
    for (i = 0; i < calls; ++i) {
        must(delam_solver_value(solver, "time", &value));
        sum += value;
    }
    per_call = (now() - begin) / calls;
    begin = now();
    for (i = 1; i <= steps; ++i) {
        must(delam_solver_advance(solver, (double)i / steps));
        must(delam_solver_commit(solver));
    }
    per_step = (now() - begin) / steps;
    printf("%.6g %.6g %.17g", per_call, per_step, sum);
    for (i = 1; i <= 10; ++i) {
        must(delam_solver_advance(solver, 1.0 + i / 10.0));
        must(delam_solver_commit(solver));
    }
    print_state(solver);
    delam_solver_destroy(&solver);
    delam_context_destroy(&context);
    return 0;
}
