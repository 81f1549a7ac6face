/* SPDX-License-Identifier: BSD-3-Clause
 *
 * libdelam-petsc distributes the bodies of libdelam over many processes, by PETSc. Rank 0 holds the problem and calls
 * delam.h as it would alone; each rank holds a part of the bodies. The stiffness, the solves and their memory are
 * distributed. The interfaces (damage, contact, energies) stay on rank 0.
 *
 *   delam_petsc_create(MPI_COMM_WORLD, &petsc);              all ranks
 *   ... mesh, laws, problem with delam.h ...                 rank 0
 *   delam_petsc_take_scene(petsc, mesh, problem);            all ranks; NULL, NULL but on rank 0
 *   delam_petsc_attach(petsc, problem);                      all ranks; NULL but on rank 0
 *   delam_petsc_run(petsc, analysis, &data);                 rank 0 runs analysis(&data): solvers, steps, fields
 *   delam_petsc_destroy(&petsc);
 *
 * In the place of delam_petsc_take_scene each rank may hand over what it has:
 *   delam_petsc_set_cells  cells
 *   delam_petsc_set_part   what the rank adds to the stiffness
 *   delam_petsc_set_rows   the rank's rows of the stiffness
 *
 * The rules at the head of delam.h apply here as well, with these in addition:
 *   ranks    Calls are collective: all ranks of the communicator make the same calls in the same order, and get the
 *            same status. Only the arrays may differ, as each function says. Not collective are delam_petsc_message and
 *            the functions that say "one rank alone" or "rank 0 alone".
 *   options  PETSc's options with the prefix delam_ choose the solver, e.g. in the variable PETSC_OPTIONS:
 *            -delam_pc_type bddc, -delam_ksp_monitor. The default is a Cholesky factorisation by MUMPS. PETSc must
 *            compute with real numbers in double precision. The number of DOFs must fit into its integers.
 *   threads  All calls of a rank come from a thread that may call MPI ("MPI's" in the brackets), one at a time.
 *   errors   A rank may fail where the others cannot know, in the middle of a step of PETSc or MPI that all of them
 *            share. It then waits eight seconds for them, writes a line to PETSC_STDERR and calls MPI_Abort. In tasks
 *            (delam_petsc_everywhere) it waits as long as the others work.
 *   memory   A problem that has the engine may outlive the delam_petsc; its solvers then return DELAM_ERROR_STATE. */
#ifndef DELAM_PETSC_H
#define DELAM_PETSC_H

#include <mpi.h>

#include <delam/delam.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct delam_petsc delam_petsc; /* ranks that solve the bodies of a problem together */

/* Creates a handle for the ranks of a communicator comm, which it duplicates; *out receives it. The host must have
 * initialised MPI. If PETSc is not initialised, the function does this, with the options in the variable PETSC_OPTIONS
 * and without signal handlers. PETSc is then finalised when MPI is.
 * [null none; owns out caller; status argument, memory, internal; thread MPI's; since 0.1] */
DELAM_API int32_t delam_petsc_create(MPI_Comm comm, delam_petsc **out);
/* Creates a handle as delam_petsc_create does, for a communicator comm of Fortran.
 * [null none; owns out caller; status argument, memory, internal; thread MPI's; since 0.1] */
DELAM_API int32_t delam_petsc_create_fortran(MPI_Fint comm, delam_petsc **out);
/* Destroys a handle and sets it to NULL; inside delam_petsc_run it does nothing.
 * [null petsc, *petsc; owns petsc destroyed; status -; since 0.1] */
DELAM_API void delam_petsc_destroy(delam_petsc **petsc);
/* Returns the text of the last status other than DELAM_OK; "" if there has been none; never NULL. A collective call
 * that fails leaves the same text on all ranks, a call of one rank alone on that rank only. This function is not
 * collective.
 * [owns result until the next call with this handle; status -; since 0.1] */
DELAM_API const char *delam_petsc_message(const delam_petsc *petsc);

