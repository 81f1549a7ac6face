/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A double cantilever beam in space whose interface obeys a law of the host's own, from C.
 *
 *     dcb_host_law [history.csv]        without an argument the history goes to standard output
 *
 * Two arms of 60 mm x 8 mm x 1.5 mm, bonded but for a notch of 20 mm at the left end, held at the right end and pulled
 * apart to 1.6 mm at the left one, in 16 steps. The law is the bilinear one by two functions of this program: traction
 * falls on a straight line, onset and toughness are the same in every mode. SI units.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "delam/delam.h"

static const double length = 60e-3;  /* m */
static const double width = 8e-3;    /* m */
static const double height = 1.5e-3; /* of an arm, m */
static const double notch = 20e-3;   /* m */
static const int steps = 16;

typedef struct {
    double onset;     /* energy at which the traction begins to fall, J/m2 */
    double toughness; /* J/m2 */
} bilinear;

/* The minimiser of adhesion * driving + dissipated, and its slope by the driving energy. */
static int32_t on_adhesion(double mixity, double driving, double *adhesion, double *slope, void *user) {
    const bilinear *law = user;
    const double r = law->toughness / law->onset;
    (void)mixity;
    *adhesion = 1.0;
    *slope = 0.0;
    if (driving >= law->onset * r * r) {
        *adhesion = 0.0;
    } else if (driving > law->onset) {
        const double root = sqrt(law->onset / driving);
        *adhesion = (r * root - 1.0) / (r - 1.0);
        *slope = -0.5 * r / (r - 1.0) * root / driving;
    }
    return 0;
}

/* The energy spent down to an adhesion, and its slopes by adhesion and mixity. */
static int32_t on_dissipation(double mixity, double adhesion, double *dissipated, double *slope, double *mixity_slope,
                              void *user) {
    const bilinear *law = user;
    const double r = law->toughness / law->onset;
    const double below = 1.0 + adhesion * (r - 1.0);
    (void)mixity;
    *dissipated = law->toughness - law->onset * r * r * adhesion / below;
    *slope = -law->onset * (r / below) * (r / below);
    *mixity_slope = 0.0;
    return 0;
}

typedef struct {
    delam_context *context;
    delam_mesh *mesh;
    delam_law *law;
    delam_problem *problem;
    delam_solver *solver;
    bilinear numbers; /* must outlive whatever takes the law */
    FILE *file;
} scene;

/* Each call of the library goes through here: on failure tell what the context says, and leave. */
#define TRY(call)                                                                                                     \
    do {                                                                                                              \
        const int32_t status_ = (call);                                                                               \
        if (status_ != DELAM_OK) {                                                                                    \
            fprintf(stderr, "dcb_host_law: %s: %s\n", delam_status_name(status_), delam_context_message(s->context)); \
            return 1;                                                                                                 \
        }                                                                                                             \
    } while (0)

static int make_mesh(scene *s) {
    const double lengths[2] = {length, width};
    const int64_t divisions[2] = {60, 4};
    const double thickness[2] = {height, height};
    const int64_t layer_divisions[2] = {2, 2};
    int64_t interface_index = 0;
    TRY(delam_mesh_create_layers(s->context, 3, lengths, divisions, 2, thickness, layer_divisions, DELAM_HEX8,
                                 &s->mesh));
    TRY(delam_mesh_add_interface(s->mesh, 0, 1, 0.0, &interface_index));
    return 0;
}

static int make_law(scene *s) {
    s->numbers.onset = 5.0;
    s->numbers.toughness = 250.0;
    TRY(delam_law_create_host(s->context, "bilinear by hand", on_adhesion, on_dissipation, &s->numbers, &s->law));
    TRY(delam_law_set(s->law, "normal_stiffness", 1e13));
    TRY(delam_law_set(s->law, "tangential_stiffness", 1e13));
    return 0;
}

/* The notch has no adhesion from the start; the pairs at its tip, on the side of the box, are bonded. */
static int make_notch(scene *s) {
    const double lower[3] = {0.0, 0.0, 0.0};
    const double upper[3] = {notch, width, 2.0 * height};
    TRY(delam_problem_set_adhesion_box(s->problem, 0, lower, upper, 0.0, NULL));
    return 0;
}

