/* SPDX-License-Identifier: BSD-3-Clause
 * Bad input through the public header: laws, problems, what is exported, and what the log hears. */
#include <math.h>
#include <stdlib.h>

#include "capi_scene.h"

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

int main(void) {
    const TTest *const all[] = {laws,
                                laws_in_place,
                                scenes,
                                loads,
                                missing_parts,
                                problem_keeps_its_own_mesh,
                                exports,
                                plans,
                                log_hears_of_errors,
                                log_hears_of_moved_tips};
    return run_tests(all, (int)(sizeof all / sizeof all[0]));
}
