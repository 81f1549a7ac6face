/* SPDX-License-Identifier: BSD-3-Clause
 * Bad input through the public header: a status, a message that names the place, and objects that stay as they were. */
#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "delam/delam.h"

static delam_context *context;
static delam_mesh *mesh;
static delam_law *law;
static delam_problem *problem;

static void expect(int32_t status, int32_t expected, const char *part) {
    const char *message = delam_context_message(context);
    ck_assert_msg(status == expected, "%s instead of %s: %s", delam_status_name(status), delam_status_name(expected),
                  message);
    ck_assert_msg(strstr(message, part) != NULL, "'%s' is not in '%s'", part, message);
}

static void fine(int32_t status) {
    ck_assert_msg(status == DELAM_OK, "%s: %s", delam_status_name(status), delam_context_message(context));
}

/* Two layers of 2 x 1 with 2 x 1 quads, one interface, materials, a law, supports at the bottom. */
static void set_up(void) {
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

static void tear_down(void) {
    delam_problem_destroy(&problem);
    delam_law_destroy(&law);
    delam_mesh_destroy(&mesh);
    delam_context_destroy(&context);
    ck_assert(problem == NULL && law == NULL && mesh == NULL && context == NULL);
}

/* Is the scene what it was? */
static char before[17];
static void remember(void) { fine(delam_problem_hash(problem, before)); }
static void unchanged(void) {
    char now[17];
    fine(delam_problem_hash(problem, now));
    ck_assert_str_eq(before, now);
}

START_TEST(handles) {
    int64_t foreign[8] = {0, 0, 0, 0, 0, 0, 0, 0};
    delam_solver *solver = (delam_solver *)(void *)foreign;
    delam_mesh *none = NULL;
    delam_problem *failed = NULL;
    ck_assert_int_eq(delam_mesh_size(NULL, NULL, NULL, NULL, NULL, NULL), DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_mesh_size((const delam_mesh *)(const void *)foreign, NULL, NULL, NULL, NULL, NULL),
                     DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_mesh_size((const delam_mesh *)(const void *)law, NULL, NULL, NULL, NULL, NULL),
                     DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_law_set(NULL, "normal_onset", 1.0), DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_problem_check(NULL), DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_context_cancel(NULL), DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_context_set_log(NULL, NULL, NULL), DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_context_create(NULL), DELAM_ERROR_ARGUMENT);
    ck_assert_ptr_nonnull(delam_context_message(NULL));
    ck_assert_ptr_null(delam_problem_pattern_name(NULL, 0));
    expect(delam_problem_create(context, NULL, &failed), DELAM_ERROR_HANDLE, "mesh is NULL");
    ck_assert_ptr_null(failed);
    expect(delam_problem_create(context, mesh, NULL), DELAM_ERROR_ARGUMENT, "out is NULL");
    ck_assert_int_eq(delam_solver_create(NULL, 0.0, &solver), DELAM_ERROR_HANDLE);
    ck_assert_ptr_null(solver);
    delam_mesh_destroy(&none);
    delam_mesh_destroy(NULL);
    delam_context_destroy(NULL);
}
END_TEST

START_TEST(any_order_of_destruction) {
    char text[17];
    delam_context_destroy(&context);
    delam_mesh_destroy(&mesh);
    ck_assert_int_eq(delam_problem_check(problem), DELAM_OK);
    ck_assert_int_eq(delam_problem_hash(problem, text), DELAM_OK);
    ck_assert_int_eq(delam_problem_set_elastic(problem, 0, -1.0, 0.3), DELAM_ERROR_ARGUMENT);
    delam_problem_destroy(&problem);
    ck_assert_int_eq(delam_law_check(law), DELAM_OK);
}
END_TEST

START_TEST(constants) {
    int64_t i;
    const char *key = NULL;
    ck_assert_str_eq(delam_version(), "0.2.0");
    ck_assert(strlen(delam_commit()) > 0);
    ck_assert_int_eq(delam_abi(), DELAM_ABI);
    ck_assert_str_eq(delam_status_name(DELAM_ERROR_MESH), "DELAM_ERROR_MESH");
    ck_assert_str_eq(delam_status_name(77), "unknown status");
    ck_assert_int_gt(delam_option_count(), 0);
    for (i = 0; i < delam_option_count(); ++i)
        ck_assert_int_eq(delam_option_info(i, &key, NULL, NULL, NULL, NULL, NULL), DELAM_OK);
    ck_assert_int_eq(delam_option_info(i, &key, NULL, NULL, NULL, NULL, NULL), DELAM_ERROR_ARGUMENT);
    ck_assert_int_eq(delam_option_info(-1, &key, NULL, NULL, NULL, NULL, NULL), DELAM_ERROR_ARGUMENT);
}
END_TEST

/* The constants of the header with their names, and what the comment above them says of nodes. */
START_TEST(cell_types) {
    const struct {
        const char *name;
        int32_t type, dimension, nodes, corners, faces, face_nodes, face_corners;
    } known[] = {{"tri3", DELAM_TRI3, 2, 3, 3, 3, 2, 2},   {"quad4", DELAM_QUAD4, 2, 4, 4, 4, 2, 2},
                 {"tet4", DELAM_TET4, 3, 4, 4, 4, 3, 3},   {"hex8", DELAM_HEX8, 3, 8, 8, 6, 4, 4},
                 {"tri6", DELAM_TRI6, 2, 6, 3, 3, 3, 2},   {"quad8", DELAM_QUAD8, 2, 8, 4, 4, 3, 2},
                 {"quad9", DELAM_QUAD9, 2, 9, 4, 4, 3, 2}, {"tet10", DELAM_TET10, 3, 10, 4, 4, 6, 3},
                 {"hex20", DELAM_HEX20, 3, 20, 8, 6, 8, 4}};
    const int32_t tet10[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    const int64_t count = (int64_t)(sizeof known / sizeof known[0]);
    const char *name = NULL;
    int32_t face[6 * 8];
    int32_t middle[12 * 2];
    int32_t i, k, found[7];
    ck_assert_int_eq(delam_cell_type_count(), count);
    for (i = 0; i < count; ++i) {
        ck_assert_int_eq(
            delam_cell_type_info(i, &name, &found[0], &found[1], &found[2], &found[3], &found[4], &found[5], &found[6]),
            DELAM_OK);
        ck_assert_str_eq(name, known[i].name);
        ck_assert_mem_eq(found, &known[i].type, sizeof found);
        ck_assert_int_eq(delam_cell_type_info(i, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL), DELAM_OK);
        ck_assert_int_eq(delam_cell_type_topology(i, NULL, NULL), DELAM_OK);
        ck_assert_int_eq(delam_cell_type_topology(i, face, middle), DELAM_OK);
        for (k = 0; k < known[i].faces * known[i].face_nodes; ++k)
            ck_assert(face[k] >= 0 && face[k] < known[i].nodes &&
                      (face[k] < known[i].corners) == (k % known[i].face_nodes < known[i].face_corners));
        for (k = 0; k < 2 * (known[i].nodes - known[i].corners); ++k)
            ck_assert(middle[k] >= 0 && middle[k] < known[i].corners);
        if (known[i].type == DELAM_TET10) ck_assert_mem_eq(middle, tet10, sizeof tet10);
    }
    for (i = -1; i <= count; i += (int32_t)count + 1) {
        ck_assert_int_eq(delam_cell_type_info(i, &name, NULL, NULL, NULL, NULL, NULL, NULL, NULL),
                         DELAM_ERROR_ARGUMENT);
        ck_assert_int_eq(delam_cell_type_topology(i, face, middle), DELAM_ERROR_ARGUMENT);
    }
}
END_TEST

START_TEST(meshes) {
    const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    const double bad[8] = {0, 0, 1, NAN, 1, 1, 0, 1};
    const int64_t good[4] = {0, 1, 2, 3};
    const int64_t inverted[4] = {0, 3, 2, 1};
    const int64_t outside[4] = {1, 2, 3, 5};
    const int64_t edge_triangle[3] = {0, 1, 2};
    const int32_t two = 2;
    const int32_t negative = -3;
    const double length = -2.0;
    const int64_t cells = 2;
    int64_t count = -1;
    int64_t index = -1;
    delam_mesh *other = NULL;
    expect(delam_mesh_create(context, 4, 4, square, &other), DELAM_ERROR_ARGUMENT, "dimension = 4");
    expect(delam_mesh_create(context, 2, 0, square, &other), DELAM_ERROR_ARGUMENT, "node_count = 0");
    expect(delam_mesh_create(context, 2, INT64_MAX, square, &other), DELAM_ERROR_ARGUMENT, "node_count = ");
    expect(delam_mesh_create(context, 2, 4, NULL, &other), DELAM_ERROR_ARGUMENT, "nodes is NULL");
    expect(delam_mesh_create(context, 2, 4, bad, &other), DELAM_ERROR_ARGUMENT, "nodes[3] = nan");
    ck_assert_ptr_null(other);
    expect(delam_mesh_create_layers(context, 2, &length, &cells, 1, square + 2, &cells, DELAM_QUAD4, &other),
           DELAM_ERROR_ARGUMENT, "lengths[0] = -2");
    expect(delam_mesh_create_layers(context, 2, square + 2, &cells, 1, square + 2, &cells, DELAM_HEX8, &other),
           DELAM_ERROR_ARGUMENT, "cell_type = 4");

    fine(delam_mesh_create(context, 2, 4, square, &other));
    expect(delam_mesh_add_cells(other, 9, 1, good, NULL, 0), DELAM_ERROR_ARGUMENT, "cell_type = 9");
    expect(delam_mesh_add_cells(other, DELAM_QUAD4, 1, inverted, NULL, 0), DELAM_ERROR_MESH, "");
    expect(delam_mesh_add_cells(other, DELAM_QUAD4, 1, outside, NULL, 1), DELAM_ERROR_ARGUMENT,
           "cell 1 has node 5, outside 1 .. 4");
    expect(delam_mesh_add_cells(other, DELAM_QUAD4, 1, good, NULL, 2), DELAM_ERROR_ARGUMENT, "index_base = 2");
    expect(delam_mesh_add_cells(other, DELAM_QUAD4, 1, good, &negative, 0), DELAM_ERROR_ARGUMENT, "bodies[0] = -3");
    fine(delam_mesh_size(other, NULL, NULL, &count, NULL, NULL));
    ck_assert_int_eq(count, 0);
    fine(delam_mesh_add_cells(other, DELAM_QUAD4, 1, good, NULL, 0));
    expect(delam_mesh_add_cells(other, DELAM_TRI3, 1, edge_triangle, &two, 0), DELAM_ERROR_MESH, "node");
    fine(delam_mesh_size(other, NULL, NULL, &count, NULL, NULL));
    ck_assert_int_eq(count, 1);
    expect(delam_mesh_add_interface(other, 0, 5, 0.0, &index), DELAM_ERROR_ARGUMENT, "body_b = 5");
    expect(delam_mesh_add_interface(other, 0, 0, 0.0, &index), DELAM_ERROR_ARGUMENT, "two bodies");
    expect(delam_mesh_add_interface(mesh, 0, 1, 0.5, &index), DELAM_ERROR_ARGUMENT, "tolerance = 0.5");
    expect(delam_mesh_add_interface(mesh, 0, 1, NAN, &index), DELAM_ERROR_ARGUMENT, "tolerance = nan");
    expect(delam_mesh_interface_size(mesh, 1, NULL, NULL, NULL, NULL, NULL), DELAM_ERROR_ARGUMENT,
           "interface_index = 1");
    ck_assert_int_eq(index, -1);
    delam_mesh_destroy(&other);
}
END_TEST

START_TEST(unpaired_faces) {
    /* A square and one that lies apart; then one whose lower edge covers half of the first one's upper edge. */
    const double apart[16] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 1.5, 1, 1.5, 1, 2, 0, 2};
    const double half[16] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 1, 0.5, 1, 0.5, 2, 0, 2};
    const int64_t cells[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const int32_t bodies[2] = {0, 1};
    int64_t index = -1;
    int64_t count = -1;
    delam_mesh *other = NULL;
    fine(delam_mesh_create(context, 2, 8, apart, &other));
    fine(delam_mesh_add_cells(other, DELAM_QUAD4, 2, cells, bodies, 0));
    expect(delam_mesh_add_interface(other, 0, 1, 0.0, &index), DELAM_ERROR_MESH, "");
    delam_mesh_destroy(&other);
    fine(delam_mesh_create(context, 2, 8, half, &other));
    fine(delam_mesh_add_cells(other, DELAM_QUAD4, 2, cells, bodies, 0));
    expect(delam_mesh_add_interface(other, 0, 1, 0.0, &index), DELAM_ERROR_MESH, "");
    fine(delam_mesh_size(other, NULL, NULL, NULL, NULL, &count));
    ck_assert_int_eq(count, 0);
    delam_mesh_destroy(&other);
}
END_TEST

START_TEST(conforming_meshes) {
    /* Two squares side by side with 1-based nodes, and a triangle upon the first. */
    const double nodes[14] = {0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1, 0.5, 2};
    const int64_t squares[8] = {1, 2, 5, 4, 2, 3, 6, 5};
    const int64_t inverted[8] = {1, 2, 5, 4, 2, 5, 6, 3};
    const int64_t triangle[3] = {4, 5, 7};
    const int32_t bodies[2] = {5, 3};
    const int32_t four = 4;
    const int32_t labels[10] = {5, 5, 3, 5, 5, 3, 4, 3, 3, 4};
    int64_t origins[12];
    int32_t found[12];
    int32_t a = -1;
    int32_t b = -1;
    int64_t count = -1;
    int64_t pairs = 0;
    int64_t i;
    delam_mesh *other = NULL;
    fine(delam_mesh_create(context, 2, 7, nodes, &other));
    expect(delam_mesh_add_conforming_cells(other, DELAM_QUAD4, 2, inverted, bodies, 1), DELAM_ERROR_MESH, "body 3");
    fine(delam_mesh_size(other, NULL, &count, NULL, NULL, NULL));
    ck_assert_int_eq(count, 7);
    fine(delam_mesh_add_conforming_cells(other, DELAM_QUAD4, 2, squares, bodies, 1));
    fine(delam_mesh_add_conforming_cells(other, DELAM_TRI3, 1, triangle, &four, 1));
    expect(delam_mesh_add_conforming_cells(other, DELAM_TRI3, 1, triangle, &four, 0), DELAM_ERROR_MESH, "cell 3");
    fine(delam_mesh_size(other, NULL, &count, NULL, NULL, NULL));
    ck_assert_int_eq(count, 11);
    expect(delam_mesh_node_origins(other, 10, origins), DELAM_ERROR_ARGUMENT, "capacity 10 < 11");
    fine(delam_mesh_node_origins(other, 12, origins));
    fine(delam_mesh_node_bodies(other, 12, found));
    for (i = 0; i < 7; ++i) ck_assert_int_eq(origins[i], i);
    ck_assert(origins[7] == 1 && origins[8] == 4 && origins[9] == 3 && origins[10] == 4);
    for (i = 0; i < 10; ++i) ck_assert_int_eq(found[i], labels[i]);
    expect(delam_mesh_add_all_interfaces(other, 0.7, &count), DELAM_ERROR_ARGUMENT, "tolerance = 0.7");
    expect(delam_mesh_add_all_interfaces(other, 0.0, NULL), DELAM_ERROR_ARGUMENT, "out_count is NULL");
    fine(delam_mesh_add_all_interfaces(other, 0.0, &count));
    ck_assert_int_eq(count, 2);
    fine(delam_mesh_interface_size(other, 1, &a, &b, &pairs, NULL, NULL));
    ck_assert(a == 4 && b == 5 && pairs == 2);
    delam_mesh_destroy(&other);
}
END_TEST

START_TEST(projections_and_obstacles) {
    /* One square below two halves of another, and a node without cells. */
    const double nodes[22] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 1, 0.5, 1, 1, 1, 0, 2, 0.5, 2, 1, 2, 5, 5};
    const int64_t cells[12] = {0, 1, 2, 3, 4, 5, 8, 7, 5, 6, 9, 8};
    const int32_t bodies[3] = {0, 1, 1};
    const int64_t top[3] = {8, 9, 10};
    const double down[6] = {0, -1, 0, -1, 0, -2};
    int64_t index = -1;
    int64_t count = -1;
    int64_t entries = -1;
    int64_t tied[3];
    int64_t starts[4];
    int64_t of[4];
    double share[4];
    double weights[3];
    int32_t a = 5;
    int32_t b = 5;
    delam_mesh *other = NULL;
    fine(delam_mesh_create(context, 2, 11, nodes, &other));
    fine(delam_mesh_add_cells(other, DELAM_QUAD4, 3, cells, bodies, 0));
    expect(delam_mesh_add_projected_interface(other, 0, 1, -1.0, &index), DELAM_ERROR_ARGUMENT, "gap = -1");
    expect(delam_mesh_add_projected_interface(other, 0, 2, 0.0, &index), DELAM_ERROR_ARGUMENT, "body_b = 2");
    fine(delam_mesh_add_projected_interface(other, 0, 1, 0.0, &index));
    ck_assert_int_eq(index, 0);
    fine(delam_mesh_node_ties(other, &count, &entries, NULL, NULL, NULL, NULL));
    ck_assert(count == 3 && entries == 4);
    fine(delam_mesh_node_ties(other, NULL, NULL, tied, starts, of, share));
    ck_assert(tied[0] == 11 && tied[2] == 13 && starts[3] == 4);
    ck_assert(starts[1] == 1 && starts[2] == 3 && of[1] == 2 && of[2] == 3 && share[1] == 0.5 && share[2] == 0.5);
    expect(delam_mesh_add_obstacle(other, 3, top, down, NULL, 3, 1, &index), DELAM_ERROR_MESH, "control_node 3");
    expect(delam_mesh_add_obstacle(other, 3, top, down, NULL, 99, 1, &index), DELAM_ERROR_ARGUMENT,
           "control_node = 99");
    expect(delam_mesh_add_obstacle(other, 3, top, down, NULL, 10, 3, &index), DELAM_ERROR_ARGUMENT, "index_base = 3");
    fine(delam_mesh_add_obstacle(other, 3, top, down, NULL, 10, 1, &index));
    ck_assert_int_eq(index, 1);
    fine(delam_mesh_interface_size(other, 1, &a, &b, &count, NULL, NULL));
    ck_assert(a == -1 && b == 1 && count == 3);
    fine(delam_mesh_interface_pairs(other, 1, starts, tied, weights, NULL));
    ck_assert(starts[0] == 10 && tied[2] == 9 && weights[0] == 0.25 && weights[1] == 0.5);
    delam_mesh_destroy(&other);
}
END_TEST

