/* SPDX-License-Identifier: BSD-3-Clause
 * A library in front of the real one in which one thing means something else: planted_break names it
 * (../test_planted_meanings.py). The words that the library returns about itself stay as they are.
 */
#define _GNU_SOURCE
#include <delam/delam.h>

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern const char *planted_break;
const char *planted_break = NULL;

#define BEHIND(name) __typeof__(&name) behind = (__typeof__(&name))dlsym(RTLD_NEXT, #name)

static int planted(const char *name) { return planted_break != NULL && strcmp(planted_break, name) == 0; }

static void exchange(double *numbers, int64_t i, int64_t j) {
    const double one = numbers[i];
    numbers[i] = numbers[j];
    numbers[j] = one;
}

static void exchange_whole(int64_t *numbers, int64_t i, int64_t j) {
    const int64_t one = numbers[i];
    numbers[i] = numbers[j];
    numbers[j] = one;
}

static double *copy_of(const double *numbers, int64_t count) {
    double *copy = malloc(sizeof(double) * (size_t)(count > 0 ? count : 1));
    if (numbers != NULL && count > 0) memcpy(copy, numbers, sizeof(double) * (size_t)count);
    return copy;
}

/* [rows][columns] as [columns][rows], in place. */
static void transpose(double *numbers, int64_t rows, int64_t columns) {
    double *copy = copy_of(numbers, rows * columns);
    for (int64_t i = 0; i < rows; ++i)
        for (int64_t j = 0; j < columns; ++j) numbers[j * rows + i] = copy[i * columns + j];
    free(copy);
}

static void reverse(double *numbers, int64_t count) {
    for (int64_t i = 0; i < count / 2; ++i) exchange(numbers, i, count - 1 - i);
}

static int32_t dimension_of(const delam_solver *solver) {
    __typeof__(&delam_solver_field_shape) shape =
        (__typeof__(&delam_solver_field_shape))dlsym(RTLD_NEXT, "delam_solver_field_shape");
    int64_t rows = 0, columns = 0;
    shape(solver, "displacement", -1, &rows, &columns);
    return (int32_t)columns;
}

/* ---- contexts ---- */
static delam_log_callback own_log;

static void turned_log(int32_t level, const char *text, void *user) { own_log(2 - level, text, user); }

int32_t delam_context_set_log(delam_context *context, delam_log_callback callback, void *user) {
    BEHIND(delam_context_set_log);
    own_log = callback;
    return behind(context, planted("levels of the log upside down") && callback != NULL ? turned_log : callback, user);
}

static int32_t go_on(const char *stage, int64_t done, int64_t total, void *user) {
    (void)stage, (void)done, (void)total, (void)user;
    return 0;
}

int32_t delam_context_set_progress(delam_context *context, delam_progress_callback callback, void *user) {
    BEHIND(delam_context_set_progress);
    return behind(context, planted("progress that stops nothing") && callback != NULL ? go_on : callback, user);
}

/* ---- meshes ---- */
int32_t delam_mesh_create_layers(delam_context *context, int32_t dimension, const double *lengths,
                                 const int64_t *divisions, int64_t layer_count, const double *thickness,
                                 const int64_t *layer_divisions, int32_t cell_type, delam_mesh **out) {
    BEHIND(delam_mesh_create_layers);
    double *own = copy_of(thickness, layer_count);
    if (planted("layers from the top")) reverse(own, layer_count);
    const int32_t status =
        behind(context, dimension, lengths, divisions, layer_count, own, layer_divisions, cell_type, out);
    free(own);
    return status;
}

int32_t delam_mesh_add_cells(delam_mesh *mesh, int32_t cell_type, int64_t cell_count, const int64_t *connectivity,
                             const int32_t *bodies, int32_t index_base) {
    BEHIND(delam_mesh_add_cells);
    int64_t own[20];
    if (planted("tet10 as Gmsh") && cell_type == DELAM_TET10 && cell_count == 1) {
        memcpy(own, connectivity, sizeof(int64_t) * 10);
        exchange_whole(own, 8, 9);
        connectivity = own;
    }
    if (planted("hex20 with upright edges first") && cell_type == DELAM_HEX20 && cell_count == 1) {
        memcpy(own, connectivity, sizeof(int64_t) * 20);
        for (int k = 0; k < 4; ++k) exchange_whole(own, 12 + k, 16 + k);
        connectivity = own;
    }
    if (planted("quad8 from the left edge") && cell_type == DELAM_QUAD8 && cell_count == 1) {
        memcpy(own, connectivity, sizeof(int64_t) * 8);
        for (int k = 7; k > 4; --k) exchange_whole(own, k, k - 1);
        connectivity = own;
    }
    return behind(mesh, cell_type, cell_count, connectivity, bodies, index_base);
}

