/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A host in space with a law of its own: a double cantilever beam opened, shut by half and opened further.
 *
 *     space                  prints all steps as csv
 *     space save STATE       prints the first half and saves the state with delam_solver_save_file
 *     space load STATE       loads it with delam_solver_load_file and prints the second half
 */
#include <delam/delam.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { steps = 12, half = 5, most_nodes = 64 };

static const double length = 0.0625, width = 0.015625, height = 0.00390625, notch = 0.03125; /* m */

static delam_context *context;
static delam_mesh *mesh;
static delam_law *law;
static delam_problem *problem;
static delam_solver *solver;

static void fine(int32_t status, const char *call) {
    if (status == DELAM_OK) return;
    fprintf(stderr, "space: %s: %s: %s\n", call, delam_status_name(status), delam_context_message(context));
    exit(1);
}
#define FINE(call) fine(call, #call)

typedef struct {
    double onset, toughness; /* J/m2 */
} bilinear;

static bilinear numbers = {12.5, 170.0};

/* The traction falls on a straight line, in every mode alike. */
static int32_t on_adhesion(double mixity, double driving, double *adhesion, double *slope, void *user) {
    const bilinear *own = user;
    const double r = own->toughness / own->onset;
    (void)mixity;
    *adhesion = 1.0;
    *slope = 0.0;
    if (driving >= own->onset * r * r) {
        *adhesion = 0.0;
    } else if (driving > own->onset) {
        const double root = sqrt(own->onset / driving);
        *adhesion = (r * root - 1.0) / (r - 1.0);
        *slope = -0.5 * r / (r - 1.0) * root / driving;
    }
    return 0;
}

static int32_t on_dissipation(double mixity, double adhesion, double *dissipated, double *slope, double *mixity_slope,
                              void *user) {
    const bilinear *own = user;
    const double r = own->toughness / own->onset, below = 1.0 + adhesion * (r - 1.0);
    (void)mixity;
    *dissipated = own->toughness - own->onset * r * r * adhesion / below;
    *slope = -own->onset * (r / below) * (r / below);
    *mixity_slope = 0.0;
    return 0;
}

static void make_mesh(void) {
    const double lengths[2] = {length, width}, thickness[2] = {height, height};
    const int64_t cells[2] = {32, 2}, layers[2] = {1, 1};
    int64_t index = -1;
    FINE(delam_mesh_create_layers(context, 3, lengths, cells, 2, thickness, layers, DELAM_HEX8, &mesh));
    FINE(delam_mesh_add_interface(mesh, 0, 1, 0.0, &index));
}

static void prescribe(double x, double z_lower, double z_upper, int axis, const int64_t *pattern, double coefficient) {
    const double lower[3] = {x, 0.0, z_lower}, upper[3] = {x, width, z_upper};
    double direction[3] = {0.0, 0.0, 0.0}, coefficients[most_nodes];
    int64_t nodes[most_nodes], count = 0, i;
    FINE(delam_mesh_find_nodes(mesh, -1, lower, upper, most_nodes, nodes, &count));
    for (i = 0; i < count; ++i) coefficients[i] = coefficient;
    direction[axis] = 1.0;
    FINE(delam_problem_prescribe_nodes(problem, count, nodes, direction, pattern == NULL ? 0 : 1, pattern, coefficients,
                                       0));
}

static void make_problem(void) {
    static const double times[4] = {0.0, 0.5, 0.75, 1.0}, values[4] = {0.0, 0.002, 0.001, 0.004};
    const double lower[3] = {0.0, 0.0, 0.0}, upper[3] = {notch, width, 2.0 * height};
    int64_t open = -1;
    int axis;
    FINE(delam_law_create_host(context, "bilinear by hand", on_adhesion, on_dissipation, &numbers, &law));
    FINE(delam_law_set(law, "normal_stiffness", 1e12));
    FINE(delam_law_set(law, "tangential_stiffness", 1e12));
    FINE(delam_problem_create(context, mesh, &problem));
    FINE(delam_problem_set_elastic(problem, -1, 120e9, 0.3));
    FINE(delam_problem_set_formulation(problem, -1, "incompatible"));
    FINE(delam_problem_set_law(problem, 0, law));
    FINE(delam_problem_set_adhesion_box(problem, 0, lower, upper, 0.0, NULL));
    FINE(delam_problem_add_pattern(problem, "open", 4, times, values, &open));
    for (axis = 0; axis < 3; ++axis) prescribe(length, 0.0, 2.0 * height, axis, NULL, 0.0);
    prescribe(0.0, 2.0 * height, 2.0 * height, 2, &open, 0.5);
    prescribe(0.0, 0.0, 0.0, 2, &open, -0.5);
    FINE(delam_problem_check(problem));
}

static const char *const keys[] = {
    "step",       "time", "load:open",       "reaction:open", "stored_bulk", "stored_interface",
    "dissipated", "work", "debonded_length", "crack_length",  "released"};
enum { key_count = sizeof keys / sizeof keys[0] };

static void print_titles(void) {
    int i;
    for (i = 0; i < key_count; ++i) printf("%s%s", keys[i], i + 1 < key_count ? "," : "\n");
}

static void print_row(void) {
    double number = 0.0;
    int i;
    for (i = 0; i < key_count; ++i) {
        FINE(delam_solver_value(solver, keys[i], &number));
        printf("%.17g%s", number, i + 1 < key_count ? "," : "\n");
    }
}

static void march(int from, int to) {
    int step;
    for (step = from; step <= to; ++step) {
        FINE(delam_solver_advance(solver, (double)step / steps));
        FINE(delam_solver_commit(solver));
        print_row();
    }
}

int main(int argc, char **argv) {
    const char *word = argc == 3 ? argv[1] : "";
    if (delam_abi() != DELAM_ABI) {
        fprintf(stderr, "space: DELAM_ABI is %d in the header, %d in the library\n", DELAM_ABI, (int)delam_abi());
        return 1;
    }
    FINE(delam_context_create(&context));
    make_mesh();
    make_problem();
    FINE(delam_solver_create(problem, 0.0, &solver));
    print_titles();
    if (strcmp(word, "load") == 0) {
        FINE(delam_solver_load_file(solver, argv[2]));
    } else {
        print_row();
        march(1, half);
    }
    if (strcmp(word, "save") == 0)
        FINE(delam_solver_save_file(solver, argv[2]));
    else
        march(half + 1, steps);
    delam_solver_destroy(&solver);
    delam_problem_destroy(&problem);
    delam_law_destroy(&law);
    delam_mesh_destroy(&mesh);
    delam_context_destroy(&context);
    return 0;
}