START_TEST(laws) {
    const double half = 0.5;
    const double beyond = 1.5;
    const double jump[2] = {-1e-6, 0.0};
    const double nowhere[2] = {0.0, NAN};
    double out = -7.0;
    delam_law *other = NULL;
    expect(delam_law_create(context, "cubic", &other), DELAM_ERROR_ARGUMENT, "'cubic' is not known");
    expect(delam_law_create(context, NULL, &other), DELAM_ERROR_ARGUMENT, "kind is NULL");
    expect(delam_law_set(law, "stiffness", 1.0), DELAM_ERROR_ARGUMENT,
           "'stiffness' is not known; known are normal_stiffness");
    expect(delam_law_set(law, "stiffness", -1.0), DELAM_ERROR_ARGUMENT, "'stiffness' is not known");
    expect(delam_law_set(law, "normal_onset", -1.0), DELAM_ERROR_ARGUMENT,
           "'normal_onset' = -1 must be finite and > 0");
    expect(delam_law_set(law, "normal_onset", NAN), DELAM_ERROR_ARGUMENT, "'normal_onset' = nan");
    expect(delam_law_set(law, "gradient", -1.0), DELAM_ERROR_ARGUMENT, "'gradient' = -1 must be finite and >= 0");
    expect(delam_law_set(law, "gradient", INFINITY), DELAM_ERROR_ARGUMENT, "'gradient' = inf");
    fine(delam_law_set(law, "gradient", 1e-3));
    fine(delam_law_set(law, "gradient", 0.0));
    expect(delam_law_set(law, NULL, 1.0), DELAM_ERROR_ARGUMENT, "key is NULL");
    fine(delam_law_check(law));

    fine(delam_law_create(context, "piecewise-linear", &other));
    expect(delam_law_check(other), DELAM_ERROR_PROBLEM, "normal_stiffness");
    expect(delam_law_toughness(other, 1, &half, &out, NULL), DELAM_ERROR_PROBLEM, "normal_stiffness");
    delam_law_destroy(&other);

    expect(delam_law_toughness(law, 1, &beyond, &out, NULL), DELAM_ERROR_ARGUMENT, "mixity[0] = 1.5");
    expect(delam_law_respond(law, 2, 1, jump, &half, &half, &out, NULL), DELAM_ERROR_ARGUMENT, "jump[0] = -1e-06");
    expect(delam_law_respond(law, 2, 1, nowhere, &half, &half, &out, NULL), DELAM_ERROR_ARGUMENT, "jump[1] = nan");
    expect(delam_law_respond(law, 2, 1, nowhere, &half, &half, NULL, NULL), DELAM_ERROR_ARGUMENT, "");
    ck_assert_double_eq(out, -7.0);

    /* Toughness below onset at an end, and in between only. */
    fine(delam_law_set(law, "normal_toughness", 50.0));
    expect(delam_law_check(law), DELAM_ERROR_PROBLEM, "normal_toughness");
    fine(delam_law_set(law, "normal_toughness", 105.0));
    fine(delam_law_set(law, "tangential_toughness", 105.0));
    fine(delam_law_check(law));
    fine(delam_law_set(law, "toughness_exponent_1", 1.0));
    fine(delam_law_set(law, "toughness_exponent_2", 1.0));
    expect(delam_law_check(law), DELAM_ERROR_PROBLEM, "B");
    remember();
    expect(delam_problem_set_law(problem, 0, law), DELAM_ERROR_PROBLEM, "B");
    unchanged();
}
END_TEST