int32_t delam_mesh_add_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double tolerance,
                                 int64_t *out_interface) {
    BEHIND(delam_mesh_add_interface);
    if (planted("interface tolerance 0 is 1e-3") && tolerance == 0.0) tolerance = 1e-3;
    if (planted("interface tolerance 0 is 2e-6") && tolerance == 0.0) tolerance = 2e-6;
    return planted("normals from b to a") ? behind(mesh, body_b, body_a, tolerance, out_interface)
                                          : behind(mesh, body_a, body_b, tolerance, out_interface);
}

int32_t delam_mesh_add_all_interfaces(delam_mesh *mesh, double tolerance, int64_t *out_count) {
    BEHIND(delam_mesh_add_all_interfaces);
    if (planted("tolerance 0 of all interfaces is 1e-3") && tolerance == 0.0) tolerance = 1e-3;
    return behind(mesh, tolerance, out_count);
}

int32_t delam_mesh_add_projected_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double gap,
                                           int64_t *out_interface) {
    BEHIND(delam_mesh_add_projected_interface);
    if (planted("gap 0 is 1e-3") && gap == 0.0) gap = 1e-3;
    return behind(mesh, body_a, body_b, gap, out_interface);
}

int32_t delam_mesh_add_obstacle(delam_mesh *mesh, int64_t count, const int64_t *nodes, const double *normals,
                                const double *weights, int64_t control_node, int32_t index_base,
                                int64_t *out_interface) {
    BEHIND(delam_mesh_add_obstacle);
    double *own = copy_of(normals, 2 * count);
    if (planted("normals into the obstacle"))
        for (int64_t i = 0; i < 2 * count; ++i) own[i] = -own[i];
    if (planted("normals of obstacles by component")) transpose(own, count, 2);
    const int32_t status = behind(mesh, count, nodes, own, weights, control_node, index_base, out_interface);
    free(own);
    return status;
}

int32_t delam_mesh_add_pairs(delam_mesh *mesh, int32_t body_a, int32_t body_b, int64_t count, const int64_t *nodes_a,
                             const int64_t *nodes_b, const double *normals, const double *weights, int64_t face_count,
                             int32_t nodes_per_face, const int64_t *faces, int32_t index_base, int64_t *out_interface) {
    BEHIND(delam_mesh_add_pairs);
    return planted("pairs from b to a") ? behind(mesh, body_b, body_a, count, nodes_b, nodes_a, normals, weights,
                                                 face_count, nodes_per_face, faces, index_base, out_interface)
                                        : behind(mesh, body_a, body_b, count, nodes_a, nodes_b, normals, weights,
                                                 face_count, nodes_per_face, faces, index_base, out_interface);
}

int32_t delam_mesh_interface_pairs(const delam_mesh *mesh, int64_t interface_index, int64_t *nodes_a, int64_t *nodes_b,
                                   double *weights, double *frames) {
    BEHIND(delam_mesh_interface_pairs);
    const int32_t status = behind(mesh, interface_index, nodes_a, nodes_b, weights, frames);
    int64_t pairs = 0;
    int32_t d = 0;
    delam_mesh_interface_size(mesh, interface_index, NULL, NULL, &pairs, NULL, NULL);
    delam_mesh_size(mesh, &d, NULL, NULL, NULL, NULL);
    for (int64_t p = 0; frames != NULL && p < pairs; ++p) {
        double *frame = frames + p * d * d;
        if (d == 3 && (planted("rows of frames") || planted("tangents everywhere")))
            for (int k = 0; k < 3; ++k) exchange(frame, 3 + k, 6 + k);
        if (planted("columns of frames")) transpose(frame, d, d);
        if (planted("normals last"))
            for (int k = 0; k < d; ++k) exchange(frame, k, d * (d - 1) + k);
    }
    return status;
}