/* Sets what this rank adds to the stiffness of the bodies, which is the sum over all ranks.
 *   nodes            [node_count], each once, in the numbers of the mesh of rank 0's problem
 *   coordinates      [node_count][dimension], which some preconditioners use
 *   row_starts       [dimension*node_count+1]
 *   columns, values  [entries] CSR with both triangles over the DOFs of these nodes, dimension*i + component for node i
 * Numbers beyond the mesh are nodes that only the ranks know. Nodes of the mesh that are in no part have no stiffness.
 * A pair of nodes that an interface joins is best in one part. Solvers made before are of no use afterwards.
 * [unit coordinates L finite, values F/L finite; null coordinates; status argument, state; since 0.1] */
DELAM_API int32_t delam_petsc_set_part(delam_petsc *petsc, int32_t dimension, int64_t node_count, const int64_t *nodes,
                                       const double *coordinates, const int64_t *row_starts, const int64_t *columns,
                                       const double *values);
/* Divides the cells of rank 0's mesh among the ranks and sends each the data of its stiffness, for
 * delam_petsc_set_part. mesh and problem are those of rank 0, and NULL on the others. The problem must be complete but
 * for its loads. Cells on the two sides of an interface stay together. PTScotch divides the cells;
 * -delam_mat_partitioning_type chooses another partitioner.
 * [null mesh and problem but on rank 0; status cancelled, argument, problem, numerical, state; source C. Chevalier, F.
 * Pellegrini, Parallel Comput. 34 (2008) 318-331; since 0.1] */
DELAM_API int32_t delam_petsc_take_scene(delam_petsc *petsc, const delam_mesh *mesh, const delam_problem *problem);
/* Divides the cells as delam_petsc_take_scene does, with mesh and problem as there, but by the host's own partition,
 * e.g. that of its mesh generator. ranks: [cell_count] has the rank of each cell of rank 0's mesh, in [0, number of
 * ranks). The other ranks ignore it. Cells on the two sides of an interface may have different ranks. Where a whole
 * interface is a cut, solves with -delam_pc_type bddc may end without convergence, which the solvers say.
 * [null mesh, problem and ranks but on rank 0; status cancelled, argument, problem, state; source none; since 0.1] */
DELAM_API int32_t delam_petsc_take_cells(delam_petsc *petsc, const delam_mesh *mesh, const delam_problem *problem,
                                         int64_t cell_count, const int32_t *ranks);
/* Sets rows of the assembled stiffness of the bodies, without supports, in the place of a part.
 *   nodes            [node_count], those whose rows this rank has, in the numbers of delam_petsc_set_part; each on one
 *                    rank only
 *   coordinates      [node_count][dimension], which some preconditioners use
 *   row_starts       [dimension*node_count+1]
 *   columns, values  [entries] CSR with both triangles; repeated entries add up
 * Row dimension*i + component is that of nodes[i]. Columns are dimension*node + component for nodes of any rank. All
 * ranks together must be symmetric to 1e-9 of the geometric mean of the two diagonal entries. These entries must be
 * positive. The function refuses -delam_pc_type bddc, which needs the ranks' own cells. DELAM_ERROR_ARGUMENT: the
 * message names the node and both ranks, or row, column and both values.
 * [unit coordinates L finite, values F/L finite; null coordinates; status argument, state; since 0.1] */
DELAM_API int32_t delam_petsc_set_rows(delam_petsc *petsc, int32_t dimension, int64_t node_count, const int64_t *nodes,
                                       const double *coordinates, const int64_t *row_starts, const int64_t *columns,
                                       const double *values);
/* Sets the stiffness of cells that this rank has described with delam.h, in the place of a part. mesh and problem are
 * this rank's own, and NULL on a rank without cells. The mesh has its nodes and cells, the problem their plane
 * assumption, materials, formulations and orientations. nodes: [node_count] has for each node of this mesh its number
 * for delam_petsc_set_part, each once. Nodes that no cell has do not count.
 * Rank 0's problem, over a mesh of bodies without cells, has the interfaces, supports and loads. The rank's own problem
 * must not have any of these, nor eigenstrains: only cells of rank 0's mesh (delam_petsc_take_scene) can have those.
 * The host may destroy both objects afterwards.
 * [null mesh, problem, nodes; status cancelled, argument, problem, state; source T. Hughes, The Finite Element Method
 * (1987), chapters 3 and 4; since 0.1] */