/* An output may lie in the place of any input, in whole or in part; outputs must not overlap each other. */
START_TEST(laws_in_place) {
    enum { points = 3 };
    const double jump[2 * points] = {4.5e-5, 1e-5, 5e-5, 4e-5, 0.0, 9e-5}, mixity[points] = {0.1, 0.5, 0.9};
    const double old[points] = {1.0, 0.5, 0.8};
    double zeta[points], traction[2 * points], onset[points], toughness[points], room[5 * points];
    int at;
    fine(delam_law_set(law, "tangential_onset", 150.0));
    fine(delam_law_set(law, "tangential_toughness", 500.0));
    fine(delam_law_respond(law, 2, points, jump, mixity, old, zeta, traction));
    fine(delam_law_toughness(law, points, mixity, onset, toughness));
    ck_assert(zeta[0] < 1.0 && zeta[0] > 0.0 && traction[1] > 0.0 && onset[1] < toughness[1]);
    for (at = 0; at <= 3 * points; ++at) {
        memcpy(room + points, jump, sizeof jump);
        fine(delam_law_respond(law, 2, points, room + points, mixity, old, zeta, room + at));
        ck_assert_mem_eq(room + at, traction, sizeof traction);
    }
    for (at = 0; at <= 4 * points; ++at) {
        memcpy(room, jump, sizeof jump);
        memcpy(room + 2 * points, mixity, sizeof mixity);
        memcpy(room + 3 * points, old, sizeof old);
        fine(delam_law_respond(law, 2, points, room, room + 2 * points, room + 3 * points, room + at, NULL));
        ck_assert_mem_eq(room + at, zeta, sizeof zeta);
        memcpy(room + points, mixity, sizeof mixity);
        fine(delam_law_toughness(law, points, room + points, room + at, NULL));
        ck_assert_mem_eq(room + at, onset, sizeof onset);
        memcpy(room + points, mixity, sizeof mixity);
        fine(delam_law_toughness(law, points, room + points, NULL, room + at));
        ck_assert_mem_eq(room + at, toughness, sizeof toughness);
    }
    for (at = 0; at < points; ++at) {
        expect(delam_law_toughness(law, points, mixity, room + at, room), DELAM_ERROR_ARGUMENT, "onset and toughness");
        expect(delam_law_respond(law, 2, points, jump, mixity, old, room + at, room), DELAM_ERROR_ARGUMENT,
               "adhesion and traction");
    }
    fine(delam_law_respond(law, 2, points, jump, mixity, old, room, room + points));
    fine(delam_law_toughness(law, points, mixity, room, room + points));
}
END_TEST

