/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The end-notched flexure test with a ductile interface (Zeman, Kruzik, Gruber, PANM 15, 2010), from C.
 *
 *     enf [history.csv]        without an argument the history goes to standard output
 *
 * Two arms of 120 mm x 3 mm lie on each other, bonded by an interface but for a notch of 30 mm at the left end. The
 * bottom corners are held, the top of mid-span is pressed down to 6 mm in 40 steps. SI units, per metre of width.
 */
#include <stdint.h>
#include <stdio.h>

#include "delam/delam.h"

static const double length = 120e-3; /* span, m */
static const double height = 3e-3;   /* of an arm, m */
static const double notch = 30e-3;   /* m */
static const int steps = 40;

typedef struct {
    delam_context *context;
    delam_mesh *mesh;
    delam_law *law;
    delam_problem *problem;
    delam_solver *solver;
    FILE *file;
} scene;

/* Each call of the library goes through here: on failure tell what the context says, and leave. */
#define TRY(call)                                                                                            \
    do {                                                                                                     \
        const int32_t status_ = (call);                                                                      \
        if (status_ != DELAM_OK) {                                                                           \
            fprintf(stderr, "enf: %s: %s\n", delam_status_name(status_), delam_context_message(s->context)); \
            return 1;                                                                                        \
        }                                                                                                    \
    } while (0)

/* What the library warns of (level 1) reaches the log alone. TRY tells errors. */
static void tell(int32_t level, const char *text, void *user) {
    (void)user;
    if (level == 1) fprintf(stderr, "enf: %s\n", text);
}

static int make_mesh(scene *s) {
    const double lengths[1] = {length};
    const int64_t divisions[1] = {240};
    const double thickness[2] = {height, height};
    const int64_t layer_divisions[2] = {6, 6};
    int64_t interface_index = 0;
    TRY(delam_mesh_create_layers(s->context, 2, lengths, divisions, 2, thickness, layer_divisions, DELAM_QUAD4,
                                 &s->mesh));
    TRY(delam_mesh_add_interface(s->mesh, 0, 1, 0.0, &interface_index));
    return 0;
}

static int make_law(scene *s) {
    TRY(delam_law_create(s->context, "piecewise-linear", &s->law));
    TRY(delam_law_set(s->law, "normal_stiffness", 125e9));
    TRY(delam_law_set(s->law, "tangential_stiffness", 125e9));
    TRY(delam_law_set(s->law, "normal_onset", 100.0));
    TRY(delam_law_set(s->law, "tangential_onset", 100.0));
    TRY(delam_law_set(s->law, "normal_toughness", 250.0));
    TRY(delam_law_set(s->law, "tangential_toughness", 250.0));
    TRY(delam_law_set(s->law, "onset_exponent_1", 2.0));
    TRY(delam_law_set(s->law, "onset_exponent_2", 2.0));
    TRY(delam_law_set(s->law, "toughness_exponent_1", 2.0));
    TRY(delam_law_set(s->law, "toughness_exponent_2", 2.0));
    return 0;
}

/* The notch has no adhesion from the start; the pair at its tip, on the side of the box, is bonded. */
static int make_notch(scene *s) {
    const double lower[2] = {0.0, 0.0};
    const double upper[2] = {notch, 2.0 * height};
    TRY(delam_problem_set_adhesion_box(s->problem, 0, lower, upper, 0.0, NULL));
    return 0;
}

/* The one node of a body at a place. */
static int find_node(scene *s, int32_t body, double x, double y, int64_t *node) {
    const double place[2] = {x, y};
    int64_t count = 0;
    TRY(delam_mesh_find_nodes(s->mesh, body, place, place, 1, node, &count));
    if (count != 1) {
        fprintf(stderr, "enf: %ld nodes of body %d at (%g, %g), expected 1\n", (long)count, (int)body, x, y);
        return 1;
    }
    return 0;
}

