/* SPDX-License-Identifier: BSD-3-Clause
 * delam.h of the baseline, without its comments. Written by update.sh. */
#ifndef DELAM_DELAM_H
#define DELAM_DELAM_H
#include <stdint.h>
#if defined(__GNUC__)
#define DELAM_API __attribute__((visibility("default")))
#else
#define DELAM_API
#endif
#ifdef __cplusplus
extern "C" {
#endif
#define DELAM_ABI 1
#define DELAM_OK 0
#define DELAM_NOT_CONVERGED 1
#define DELAM_CANCELLED 2
#define DELAM_LIMIT 3
#define DELAM_ERROR_ARGUMENT -1
#define DELAM_ERROR_HANDLE -2
#define DELAM_ERROR_MESH -3
#define DELAM_ERROR_PROBLEM -4
#define DELAM_ERROR_STATE -5
#define DELAM_ERROR_MEMORY -6
#define DELAM_ERROR_NUMERICAL -7
#define DELAM_ERROR_SNAPSHOT -8
#define DELAM_ERROR_INTERNAL -9
#define DELAM_ERROR_FILE -10
typedef struct delam_context delam_context;
typedef struct delam_mesh delam_mesh;
typedef struct delam_law delam_law;
typedef struct delam_problem delam_problem;
typedef struct delam_solver delam_solver;
DELAM_API const char *delam_version(void);
DELAM_API const char *delam_commit(void);
DELAM_API int32_t delam_abi(void);
DELAM_API const char *delam_status_name(int32_t status);
DELAM_API int32_t delam_blas_threads(void);
typedef void (*delam_log_callback)(int32_t level, const char *text, void *user);
typedef int32_t (*delam_progress_callback)(const char *stage, int64_t done, int64_t total, void *user);
DELAM_API int32_t delam_context_create(delam_context **out);
DELAM_API void delam_context_destroy(delam_context **context);
DELAM_API const char *delam_context_message(const delam_context *context);
DELAM_API int32_t delam_context_set_log(delam_context *context, delam_log_callback callback, void *user);
DELAM_API int32_t delam_context_set_progress(delam_context *context, delam_progress_callback callback, void *user);
DELAM_API int32_t delam_context_cancel(delam_context *context);
#define DELAM_TRI3 1
#define DELAM_QUAD4 2
#define DELAM_TET4 3
#define DELAM_HEX8 4
#define DELAM_TRI6 5
#define DELAM_QUAD8 6
#define DELAM_QUAD9 7
#define DELAM_TET10 8
#define DELAM_HEX20 9
#define DELAM_HEX27 10
#define DELAM_WEDGE6 11
#define DELAM_PYRAMID5 12
#define DELAM_WEDGE15 13
DELAM_API int64_t delam_cell_type_count(void);
DELAM_API int32_t delam_cell_type_info(int64_t index, const char **name, int32_t *cell_type, int32_t *dimension,
                                       int32_t *nodes, int32_t *corners, int32_t *faces, int32_t *face_nodes,
                                       int32_t *face_corners);
DELAM_API int32_t delam_cell_type_topology(int64_t index, int32_t *face, int32_t *middle);
DELAM_API int32_t delam_mesh_create(delam_context *context, int32_t dimension, int64_t node_count, const double *nodes,
                                    delam_mesh **out);
DELAM_API int32_t delam_mesh_create_layers(delam_context *context, int32_t dimension, const double *lengths,
                                           const int64_t *divisions, int64_t layer_count, const double *thickness,
                                           const int64_t *layer_divisions, int32_t cell_type, delam_mesh **out);
DELAM_API int32_t delam_mesh_add_cells(delam_mesh *mesh, int32_t cell_type, int64_t cell_count,
                                       const int64_t *connectivity, const int32_t *bodies, int32_t index_base);
DELAM_API int32_t delam_mesh_add_conforming_cells(delam_mesh *mesh, int32_t cell_type, int64_t cell_count,
                                                  const int64_t *connectivity, const int32_t *bodies,
                                                  int32_t index_base);
DELAM_API int32_t delam_mesh_add_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double tolerance,
                                           int64_t *out_interface);