START_TEST(scenes) {
    const int64_t nodes[2] = {6, 99};
    const double fraction[2] = {0.5, 1.5};
    const int64_t pairs[2] = {0, 1};
    const int64_t cells[2] = {0, 99};
    const double axes[12] = {0, 0, 1, 1, 0, 0, 1, 0, 0, 2, 0, 0};
    const double ply[9] = {135e9, 9e9, 9e9, 0.24, 0.24, 0.46, 5.2e9, 5.2e9, 3.08e9};
    const double too_much[9] = {135e9, 9e9, 9e9, 4.0, 0.24, 0.46, 5.2e9, 5.2e9, 3.08e9};
    remember();
    expect(delam_problem_set_plane(problem, "flat"), DELAM_ERROR_ARGUMENT, "'flat' is not known");
    expect(delam_problem_set_elastic(problem, -1, -75e9, 0.3), DELAM_ERROR_ARGUMENT, "young = -7.5e+10");
    expect(delam_problem_set_elastic(problem, -1, NAN, 0.3), DELAM_ERROR_ARGUMENT, "young = nan");
    expect(delam_problem_set_elastic(problem, 0, 75e9, 0.5), DELAM_ERROR_ARGUMENT, "poisson = 0.5");
    expect(delam_problem_set_elastic(problem, 7, 75e9, 0.3), DELAM_ERROR_ARGUMENT, "body = 7");
    expect(delam_problem_set_orthotropic(problem, -1, NULL), DELAM_ERROR_ARGUMENT, "constants is NULL");
    expect(delam_problem_set_orthotropic(problem, 7, ply), DELAM_ERROR_ARGUMENT, "body = 7");
    expect(delam_problem_set_orthotropic(problem, 0, too_much), DELAM_ERROR_ARGUMENT, "nu12 = 4 is outside");
    expect(delam_problem_set_orientation(problem, 0, 2, NULL, axes, 0), DELAM_ERROR_ARGUMENT, "count = 2, not 1");
    expect(delam_problem_set_orientation(problem, 0, 1, NULL, NULL, 0), DELAM_ERROR_ARGUMENT, "axes is NULL");
    expect(delam_problem_set_orientation(problem, 0, 1, &cells[1], axes, 0), DELAM_ERROR_ARGUMENT, "cells[0] = 99");
    expect(delam_problem_set_orientation(problem, 1, 1, &cells[0], axes, 0), DELAM_ERROR_ARGUMENT, "belongs to body 0");
    expect(delam_problem_set_orientation(problem, -1, 2, cells, axes, 0), DELAM_ERROR_ARGUMENT,
           "axes[1]: axis 1 = (1, 0, 0)");
    expect(delam_problem_add_eigenstrain(problem, 0, -1, axes), DELAM_ERROR_ARGUMENT,
           "pattern = 0, but there are none");
    expect(delam_problem_set_law(problem, 4, law), DELAM_ERROR_ARGUMENT, "interface_index = 4");
    expect(delam_problem_set_law(problem, 0, NULL), DELAM_ERROR_HANDLE, "law is NULL");
    expect(delam_problem_set_adhesion(problem, 0, 2, pairs, fraction, 0), DELAM_ERROR_ARGUMENT, "adhesion[1] = 1.5");
    expect(delam_problem_set_adhesion(problem, 0, 1, nodes, fraction, 0), DELAM_ERROR_ARGUMENT,
           "pairs[0] = 6 is outside 0 .. 2");
    expect(delam_problem_set_adhesion(problem, 0, 1, pairs, fraction, 1), DELAM_ERROR_ARGUMENT,
           "pairs[0] = 0 is outside 1 .. 3");
    expect(delam_problem_set_adhesion_box(problem, 0, NULL, axes, 0.0, NULL), DELAM_ERROR_ARGUMENT, "lower is NULL");
    expect(delam_problem_set_adhesion_box(problem, 0, axes, fraction, 1.5, NULL), DELAM_ERROR_ARGUMENT,
           "adhesion = 1.5 is outside");
    expect(delam_problem_set_adhesion_box(problem, 0, axes, axes, 0.0, NULL), DELAM_ERROR_ARGUMENT,
           "no pair of interface 0 is in this box");
    expect(delam_problem_propose(problem, 0, -1.0, NULL, NULL, NULL, NULL), DELAM_ERROR_ARGUMENT, "pairs = -1");
    expect(delam_problem_set_number(problem, "tolerance", 1.0), DELAM_ERROR_ARGUMENT,
           "'tolerance' is not known; known are");
    expect(delam_problem_set_number(problem, "damage_tolerance", NAN), DELAM_ERROR_ARGUMENT,
           "'damage_tolerance' = nan");
    expect(delam_problem_set_number(problem, "subdomains", 2.5), DELAM_ERROR_ARGUMENT, "whole number");
    expect(delam_problem_set_text(problem, "scaling", "loud"), DELAM_ERROR_ARGUMENT, "stiffness | multiplicity");
    unchanged();
}
END_TEST