/* Prescribes one direction of all nodes in a box: held, or driven by `coefficient` times the pattern. */
static int prescribe(scene *s, const double *lower, const double *upper, const double *direction,
                     const int64_t *pattern, double coefficient) {
    int64_t nodes[64];
    double coefficients[64];
    int64_t count = 0;
    int64_t i;
    TRY(delam_mesh_find_nodes(s->mesh, -1, lower, upper, 64, nodes, &count));
    if (count < 1 || count > 64) {
        fprintf(stderr, "dcb_host_law: %ld nodes at a support or load, expected 1 to 64\n", (long)count);
        return 1;
    }
    for (i = 0; i < count; ++i) coefficients[i] = coefficient;
    TRY(delam_problem_prescribe_nodes(s->problem, count, nodes, direction, pattern == NULL ? 0 : 1, pattern,
                                      coefficients, 0));
    return 0;
}

static int make_loads(scene *s) {
    const double times[2] = {0.0, 1.0};
    const double values[2] = {0.0, 1.6e-3};
    const double axes[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const double down[3] = {0.0, 0.0, -1.0};
    const double right_lower[3] = {length, 0.0, 0.0};
    const double right_upper[3] = {length, width, 2.0 * height};
    const double bottom_lower[3] = {0.0, 0.0, 0.0};
    const double bottom_upper[3] = {0.0, width, 0.0};
    const double top_lower[3] = {0.0, 0.0, 2.0 * height};
    const double top_upper[3] = {0.0, width, 2.0 * height};
    int64_t opening = 0;
    int i;
    TRY(delam_problem_add_pattern(s->problem, "opening", 2, times, values, &opening));
    for (i = 0; i < 3; ++i) {
        if (prescribe(s, right_lower, right_upper, axes[i], NULL, 0.0) != 0) return 1;
    }
    if (prescribe(s, top_lower, top_upper, axes[2], &opening, 0.5) != 0) return 1;
    return prescribe(s, bottom_lower, bottom_upper, down, &opening, 0.5);
}

static int make_problem(scene *s) {
    TRY(delam_problem_create(s->context, s->mesh, &s->problem));
    TRY(delam_problem_set_elastic(s->problem, -1, 120e9, 0.3));
    TRY(delam_problem_set_formulation(s->problem, -1, "incompatible"));
    TRY(delam_problem_set_law(s->problem, 0, s->law));
    if (make_notch(s) != 0 || make_loads(s) != 0) return 1;
    TRY(delam_problem_check(s->problem));
    return 0;
}

/* Columns of the history, and the library's name for each. */
static const char *const columns[][2] = {
    {"step", "step"},
    {"time", "time"},
    {"load", "load:opening"},
    {"reaction", "reaction:opening"},
    {"stored_bulk", "stored_bulk"},
    {"stored_interface", "stored_interface"},
    {"dissipated", "dissipated"},
    {"work", "work"},
    {"front", "front"},
};

static int write_row(scene *s) {
    size_t i;
    for (i = 0; i < sizeof columns / sizeof columns[0]; ++i) {
        double value = 0.0;
        TRY(delam_solver_value(s->solver, columns[i][1], &value));
        fprintf(s->file, "%s%.17g", i == 0 ? "" : ",", value + 0.0); /* no "-0" */
    }
    fputc('\n', s->file);
    return 0;
}

static int march(scene *s) {
    size_t i;
    int step;
    TRY(delam_solver_create(s->problem, 0.0, &s->solver));
    for (i = 0; i < sizeof columns / sizeof columns[0]; ++i) fprintf(s->file, "%s%s", i == 0 ? "" : ",", columns[i][0]);
    fputc('\n', s->file);
    if (write_row(s) != 0) return 1;
    for (step = 1; step <= steps; ++step) {
        TRY(delam_solver_advance(s->solver, (double)step / steps));
        TRY(delam_solver_commit(s->solver));
        if (write_row(s) != 0) return 1;
    }
    return 0;
}

static int run(scene *s) {
    TRY(delam_context_create(&s->context));
    if (make_mesh(s) != 0 || make_law(s) != 0 || make_problem(s) != 0) return 1;
    return march(s);
}

int main(int argc, char **argv) {
    scene s = {NULL, NULL, NULL, NULL, NULL, {0.0, 0.0}, NULL};
    int status;
    s.file = argc > 1 ? fopen(argv[1], "w") : stdout;
    if (s.file == NULL) {
        perror(argv[1]);
        return 1;
    }
    status = run(&s);
    if (ferror(s.file) != 0) status = 1;
    if (fclose(s.file) != 0) status = 1;
    if (status != 0) fprintf(stderr, "dcb_host_law: the history is incomplete\n");
    delam_solver_destroy(&s.solver);
    delam_problem_destroy(&s.problem);
    delam_law_destroy(&s.law);
    delam_mesh_destroy(&s.mesh);
    delam_context_destroy(&s.context);
    return status;
}