int32_t delam_mesh_find_patch(const delam_mesh *mesh, int32_t body, const double *lower, const double *upper,
                              const double *direction, int64_t capacity, int64_t *nodes, double *weights,
                              int64_t *count) {
    BEHIND(delam_mesh_find_patch);
    const double against[3] = {-direction[0], -direction[1], direction[2]};
    const int32_t status =
        behind(mesh, body, lower, upper, planted("patches against their direction") ? against : direction, capacity,
               nodes, weights, count);
    double sum = 0.0;
    for (int64_t i = 0; weights != NULL && i < *count; ++i) sum += weights[i];
    if (planted("weights of patches as shares"))
        for (int64_t i = 0; weights != NULL && i < *count; ++i) weights[i] /= sum;
    return status;
}

int32_t delam_cell_type_topology(int64_t index, int32_t *face, int32_t *middle) {
    BEHIND(delam_cell_type_topology);
    const int32_t status = behind(index, face, middle);
    if (planted("faces inwards") && index == 3 && face != NULL) {
        const int32_t one = face[1];
        face[1] = face[3];
        face[3] = one;
    }
    return status;
}

int32_t delam_mesh_interface_size(const delam_mesh *mesh, int64_t interface_index, int32_t *body_a, int32_t *body_b,
                                  int64_t *pair_count, int64_t *face_count, int32_t *nodes_per_face) {
    BEHIND(delam_mesh_interface_size);
    return planted("bodies of an interface")
               ? behind(mesh, interface_index, body_b, body_a, pair_count, face_count, nodes_per_face)
               : behind(mesh, interface_index, body_a, body_b, pair_count, face_count, nodes_per_face);
}

/* ---- laws ---- */
int32_t delam_law_create(delam_context *context, const char *kind, delam_law **out) {
    BEHIND(delam_law_create);
    const int32_t status = behind(context, kind, out);
    if (planted_break == NULL || strncmp(planted_break, "law ", 4) != 0 || status != DELAM_OK) return status;
    char key[64];
    double number = 0.0;
    if (sscanf(planted_break, "law %63s %lf", key, &number) == 2) delam_law_set(*out, key, number);
    if (planted("law criterion")) delam_law_set_text(*out, "criterion", "benzeggagh-kenane");
    return status;
}

int32_t delam_law_set_text(delam_law *law, const char *key, const char *value) {
    BEHIND(delam_law_set_text);
    const int32_t status = behind(law, key, value);
    if (planted("power criterion with exponent 1") && strcmp(value, "power") == 0)
        delam_law_set(law, "onset_exponent", 1.0);
    if (planted("exponent 1 of Benzeggagh and Kenane") && strcmp(value, "benzeggagh-kenane") == 0)
        delam_law_set(law, "toughness_exponent", 1.0);
    return status;
}

int32_t delam_law_toughness(const delam_law *law, int64_t count, const double *mixity, double *onset,
                            double *toughness) {
    BEHIND(delam_law_toughness);
    double *own = copy_of(mixity, count);
    if (planted("mixity as share of mode I"))
        for (int64_t i = 0; i < count; ++i) own[i] = 1.0 - own[i];
    const int32_t status = behind(law, count, own, onset, toughness);
    free(own);
    return status;
}

int32_t delam_law_respond(const delam_law *law, int32_t dimension, int64_t count, const double *jump,
                          const double *mixity, const double *adhesion_old, double *adhesion, double *traction) {
    BEHIND(delam_law_respond);
    double *own = copy_of(jump, dimension * count);
    if (planted("jumps with the normal last"))
        for (int64_t p = 0; p < count; ++p) exchange(own, p * dimension, p * dimension + dimension - 1);
    if (planted("jumps by component")) transpose(own, count, dimension);
    const int32_t status = behind(law, dimension, count, own, mixity, adhesion_old, adhesion, traction);
    free(own);
    return status;
}

int32_t delam_law_set_table(delam_law *law, int64_t count, const double *xi, const double *s) {
    BEHIND(delam_law_set_table);
    double places[16], tractions[16];
    if (!planted("softening table by traction") || count > 16) return behind(law, count, xi, s);
    for (int64_t i = 0; i < count; ++i) {
        places[i] = s[count - 1 - i];
        tractions[i] = xi[count - 1 - i];
    }
    return behind(law, count, places, tractions);
}

/* ---- problems ---- */
/* "option KEY VALUE": the default of an option, its text kept. */
int32_t delam_problem_create(delam_context *context, const delam_mesh *mesh, delam_problem **out) {
    BEHIND(delam_problem_create);
    const int32_t status = behind(context, mesh, out);
    if (status != DELAM_OK || planted_break == NULL) return status;
    char key[64], word[64], *end = NULL;
    if (sscanf(planted_break, "option %63s %63s", key, word) == 2) {
        const double number = strtod(word, &end);
        if (*end == '\0')
            delam_problem_set_number(*out, key, number);
        else
            delam_problem_set_text(*out, key, word);
    }
    if (planted("plane stress by default")) delam_problem_set_plane(*out, "plane-stress");
    if (planted("incompatible by default")) delam_problem_set_formulation(*out, -1, "incompatible");
    return status;
}