DELAM_API int32_t delam_mesh_add_all_interfaces(delam_mesh *mesh, double tolerance, int64_t *out_count);
DELAM_API int32_t delam_mesh_add_seams(delam_mesh *mesh, double tolerance, int64_t *out_count);
DELAM_API int32_t delam_mesh_add_self_contact(delam_mesh *mesh, double gap, int64_t *out_count);
DELAM_API int32_t delam_mesh_add_projected_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double gap,
                                                     int64_t *out_interface);
DELAM_API int32_t delam_mesh_add_mortar_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double gap,
                                                  int64_t *out_interface);
DELAM_API int32_t delam_mesh_add_obstacle(delam_mesh *mesh, int64_t count, const int64_t *nodes, const double *normals,
                                          const double *weights, int64_t control_node, int32_t index_base,
                                          int64_t *out_interface);
DELAM_API int32_t delam_mesh_add_host_body(delam_mesh *mesh, int32_t body, int64_t count, const int64_t *nodes,
                                           int32_t index_base);
DELAM_API int32_t delam_mesh_add_pairs(delam_mesh *mesh, int32_t body_a, int32_t body_b, int64_t count,
                                       const int64_t *nodes_a, const int64_t *nodes_b, const double *normals,
                                       const double *weights, int64_t face_count, int32_t nodes_per_face,
                                       const int64_t *faces, int32_t index_base, int64_t *out_interface);
DELAM_API void delam_mesh_destroy(delam_mesh **mesh);
DELAM_API int32_t delam_mesh_size(const delam_mesh *mesh, int32_t *dimension, int64_t *node_count, int64_t *cell_count,
                                  int64_t *body_count, int64_t *interface_count);
DELAM_API int32_t delam_mesh_nodes(const delam_mesh *mesh, int64_t capacity, double *nodes);
DELAM_API int32_t delam_mesh_node_bodies(const delam_mesh *mesh, int64_t capacity, int32_t *bodies);
DELAM_API int32_t delam_mesh_node_origins(const delam_mesh *mesh, int64_t capacity, int64_t *origins);
DELAM_API int32_t delam_mesh_node_ties(const delam_mesh *mesh, int64_t *count, int64_t *entries, int64_t *nodes,
                                       int64_t *starts, int64_t *of, double *weights);
DELAM_API int32_t delam_mesh_cells(const delam_mesh *mesh, int32_t *types, int32_t *bodies, int64_t *offsets,
                                   int64_t capacity, int64_t *connectivity, int64_t *needed);
DELAM_API int32_t delam_mesh_interface_size(const delam_mesh *mesh, int64_t interface_index, int32_t *body_a,
                                            int32_t *body_b, int64_t *pair_count, int64_t *face_count,
                                            int32_t *nodes_per_face);
DELAM_API int32_t delam_mesh_interface_pairs(const delam_mesh *mesh, int64_t interface_index, int64_t *nodes_a,
                                             int64_t *nodes_b, double *weights, double *frames);
DELAM_API int32_t delam_mesh_interface_faces(const delam_mesh *mesh, int64_t interface_index, int64_t *faces);
DELAM_API int32_t delam_mesh_find_nodes(const delam_mesh *mesh, int32_t body, const double *lower, const double *upper,
                                        int64_t capacity, int64_t *nodes, int64_t *count);
DELAM_API int32_t delam_mesh_find_patch(const delam_mesh *mesh, int32_t body, const double *lower, const double *upper,
                                        const double *direction, int64_t capacity, int64_t *nodes, double *weights,
                                        int64_t *count);
DELAM_API int32_t delam_law_create(delam_context *context, const char *kind, delam_law **out);
DELAM_API int32_t delam_law_set(delam_law *law, const char *key, double value);
DELAM_API int32_t delam_law_set_text(delam_law *law, const char *key, const char *value);
DELAM_API int32_t delam_law_set_table(delam_law *law, int64_t count, const double *xi, const double *s);
DELAM_API int64_t delam_law_parameter_count(const char *kind);
DELAM_API int32_t delam_law_parameter_info(const char *kind, int64_t index, const char **key, const char **type,
                                           const char **unit, const char **initial, const char **range,
                                           const char **meaning);