START_TEST(loads) {
    const double times[3] = {0.0, 1.0, 1.0};
    const double values[3] = {0.0, 1.0, 2.0};
    const double infinite[2] = {0.0, INFINITY};
    const double y[2] = {0.0, 1.0};
    const double down[2] = {0.0, -2.0};
    const double zero[2] = {0.0, 0.0};
    const double force[2] = {1.0, NAN};
    const double one = 1.0;
    const double weights[2] = {1.0, -1.0};
    const int64_t top[2] = {9, 10};
    const int64_t twice[2] = {9, 9};
    const double huge[4] = {1.7e308, 1.7e308, 1.7e308, 1.7e308};
    const int64_t corner = 0;
    int64_t pattern = -1;
    int64_t other = -1;
    int64_t unknown = 5;
    remember();
    expect(delam_problem_add_pattern(problem, "a b", 2, times, values, &pattern), DELAM_ERROR_ARGUMENT, "name = 'a b'");
    expect(delam_problem_add_pattern(problem, NULL, 2, times, values, &pattern), DELAM_ERROR_ARGUMENT, "name is NULL");
    expect(delam_problem_add_pattern(problem, "p", 0, times, values, &pattern), DELAM_ERROR_ARGUMENT, "count = 0");
    expect(delam_problem_add_pattern(problem, "p", 3, times, values, &pattern), DELAM_ERROR_ARGUMENT,
           "times[2] = 1 must be > times[1]");
    expect(delam_problem_add_pattern(problem, "p", 2, times, infinite, &pattern), DELAM_ERROR_ARGUMENT,
           "values[1] = inf");
    unchanged();
    fine(delam_problem_add_pattern(problem, "p", 2, times, values, &pattern));
    fine(delam_problem_add_pattern(problem, "q", 2, times, values, &other));
    expect(delam_problem_add_pattern(problem, "p", 2, times, values, &pattern), DELAM_ERROR_ARGUMENT,
           "'p' is already the name of another pattern");
    ck_assert_str_eq(delam_problem_pattern_name(problem, other), "q");
    ck_assert_ptr_null(delam_problem_pattern_name(problem, 2));

    remember();
    expect(delam_problem_prescribe_nodes(problem, 1, &corner, down, 0, NULL, NULL, 0), DELAM_ERROR_PROBLEM,
           "nodes[0] = 0");
    expect(delam_problem_prescribe_nodes(problem, 2, twice, y, 0, NULL, NULL, 0), DELAM_ERROR_PROBLEM, "nodes[1] = 9");
    expect(delam_problem_prescribe_nodes(problem, 1, top, zero, 0, NULL, NULL, 0), DELAM_ERROR_ARGUMENT,
           "direction has length 0");
    expect(delam_problem_prescribe_nodes(problem, 1, top, force, 0, NULL, NULL, 0), DELAM_ERROR_ARGUMENT,
           "direction[1] = nan");
    expect(delam_problem_prescribe_nodes(problem, 1, top, y, 1, &unknown, &one, 0), DELAM_ERROR_ARGUMENT,
           "patterns[0] = 5");
    expect(delam_problem_prescribe_nodes(problem, 1, top, y, 1, &pattern, force + 1, 0), DELAM_ERROR_ARGUMENT,
           "coefficients[0] = nan");
    expect(delam_problem_prescribe_nodes(problem, 1, &(int64_t){12}, y, 0, NULL, NULL, 0), DELAM_ERROR_ARGUMENT,
           "nodes[0] = 12");
    expect(delam_problem_prescribe_mean(problem, 2, top, weights, y, 0, NULL, NULL, 0), DELAM_ERROR_ARGUMENT,
           "weights: their sum is ");
    expect(delam_problem_prescribe_mean(problem, 2, twice, values + 1, y, 0, NULL, NULL, 0), DELAM_ERROR_ARGUMENT,
           "node 9 is listed twice");
    expect(delam_problem_prescribe_mean(problem, 2, top, huge, y, 0, NULL, NULL, 0), DELAM_ERROR_ARGUMENT,
           "weights: their sum is inf");
    expect(delam_problem_add_equation(problem, 2, twice, huge, 0, NULL, NULL, 0), DELAM_ERROR_ARGUMENT,
           "a coefficient of node 9 amounts to inf");
    expect(delam_problem_add_forces(problem, pattern, 1, top, force, 0), DELAM_ERROR_ARGUMENT, "forces[1] = nan");
    unchanged();
    fine(delam_problem_prescribe_nodes(problem, 1, top, down, 1, &pattern, &one, 0));
    expect(delam_problem_add_forces(problem, pattern, 1, top, y, 0), DELAM_ERROR_PROBLEM,
           "pattern 'p' drives prescribed displacements");
    expect(delam_problem_check(problem), DELAM_ERROR_PROBLEM, "pattern 'q' drives neither");
    fine(delam_problem_add_forces(problem, other, 1, top + 1, y, 0));
    expect(delam_problem_prescribe_nodes(problem, 1, top + 1, y, 1, &other, &one, 0), DELAM_ERROR_PROBLEM,
           "pattern 'q' drives forces");
    fine(delam_problem_check(problem));
}
END_TEST