DELAM_API int32_t delam_petsc_set_cells(delam_petsc *petsc, const delam_mesh *mesh, const delam_problem *problem,
                                        int64_t node_count, const int64_t *nodes);
/* Gives rank 0's problem the engine (delam_experimental_problem_set_engine): the ranks solve its bodies from now on.
 * Its solvers are made, and work, inside delam_petsc_run. problem is that of rank 0, and NULL on the others.
 * [null problem but on rank 0; owns the engine the problem; status argument, state; since 0.1] */
DELAM_API int32_t delam_petsc_attach(delam_petsc *petsc, delam_problem *problem);
/* Does the work of rank 0, for delam_petsc_run. It returns DELAM_OK, or another number, which the running call then
 * returns.
 * [null user; status returned; thread call's; since 0.1] */
typedef int32_t (*delam_petsc_work_callback)(void *user);
/* Runs work(user) on rank 0, which may call everything of delam.h, while the other ranks work for the engine. Returns
 * what work returns, on all ranks; an exception of C++ that leaves work becomes a status. Of the functions of this
 * header, work may call only those of one rank or rank 0 alone. work is that of rank 0; the other ranks ignore it.
 * [null work but on rank 0, user; owns work and user: the host, until the call returns; status argument, state,
 * returned; source none; since 0.1] */
DELAM_API int32_t delam_petsc_run(delam_petsc *petsc, delam_petsc_work_callback work, void *user);

/* Performs what all ranks do when rank 0 says so, with the bytes: [size] of rank 0. The task may communicate with the
 * other ranks, over a communicator of the host, and call the functions of one rank alone. It must not call those that
 * need the ranks for a solve. It returns DELAM_OK, or another number; delam_petsc_explain tells why. A rank must not
 * return while others wait for it in communication of the host. The ranks must therefore agree before such a step that
 * none has failed.
 * [null user; status returned; thread call's; since 0.1] */
typedef int32_t (*delam_petsc_task_callback)(int64_t size, const uint8_t *bytes, void *user);
/* Sets the task of each rank, for delam_petsc_everywhere; it replaces an earlier one. Each rank has a function and user
 * of its own: addresses are not the same in two processes.
 * [null user; owns task and user: the host, as long as petsc is run; status argument, state; source none; since 0.1] */
DELAM_API int32_t delam_petsc_set_task(delam_petsc *petsc, delam_petsc_task_callback task, void *user);
/* Runs the task of all ranks, of rank 0 as well, with these bytes [size], and waits for all. Rank 0 alone calls this
 * function, in the work of delam_petsc_run. If the task fails on some ranks, by its number or by an exception of C++,
 * the status is that of the lowest of them. So is the message on all ranks, and work may go on. A rank that has failed
 * waits for the others however long they work. After eight seconds it writes a line to PETSC_STDERR. If they wait for
 * it in turn, nobody ever returns.
 * [null bytes; status argument, internal, memory, state, returned; source none; since 0.1] */
DELAM_API int32_t delam_petsc_everywhere(delam_petsc *petsc, int64_t size, const uint8_t *bytes);
/* Explains by text why the task is about to fail; this becomes the message. One rank alone calls this function, in its
 * task.
 * [null none; status argument; source none; since 0.1] */
DELAM_API int32_t delam_petsc_explain(delam_petsc *petsc, const char *text);

/* Makes each rank recover the displacements of a solver's present state, pending or committed, at the nodes of its
 * part. Rank 0 alone calls this function, in the work of delam_petsc_run. No rank gets all displacements, as rank 0
 * does by delam_solver_field, which changes nothing here. The ranks keep what they have until the next call or other
 * parts. The functions below describe this state, however far the solver has gone on.
 * A part that nothing holds may have moved rigidly while ranks have nodes beyond the mesh. The call then takes a solve
 * with a new preconditioner, and the next step another one. The steps may therefore differ by what the solves leave.
 * [status cancelled, memory, numerical, state; source none; since 0.1] */
