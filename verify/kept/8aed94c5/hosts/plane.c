/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A host in the plane: mixed-mode flexure of two orthotropic arms, cooled and then pressed; options, a log, a step
 * rolled back, a history that the host changes, recorded values, jumps, fields.
 *
 *     plane                  prints all steps as csv
 *     plane save STATE       prints the first half and saves the state as bytes of delam_solver_save
 *     plane load STATE       loads these bytes and prints the second half
 */
#include <delam/delam.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { steps = 16, half = 7, pairs = 65 };

static const double length = 0.125, height = 0.00390625, notch = 0.03125; /* m */

static delam_context *context;
static delam_mesh *mesh;
static delam_law *law;
static delam_problem *problem;
static delam_solver *solver;
static int told;

static void fine(int32_t status, const char *call) {
    if (status == DELAM_OK) return;
    fprintf(stderr, "plane: %s: %s: %s\n", call, delam_status_name(status), delam_context_message(context));
    exit(1);
}
#define FINE(call) fine(call, #call)

static void on_log(int32_t level, const char *text, void *user) {
    if (level == 0 && text != NULL) ++*(int *)user;
}

static int32_t on_progress(const char *stage, int64_t done, int64_t total, void *user) {
    (void)user;
    return stage == NULL || done < 0 || total < 0;
}

static void make_mesh(void) {
    const int64_t cells = 64, layers[2] = {2, 2};
    const double thickness[2] = {height, height};
    int64_t index = -1;
    FINE(delam_mesh_create_layers(context, 2, &length, &cells, 2, thickness, layers, DELAM_QUAD4, &mesh));
    FINE(delam_mesh_add_interface(mesh, 0, 1, 0.0, &index));
}

static void make_law(void) {
    static const char *const keys[] = {"normal_stiffness", "tangential_stiffness", "normal_onset",
                                       "tangential_onset", "normal_toughness",     "tangential_toughness",
                                       "onset_exponent",   "toughness_exponent"};
    static const double values[] = {1e12, 1e12, 32.0, 72.0, 250.0, 700.0, 2.0, 2.1};
    size_t i;
    FINE(delam_law_create(context, "piecewise-linear", &law));
    FINE(delam_law_set_text(law, "criterion", "benzeggagh-kenane"));
    for (i = 0; i < sizeof keys / sizeof keys[0]; ++i) FINE(delam_law_set(law, keys[i], values[i]));
}

static int64_t node_at(int32_t body, double x, double y) {
    const double place[2] = {x, y};
    int64_t node = -1, count = 0;
    FINE(delam_mesh_find_nodes(mesh, body, place, place, 1, &node, &count));
    if (count == 1) return node;
    fprintf(stderr, "plane: %ld nodes at (%g, %g)\n", (long)count, x, y);
    exit(1);
}

static void prescribe(int64_t node, double x, double y, int64_t pattern) {
    const double direction[2] = {x, y}, one = 1.0;
    FINE(delam_problem_prescribe_nodes(problem, 1, &node, direction, pattern < 0 ? 0 : 1, &pattern, &one, 0));
}

static void make_problem(void) {
    static const double ply[9] = {120e9, 10e9, 10e9, 0.3, 0.3, 0.4, 5e9, 5e9, 3.5e9};
    static const double cooling[6] = {0.0, 27e-6, 27e-6, 0.0, 0.0, 0.0};
    static const double times[3] = {0.0, 0.125, 1.0}, cool[3] = {0.0, -100.0, -100.0}, press[3] = {0.0, 0.0, 0.003};
    const double lower[2] = {0.0, 0.0}, upper[2] = {notch, 2.0 * height};
    int64_t cool_pattern = -1, press_pattern = -1;
    FINE(delam_problem_create(context, mesh, &problem));
    FINE(delam_problem_set_plane(problem, "plane-strain"));
    FINE(delam_problem_set_orthotropic(problem, -1, ply));
    FINE(delam_problem_set_formulation(problem, -1, "incompatible"));
    FINE(delam_problem_set_law(problem, 0, law));
    FINE(delam_problem_set_adhesion_box(problem, 0, lower, upper, 0.0, NULL));
    FINE(delam_problem_add_pattern(problem, "cool", 3, times, cool, &cool_pattern));
    FINE(delam_problem_add_eigenstrain(problem, cool_pattern, 1, cooling));
    FINE(delam_problem_add_pattern(problem, "press", 3, times, press, &press_pattern));
    prescribe(node_at(1, 0.0, height), 0.0, 1.0, -1);
    prescribe(node_at(0, length, 0.0), 1.0, 0.0, -1);
    prescribe(node_at(0, length, 0.0), 0.0, 1.0, -1);
    prescribe(node_at(1, 0.5 * length, 2.0 * height), 0.0, -1.0, press_pattern);
    FINE(delam_problem_set_number(problem, "damage_tolerance", 1e-6));
    FINE(delam_problem_set_text(problem, "solution", "local"));
    FINE(delam_problem_check(problem));
}