static int make_loads(scene *s) {
    const double times[2] = {0.0, 2.0};
    const double values[2] = {0.0, 6e-3};
    const double along_x[2] = {1.0, 0.0};
    const double along_y[2] = {0.0, 1.0};
    const double down[2] = {0.0, -1.0};
    const double one = 1.0;
    int64_t pattern = 0;
    int64_t corners[2] = {0, 0}; /* left, right */
    int64_t top = 0;
    if (find_node(s, 0, 0.0, 0.0, &corners[0]) != 0 || find_node(s, 0, length, 0.0, &corners[1]) != 0 ||
        find_node(s, 1, 0.5 * length, 2.0 * height, &top) != 0) {
        return 1;
    }
    TRY(delam_problem_add_pattern(s->problem, "load", 2, times, values, &pattern));
    TRY(delam_problem_prescribe_nodes(s->problem, 1, &corners[0], along_y, 0, NULL, NULL, 0));
    TRY(delam_problem_prescribe_nodes(s->problem, 1, &corners[1], along_x, 0, NULL, NULL, 0));
    TRY(delam_problem_prescribe_nodes(s->problem, 1, &corners[1], along_y, 0, NULL, NULL, 0));
    TRY(delam_problem_prescribe_nodes(s->problem, 1, &top, down, 1, &pattern, &one, 0));
    return 0;
}

static int make_problem(scene *s) {
    TRY(delam_problem_create(s->context, s->mesh, &s->problem));
    TRY(delam_problem_set_plane(s->problem, "plane-strain"));
    TRY(delam_problem_set_elastic(s->problem, -1, 75e9, 0.3));
    TRY(delam_problem_set_law(s->problem, 0, s->law));
    if (make_notch(s) != 0 || make_loads(s) != 0) return 1;
    TRY(delam_problem_check(s->problem));
    return 0;
}

/* Columns of the history, and the library's name for each. */
static const char *const columns[][2] = {
    {"step", "step"},
    {"time", "time"},
    {"load", "load:load"},
    {"reaction", "reaction:load"},
    {"stored_bulk", "stored_bulk"},
    {"stored_interface", "stored_interface"},
    {"dissipated", "dissipated"},
    {"stored_interface_slides", "stored_interface_linear"},
    {"dissipated_slides", "dissipated_linear"},
    {"work", "work"},
    {"lower", "lower"},
    {"increment", "increment"},
    {"upper", "upper"},
    {"increment_lower", "increment_lower"},
    {"am_iterations", "am_iterations"},
    {"linear_iterations", "linear_iterations"},
    {"contact_pairs", "contact_pairs"},
    {"debonded_length", "debonded_length"},
    {"backtracks", "backtracks"},
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
        TRY(delam_solver_advance(s->solver, 2.0 * step / steps));
        TRY(delam_solver_commit(s->solver));
        if (write_row(s) != 0) return 1;
    }
    return 0;
}

static int run(scene *s) {
    TRY(delam_context_create(&s->context));
    TRY(delam_context_set_log(s->context, tell, NULL));
    if (make_mesh(s) != 0 || make_law(s) != 0 || make_problem(s) != 0) return 1;
    return march(s);
}

int main(int argc, char **argv) {
    scene s = {NULL, NULL, NULL, NULL, NULL, NULL};
    int status;
    s.file = argc > 1 ? fopen(argv[1], "w") : stdout;
    if (s.file == NULL) {
        perror(argv[1]);
        return 1;
    }
    status = run(&s);
    if (ferror(s.file) != 0) status = 1;
    if (fclose(s.file) != 0) status = 1;
    if (status != 0) fprintf(stderr, "enf: the history is incomplete\n");
    delam_solver_destroy(&s.solver);
    delam_problem_destroy(&s.problem);
    delam_law_destroy(&s.law);
    delam_mesh_destroy(&s.mesh);
    delam_context_destroy(&s.context);
    return status;
}