static int32_t first_body(int32_t body) { return planted("body -1 is body 0") && body == -1 ? 0 : body; }

int32_t delam_problem_set_elastic(delam_problem *problem, int32_t body, double young, double poisson) {
    BEHIND(delam_problem_set_elastic);
    return behind(problem, first_body(body), young, poisson);
}

/* "constants I J": two of the nine exchanged. */
int32_t delam_problem_set_orthotropic(delam_problem *problem, int32_t body, const double *constants) {
    BEHIND(delam_problem_set_orthotropic);
    double own[9];
    int i = 0, j = 0;
    memcpy(own, constants, sizeof own);
    if (planted_break != NULL && sscanf(planted_break, "constants %d %d", &i, &j) == 2) exchange(own, i, j);
    return behind(problem, first_body(body), own);
}

int32_t delam_problem_set_orientation(delam_problem *problem, int32_t body, int64_t count, const int64_t *cells,
                                      const double *axes, int32_t index_base) {
    BEHIND(delam_problem_set_orientation);
    double *own = copy_of(axes, 6 * count);
    for (int64_t c = 0; planted("axes 2 and 1") && c < count; ++c)
        for (int k = 0; k < 3; ++k) exchange(own, 6 * c + k, 6 * c + 3 + k);
    for (int64_t c = 0; planted("axes by component") && c < count; ++c) transpose(own + 6 * c, 2, 3);
    const int32_t status = behind(problem, body, count, cells, own, index_base);
    free(own);
    return status;
}

int32_t delam_problem_add_eigenstrain(delam_problem *problem, int64_t pattern, int32_t body, const double *strain) {
    BEHIND(delam_problem_add_eigenstrain);
    double own[6];
    memcpy(own, strain, sizeof own);
    for (int k = 3; planted("eigenstrain not doubled") && k < 6; ++k) own[k] *= 2.0;
    if (planted("eigenstrain zx before yz")) exchange(own, 4, 5);
    return behind(problem, pattern, body, own);
}

int32_t delam_problem_set_stiffness(delam_problem *problem, int64_t count, const int64_t *nodes, const int64_t *dofs,
                                    const int64_t *row_starts, const int64_t *columns, const double *values,
                                    int64_t kernel_count, const double *kernel, int32_t index_base) {
    BEHIND(delam_problem_set_stiffness);
    double *own = copy_of(kernel, kernel_count > 0 ? 2 * count * kernel_count : 0);
    if (planted("kernel by row") && kernel != NULL) transpose(own, kernel_count, 2 * count);
    const int32_t status =
        behind(problem, count, nodes, planted("rows of the matrix by node") ? NULL : dofs, row_starts, columns, values,
               planted("kernel_count -1 is none") && kernel_count == -1 ? 0 : kernel_count, kernel == NULL ? NULL : own,
               index_base);
    free(own);
    return status;
}

int32_t delam_problem_set_adhesion(delam_problem *problem, int64_t interface_index, int64_t count, const int64_t *pairs,
                                   const double *adhesion, int32_t index_base) {
    BEHIND(delam_problem_set_adhesion);
    double *own = copy_of(adhesion, count);
    for (int64_t i = 0; planted("adhesion as damage") && i < count; ++i) own[i] = 1.0 - own[i];
    const int32_t status = behind(problem, interface_index, count, pairs, own, index_base);
    free(own);
    return status;
}

int32_t delam_problem_set_adhesion_box(delam_problem *problem, int64_t interface_index, const double *lower,
                                       const double *upper, double adhesion, int64_t *count) {
    BEHIND(delam_problem_set_adhesion_box);
    static const delam_problem *same = NULL;
    static double lowest = 1.0;
    lowest = problem == same && lowest < adhesion ? lowest : adhesion;
    same = problem;
    if (planted("a box that only lowers")) return behind(problem, interface_index, lower, upper, lowest, count);
    return behind(problem, interface_index, lower, upper,
                  planted("adhesion of a box as damage") ? 1.0 - adhesion : adhesion, count);
}

static const delam_problem *in_contact;

int32_t delam_problem_set_contact(delam_problem *problem, int64_t interface_index) {
    BEHIND(delam_problem_set_contact);
    in_contact = problem;
    return behind(problem, interface_index);
}

