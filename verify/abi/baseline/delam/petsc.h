/* SPDX-License-Identifier: BSD-3-Clause
 * petsc.h of the baseline, without its comments. Written by update.sh. */
#ifndef DELAM_PETSC_H
#define DELAM_PETSC_H
#include <mpi.h>
#include <delam/delam.h>
#ifdef __cplusplus
extern "C" {
#endif
typedef struct delam_petsc delam_petsc;
DELAM_API int32_t delam_petsc_create(MPI_Comm comm, delam_petsc **out);
DELAM_API int32_t delam_petsc_create_fortran(MPI_Fint comm, delam_petsc **out);
DELAM_API void delam_petsc_destroy(delam_petsc **petsc);
DELAM_API const char *delam_petsc_message(const delam_petsc *petsc);
DELAM_API int32_t delam_petsc_set_part(delam_petsc *petsc, int32_t dimension, int64_t node_count, const int64_t *nodes,
                                       const double *coordinates, const int64_t *row_starts, const int64_t *columns,
                                       const double *values);
DELAM_API int32_t delam_petsc_take_scene(delam_petsc *petsc, const delam_mesh *mesh, const delam_problem *problem);
DELAM_API int32_t delam_petsc_take_cells(delam_petsc *petsc, const delam_mesh *mesh, const delam_problem *problem,
                                         int64_t cell_count, const int32_t *ranks);
DELAM_API int32_t delam_petsc_set_rows(delam_petsc *petsc, int32_t dimension, int64_t node_count, const int64_t *nodes,
                                       const double *coordinates, const int64_t *row_starts, const int64_t *columns,
                                       const double *values);
DELAM_API int32_t delam_petsc_set_cells(delam_petsc *petsc, const delam_mesh *mesh, const delam_problem *problem,
                                        int64_t node_count, const int64_t *nodes);
DELAM_API int32_t delam_petsc_attach(delam_petsc *petsc, delam_problem *problem);
typedef int32_t (*delam_petsc_work_callback)(void *user);
DELAM_API int32_t delam_petsc_run(delam_petsc *petsc, delam_petsc_work_callback work, void *user);
typedef int32_t (*delam_petsc_task_callback)(int64_t size, const uint8_t *bytes, void *user);
DELAM_API int32_t delam_petsc_set_task(delam_petsc *petsc, delam_petsc_task_callback task, void *user);
DELAM_API int32_t delam_petsc_everywhere(delam_petsc *petsc, int64_t size, const uint8_t *bytes);
DELAM_API int32_t delam_petsc_explain(delam_petsc *petsc, const char *text);
DELAM_API int32_t delam_petsc_recover(delam_petsc *petsc, delam_solver *solver);
DELAM_API int32_t delam_petsc_part_nodes(delam_petsc *petsc, int64_t capacity, int64_t *nodes, int32_t *owned,
                                         int64_t *count);
DELAM_API int32_t delam_petsc_part_cells(delam_petsc *petsc, int64_t capacity, int64_t *cells, int64_t *count);
DELAM_API int32_t delam_petsc_part_field(delam_petsc *petsc, const char *key, int64_t capacity, double *values,
                                         int64_t *rows, int64_t *columns);
DELAM_API int32_t delam_petsc_value(delam_petsc *petsc, const char *key, double *value);
#ifdef __cplusplus
}
#endif
#endif