START_TEST(missing_parts) {
    const double y[2] = {0.0, 1.0};
    const int64_t corners[2] = {0, 2};
    delam_problem *bare = NULL;
    delam_solver *solver = NULL;
    fine(delam_problem_create(context, mesh, &bare));
    expect(delam_problem_check(bare), DELAM_ERROR_PROBLEM, "body 0: no material");
    fine(delam_problem_set_elastic(bare, -1, 1.0, 0.3));
    expect(delam_problem_check(bare), DELAM_ERROR_PROBLEM, "interface 0: no law");
    fine(delam_problem_set_bonded(bare, 0));
    expect(delam_problem_check(bare), DELAM_ERROR_PROBLEM, "missing support");
    fine(delam_problem_prescribe_nodes(bare, 2, corners, y, 0, NULL, NULL, 0));
    expect(delam_problem_check(bare), DELAM_ERROR_PROBLEM, "bodies 0, 1 can translate along x");
    expect(delam_solver_create(bare, 0.0, &solver), DELAM_ERROR_PROBLEM, "translate along x");
    ck_assert_ptr_null(solver);
    delam_problem_destroy(&bare);
}
END_TEST

START_TEST(problem_keeps_its_own_mesh) {
    const double lower[2] = {0.0, 0.0};
    const double upper[2] = {2.0, 0.0};
    int64_t found[2] = {-1, -1};
    int64_t count = 0;
    int64_t dual = 0;
    int64_t primal = 0;
    int64_t index = -1;
    const double length = 2.0;
    const int64_t cells = 2;
    const double thickness[2] = {1.0, 1.0};
    const int64_t layer_cells[2] = {1, 1};
    delam_mesh *growing = NULL;
    delam_problem *early = NULL;
    fine(delam_mesh_create_layers(context, 2, &length, &cells, 2, thickness, layer_cells, DELAM_TRI3, &growing));
    fine(delam_problem_create(context, growing, &early));
    fine(delam_mesh_add_interface(growing, 0, 1, 0.0, &index));
    fine(delam_problem_dofs(early, &primal, &dual));
    ck_assert_int_eq(primal, 24);
    ck_assert_int_eq(dual, 0);
    delam_mesh_destroy(&growing);
    delam_problem_destroy(&early);
    fine(delam_mesh_find_nodes(mesh, 0, lower, upper, 2, found, &count));
    ck_assert(count == 3 && found[0] == 0 && found[1] == 1);
    expect(delam_mesh_find_nodes(mesh, 0, upper, lower, 2, found, &count), DELAM_ERROR_ARGUMENT,
           "lower[0] = 2 > upper[0] = 0");
}
END_TEST

