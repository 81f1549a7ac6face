/* SPDX-License-Identifier: BSD-3-Clause
 * Counts, sizes, capacities, indices and pointers that the functions of experimental.h have to refuse: with
 * DELAM_ERROR_ARGUMENT, and a message that names the argument. */
#include <delam/experimental.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static delam_context *context;
static int checks, failures;

static void expect(int32_t status, int32_t wanted, const char *word, const char *what) {
    const char *message = delam_context_message(context);
    ++checks;
    if (status == wanted && (word == NULL || strstr(message, word) != NULL)) return;
    ++failures;
    printf("%s: status %" PRId32 ", expected %" PRId32 ", the message should name '%s': %s\n", what, status, wanted,
           word != NULL ? word : "-", message);
}

static void fine(int32_t status) {
    if (status == DELAM_OK) return;
    printf("the scene is refused: %s\n", delam_context_message(context));
    exit(1);
}

#define REFUSED(call, word) expect((call), DELAM_ERROR_ARGUMENT, (word), #call)

/* Creates the context. One interface becomes two: the pair of the left end, and the others. */
static void create_and_split(void) {
    static const int64_t hostile[] = {INT64_MIN, INT64_MIN / 8, -1, INT64_MAX / 8, INT64_MAX};
    const double length = 0.02, thickness[] = {2e-3, 2e-3};
    const int64_t cells = 4, layers[] = {1, 1};
    int64_t glue;
    delam_mesh *mesh;
    fine(delam_context_create(&context));
    fine(delam_mesh_create_layers(context, 2, &length, &cells, 2, thickness, layers, DELAM_QUAD4, &mesh));
    fine(delam_mesh_add_interface(mesh, 0, 1, 0, &glue));
    const int64_t left_pair[] = {0, 0}, every[] = {0, 1, 2, 3, 4};
    int64_t half, there[2];
    for (int i = 0; i < 5; ++i) {
        REFUSED(delam_experimental_mesh_split_interface(mesh, hostile[i], 1, left_pair, 0, &half), "interface_index");
        REFUSED(delam_experimental_mesh_split_interface(mesh, glue, hostile[i], left_pair, 0, &half), "count");
        REFUSED(delam_experimental_mesh_split_interface(mesh, glue, 1, &hostile[i], 0, &half), "pairs");
    }
    REFUSED(delam_experimental_mesh_split_interface(mesh, glue, 2, left_pair, 0, &half), "twice");
    REFUSED(delam_experimental_mesh_split_interface(mesh, glue, 5, every, 0, &half), "at least one");
    REFUSED(delam_experimental_mesh_split_interface(mesh, glue, 1, NULL, 0, &half), "pairs");
    REFUSED(delam_experimental_mesh_split_interface(mesh, glue, 1, left_pair, 2, &half), "index_base");
    REFUSED(delam_experimental_mesh_split_interface(mesh, glue, 1, left_pair, 0, NULL), "out_interface");
    fine(delam_experimental_mesh_split_interface(mesh, glue, 1, left_pair, 0, &half));
    for (int i = 0; i < 2; ++i)
        fine(delam_mesh_interface_size(mesh, i == 0 ? glue : half, NULL, NULL, &there[i], NULL, NULL));
    ++checks;
    if (half != glue + 1 || there[0] != 4 || there[1] != 1) ++failures, printf("the pairs of both interfaces\n");
    delam_mesh_destroy(&mesh);
}