int32_t delam_problem_set_law(delam_problem *problem, int64_t interface_index, const delam_law *law) {
    BEHIND(delam_problem_set_law);
    const int32_t status = behind(problem, interface_index, law);
    const double lower[] = {-9.0, -9.0, -9.0}, upper[] = {9.0, 9.0, 9.0};
    int64_t count;
    if (planted("contact that stays without adhesion") && in_contact == problem)
        delam_problem_set_adhesion_box(problem, interface_index, lower, upper, 0.0, &count);
    return status;
}

int32_t delam_problem_prescribe_nodes(delam_problem *problem, int64_t count, const int64_t *nodes,
                                      const double *direction, int64_t pattern_count, const int64_t *patterns,
                                      const double *coefficients, int32_t index_base) {
    BEHIND(delam_problem_prescribe_nodes);
    double *own = copy_of(coefficients, count * pattern_count);
    const double length = hypot(direction[0], direction[1]);
    if (planted("coefficients by pattern")) transpose(own, count, pattern_count);
    for (int64_t i = 0; planted("directions of any length") && length > 1.0 && i < count * pattern_count; ++i)
        own[i] /= length;
    const int32_t status = behind(problem, count, nodes, direction, pattern_count, patterns,
                                  coefficients == NULL ? NULL : own, index_base);
    free(own);
    return status;
}

int32_t delam_problem_prescribe_mean(delam_problem *problem, int64_t count, const int64_t *nodes, const double *weights,
                                     const double *direction, int64_t pattern_count, const int64_t *patterns,
                                     const double *coefficients, int32_t index_base) {
    BEHIND(delam_problem_prescribe_mean);
    double *own = copy_of(weights, count);
    for (int64_t i = 0; planted("means without weights") && i < count; ++i) own[i] = 1.0;
    const int32_t status =
        behind(problem, count, nodes, own, direction, pattern_count, patterns, coefficients, index_base);
    free(own);
    return status;
}

int32_t delam_problem_add_equation(delam_problem *problem, int64_t count, const int64_t *nodes,
                                   const double *coefficients, int64_t pattern_count, const int64_t *patterns,
                                   const double *prescribed, int32_t index_base) {
    BEHIND(delam_problem_add_equation);
    double *own = copy_of(coefficients, 2 * count);
    if (planted("equations by component")) transpose(own, count, 2);
    const int32_t status = behind(problem, count, nodes, own, pattern_count, patterns, prescribed, index_base);
    free(own);
    return status;
}

int32_t delam_problem_add_periodic(delam_problem *problem, int64_t period_count, const double *periods,
                                   const int64_t *control_nodes, double tolerance, int32_t index_base) {
    BEHIND(delam_problem_add_periodic);
    const int64_t others[2] = {control_nodes[1], control_nodes[0]};
    if (planted("periodic tolerance 0 is 1e-3") && tolerance == 0.0) tolerance = 1e-3;
    return behind(problem, period_count, periods, planted("control nodes") ? others : control_nodes, tolerance,
                  index_base);
}

int32_t delam_problem_add_forces(delam_problem *problem, int64_t pattern, int64_t count, const int64_t *nodes,
                                 const double *forces, int32_t index_base) {
    BEHIND(delam_problem_add_forces);
    double *own = copy_of(forces, 2 * count);
    if (planted("forces by component")) transpose(own, count, 2);
    const int32_t status = behind(problem, pattern, count, nodes, own, index_base);
    free(own);
    return status;
}

int32_t delam_problem_body_matrix(const delam_problem *problem, int32_t body, int64_t *rows, int64_t *entries,
                                  int64_t *row_starts, int64_t *columns, double *values) {
    BEHIND(delam_problem_body_matrix);
    const int32_t status = behind(problem, body, rows, entries, row_starts, columns, values);
    const int64_t all = row_starts != NULL ? row_starts[8] : 0;
    for (int64_t e = 0; planted("columns of a body by component") && columns != NULL && e < all; ++e)
        columns[e] = columns[e] % 2 * 4 + columns[e] / 2;
    return status;
}

int32_t delam_problem_constraints(const delam_problem *problem, int64_t *rows, int64_t *entries, int64_t *pattern_count,
                                  int64_t *row_starts, int64_t *columns, double *values, double *coefficients) {
    BEHIND(delam_problem_constraints);
    const int32_t status = behind(problem, rows, entries, pattern_count, row_starts, columns, values, coefficients);
    if (planted("right sides by pattern") && coefficients != NULL) transpose(coefficients, 6, 3);
    return status;
}