START_TEST(exports) {
    int64_t rows = 0;
    int64_t entries = 0;
    int64_t patterns = -1;
    int64_t *starts;
    int64_t *columns;
    double *values;
    double *again;
    int64_t i;
    double forces[24];
    char first[17];
    char second[17];
    const double ply[9] = {135e9, 9e9, 9e9, 0.24, 0.24, 0.46, 5.2e9, 5.2e9, 3.08e9};
    const double along_x[6] = {1, 0, 0, 0, 1, 0};
    const double out_of_plane[6] = {0, 0, 2, 1, 0, 0};
    fine(delam_problem_body_matrix(problem, 1, &rows, &entries, NULL, NULL, NULL));
    ck_assert_int_eq(rows, 12);
    starts = malloc((size_t)(rows + 1) * sizeof *starts);
    columns = malloc((size_t)entries * sizeof *columns);
    values = malloc((size_t)entries * sizeof *values);
    again = malloc((size_t)entries * sizeof *again);
    ck_assert(starts != NULL && columns != NULL && values != NULL && again != NULL);
    fine(delam_problem_body_matrix(problem, 1, &rows, &entries, starts, columns, values));
    ck_assert_int_eq(starts[rows], entries);
    /* The stiffness follows the material, whatever was asked for before. */
    fine(delam_problem_set_elastic(problem, 1, 150e9, 0.3));
    fine(delam_problem_body_matrix(problem, 1, NULL, NULL, NULL, NULL, again));
    for (i = 0; i < entries; ++i) ck_assert_double_eq_tol(again[i], 2.0 * values[i], 1e-3);
    /* And its axes: with axis 1 out of the plane, x and y are alike. */
    fine(delam_problem_set_orthotropic(problem, 1, ply));
    fine(delam_problem_set_orientation(problem, 1, 1, NULL, out_of_plane, 0));
    fine(delam_problem_hash(problem, first));
    fine(delam_problem_body_matrix(problem, 1, NULL, NULL, NULL, NULL, values));
    fine(delam_problem_set_orientation(problem, 1, 1, NULL, along_x, 0));
    fine(delam_problem_hash(problem, second));
    fine(delam_problem_body_matrix(problem, 1, NULL, NULL, NULL, NULL, again));
    ck_assert_str_ne(first, second);
    ck_assert(again[0] > 3.0 * values[0]);
    free(starts);
    free(columns);
    free(values);
    free(again);
    expect(delam_problem_body_matrix(problem, 3, &rows, &entries, NULL, NULL, NULL), DELAM_ERROR_ARGUMENT, "body = 3");
    fine(delam_problem_constraints(problem, &rows, &entries, &patterns, NULL, NULL, NULL, NULL));
    ck_assert(rows == 3 && entries == 3 && patterns == 0);
    expect(delam_problem_forces(problem, 0, 24, forces), DELAM_ERROR_ARGUMENT, "pattern = 0, but there are none");
    expect(delam_problem_factors(problem, NAN, 0, NULL), DELAM_ERROR_ARGUMENT, "time = nan");
    fine(delam_problem_factors(problem, 0.0, 0, NULL));
    expect(delam_mesh_nodes(mesh, 23, forces), DELAM_ERROR_ARGUMENT, "capacity 23 < 24");
}
END_TEST

/* The plan: words and items say the same, each with a reason; a law of exponents 1 needs no mixity, a bonded
 * interface no contact. */
