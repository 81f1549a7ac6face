/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A host that was compiled with the baseline's header and runs with today's library. Two blocks of 1 m are moved apart,
 * all nodes prescribed, so that the interface alone answers: the bilinear law in mode I in closed form, up and down
 * again, with a step that is rolled back, a log, a state saved and loaded, values and fields read.
 */
#include <delam/delam.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static delam_context *context;
static int failures;

static void fine(int32_t status, const char *what) {
    if (status != DELAM_OK) {
        printf("%s: %s: %s\n", what, delam_status_name(status), delam_context_message(context));
        exit(1);
    }
}
#define FINE(call) fine(call, #call)

static void near_to(double value, double expected, double scale, const char *what, int step) {
    if (!(fabs(value - expected) <= 1e-12 * scale)) {
        printf("step %d: %s = %.17g, expected %.17g\n", step, what, value, expected);
        ++failures;
    }
}

static void expect(int condition, const char *what) {
    if (!condition) {
        printf("%s\n", what);
        ++failures;
    }
}

static const double stiffness = 125e9, onset = 100.0, toughness = 250.0; /* N/m3, J/m2, J/m2 */

static void log_line(int32_t level, const char *text, void *user) {
    (void)text;
    if (level == 0) ++*(int *)user;
}

static void hold(delam_problem *problem, const delam_mesh *mesh, int32_t body, int64_t pattern_count, int64_t pattern) {
    static const double box[2][2] = {{0.0, 0.0}, {1.0, 2.0}};
    static const double x[2] = {1.0, 0.0}, y[2] = {0.0, 1.0};
    static const double one[16] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    int64_t nodes[16], count = 0;
    FINE(delam_mesh_find_nodes(mesh, body, box[0], box[1], 16, nodes, &count));
    expect(count == 4, "a block has four nodes");
    FINE(delam_problem_prescribe_nodes(problem, count, nodes, x, 0, NULL, NULL, 0));
    FINE(delam_problem_prescribe_nodes(problem, count, nodes, y, pattern_count, &pattern, one, 0));
}

int main(void) {
    static const char *const keys[] = {"normal_stiffness", "tangential_stiffness", "normal_onset",
                                       "tangential_onset", "normal_toughness",     "tangential_toughness"};
    const double values[] = {stiffness, stiffness, onset, onset, toughness, toughness};
    const double first = sqrt(2.0 * onset / stiffness); /* jump at the onset, m */
    const double last = first * toughness / onset;      /* where nothing adheres any more */
    const double peak = stiffness * first;
    const double length = 1.0, thickness[2] = {1.0, 1.0};
    const int64_t one = 1, layer_cells[2] = {1, 1};
    double times[3] = {0.0, 1.0, 2.0}, openings[3];
    double largest = 0.0, number = 0.0, jumps[4], held[2];
    int64_t index = -1, pattern = -1, pairs = 0, rows = 0, columns = 0, needed = 0;
    int errors = 0, step;
    uint8_t *bytes;
    delam_mesh *mesh = NULL;
    delam_law *law = NULL;
    delam_problem *problem = NULL;
    delam_solver *solver = NULL;

    expect(delam_abi() == DELAM_ABI, "the library has another DELAM_ABI than the header this host was compiled with");
    FINE(delam_context_create(&context));
    FINE(delam_context_set_log(context, log_line, &errors));
    FINE(delam_mesh_create_layers(context, 2, &length, &one, 2, thickness, layer_cells, DELAM_QUAD4, &mesh));
    FINE(delam_mesh_add_interface(mesh, 0, 1, 0.0, &index));
    FINE(delam_mesh_interface_size(mesh, index, NULL, NULL, &pairs, NULL, NULL));
    expect(index == 0 && pairs == 2, "one interface of two pairs");
    FINE(delam_law_create(context, "piecewise-linear", &law));
    for (step = 0; step < 6; ++step) FINE(delam_law_set(law, keys[step], values[step]));
    FINE(delam_problem_create(context, mesh, &problem));
    FINE(delam_problem_set_elastic(problem, -1, 1e9, 0.2));
    FINE(delam_problem_set_law(problem, index, law));
    openings[0] = 0.0;
    openings[1] = 0.75 * last;
    openings[2] = 0.25 * last;
    FINE(delam_problem_add_pattern(problem, "open", 3, times, openings, &pattern));
    hold(problem, mesh, 0, 0, 0);
    hold(problem, mesh, 1, 1, pattern);
    FINE(delam_problem_check(problem));
    FINE(delam_solver_create(problem, 0.0, &solver));
    delam_law_destroy(&law);
    delam_mesh_destroy(&mesh);
    expect(law == NULL && mesh == NULL, "destroy sets the handle to NULL");

    for (step = 1; step <= 16; ++step) {
        const double time = step / 8.0;
        const double opening =
            time <= 1.0 ? time * openings[1] : openings[1] + (time - 1.0) * (openings[2] - openings[1]);
        double zeta = 1.0;
        if (opening > largest) largest = opening;
        if (largest > first) zeta = first * (last - largest) / (largest * (last - first));
        FINE(delam_solver_advance(solver, time));
        if (step == 5) {
            expect(delam_solver_advance(solver, time + 0.1) == DELAM_ERROR_STATE, "a pending step comes first");
            expect(errors == 1 && strlen(delam_context_message(context)) > 0, "an error is logged and told");
            FINE(delam_solver_rollback(solver));
            FINE(delam_solver_advance(solver, time));
        }
        FINE(delam_solver_commit(solver));
        FINE(delam_solver_value(solver, "reaction:open", &number));
        near_to(number, zeta * stiffness * opening, peak, "reaction", step);
        FINE(delam_solver_value(solver, "stored_interface", &number));
        near_to(number, 0.5 * zeta * stiffness * opening * opening, toughness, "stored energy", step);
        FINE(delam_solver_value(solver, "dissipated", &number));
        near_to(number, toughness * onset * (1.0 - zeta) / (onset + (toughness - onset) * zeta), toughness,
                "dissipated energy", step);
        FINE(delam_solver_field_shape(solver, "jump", 0, &rows, &columns));
        expect(rows == 2 && columns == 2, "jumps are [pairs][dimension]");
        FINE(delam_solver_field(solver, "jump", 0, 4, jumps));
        near_to(jumps[0], opening, last, "normal jump", step);
        FINE(delam_solver_field(solver, "adhesion", 0, 2, held));
        near_to(held[1], zeta, 1.0, "adhesion", step);
    }
    FINE(delam_solver_save(solver, 0, NULL, &needed));
    bytes = malloc((size_t)needed);
    FINE(delam_solver_save(solver, needed, bytes, &needed));
    FINE(delam_solver_load(solver, needed, bytes));
    bytes[needed / 2] ^= 1u;
    expect(delam_solver_load(solver, needed, bytes) == DELAM_ERROR_SNAPSHOT, "a flipped bit is refused");
    free(bytes);
    delam_context_destroy(&context);
    delam_solver_destroy(&solver);
    delam_problem_destroy(&problem);
    expect(context == NULL && solver == NULL && problem == NULL, "objects go in any order");
    printf("%s, ABI %d: %d failures\n", delam_version(), (int)delam_abi(), failures);
    return failures == 0 ? 0 : 1;
}