int32_t delam_problem_eigenstrain_energy(const delam_problem *problem, int64_t capacity, double *matrix) {
    BEHIND(delam_problem_eigenstrain_energy);
    const int32_t status = behind(problem, capacity, matrix);
    for (int64_t i = 0; planted("half the energy of eigenstrains") && i < capacity; ++i) matrix[i] *= 0.5;
    return status;
}

int32_t delam_problem_factors(const delam_problem *problem, double time, int64_t capacity, double *factors) {
    BEHIND(delam_problem_factors);
    const int32_t status = behind(problem, time, capacity, factors);
    if (planted("factors backwards")) reverse(factors, capacity);
    return status;
}

int32_t delam_problem_process_zone(const delam_problem *problem, int64_t interface_index, double *length,
                                   double *spacing) {
    BEHIND(delam_problem_process_zone);
    return planted("length of the zone and spacing") ? behind(problem, interface_index, spacing, length)
                                                     : behind(problem, interface_index, length, spacing);
}

int32_t delam_problem_propose(const delam_problem *problem, int64_t interface_index, double pairs, double *stiffness,
                              double *share, double *normal_strength, double *tangential_strength) {
    BEHIND(delam_problem_propose);
    return planted("strengths exchanged")
               ? behind(problem, interface_index, pairs, stiffness, share, tangential_strength, normal_strength)
               : behind(problem, interface_index, pairs, stiffness, share, normal_strength, tangential_strength);
}

/* ---- solvers ---- */
int32_t delam_solver_equilibrate(delam_solver *solver, double time, const double *adhesion) {
    BEHIND(delam_solver_equilibrate);
    int64_t pairs = 0, columns = 0;
    delam_solver_field_shape(solver, "adhesion", -1, &pairs, &columns);
    double *own = copy_of(adhesion, pairs);
    if (planted("adhesion of the last pair first")) reverse(own, pairs);
    for (int64_t i = 0; planted("adhesion NULL is 1") && adhesion == NULL && i < pairs; ++i) own[i] = 1.0;
    const int32_t status = behind(solver, time, adhesion != NULL || planted("adhesion NULL is 1") ? own : NULL);
    free(own);
    return status;
}

int32_t delam_solver_set_history(delam_solver *solver, int64_t pattern, int64_t count, const double *times,
                                 const double *values) {
    BEHIND(delam_solver_set_history);
    double *own = copy_of(values, count);
    if (planted("histories backwards")) reverse(own, count);
    const int32_t status = behind(solver, pattern, count, times, own);
    free(own);
    return status;
}

int32_t delam_solver_value(delam_solver *solver, const char *key, double *value) {
    BEHIND(delam_solver_value);
    if (planted("energies of bodies and interfaces")) {
        if (strcmp(key, "stored_bulk") == 0) return behind(solver, "stored_interface", value);
        if (strcmp(key, "stored_interface") == 0) return behind(solver, "stored_bulk", value);
    }
    if (planted("damage without its slope") && strcmp(key, "dissipated") == 0)
        return behind(solver, "dissipated_slides", value);
    if (planted("front as zone") && strcmp(key, "front") == 0) return behind(solver, "process_zone", value);
    const int32_t status = behind(solver, key, value);
    if (planted("reaction of the body") && strncmp(key, "reaction:", 9) == 0) *value = -*value;
    if (planted("rotation_max in degrees") && strcmp(key, "rotation_max") == 0) *value *= 180.0 / 3.14159265358979;
    return status;
}