START_TEST(plans) {
    static const char *const exponents[] = {"onset_exponent_1", "onset_exponent_2", "toughness_exponent_1",
                                            "toughness_exponent_2"};
    delam_solver *solver = NULL;
    const char *words;
    int64_t count = -1;
    int64_t i;
    int round;
    double number = -1.0;
    for (round = 0; round < 3; ++round) {
        int contact = 0;
        int mixity = 0;
        if (round == 1) {
            for (i = 0; i < 4; ++i) fine(delam_law_set(law, exponents[i], 1.0));
            fine(delam_problem_set_law(problem, 0, law));
        }
        if (round == 2) {
            fine(delam_problem_set_text(problem, "mixity", "always"));
            fine(delam_problem_set_text(problem, "contact", "always"));
        }
        fine(delam_solver_create(problem, 0.0, &solver));
        words = delam_solver_plan(solver);
        fine(delam_solver_plan_count(solver, &count));
        ck_assert_int_gt(count, 5);
        for (i = 0; i < count; ++i) {
            const char *subject = NULL;
            const char *decision = NULL;
            const char *reason = NULL;
            const char *unit = NULL;
            double cost = -1.0;
            double saving = -1.0;
            int used;
            fine(delam_solver_plan_item(solver, i, &subject, &decision, &reason, &cost, &saving, &unit));
            fine(delam_solver_plan_item(solver, i, NULL, NULL, NULL, NULL, NULL, NULL));
            used = strcmp(decision, "used") == 0;
            ck_assert(used || strcmp(decision, "left out") == 0);
            ck_assert(strlen(reason) > 0 && strlen(unit) > 0 && cost >= 0.0 && (used || cost == 0.0));
            ck_assert(strstr(words, subject) != NULL && strstr(words, reason) != NULL);
            if (strcmp(subject, "contact of interface 0") == 0) contact += used ? 1 : 100;
            if (strcmp(subject, "mixity of interface 0") == 0) mixity += used ? 1 : 100;
        }
        ck_assert_int_eq(contact, 1);
        ck_assert_int_eq(mixity, round == 1 ? 100 : 1);
        expect(delam_solver_plan_item(solver, count, NULL, NULL, NULL, NULL, NULL, NULL), DELAM_ERROR_ARGUMENT,
               "plan index");
        expect(delam_solver_plan_item(solver, -1, NULL, NULL, NULL, NULL, NULL, NULL), DELAM_ERROR_ARGUMENT,
               "plan index -1");
        expect(delam_solver_plan_count(solver, NULL), DELAM_ERROR_ARGUMENT, "count");
        fine(delam_solver_value(solver, "bulk_factorisations", &number));
        ck_assert(number == 1.0);
        fine(delam_solver_value(solver, "field_recoveries", &number));
        ck_assert(number == 0.0);
        delam_solver_destroy(&solver);
    }
    ck_assert_int_eq(delam_solver_plan_count(NULL, &count), DELAM_ERROR_HANDLE);
    ck_assert_int_eq(delam_solver_plan_item(NULL, 0, NULL, NULL, NULL, NULL, NULL, NULL), DELAM_ERROR_HANDLE);
}
END_TEST

static void count_lines(int32_t level, const char *text, void *user) {
    if (level == 0 && strstr(text, "young") != NULL) ++*(int *)user;
}

START_TEST(log_hears_of_errors) {
    int lines = 0;
    fine(delam_context_set_log(context, count_lines, &lines));
    ck_assert_int_eq(delam_problem_set_elastic(problem, 0, 0.0, 0.3), DELAM_ERROR_ARGUMENT);
    ck_assert_int_eq(lines, 1);
    fine(delam_context_set_log(context, NULL, NULL));
    ck_assert_int_eq(delam_problem_set_elastic(problem, 0, 0.0, 0.3), DELAM_ERROR_ARGUMENT);
    ck_assert_int_eq(lines, 1);
}
END_TEST

static void keep_line(int32_t level, const char *text, void *user) {
    if (level == 1) snprintf((char *)user, 200, "%s", text);
}

/* Pairs at 0, 1, 2: a side between two of them is told to the log, one on a pair is not. */
START_TEST(log_hears_of_moved_tips) {
    const double lower[2] = {0.0, 0.0};
    double upper[2] = {1.0, 2.0};
    char line[200] = "";
    int64_t count = -1;
    fine(delam_context_set_log(context, keep_line, line));
    fine(delam_problem_set_adhesion_box(problem, 0, lower, upper, 0.0, &count));
    ck_assert_str_eq(line, "");
    ck_assert_int_eq(count, 1);
    upper[0] = 1.25;
    fine(delam_problem_set_adhesion_box(problem, 0, lower, upper, 0.0, &count));
    ck_assert_str_eq(line,
                     "interface 0: the box ends at x = 1.25, between two pairs: the tip of the crack is the next pair, "
                     "at 2");
    ck_assert_int_eq(count, 2);
    fine(delam_context_set_log(context, NULL, NULL));
}
END_TEST

int main(void) {
    int failed;
    Suite *suite = suite_create("capi");
    TCase *tests = tcase_create("capi");
    SRunner *runner;
    tcase_add_checked_fixture(tests, set_up, tear_down);
    tcase_add_test(tests, handles);
    tcase_add_test(tests, any_order_of_destruction);
    tcase_add_test(tests, constants);
    tcase_add_test(tests, cell_types);
    tcase_add_test(tests, meshes);
    tcase_add_test(tests, unpaired_faces);
    tcase_add_test(tests, conforming_meshes);
    tcase_add_test(tests, projections_and_obstacles);
    tcase_add_test(tests, laws);
    tcase_add_test(tests, laws_in_place);
    tcase_add_test(tests, scenes);
    tcase_add_test(tests, loads);
    tcase_add_test(tests, missing_parts);
    tcase_add_test(tests, problem_keeps_its_own_mesh);
    tcase_add_test(tests, exports);
    tcase_add_test(tests, plans);
    tcase_add_test(tests, log_hears_of_errors);
    tcase_add_test(tests, log_hears_of_moved_tips);
    suite_add_tcase(suite, tests);
    runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