int main(void) {
    static const char *const keys[] = {"normal_stiffness", "tangential_stiffness", "normal_onset",
                                       "tangential_onset", "normal_toughness",     "tangential_toughness"};
    static const double numbers[] = {1e12, 1e12, 20, 20, 250, 250};
    static const int64_t hostile[] = {INT64_MIN, INT64_MIN / 8, -1, INT64_MAX / 8, INT64_MAX};
    const double length = 0.02, thickness[] = {2e-3, 2e-3}, across[] = {1, 0}, up[] = {0, 1};
    const int64_t cells = 4, layers[] = {1, 1}, low[] = {0, 4}, zero[] = {0, 0};
    int64_t glue, size = 0, dimension, nodes, entries, parameter, count, unknown, list[16];
    delam_mesh *mesh;
    delam_law *law;
    delam_problem *problem;
    delam_solver *solver;
    create_and_split();
    fine(delam_mesh_create_layers(context, 2, &length, &cells, 2, thickness, layers, DELAM_QUAD4, &mesh));
    fine(delam_mesh_add_interface(mesh, 0, 1, 0, &glue));
    fine(delam_law_create(context, "piecewise-linear", &law));
    for (int i = 0; i < 6; ++i) fine(delam_law_set(law, keys[i], numbers[i]));
    fine(delam_problem_create(context, mesh, &problem));
    fine(delam_problem_set_elastic(problem, -1, 70e9, 0.3));
    fine(delam_problem_set_law(problem, glue, law));
    fine(delam_problem_prescribe_nodes(problem, 2, low, across, 0, NULL, NULL, 0));
    fine(delam_problem_prescribe_nodes(problem, 2, low, up, 0, NULL, NULL, 0));
    fine(delam_solver_create(problem, 0, &solver));

    /* engines */
    delam_experimental_engine engine;
    memset(&engine, 0, sizeof engine);
    for (int i = 0; i < 5; ++i) {
        engine.size = hostile[i];
        REFUSED(delam_experimental_problem_set_engine(problem, &engine), "size");
    }
    int64_t *const short_one = malloc(sizeof(int64_t)); /* of a host with a smaller structure: nothing else is read */
    *short_one = 8;
    REFUSED(delam_experimental_problem_set_engine(problem, (const delam_experimental_engine *)(const void *)short_one),
            "size");
    free(short_one);
    engine.size = sizeof engine;
    for (int i = 0; i < 5; ++i) {
        engine.kept = hostile[i];
        REFUSED(delam_experimental_problem_set_engine(problem, &engine), "kept");
    }
    engine.kept = 8;
    REFUSED(delam_experimental_problem_set_engine(problem, &engine), "prepare");
    expect(delam_experimental_problem_set_engine(problem, NULL), DELAM_OK, NULL, "set_engine NULL");
    expect(delam_experimental_problem_set_engine((delam_problem *)(void *)mesh, NULL), DELAM_ERROR_HANDLE, NULL,
           "mesh");

    /* parts */
    int64_t part_cells[] = {0, 1, 2};
    for (int i = 0; i < 5; ++i) {
        REFUSED(delam_experimental_problem_part(problem, hostile[i], part_cells, 0, NULL, &size), "count");
        if (hostile[i] < 0)
            REFUSED(delam_experimental_problem_part(problem, 3, part_cells, hostile[i], NULL, &size), "capacity");
    }
    REFUSED(delam_experimental_problem_part(problem, 0, part_cells, 0, NULL, &size), "count");
    REFUSED(delam_experimental_problem_part(problem, 9, part_cells, 0, NULL, &size), "count");
    REFUSED(delam_experimental_problem_part(problem, 3, NULL, 0, NULL, &size), "cells");
    for (int i = 0; i < 5; ++i) {
        part_cells[2] = hostile[i];
        REFUSED(delam_experimental_problem_part(problem, 3, part_cells, 0, NULL, &size), "cells[2]");
    }
    part_cells[2] = 1;
    REFUSED(delam_experimental_problem_part(problem, 3, part_cells, 0, NULL, &size), "cells[2]");
    part_cells[2] = 2;
    fine(delam_experimental_problem_part(problem, 3, part_cells, 0, NULL, &size));
    uint8_t *const bytes = malloc((size_t)size);
    REFUSED(delam_experimental_problem_part(problem, 3, part_cells, size - 1, bytes, &size), "bytes");
    fine(delam_experimental_problem_part(problem, 3, part_cells, size, bytes, &size));
    for (int i = 0; i < 5; ++i) {
        if (hostile[i] < 0 || hostile[i] == INT64_MAX)
            REFUSED(delam_experimental_part_matrix(context, hostile[i], bytes, &dimension, &nodes, &entries, NULL, NULL,
                                                   NULL, NULL, NULL),
                    "size");
    }
    REFUSED(
        delam_experimental_part_matrix(context, size, NULL, &dimension, &nodes, &entries, NULL, NULL, NULL, NULL, NULL),
        "bytes");
    for (int64_t some = 0; some < size; some += 7)
        expect(delam_experimental_part_matrix(context, some, bytes, &dimension, &nodes, &entries, NULL, NULL, NULL,
                                              NULL, NULL),
               DELAM_ERROR_SNAPSHOT, NULL, "a part that ends early");
    fine(delam_experimental_part_matrix(context, size, bytes, &dimension, &nodes, &entries, NULL, NULL, NULL, NULL,
                                        NULL));
    double *const u = calloc((size_t)(nodes * dimension), sizeof(double));
    const int32_t labels[] = {0, 0}, negative[] = {-1};
    const double strains[12] = {0};
    for (int i = 0; i < 5; ++i) {
        REFUSED(delam_experimental_part_fields(context, size, bytes, hostile[i], u, 0, NULL, NULL, 3, NULL, NULL),
                "node_count");
        REFUSED(delam_experimental_part_fields(context, size, bytes, nodes, u, 0, NULL, NULL, hostile[i], NULL, NULL),
                "cell_count");
        if (hostile[i] < 0)
            REFUSED(delam_experimental_part_fields(context, size, bytes, nodes, u, hostile[i], labels, strains, 3, NULL,
                                                   NULL),
                    "body_count");
    }
    REFUSED(delam_experimental_part_fields(context, size, bytes, nodes, NULL, 0, NULL, NULL, 3, NULL, NULL),
            "displacement");
    REFUSED(delam_experimental_part_fields(context, size, bytes, nodes, u, 1, NULL, strains, 3, NULL, NULL), "bodies");
    REFUSED(delam_experimental_part_fields(context, size, bytes, nodes, u, 1, labels, NULL, 3, NULL, NULL),
            "eigenstrains");
    REFUSED(delam_experimental_part_fields(context, size, bytes, nodes, u, 2, labels, strains, 3, NULL, NULL),
            "bodies[1]");
    REFUSED(delam_experimental_part_fields(context, size, bytes, nodes, u, 1, negative, strains, 3, NULL, NULL),
            "bodies[0]");

    /* solvers */
    expect(delam_experimental_solver_recover(solver), DELAM_ERROR_STATE, "engine", "recover without an engine");
    for (int i = 0; i < 3; ++i)
        REFUSED(delam_experimental_solver_eigenstrains(solver, hostile[i], NULL, NULL, &count), "capacity");
    for (int i = 0; i < 5; ++i) {
        REFUSED(delam_experimental_solver_follow(solver, hostile[i], NULL, keys[0], &parameter), "interface_count");
        REFUSED(delam_experimental_solver_follow(solver, hostile[i], zero, keys[0], &parameter), "interface_count");
        list[0] = hostile[i];
        REFUSED(delam_experimental_solver_follow(solver, 1, list, keys[0], &parameter), "interfaces[0]");
        if (hostile[i] < 0)
            REFUSED(delam_experimental_solver_sensitivity(solver, hostile[i], NULL, &unknown), "matrix");
    }
    REFUSED(delam_experimental_solver_follow(solver, 0, zero, keys[0], &parameter), "interface_count");
    REFUSED(delam_experimental_solver_follow(solver, 2, zero, keys[0], &parameter), "interface_count");
    REFUSED(delam_experimental_solver_follow(solver, 1, NULL, keys[0], &parameter), "interfaces");
    REFUSED(delam_experimental_solver_follow(solver, 1, zero, NULL, &parameter), "key");
    REFUSED(delam_experimental_solver_follow(solver, 1, zero, "no such key", &parameter), "no such key");
    REFUSED(delam_experimental_solver_follow(solver, 1, zero, "", &parameter), "");
    expect(delam_experimental_solver_follow(solver, 1, zero, keys[0], NULL), DELAM_OK, NULL, "follow, parameter NULL");
    expect(delam_experimental_solver_follow((delam_solver *)(void *)law, 1, zero, keys[0], NULL), DELAM_ERROR_HANDLE,
           NULL, "a law");
    fine(delam_solver_advance(solver, 1.0));
    expect(delam_experimental_solver_follow(solver, 1, zero, keys[0], NULL), DELAM_ERROR_STATE, NULL, "after a step");

    free(u);
    free(bytes);
    delam_solver_destroy(&solver);
    delam_problem_destroy(&problem);
    delam_law_destroy(&law);
    delam_mesh_destroy(&mesh);
    delam_context_destroy(&context);
    printf("%d checks, %d failures\n", checks, failures);
    return failures == 0 ? 0 : 1;
}