DELAM_API int32_t delam_law_parameter_bounds(const char *kind, int64_t index, double *lower, double *upper,
                                             int32_t *lower_open, int32_t *upper_open);
DELAM_API int64_t delam_law_kind_count(void);
DELAM_API int32_t delam_law_kind_info(int64_t index, const char **kind, const char **meaning, int32_t *hosted);
typedef int32_t (*delam_adhesion_callback)(double mixity, double driving, double *adhesion, double *slope, void *user);
typedef int32_t (*delam_dissipation_callback)(double mixity, double adhesion, double *dissipated, double *slope,
                                              double *mixity_slope, void *user);
DELAM_API int32_t delam_law_create_host(delam_context *context, const char *name, delam_adhesion_callback adhesion,
                                        delam_dissipation_callback dissipation, void *user, delam_law **out);
DELAM_API int32_t delam_law_check(const delam_law *law);
DELAM_API int32_t delam_law_toughness(const delam_law *law, int64_t count, const double *mixity, double *onset,
                                      double *toughness);
DELAM_API int32_t delam_law_respond(const delam_law *law, int32_t dimension, int64_t count, const double *jump,
                                    const double *mixity, const double *adhesion_old, double *adhesion,
                                    double *traction);
DELAM_API void delam_law_destroy(delam_law **law);
DELAM_API int32_t delam_problem_create(delam_context *context, const delam_mesh *mesh, delam_problem **out);
DELAM_API void delam_problem_destroy(delam_problem **problem);
DELAM_API int32_t delam_problem_set_plane(delam_problem *problem, const char *assumption);
DELAM_API int32_t delam_problem_set_elastic(delam_problem *problem, int32_t body, double young, double poisson);
DELAM_API int32_t delam_problem_set_orthotropic(delam_problem *problem, int32_t body, const double *constants);
DELAM_API int32_t delam_problem_set_orientation(delam_problem *problem, int32_t body, int64_t count,
                                                const int64_t *cells, const double *axes, int32_t index_base);
DELAM_API int32_t delam_problem_set_formulation(delam_problem *problem, int32_t body, const char *formulation);
DELAM_API int32_t delam_problem_set_stiffness(delam_problem *problem, int64_t count, const int64_t *nodes,
                                              const int64_t *dofs, const int64_t *row_starts, const int64_t *columns,
                                              const double *values, int64_t kernel_count, const double *kernel,
                                              int32_t index_base);
DELAM_API int32_t delam_problem_set_law(delam_problem *problem, int64_t interface_index, const delam_law *law);
DELAM_API int32_t delam_problem_set_bonded(delam_problem *problem, int64_t interface_index);
DELAM_API int32_t delam_problem_set_contact(delam_problem *problem, int64_t interface_index);
DELAM_API int32_t delam_problem_set_adhesion(delam_problem *problem, int64_t interface_index, int64_t count,
                                             const int64_t *pairs, const double *adhesion, int32_t index_base);
DELAM_API int32_t delam_problem_set_adhesion_box(delam_problem *problem, int64_t interface_index, const double *lower,
                                                 const double *upper, double adhesion, int64_t *count);
DELAM_API int32_t delam_problem_add_pattern(delam_problem *problem, const char *name, int64_t count,
                                            const double *times, const double *values, int64_t *out_pattern);
DELAM_API int32_t delam_problem_prescribe_nodes(delam_problem *problem, int64_t count, const int64_t *nodes,
                                                const double *direction, int64_t pattern_count, const int64_t *patterns,
                                                const double *coefficients, int32_t index_base);
DELAM_API int32_t delam_problem_prescribe_mean(delam_problem *problem, int64_t count, const int64_t *nodes,
                                               const double *weights, const double *direction, int64_t pattern_count,
                                               const int64_t *patterns, const double *coefficients, int32_t index_base);
DELAM_API int32_t delam_problem_add_equation(delam_problem *problem, int64_t count, const int64_t *nodes,
                                             const double *coefficients, int64_t pattern_count, const int64_t *patterns,
                                             const double *prescribed, int32_t index_base);
DELAM_API int32_t delam_problem_begin_constraints(delam_problem *problem, int64_t first, int64_t count, double time,
                                                  int64_t pattern);
