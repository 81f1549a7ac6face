/* SPDX-License-Identifier: BSD-3-Clause
 * Bad input through the public header: a status, a message that names the place, and objects that stay as they were.
 * Handles, cell types and meshes. */
#include <math.h>
#include <stdlib.h>

#include "capi_scene.h"

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

/* The constants of the header with their names, and what the comment above them says of nodes. */
START_TEST(cell_types) {
    const struct {
        const char *name;
        int32_t type, dimension, nodes, corners, faces, face_nodes, face_corners;
    } known[] = {{"tri3", DELAM_TRI3, 2, 3, 3, 3, 2, 2},       {"quad4", DELAM_QUAD4, 2, 4, 4, 4, 2, 2},
                 {"tet4", DELAM_TET4, 3, 4, 4, 4, 3, 3},       {"hex8", DELAM_HEX8, 3, 8, 8, 6, 4, 4},
                 {"tri6", DELAM_TRI6, 2, 6, 3, 3, 3, 2},       {"quad8", DELAM_QUAD8, 2, 8, 4, 4, 3, 2},
                 {"quad9", DELAM_QUAD9, 2, 9, 4, 4, 3, 2},     {"tet10", DELAM_TET10, 3, 10, 4, 4, 6, 3},
                 {"hex20", DELAM_HEX20, 3, 20, 8, 6, 8, 4},    {"hex27", DELAM_HEX27, 3, 27, 8, 6, 9, 4},
                 {"wedge6", DELAM_WEDGE6, 3, 6, 6, 5, 4, 4},   {"pyramid5", DELAM_PYRAMID5, 3, 5, 5, 5, 4, 4},
                 {"wedge15", DELAM_WEDGE15, 3, 15, 6, 5, 8, 4}};
    const int32_t wedge6[5 * 4] = {3, 5, 4, -1, 0, 1, 2, -1, 3, 4, 1, 0, 4, 5, 2, 1, 5, 3, 0, 2};
    const int32_t tet10[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    const int64_t count = (int64_t)(sizeof known / sizeof known[0]);
    const char *name = NULL;
    int32_t face[6 * 9];
    int32_t middle[19 * 2];
    int32_t i, k, f, found[7];
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
        for (f = 0; f < known[i].faces; ++f) { /* corners, then the others, then -1 where the face has fewer nodes */
            int32_t corners = 0, nodes = 0;
            const int32_t *own = face + f * known[i].face_nodes;
            while (corners < known[i].face_nodes && own[corners] >= 0 && own[corners] < known[i].corners) ++corners;
            for (nodes = corners; nodes < known[i].face_nodes && own[nodes] >= 0; ++nodes)
                ck_assert(own[nodes] >= known[i].corners && own[nodes] < known[i].nodes);
            for (k = nodes; k < known[i].face_nodes; ++k) ck_assert_int_eq(own[k], -1);
            ck_assert(corners == known[i].face_corners || (known[i].corners < 7 && corners == 3));
            ck_assert(nodes == corners || nodes >= 2 * corners - 1);
        }
        if (known[i].type == DELAM_WEDGE6) ck_assert_mem_eq(face, wedge6, sizeof wedge6);
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
    expect(delam_mesh_add_seams(other, 0.7, &count), DELAM_ERROR_ARGUMENT, "tolerance");
    expect(delam_mesh_add_seams(other, -1.0, &count), DELAM_ERROR_ARGUMENT, "tolerance");
    expect(delam_mesh_add_seams(other, 0.0, NULL), DELAM_ERROR_ARGUMENT, "out_count is NULL");
    fine(delam_mesh_add_seams(other, 0.0, &count));
    ck_assert_int_eq(count, 0);
    delam_mesh_destroy(&other);
}

/* Three rows of four cells, without the last two of the middle row: the walls of this slot are 1 apart. */
START_TEST(walls_of_a_slot) {
    const int64_t corners[10] = {0, 1, 2, 3, 5, 6, 10, 11, 12, 13};
    double nodes[40];
    int64_t cells[40];
    int64_t count = -1;
    int64_t size = -1;
    int32_t a = 5;
    int32_t b = 5;
    int i;
    delam_mesh *other = NULL;
    for (i = 0; i < 20; ++i) {
        nodes[2 * i] = i % 5;
        nodes[2 * i + 1] = (double)(i / 5);
    }
    for (i = 0; i < 10; ++i) {
        cells[4 * i] = corners[i];
        cells[4 * i + 1] = corners[i] + 1;
        cells[4 * i + 2] = corners[i] + 6;
        cells[4 * i + 3] = corners[i] + 5;
    }
    fine(delam_mesh_create(context, 2, 20, nodes, &other));
    fine(delam_mesh_add_cells(other, DELAM_QUAD4, 10, cells, NULL, 0));
    expect(delam_mesh_add_self_contact(other, 0.0, &count), DELAM_ERROR_ARGUMENT, "gap = 0");
    expect(delam_mesh_add_self_contact(other, -1.0, &count), DELAM_ERROR_ARGUMENT, "gap = -1");
    expect(delam_mesh_add_self_contact(other, NAN, &count), DELAM_ERROR_ARGUMENT, "gap = nan");
    expect(delam_mesh_add_self_contact(other, INFINITY, &count), DELAM_ERROR_ARGUMENT, "gap = inf");
    expect(delam_mesh_add_self_contact(other, 1.1, NULL), DELAM_ERROR_ARGUMENT, "out_count is NULL");
    ck_assert_int_eq(delam_mesh_add_self_contact(NULL, 1.1, &count), DELAM_ERROR_HANDLE);
    fine(delam_mesh_add_self_contact(other, 0.5, &count));
    ck_assert_int_eq(count, 0);
    fine(delam_mesh_size(other, NULL, &size, NULL, NULL, &count));
    ck_assert(size == 20 && count == 0);
    fine(delam_mesh_add_self_contact(other, 1.1, &count));
    ck_assert_int_eq(count, 1);
    fine(delam_mesh_interface_size(other, 0, &a, &b, &size, NULL, NULL));
    ck_assert(a == 0 && b == 0 && size > 0);
    delam_mesh_destroy(&other);
}

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
    expect(delam_mesh_add_mortar_interface(other, 0, 1, -1.0, &index), DELAM_ERROR_ARGUMENT, "gap = -1");
    expect(delam_mesh_add_mortar_interface(other, 0, 2, 0.0, &index), DELAM_ERROR_ARGUMENT, "body_b = 2");
    fine(delam_mesh_add_projected_interface(other, 0, 1, 0.0, &index));
    expect(delam_mesh_add_mortar_interface(other, 0, 1, 0.0, &index), DELAM_ERROR_ARGUMENT, "joined");
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

int main(void) {
    const TTest *const all[] = {
        handles,         any_order_of_destruction, constants, cell_types, meshes, unpaired_faces, conforming_meshes,
        walls_of_a_slot, projections_and_obstacles};
    return run_tests(all, (int)(sizeof all / sizeof all[0]));
}