DELAM_API int32_t delam_petsc_recover(delam_petsc *petsc, delam_solver *solver);
/* Returns the nodes of the fields of delam_petsc_part_field. One rank alone calls this function, in its task, in work
 * or afterwards. The nodes are those of its part, and behind them, on rank 0, those of the mesh that no part has. owned
 * is 1 on one of the ranks that have the node, and 0 on the others. The arrays are nodes and owned: [capacity]. *count
 * receives the number of nodes. Their order and owner depend on the function that made the part:
 *   delam_petsc_take_scene, _take_cells  nodes of the rank's cells, ascending; the lowest rank with a node owns it
 *   delam_petsc_set_part                 its nodes in their order; likewise
 *   delam_petsc_set_cells                those of its cells, in the order of its own mesh; likewise
 *   delam_petsc_set_rows                 its nodes in their order; behind them ghosts, those of other ranks in its
 *                                        columns, as they first occur there; the rank with a node's rows owns it
 * [null nodes, owned, count; status argument, state; source none; since 0.1] */
DELAM_API int32_t delam_petsc_part_nodes(delam_petsc *petsc, int64_t capacity, int64_t *nodes, int32_t *owned,
                                         int64_t *count);
/* Returns the cells of the rank's part in rank 0's mesh, ascending, from 0 on, cells: [capacity]. One rank alone calls
 * this function. *count receives the number of cells. There are cells after delam_petsc_take_scene and
 * delam_petsc_take_cells, and none after the other functions.
 * [null cells, count; status argument; source none; since 0.1] */
DELAM_API int32_t delam_petsc_part_cells(delam_petsc *petsc, int64_t capacity, int64_t *cells, int64_t *count);
/* Returns a field of the state recovered last (delam_petsc_recover). One rank alone calls this function, in its task,
 * in work or afterwards.
 *   displacement  [nodes][dimension]  u, at the nodes of delam_petsc_part_nodes
 *   force         [nodes][dimension]  K u, the sum over all ranks: in equilibrium what acts on the node
 *   stress        [cells][4 or 6]     at the centres of the cells of delam_petsc_part_cells, as by delam_solver_field
 *   rotation      [cells][1 or 3]     likewise
 * The field is values: [capacity], row after row. *rows and *columns receive the shape. After
 * delam_experimental_solver_recover by itself, stress and rotation give DELAM_ERROR_STATE.
 * [unit values of key; null values, rows, columns; status argument, memory, state; source none; since 0.1] */
DELAM_API int32_t delam_petsc_part_field(delam_petsc *petsc, const char *key, int64_t capacity, double *values,
                                         int64_t *rows, int64_t *columns);

/* Writes a number, by key, to *value. Counts begin when the handle is made.
 *   solves                          solves of the engine
 *   iterations                      iterations of these solves
 *   renewals                        renewals of the preconditioner
 *   factor_entries, factor_flops    entries of the present factor and operations for it, of all ranks; 0 if there is
 *                                   none, or if it is not MUMPS'
 *   memory_mb_max, memory_mb_sum    most memory (10^6 bytes) of a process up to now: the largest, and of all ranks
 *   operations_max, operations_sum  floating-point operations that PETSc has counted, those inside MUMPS left out: of
 *                                   the busiest rank, and of all ranks
 *   bytes_sent_max, bytes_sent_sum  bytes that a rank has sent to single others or, on rank 0, to all: the largest, and
 *                                   of all ranks
 *   messages_max, messages_sum      messages, likewise
 * MUMPS' own bytes and messages are not counted.
 * [unit value of key; null none; status argument, state; source none; since 0.1] */
DELAM_API int32_t delam_petsc_value(delam_petsc *petsc, const char *key, double *value);

#ifdef __cplusplus
}
#endif
#endif