DELAM_API int32_t delam_problem_end_constraints(delam_problem *problem, int64_t first, int64_t count, double time,
                                                int64_t pattern);
DELAM_API int32_t delam_problem_add_periodic(delam_problem *problem, int64_t period_count, const double *periods,
                                             const int64_t *control_nodes, double tolerance, int32_t index_base);
DELAM_API int32_t delam_problem_add_forces(delam_problem *problem, int64_t pattern, int64_t count, const int64_t *nodes,
                                           const double *forces, int32_t index_base);
DELAM_API int32_t delam_problem_add_eigenstrain(delam_problem *problem, int64_t pattern, int32_t body,
                                                const double *strain);
DELAM_API int32_t delam_problem_set_gaps(delam_problem *problem, int64_t interface_index, int64_t pattern,
                                         const double *gaps, double adjust);
DELAM_API int32_t delam_problem_set_number(delam_problem *problem, const char *key, double value);
DELAM_API int32_t delam_problem_set_text(delam_problem *problem, const char *key, const char *value);
DELAM_API int64_t delam_option_count(void);
DELAM_API int32_t delam_option_info(int64_t index, const char **key, const char **type, const char **unit,
                                    const char **initial, const char **range, const char **meaning);
DELAM_API int32_t delam_option_alias(int64_t index, const char **alias);
DELAM_API int32_t delam_option_bounds(int64_t index, double *lower, double *upper, int32_t *lower_open,
                                      int32_t *upper_open);
DELAM_API int32_t delam_problem_check(delam_problem *problem);
DELAM_API int32_t delam_problem_hash(const delam_problem *problem, char *out);
DELAM_API int32_t delam_problem_dofs(const delam_problem *problem, int64_t *primal, int64_t *dual);
DELAM_API int32_t delam_problem_process_zone(const delam_problem *problem, int64_t interface_index, double *length,
                                             double *spacing);
DELAM_API int32_t delam_problem_propose(const delam_problem *problem, int64_t interface_index, double pairs,
                                        double *stiffness, double *share, double *normal_strength,
                                        double *tangential_strength);
DELAM_API int32_t delam_problem_body_matrix(const delam_problem *problem, int32_t body, int64_t *rows, int64_t *entries,
                                            int64_t *row_starts, int64_t *columns, double *values);
DELAM_API int32_t delam_problem_constraints(const delam_problem *problem, int64_t *rows, int64_t *entries,
                                            int64_t *pattern_count, int64_t *row_starts, int64_t *columns,
                                            double *values, double *coefficients);
DELAM_API int32_t delam_problem_forces(const delam_problem *problem, int64_t pattern, int64_t capacity, double *forces);
DELAM_API int32_t delam_problem_eigenstrain_energy(const delam_problem *problem, int64_t capacity, double *matrix);
DELAM_API int32_t delam_problem_factors(const delam_problem *problem, double time, int64_t capacity, double *factors);
DELAM_API int32_t delam_problem_pattern_count(const delam_problem *problem, int64_t *count);
DELAM_API const char *delam_problem_pattern_name(const delam_problem *problem, int64_t pattern);
DELAM_API const char *delam_problem_option(const delam_problem *problem, const char *key);
DELAM_API int32_t delam_problem_value_count(const delam_problem *problem, int64_t *count);
DELAM_API int32_t delam_problem_value_info(const delam_problem *problem, int64_t index, const char **key,
                                           const char **alias);
DELAM_API int32_t delam_problem_plan(delam_problem *problem, const char **plan, double *setup, double *memory);
DELAM_API int32_t delam_solver_create(const delam_problem *problem, double time, delam_solver **out);
DELAM_API int32_t delam_solver_create_like(const delam_problem *problem, const delam_solver *other, double time,
                                           delam_solver **out);
DELAM_API int32_t delam_solver_shares_bodies(const delam_solver *solver, const delam_problem *problem, int32_t *shares);
DELAM_API void delam_solver_destroy(delam_solver **solver);
DELAM_API int32_t delam_solver_advance(delam_solver *solver, double time);
DELAM_API int32_t delam_solver_commit(delam_solver *solver);
DELAM_API int32_t delam_solver_rollback(delam_solver *solver);
DELAM_API int32_t delam_solver_pending(const delam_solver *solver, int32_t *pending);
DELAM_API int32_t delam_solver_set_history(delam_solver *solver, int64_t pattern, int64_t count, const double *times,
                                           const double *values);