static const char *const keys[] = {"step",
                                   "time",
                                   "load:press",
                                   "reaction:press",
                                   "reaction:cool",
                                   "stored_bulk",
                                   "stored_interface",
                                   "dissipated",
                                   "work",
                                   "debonded_length",
                                   "crack_length",
                                   "energy_release_rate",
                                   "front_mixity",
                                   "released"};
enum { key_count = sizeof keys / sizeof keys[0] };

static void print_titles(void) {
    int i;
    for (i = 0; i < key_count; ++i) printf("%s,", keys[i]);
    printf("adhesion,slip,recorded_work,jumps\n");
}

/* The values, and sums of fields. */
static void print_row(void) {
    double number = 0.0, adhesion[pairs], jump[2 * pairs], recorded[steps + 1], sum = 0.0, slip = 0.0;
    int64_t first = 0, count = 0;
    int i;
    for (i = 0; i < key_count; ++i) {
        FINE(delam_solver_value(solver, keys[i], &number));
        printf("%.17g,", number);
    }
    FINE(delam_solver_field(solver, "adhesion", 0, pairs, adhesion));
    FINE(delam_solver_field(solver, "jump", -1, 2 * pairs, jump));
    for (i = 0; i < pairs; ++i) {
        sum += adhesion[i];
        slip += jump[2 * i + 1];
    }
    FINE(delam_solver_recorded_size(solver, &first, &count));
    FINE(delam_solver_recorded(solver, "work", steps + 1, recorded));
    printf("%.17g,%.17g,%.17g,", sum, slip, recorded[count - 1]);
    FINE(delam_solver_jump_count(solver, &count));
    printf("%ld\n", (long)count);
}

static void march(int from, int to) {
    static const double times[2] = {0.75, 1.0}, values[2] = {0.00225, 0.0025};
    int step;
    for (step = from; step <= to; ++step) {
        const double time = (double)step / steps;
        FINE(delam_solver_advance(solver, time));
        if (step % 4 == 0) {
            FINE(delam_solver_rollback(solver));
            FINE(delam_solver_advance(solver, time));
        }
        FINE(delam_solver_commit(solver));
        print_row();
        if (step == 5) FINE(delam_solver_set_history(solver, 1, 2, times, values));
    }
}

static void save(const char *path) {
    uint8_t bytes[65536];
    int64_t needed = 0;
    FILE *file = fopen(path, "wb");
    FINE(delam_solver_save(solver, sizeof bytes, bytes, &needed));
    if (file == NULL || fwrite(bytes, 1, (size_t)needed, file) != (size_t)needed || fclose(file) != 0) {
        perror(path);
        exit(1);
    }
}

static void load(const char *path) {
    uint8_t bytes[65536];
    FILE *file = fopen(path, "rb");
    size_t size;
    if (file == NULL) {
        perror(path);
        exit(1);
    }
    size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    FINE(delam_solver_load(solver, (int64_t)size, bytes));
}

int main(int argc, char **argv) {
    const char *word = argc == 3 ? argv[1] : "";
    if (delam_abi() != DELAM_ABI) {
        fprintf(stderr, "plane: DELAM_ABI is %d in the header, %d in the library\n", DELAM_ABI, (int)delam_abi());
        return 1;
    }
    FINE(delam_context_create(&context));
    FINE(delam_context_set_log(context, on_log, &told));
    FINE(delam_context_set_progress(context, on_progress, NULL));
    make_mesh();
    make_law();
    make_problem();
    FINE(delam_solver_create(problem, 0.0, &solver));
    print_titles();
    if (strcmp(word, "load") == 0) {
        load(argv[2]);
    } else {
        FINE(delam_solver_record(solver, "work"));
        print_row();
        march(1, half);
    }
    if (strcmp(word, "save") == 0)
        save(argv[2]);
    else
        march(half + 1, steps);
    delam_solver_destroy(&solver);
    delam_problem_destroy(&problem);
    delam_law_destroy(&law);
    delam_mesh_destroy(&mesh);
    delam_context_destroy(&context);
    return told > 0 || solver != NULL;
}