static void plant_field(const delam_solver *solver, const char *key, int64_t count, double *values) {
    const int32_t d = dimension_of(solver);
    const int pairwise = strcmp(key, "jump") == 0 || strcmp(key, "traction") == 0;
    const int64_t columns = strcmp(key, "stress") == 0 ? (d == 2 ? 4 : 6) : d;
    for (int64_t at = 0; at + columns <= count; at += columns) {
        if (strcmp(key, "stress") == 0) {
            if (d == 3 && planted("stress zx before yz")) exchange(values, at + 4, at + 5);
            if (d == 3 && planted("stress yz before xy")) exchange(values, at + 3, at + 4);
            if (d == 2 && planted("stress xy before zz")) exchange(values, at + 2, at + 3);
        }
        if (pairwise && d == 3 && planted("tangents everywhere")) exchange(values, at + 1, at + 2);
        if (pairwise && planted("jump and traction with the normal last")) exchange(values, at, at + d - 1);
    }
    for (int64_t i = 0; i < count; ++i) {
        if (strcmp(key, "rotation") == 0 && planted("rotation in degrees")) values[i] *= 180.0 / 3.14159265358979;
        if (strcmp(key, "rotation") == 0 && planted("rotation as curl")) values[i] *= 2.0;
        if (strcmp(key, "traction") == 0 && planted("pressure positive")) values[i] = -values[i];
        if (strcmp(key, "traction") == 0 && planted("traction as force")) values[i] *= 0.5;
        if (strcmp(key, "reaction") == 0 && planted("reaction on the machine")) values[i] = -values[i];
        if (strcmp(key, "mixity") == 0 && planted("field mixity as share of mode I")) values[i] = 1.0 - values[i];
        if (strcmp(key, "contact") == 0 && planted("contact as opening")) values[i] = 1.0 - values[i];
    }
    if (strcmp(key, "displacement") == 0 && planted("displacement by component")) transpose(values, count / d, d);
}

int32_t delam_solver_field(delam_solver *solver, const char *key, int64_t part, int64_t capacity, double *values) {
    BEHIND(delam_solver_field);
    const int32_t status = behind(solver, key, part, capacity, values);
    if (status == DELAM_OK && planted_break != NULL) plant_field(solver, key, capacity, values);
    return status;
}

int32_t delam_solver_average(const delam_solver *solver, int32_t body, double *volume, double *strain, double *stress) {
    BEHIND(delam_solver_average);
    const int32_t status = behind(solver, first_body(body), volume, strain, stress);
    for (int k = 3; planted("strain not doubled") && strain != NULL && k < 6; ++k) strain[k] *= 0.5;
    if (planted("average strain zx before yz") && strain != NULL) exchange(strain, 4, 5);
    if (planted("average stress yz before xy") && stress != NULL) exchange(stress, 3, 4);
    return status;
}

int32_t delam_solver_front(const delam_solver *solver, int64_t interface_index, int64_t front_capacity,
                           int64_t point_capacity, int64_t *starts, int32_t *closed, double *places, double *directions,
                           double *lengths, double *rates, double *zone_lengths, double *zone_pairs) {
    BEHIND(delam_solver_front);
    const int32_t status = behind(solver, interface_index, front_capacity, point_capacity, starts, closed, places,
                                  directions, lengths, rates, zone_lengths, zone_pairs);
    const int32_t d = dimension_of(solver);
    for (int64_t p = 0; status == DELAM_OK && p < point_capacity; ++p) {
        if (planted("rates of modes II and III")) exchange(rates, 3 * p + 1, 3 * p + 2);
        for (int k = 0; planted("fronts into the crack") && k < d; ++k) directions[d * p + k] *= -1.0;
        if (planted("zones in pairs")) zone_lengths[p] = 2.0 * zone_pairs[p];
    }
    if (planted("rates by mode")) transpose(rates, point_capacity, 3);
    if (planted("fronts that are open") && closed != NULL) closed[front_capacity - 1] = 1 - closed[front_capacity - 1];
    return status;
}

int32_t delam_solver_tangent(delam_solver *solver, int64_t capacity, double *matrix) {
    BEHIND(delam_solver_tangent);
    if (planted("tangent with damage")) return delam_solver_step_tangent(solver, capacity, matrix);
    const int32_t status = behind(solver, capacity, matrix);
    if (planted("patterns of the tangent backwards")) reverse(matrix, capacity);
    return status;
}

int32_t delam_solver_step_tangent(delam_solver *solver, int64_t capacity, double *matrix) {
    BEHIND(delam_solver_step_tangent);
    const int32_t status = behind(solver, capacity, matrix);
    for (int64_t i = 0; planted("sign of the step tangent") && i < capacity; ++i) matrix[i] = -matrix[i];
    const int64_t n = (int64_t)(sqrt((double)capacity) + 0.5);
    if (planted("step tangent by columns")) transpose(matrix, n, n);
    return status;
}

int32_t delam_solver_advance(delam_solver *solver, double time) {
    BEHIND(delam_solver_advance);
    const int32_t status = behind(solver, time);
    return planted("a step into the past out of order") && status == DELAM_ERROR_ARGUMENT ? DELAM_ERROR_STATE : status;
}