DELAM_API int32_t delam_solver_equilibrate(delam_solver *solver, double time, const double *adhesion);
DELAM_API int32_t delam_solver_value(delam_solver *solver, const char *key, double *value);
DELAM_API int32_t delam_solver_value_count(const delam_solver *solver, int64_t *count);
DELAM_API const char *delam_solver_value_name(const delam_solver *solver, int64_t index);
DELAM_API int32_t delam_solver_value_info(const delam_solver *solver, int64_t index, const char **alias,
                                          const char **unit, const char **cost, const char **scope,
                                          const char **meaning, int32_t *recorded);
DELAM_API int32_t delam_solver_record(delam_solver *solver, const char *key);
DELAM_API int32_t delam_solver_recorded_size(const delam_solver *solver, int64_t *first, int64_t *steps);
DELAM_API int32_t delam_solver_recorded(const delam_solver *solver, const char *key, int64_t capacity, double *values);
DELAM_API int32_t delam_solver_field_shape(const delam_solver *solver, const char *key, int64_t part, int64_t *rows,
                                           int64_t *columns);
DELAM_API int32_t delam_solver_field(delam_solver *solver, const char *key, int64_t part, int64_t capacity,
                                     double *values);
DELAM_API int32_t delam_solver_average(const delam_solver *solver, int32_t body, double *volume, double *strain,
                                       double *stress);
DELAM_API int32_t delam_solver_front_count(const delam_solver *solver, int64_t interface_index, int64_t *fronts,
                                           int64_t *points);
DELAM_API int32_t delam_solver_front(const delam_solver *solver, int64_t interface_index, int64_t front_capacity,
                                     int64_t point_capacity, int64_t *starts, int32_t *closed, double *places,
                                     double *directions, double *lengths, double *rates, double *zone_lengths,
                                     double *zone_pairs);
DELAM_API int32_t delam_solver_tangent(delam_solver *solver, int64_t capacity, double *matrix);
DELAM_API int32_t delam_solver_step_tangent(delam_solver *solver, int64_t capacity, double *matrix);
DELAM_API int32_t delam_solver_condensed_size(const delam_solver *solver, int64_t *unknowns, int64_t *entries);
DELAM_API int32_t delam_solver_condensed(const delam_solver *solver, int64_t capacity, double *stiffness, double *load,
                                         double *constant, int64_t *row_starts, int64_t *columns, double *values,
                                         double *offset);
DELAM_API const char *delam_solver_plan(delam_solver *solver);
DELAM_API int32_t delam_solver_plan_count(const delam_solver *solver, int64_t *count);
DELAM_API int32_t delam_solver_plan_item(const delam_solver *solver, int64_t index, const char **subject,
                                         const char **decision, const char **reason, double *cost, double *saving,
                                         const char **unit);
DELAM_API const char *delam_solver_option(const delam_solver *solver, const char *key);
DELAM_API const char *delam_solver_searched(const delam_solver *solver);
DELAM_API int32_t delam_solver_look(delam_solver *solver, int64_t step);
DELAM_API int32_t delam_solver_jump_count(const delam_solver *solver, int64_t *count);
DELAM_API int32_t delam_solver_jump(const delam_solver *solver, int64_t index, int64_t *step, double *before,
                                    double *time, double *stored, double *dissipated, double *released,
                                    double *debonded, int64_t *interface_index, int64_t *first_pair,
                                    int64_t *last_pair);
DELAM_API int32_t delam_solver_jump_reactions(const delam_solver *solver, int64_t index, int64_t capacity,
                                              double *before, double *after);
DELAM_API int32_t delam_solver_save(const delam_solver *solver, int64_t capacity, uint8_t *bytes, int64_t *needed);
DELAM_API int32_t delam_solver_load(delam_solver *solver, int64_t size, const uint8_t *bytes);
DELAM_API int32_t delam_solver_save_file(const delam_solver *solver, const char *path);
DELAM_API int32_t delam_solver_load_file(delam_solver *solver, const char *path);
#ifdef __cplusplus
}
#endif
#endif