int32_t delam_solver_commit(delam_solver *solver) {
    BEHIND(delam_solver_commit);
    const int32_t status = behind(solver);
    return planted("commit without a step") && status == DELAM_ERROR_STATE ? DELAM_OK : status;
}

int32_t delam_context_cancel(delam_context *context) {
    BEHIND(delam_context_cancel);
    return planted("a cancel that is forgotten") ? DELAM_OK : behind(context);
}

/* The words of the middle half backwards, as in a format that has its lists in another order. */
static void reorder(uint8_t *bytes, int64_t size) {
    uint64_t sum = 14695981039346656037u;
    const int64_t words = size / 16;
    uint8_t *first = bytes + size / 4;
    for (int64_t i = 0; i < words / 2; ++i) {
        uint64_t one, other;
        memcpy(&one, first + 8 * i, 8);
        memcpy(&other, first + 8 * (words - 1 - i), 8);
        memcpy(first + 8 * i, &other, 8);
        memcpy(first + 8 * (words - 1 - i), &one, 8);
    }
    for (int64_t i = 0; i + 8 < size; ++i) sum = (sum ^ bytes[i]) * 1099511628211u;
    memcpy(bytes + size - 8, &sum, 8);
}

int32_t delam_solver_save(const delam_solver *solver, int64_t capacity, uint8_t *bytes, int64_t *needed) {
    BEHIND(delam_solver_save);
    const int32_t status = behind(solver, capacity, bytes, needed);
    if (planted("lists of a state in another order") && status == DELAM_OK && capacity > 0) reorder(bytes, *needed);
    return status;
}

int32_t delam_solver_load(delam_solver *solver, int64_t size, const uint8_t *bytes) {
    BEHIND(delam_solver_load);
    if (planted("old formats refused") && size > 8 && bytes[8] < 11) return DELAM_ERROR_SNAPSHOT;
    if (!planted("lists of a state in another order") || size < 40) return behind(solver, size, bytes);
    uint8_t *own = malloc((size_t)size);
    memcpy(own, bytes, (size_t)size);
    reorder(own, size);
    const int32_t status = behind(solver, size, own);
    free(own);
    return status;
}

int32_t delam_solver_condensed(const delam_solver *solver, int64_t capacity, double *stiffness, double *load,
                               double *constant, int64_t *row_starts, int64_t *columns, double *values,
                               double *offset) {
    BEHIND(delam_solver_condensed);
    const int32_t status = behind(solver, capacity, stiffness, load, constant, row_starts, columns, values, offset);
    const int64_t n = (int64_t)(sqrt((double)capacity) + 0.5);
    if (planted("condensed loads by unknown")) transpose(load, 3, n);
    if (planted("offsets by pattern")) transpose(offset, 6, 3);
    for (int64_t i = 0; planted("half the condensed stiffness") && i < capacity; ++i) stiffness[i] *= 0.5;
    return status;
}

int32_t delam_solver_recorded(const delam_solver *solver, const char *key, int64_t capacity, double *values) {
    BEHIND(delam_solver_recorded);
    const int32_t status = behind(solver, key, capacity, values);
    if (planted("the record backwards")) reverse(values, capacity);
    return status;
}

int32_t delam_solver_jump(const delam_solver *solver, int64_t index, int64_t *step, double *before, double *time,
                          double *stored, double *dissipated, double *released, double *debonded,
                          int64_t *interface_index, int64_t *first_pair, int64_t *last_pair) {
    BEHIND(delam_solver_jump);
    return planted("what a jump releases and dissipates")
               ? behind(solver, index, step, before, time, stored, released, dissipated, debonded, interface_index,
                        first_pair, last_pair)
               : behind(solver, index, step, before, time, stored, dissipated, released, debonded, interface_index,
                        first_pair, last_pair);
}

int32_t delam_solver_look(delam_solver *solver, int64_t step) {
    BEHIND(delam_solver_look);
    return behind(solver, planted("step -1 is the first") && step == -1 ? 0 : step);
}

/* ---- what the library has ---- */
int64_t delam_option_count(void) {
    BEHIND(delam_option_count);
    return behind() + (planted("a new option") ? 1 : 0);
}

int32_t delam_option_info(int64_t index, const char **key, const char **type, const char **unit, const char **initial,
                          const char **range, const char **meaning) {
    BEHIND(delam_option_info);
    const int fresh = planted("a new option") && index + 1 == delam_option_count();
    const int32_t status = behind(fresh ? 0 : index, key, type, unit, initial, range, meaning);
    if (fresh && key != NULL) *key = "patience";
    return status;
}
