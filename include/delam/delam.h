/* SPDX-License-Identifier: BSD-3-Clause
 *
 * libdelam: delamination of layered and fibrous composites as rate-independent energy minimisation.
 *
 * A host describes bodies and touching faces (delam_mesh), how the faces hold together (delam_law), materials,
 * supports and loads (delam_problem), and walks the load steps (delam_solver).
 *
 * Rules that hold for every function
 *   status     0 done; > 0 an outcome, the object stays valid and usable; < 0 an error, the object is unchanged.
 *              The text of the last one is delam_context_message() of the context the object was made with.
 *   units      whatever is consistent (the examples use SI: m, N, Pa, J); in 2D forces and energies are per unit
 *              thickness. Dimensions are written as L, F and their products: stress F/L2, stiffness of an
 *              interface F/L3, toughness F/L (J/m2).
 *   arrays     contiguous; `[n][d]` is row-major C, `(d,n)` in Fortran. Inputs are copied before the call returns,
 *              outputs are written into the caller's buffer. Pointers must not be NULL unless said so; an array may
 *              be NULL when its count is 0.
 *   indices    int64_t; index arrays on input take `index_base` (0 or 1); single indices and outputs are 0-based.
 *   handles    opaque; create writes *out (NULL on error), destroy takes the address, sets it to NULL and accepts
 *              NULL. Objects may be destroyed in any order. Foreign or destroyed handles give DELAM_ERROR_HANDLE
 *              as far as that can be seen.
 *   numbers    non-finite input is refused by name.
 *   threads    one context and the objects made with it belong to one thread at a time; distinct contexts are
 *              independent. delam_context_cancel() alone may be called from any thread, and from inside a callback,
 *              where what else has a status returns DELAM_ERROR_STATE, and texts are NULL or "". Callbacks return; none
 *              is left by longjmp or an exception.
 *   promise    nothing is printed, no signal handler is left behind, no exception leaves, the process never ends.
 *   names      out: the handle that is made. interface_index, pattern: as the function that added it gave them; index:
 *              of a list, below its count. body: a label of cells; where -1 is allowed, it means all. capacity: entries
 *              that the array has room for, negative or too few is DELAM_ERROR_ARGUMENT. user: handed on to the
 *              callback as it is.
 *
 * The line in brackets
 *   ends the comment of each function and callback: the rest of its contract in fixed words, complete, so that what is
 *   missing there is as above. In the order
 *   unit       of each double: its name, unit, range; that of what goes in always, finite where any number will do, and
 *              in parentheses what is asked of an array as a whole or of each of its vectors. 1: no unit; t: time of
 *              the load histories; of key: as that key says
 *   null       pointers that may be NULL
 *   owns       pointers that outlive the call, and who frees or keeps them. out caller: the caller frees *out by the
 *              object's destroy function. static: valid as long as the library is loaded
 *   status     DELAM_OK aside. Any call with a handle may return DELAM_ERROR_HANDLE, _MEMORY and _INTERNAL, and from
 *              inside a callback _STATE: usual, these alone; otherwise what may come beside them; only: not even those.
 *              - : no status is returned
 *   thread     any: from any thread at any time; not said: as above
 *   source     where the method is described; none: nothing but what was given, counted or solved for is handed out
 *   since      version of the library
 *   For a callback, which the library calls: null, what it may be given as NULL; owns, how long what it is given lives;
 *   status, what the running call ends with when the callback returns anything but 0; thread call's: that of this call.
 */
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

/* Number of the binary interface (the SONAME's); apart from the product's version. */
#define DELAM_ABI 1

/* ---- statuses ---------------------------------------------------------------------------------------------------- */

#define DELAM_OK 0
#define DELAM_NOT_CONVERGED 1    /* a limit was met, or forces do not balance; the best state found can be read */
#define DELAM_CANCELLED 2        /* stopped on request; the state before the call is restored */
#define DELAM_LIMIT 3            /* no equilibrium: a dead load acts on a part that nothing holds any more */
#define DELAM_ERROR_ARGUMENT -1  /* a value outside its range, a NULL, an index past the end */
#define DELAM_ERROR_HANDLE -2    /* NULL or foreign handle */
#define DELAM_ERROR_MESH -3      /* inverted cell, shared node, unmatched faces */
#define DELAM_ERROR_PROBLEM -4   /* incomplete or contradictory scene: missing material, missing support, bad law */
#define DELAM_ERROR_STATE -5     /* a call out of order (e.g. advance with a step not yet committed) */
#define DELAM_ERROR_MEMORY -6    /* no room for what the call needs */
#define DELAM_ERROR_NUMERICAL -7 /* a factorisation broke down */
#define DELAM_ERROR_SNAPSHOT -8  /* bytes that are damaged, of another version or of another scene */
#define DELAM_ERROR_INTERNAL -9  /* a defect of the library: please report */
#define DELAM_ERROR_FILE -10     /* a file that cannot be opened, read or written: the message says why */

typedef struct delam_context delam_context; /* messages, log, progress, cancel; what everything else is made with */
typedef struct delam_mesh delam_mesh;       /* nodes, cells, bodies, interfaces */
typedef struct delam_law delam_law;         /* how an interface holds together */
typedef struct delam_problem delam_problem; /* mesh, materials, laws, supports, loads, options: the scene */
typedef struct delam_solver delam_solver;   /* operator, state and history of a march */

/* Product version "major.minor.patch".
 * [owns result static; status -; thread any; since 0.1] */
DELAM_API const char *delam_version(void);
/* Commit the library was built from, or "unknown".
 * [owns result static; status -; thread any; since 0.1] */
DELAM_API const char *delam_commit(void);
/* DELAM_ABI of the library that runs (compare with the header's).
 * [status -; thread any; since 0.1] */
DELAM_API int32_t delam_abi(void);
/* Name of a status, e.g. "DELAM_ERROR_MESH"; "unknown status" for others.
 * [owns result static; status -; thread any; since 0.1] */
DELAM_API const char *delam_status_name(int32_t status);
/* Threads that the BLAS of this process uses; 0: it does not say. The library leaves them alone (its own: option
 * threads). Equal digits from run to run need an equal number.
 * [status -; thread any; since 0.1] */
DELAM_API int32_t delam_blas_threads(void);

/* ---- context: messages, log, progress, cancel -------------------------------------------------------------------- */

/* Called with lines for people. level: 0 error, 1 warning, 2 information.
 * [null user; owns text until the callback returns; status -; thread call's; since 0.1] */
typedef void (*delam_log_callback)(int32_t level, const char *text, void *user);
/* Called inside long work, on the calling thread. stage: static text ("factor", "minimise", ...); done of total
 * (total 0 = not known). Non-zero return cancels: the call ends with DELAM_CANCELLED. Calls that read do not heed it,
 * so that a host that has stopped can read what there is: delam_mesh_find_patch, delam_problem_hash, _process_zone,
 * _body_matrix, _constraints, _forces, _eigenstrain_energy, delam_solver_value, _field, _average, _condensed.
 * [null user; owns stage static; status cancelled; thread call's; since 0.1] */
typedef int32_t (*delam_progress_callback)(const char *stage, int64_t done, int64_t total, void *user);

/* A context with no callbacks, for objects made with it; *out receives it.
 * [null none; owns out caller; status only argument, memory; thread any; since 0.1] */
DELAM_API int32_t delam_context_create(delam_context **out);
/* Destroys a context; objects made with it live on.
 * [null context, *context; owns context destroyed; status -; since 0.1] */
DELAM_API void delam_context_destroy(delam_context **context);
/* Text of the last status that was not DELAM_OK ("" before any): what, where, value, allowed range. Never NULL.
 * [owns result until the next call with this context or its objects; status -; since 0.1] */
DELAM_API const char *delam_context_message(const delam_context *context);
/* Where lines for people go; callback NULL switches it off. Errors and outcomes come here too, beside the message.
 * [null callback, user; owns callback and user: the host, until replaced or the last object of the context is gone;
 * status usual; since 0.1] */
DELAM_API int32_t delam_context_set_log(delam_context *context, delam_log_callback callback, void *user);
/* Where the library reports from long work; callback NULL switches it off.
 * [null callback, user; owns callback and user: as delam_context_set_log; status usual; since 0.1] */
DELAM_API int32_t delam_context_set_progress(delam_context *context, delam_progress_callback callback, void *user);
/* Ask the running call to stop at its next check; any thread (and from a signal handler: it counts up one lock-free
 * number). The request is consumed by the call that it stops. One that comes while no call runs, that the running one
 * does not meet any more, or whose call is refused for its arguments, waits for the next call of the march:
 * delam_solver_create, _advance, _equilibrate, _tangent, _step_tangent, _load, _load_file or
 * delam_problem_set_stiffness. The other calls that list `cancelled` build or read; only a request that comes while
 * they run stops them.
 * [status only handle; thread any; since 0.1] */
DELAM_API int32_t delam_context_cancel(delam_context *context);

/* ---- mesh: nodes, cells, bodies, interfaces ---------------------------------------------------------------------- */

/* Cell types. Node order as in VTK: corners (counter-clockwise; bottom face, then top face), then the nodes midway
 * between two corners, then the centre. With corners numbered from 0, the middle nodes sit between
 *   tri6    0-1 1-2 2-0
 *   quad8   0-1 1-2 2-3 3-0      quad9 likewise, then the centre
 *   tet10   0-1 1-2 2-0 0-3 1-3 2-3                              (Gmsh exchanges the last two)
 *   hex20   0-1 1-2 2-3 3-0  4-5 5-6 6-7 7-4  0-4 1-5 2-6 3-7    (Gmsh has another order)
 * Cells may be curved: middle nodes need not be exactly midway. Neighbours share all nodes of a face. In bending, tri3,
 * quad4, tet4 and hex8 are far too stiff unless many lie across the thickness; the others need few, and so do quad4
 * and hex8 with delam_problem_set_formulation. */
#define DELAM_TRI3 1
#define DELAM_QUAD4 2
#define DELAM_TET4 3
#define DELAM_HEX8 4
#define DELAM_TRI6 5
#define DELAM_QUAD8 6
#define DELAM_QUAD9 7
#define DELAM_TET10 8
#define DELAM_HEX20 9

/* A mesh of nodes: [node_count][dimension], dimension 2 or 3, node_count >= 1.
 * [unit nodes L finite; null none; owns out caller; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_create(delam_context *context, int32_t dimension, int64_t node_count, const double *nodes,
                                    delam_mesh **out);

/* Block of layers stacked along the last axis (y in 2D, z in 3D), each layer a body of its own with its own nodes,
 * body 0 at the bottom. The block starts at the origin.
 *   lengths, divisions  [dimension-1] extent (L) and number of cells along the other axes
 *   thickness, layer_divisions  [layer_count] of each layer
 *   cell_type           DELAM_TRI3 / QUAD4 / TRI6 / QUAD8 / QUAD9 in 2D, TET4 / HEX8 / TET10 / HEX20 in 3D; simplices
 *                       split each box into 2 or 6
 * Neighbouring layers match; no interface is made yet. Nodes of a layer are numbered x fastest, the last axis slowest,
 * middle nodes among the corners.
 * [unit lengths L > 0, thickness L > 0; null none; owns out caller; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_create_layers(delam_context *context, int32_t dimension, const double *lengths,
                                           const int64_t *divisions, int64_t layer_count, const double *thickness,
                                           const int64_t *layer_divisions, int32_t cell_type, delam_mesh **out);

/* Adds cells of one type, cell_type. connectivity: [cell_count][nodes of the type]; bodies: [cell_count] labels >= 0,
 * or NULL for all 0. A node belongs to one body only: DELAM_ERROR_MESH otherwise, also for inverted or degenerate
 * cells. DELAM_ERROR_STATE: the body has an interface already, all its cells come before.
 * [null bodies; status cancelled, argument, mesh, state; since 0.1] */
DELAM_API int32_t delam_mesh_add_cells(delam_mesh *mesh, int32_t cell_type, int64_t cell_count,
                                       const int64_t *connectivity, const int32_t *bodies, int32_t index_base);

/* As delam_mesh_add_cells (cell_type, connectivity: [cell_count][nodes of the type], bodies: [cell_count]), for the
 * cells of a conforming mesh of touching bodies as a mesher writes them: a node that another body has already is
 * doubled. This body then gets a node of its own at the same place, appended after the present ones: one for each body
 * and original node, also over several calls, so that cells of several types, or a body in portions, may come one after
 * another. The first body to come keeps the original. connectivity holds nodes of the mesh, originals or copies, as
 * they were before the call; the number of nodes grows (delam_mesh_size; delam_mesh_node_origins tells what was
 * doubled). Where three or more bodies meet, each has a node. Bodies that share faces are then joined by
 * delam_mesh_add_all_interfaces; those that share no more than a corner, or in 3D an edge, are joined by nothing there.
 * DELAM_ERROR_MESH for inverted or degenerate cells.
 * [null bodies; status cancelled, argument, mesh, state; since 0.1] */
DELAM_API int32_t delam_mesh_add_conforming_cells(delam_mesh *mesh, int32_t cell_type, int64_t cell_count,
                                                  const int64_t *connectivity, const int32_t *bodies,
                                                  int32_t index_base);

/* Pairs the coinciding boundary faces of two bodies, a = body_a and b = body_b; *out_interface receives the interface's
 * index, from 0. The jump of a pair is u_b - u_a; the normal points from a to b, so a positive normal jump is an
 * opening. `tolerance`: largest distance of two nodes that count as one, as a fraction of the shortest edge of the two
 * bodies (of quadratic cells: from corner to mid-side node); 0 gives 1e-6; must be < 0.5. DELAM_ERROR_MESH when no face
 * matches, or when faces overlap but do not match, mid-side nodes included (the first place is named). Weights of
 * pairs: nodal quadrature of the paired faces, positive, summing to the length (2D) or area (3D) of the interface:
 * trapezoid rule on 2-node edges, Simpson's on 3-node ones, vertex rule on faces. 6-node triangles count as four
 * triangles, 8-node faces as four corner triangles and the quadrilateral of their mid-side nodes, also where they are
 * curved. Those of tet10 and hex20 are not in the proportion of a uniform traction: on a stiff interface pairs then
 * bear up to 1.3 (tet10) or 1.6 times (hex20) the traction at middle nodes and none, or a closed contact, at corners.
 * Pairs are ordered by coordinates, x first.
 * [unit tolerance 1 in [0, 0.5); null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double tolerance,
                                           int64_t *out_interface);
/* An interface, as by delam_mesh_add_interface, between every two bodies that share matching faces and have none yet,
 * in the order of their labels (body_a < body_b, then next pair); *out_count receives how many there are, maybe 0.
 * `tolerance` as there, of each two bodies. Where three or more bodies meet, each two that share faces have a pair
 * there. DELAM_ERROR_MESH when faces of two bodies overlap without matching (the first place is named; the mesh is
 * unchanged). Bodies whose faces are farther from each other than the tolerance, such as the two sides of a curved
 * interface meshed apart, do not touch in this sense and get no interface.
 * [unit tolerance 1 in [0, 0.5); null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_all_interfaces(delam_mesh *mesh, double tolerance, int64_t *out_count);
/* An interface of two bodies, a = body_a and b = body_b, whose meshes do not match; *out_interface receives its index.
 * The faces of b that lie on faces of a, within the distance `gap` (L; 0 gives 1e-6 of the shortest edge) and looking
 * against them within 60 degrees, are paired with their projections: each of b's nodes there with a tied node, appended
 * to the mesh at the nearest point of a's faces, without cells, whose displacement is sum_i N_i u_i of the nodes of the
 * face below it (delam_mesh_node_ties; N_i its shape functions, of curved faces too). node_a is the tied node, node_b
 * that of b; weights, faces and normals (turned to point from a to b) are those of b's faces, as by
 * delam_mesh_add_interface. Order of pairs likewise. Take the body with the finer mesh as b: linear displacements are
 * continuous across a perfect bond whichever is finer, but the forces of a uniform traction reach a through the N_i at
 * b's nodes, which is exact where a's nodes are among b's (b refines a) and else leaves an error in the cells at the
 * interface that falls with the square of the ratio of edges. Measured as the largest error of a stress in a patch
 * test, edges of a to b as 3:4, 3:7, 3:13: 0.6, 0.18, 0.05 % (quad4), 7.5, 2.3, 0.6 % (hex8). With b coarser than a,
 * nodes of a between those of b are held by nothing: 3:2 gives 2.4 and 36 %. Choose `gap` as large as the chords of
 * curved faces need and no larger: a rotation of both bodies by an angle makes a jump of that angle times the distance
 * of a node from its projection. A face of b must lie on a as a whole or not at all (a may reach beyond b, faces of b
 * may lie side by side with a's rim): DELAM_ERROR_MESH with the place where one lies on a in part only, where no face
 * of b lies on a, or when the two are joined.
 * [unit gap L >= 0; null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_projected_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double gap,
                                                     int64_t *out_interface);
/* A rigid obstacle (loading nose, support, symmetry plane) that nodes of one body may touch; it moves as one
 * translation, that of its control node: control_node, a node of the mesh without cells, the same for several obstacles
 * if they move together (0-based, as all single indices). An interface is added, *out_interface its index, with a pair
 * for each node, in the order given: node_a is the control node, body_a is -1, node_b the node. Its jump is u_node -
 * u_control.
 *   nodes    [count] of one body, each once
 *   normals  [count][dimension], of any length > 0, from the obstacle into the body
 *   weights  [count] > 0, length (2D) or area (3D) that a pair stands for; NULL: the nodal weights
 *            (delam_mesh_add_interface) of the body's boundary faces of which all nodes are listed and face the
 *            obstacle; a node on none is refused
 * [unit normals 1 finite (not 0), weights L or L2 > 0; null weights; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_obstacle(delam_mesh *mesh, int64_t count, const int64_t *nodes, const double *normals,
                                          const double *weights, int64_t control_node, int32_t index_base,
                                          int64_t *out_interface);
/* A body without cells, of which the host gives the stiffness (delam_problem_set_stiffness): nodes [count] of the mesh
 * that belong to no body yet, each once; body: a label >= 0 that no cell has. Its interfaces are made of pairs
 * (delam_mesh_add_pairs, delam_mesh_add_obstacle with weights). Of where its nodes lie only rigid motions and places in
 * the output depend.
 * [null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_host_body(delam_mesh *mesh, int32_t body, int64_t count, const int64_t *nodes,
                                           int32_t index_base);
/* An interface of pairs that the host knows, of bodies with or without cells, in the order given; *out_interface its
 * index. Nodes of a pair may lie apart: the jump is u_b - u_a.
 *   nodes_a, nodes_b  [count], of body_a and of body_b, each once
 *   normals   [count][dimension], of any length > 0, from a to b
 *   weights   [count] > 0, length (2D) or area (3D) that a pair stands for
 *   faces     [face_count][nodes_per_face] indices into the pairs (from index_base too), corners then mid-sides: 2 or 3
 *             in 2D; 3, 4, 6 or 8 in space, seen from b counter-clockwise; triangles among quadrilaterals repeat their
 *             last corner. face_count 0: none. Fronts, the gradient term and the neighbours that an energetic search
 *             advances to are known from faces alone
 * [unit normals 1 finite (not 0), weights L or L2 > 0; null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_pairs(delam_mesh *mesh, int32_t body_a, int32_t body_b, int64_t count,
                                       const int64_t *nodes_a, const int64_t *nodes_b, const double *normals,
                                       const double *weights, int64_t face_count, int32_t nodes_per_face,
                                       const int64_t *faces, int32_t index_base, int64_t *out_interface);
/* Destroys a mesh; problems made of it have their own.
 * [null mesh, *mesh; owns mesh destroyed; status -; since 0.1] */
DELAM_API void delam_mesh_destroy(delam_mesh **mesh);

/* Sizes: *dimension, *node_count, *cell_count, *body_count of distinct labels and *interface_count.
 * [null dimension, node_count, cell_count, body_count, interface_count; status usual; since 0.1] */
DELAM_API int32_t delam_mesh_size(const delam_mesh *mesh, int32_t *dimension, int64_t *node_count, int64_t *cell_count,
                                  int64_t *body_count, int64_t *interface_count);
/* Coordinates of all nodes: [node_count][dimension].
 * [unit nodes L; null none; status argument; source none; since 0.1] */
DELAM_API int32_t delam_mesh_nodes(const delam_mesh *mesh, int64_t capacity, double *nodes);
/* Labels of the bodies that nodes belong to, bodies: [node_count]; -1 for a node without cells.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_node_bodies(const delam_mesh *mesh, int64_t capacity, int32_t *bodies);
/* The node that each node was doubled from (delam_mesh_add_conforming_cells), itself otherwise; origins: [node_count].
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_node_origins(const delam_mesh *mesh, int64_t capacity, int64_t *origins);
/* Tied nodes (delam_mesh_add_projected_interface), ascending: u of nodes[i] is the sum of weights[e] u of of[e] over e
 * = starts[i] .. starts[i+1]-1. *count tied nodes and *entries: sizes; nodes [count], starts [count+1], of and weights
 * [entries]. Weights sum to 1 and may be negative on quadratic faces.
 * [unit weights 1; null count, entries, nodes, starts, of, weights; status usual; source none; since 0.1] */
DELAM_API int32_t delam_mesh_node_ties(const delam_mesh *mesh, int64_t *count, int64_t *entries, int64_t *nodes,
                                       int64_t *starts, int64_t *of, double *weights);
/* Cells in the order they were added: types, bodies [cell_count], offsets [cell_count+1] into connectivity [*needed].
 * capacity counts entries of connectivity and *needed receives how many there are.
 * [null types, bodies, offsets, connectivity, needed; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_cells(const delam_mesh *mesh, int32_t *types, int32_t *bodies, int64_t *offsets,
                                   int64_t capacity, int64_t *connectivity, int64_t *needed);
/* Sizes of an interface: its bodies *body_a (-1 for an obstacle) and *body_b, *pair_count pairs, *face_count paired
 * faces of *nodes_per_face nodes.
 * [null body_a, body_b, pair_count, face_count, nodes_per_face; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_interface_size(const delam_mesh *mesh, int64_t interface_index, int32_t *body_a,
                                            int32_t *body_b, int64_t *pair_count, int64_t *face_count,
                                            int32_t *nodes_per_face);
/* Pairs of an interface. nodes_a, nodes_b, weights: [pair_count] (weights L or L2);
 * frames: [pair_count][dimension][dimension], rows normal, tangent(s), orthonormal.
 * [unit weights L or L2 > 0, frames 1; null nodes_a, nodes_b, weights, frames; status argument; source none;
 * since 0.1] */
DELAM_API int32_t delam_mesh_interface_pairs(const delam_mesh *mesh, int64_t interface_index, int64_t *nodes_a,
                                             int64_t *nodes_b, double *weights, double *frames);
/* Faces of an interface as pair indices, faces: [face_count][nodes_per_face], corners then mid-sides (2, 3, 4 nodes; 3,
 * 6, 8 of quadratic cells). Triangles among quadrilaterals repeat their last corner, also as the mid-side node of the
 * side that has shrunk to it.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_interface_faces(const delam_mesh *mesh, int64_t interface_index, int64_t *faces);
/* Nodes of a body (-1: of all, and those without cells that are not tied) inside the closed box from lower [dimension]
 * to upper [dimension] (widened by 1e-9 of the mesh's size). *count receives how many there are; the first `capacity`
 * are written to nodes [capacity], ascending.
 * [unit lower L finite, upper L >= lower; null none; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_find_nodes(const delam_mesh *mesh, int32_t body, const double *lower, const double *upper,
                                        int64_t capacity, int64_t *nodes, int64_t *count);
/* Integrals of the nodal shape functions over the part of a body's boundary faces (-1: of each body's, those at
 * interfaces too) inside the box from lower [dimension] to upper [dimension]: the weights of a uniform traction on a
 * patch of fixed size, independent of the mesh. Faces are cut exactly where the box ends within them (2D: exact; 3D:
 * faces as triangles). Only faces whose outward normal is within 45 degrees of direction [dimension] (any length > 0)
 * count. nodes, weights: [capacity], of which the first *count are written; *count receives how many there are. Weights
 * in L (2D) or L2 (3D), with a sum > 0. Those of linear cells are all > 0; quadratic cells also have negative ones (a
 * corner of an 8-node face: -1/12 of its area). DELAM_ERROR_MESH: two cells lie on the same side of a face they share.
 * [unit lower L finite, upper L >= lower, direction 1 finite (not 0), weights L or L2 sum > 0; null none; status
 * cancelled, argument, mesh; source none; since 0.1] */
DELAM_API int32_t delam_mesh_find_patch(const delam_mesh *mesh, int32_t body, const double *lower, const double *upper,
                                        const double *direction, int64_t capacity, int64_t *nodes, double *weights,
                                        int64_t *count);

/* ---- interface law ----------------------------------------------------------------------------------------------- */

/* At the mixity B = Y_t/Y, with the driving energy Y = Y_n + Y_t, Y_c = k_c [u]_c^2 / 2, adhesion zeta minimises
 * zeta Y + g(B, zeta) over 0 <= zeta <= old adhesion. g, the energy spent, is convex and decreasing in zeta,
 * g(B, 1) = 0, g(B, 0) = Gc(B), and its slope at zeta = 1 is minus the onset Go(B). On a first loading at fixed mixity
 * the traction peaks at sqrt(2 k Go), and the area under it is Gc. kind:
 *   piecewise-linear  the bilinear law: traction falls on a straight line (slides; Valoroso and Champaney 2006)
 *   exponential       it decays, over (Gc/Go - 1)/2 of the jump at the onset; never to nothing
 *   trapezoidal       it stays at its peak on the part `plateau` of the way from onset to end, then falls on a straight
 *                     line
 *   tabulated         it follows the points of delam_law_set_table
 *   griffith          no softening: debonded at once where Y reaches Gc; no onset of its own
 *   host              callbacks of the host: delam_law_create_host (delam_law_create refuses this kind)
 * Numbers, by key with delam_law_set (delam_law_parameter_info lists those of a kind):
 *   normal_stiffness, tangential_stiffness  k_n, k_t  F/L3  > 0
 *   normal_onset, tangential_onset          G^o       F/L   > 0
 *   normal_toughness, tangential_toughness  G^c       F/L   >= onset
 *   plateau                                 [0, 1)    trapezoidal only
 *   gradient                                kappa >= 0, F L, default 0, of the term kappa/2 |grad zeta|^2
 * and exponents > 0, default 2, of the criterion, a text set with delam_law_set_text (which sets them to 2 where it
 * changes it):
 *   valoroso-champaney (default)  ((1-B) G/G_n)^p + (B G/G_t)^q = 1 (Eng. Fract. Mech. 73, 2006), p and q:
 *                                 onset_exponent_1, onset_exponent_2, toughness_exponent_1, toughness_exponent_2
 *   power                         the same with p = q: onset_exponent, toughness_exponent
 *   benzeggagh-kenane             G_n + (G_t - G_n) B^eta (Compos. Sci. Technol. 56, 1996), eta: onset_exponent,
 *                                 toughness_exponent
 * Gc(B) >= Go(B) must hold for every mixity B in [0,1]. A key that does not belong to the kind or to the criterion is
 * DELAM_ERROR_ARGUMENT.
 * With kappa > 0 the damage of an interface's pairs is one coupled minimisation and spreads over a length of about
 * sqrt(kappa/G^c), which the faces have to resolve. The term lives on the faces whose pairs all adhered at first: none
 * that touches a pair of initial adhesion 0.
 * [null none; owns out caller; status argument; source in the table above; since 0.1] */
DELAM_API int32_t delam_law_create(delam_context *context, const char *kind, delam_law **out);
/* Sets a number of a law by its key, in that key's range (see delam_law_create).
 * [unit value of key in its range; null none; status argument; since 0.1] */
DELAM_API int32_t delam_law_set(delam_law *law, const char *key, double value);
/* Sets a text of a law by its key: the criterion, to a value of those above.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_law_set_text(delam_law *law, const char *key, const char *value);
/* Softening of a tabulated law. xi, s: [count], count >= 2, from (0, 1) to (1, 0): the jump beyond that of the onset
 * over its largest, not falling, and the traction over its peak, not rising; straight lines between. xi is scaled so
 * that the area is Gc, at every mixity. Points out of order: DELAM_ERROR_ARGUMENT, the law is unchanged.
 * [unit xi 1 in [0, 1], s 1 in [0, 1]; null none; status argument; since 0.1] */
DELAM_API int32_t delam_law_set_table(delam_law *law, int64_t count, const double *xi, const double *s);
/* Parameters of a kind, all its criteria taken together; 0 for an unknown kind.
 * type: "real", "text" or "table" (delam_law_set, delam_law_set_text, delam_law_set_table); initial: "" where it must
 * be given. An unknown kind or index: DELAM_ERROR_ARGUMENT.
 * [null kind; status -; thread any; since 0.1] */
DELAM_API int64_t delam_law_parameter_count(const char *kind);
/* One of them, by index from 0; kind as there.
 * [null kind, key, type, unit, initial, range, meaning; owns texts static; status only argument; thread any;
 * since 0.1] */
DELAM_API int32_t delam_law_parameter_info(const char *kind, int64_t index, const char **key, const char **type,
                                           const char **unit, const char **initial, const char **range,
                                           const char **meaning);

/* Callbacks of a law that the host computes; non-zero return: failed, the call of the library ends with
 * DELAM_ERROR_PROBLEM. They run inside calls that check or use the law, on the calling thread, must not call back into
 * the library (delam_context_cancel aside), and must always give the same answers. */
/* Gives *adhesion on a first loading at fixed mixity: the minimiser zeta*(B, Y) of zeta Y + g(B, zeta) in [0,1],
 * nonincreasing in driving = Y; *slope: d zeta* / dY, finite (0 where it is not inside).
 * [unit mixity 1 in [0, 1], driving F/L >= 0, adhesion 1 in [0, 1], slope L/F <= 0; null user; status problem; thread
 * call's; since 0.1] */
typedef int32_t (*delam_adhesion_callback)(double mixity, double driving, double *adhesion, double *slope, void *user);
/* Gives *dissipated = g(B, zeta) >= 0 at an adhesion; *slope: dg/dzeta, may be -INFINITY at adhesion 0; *mixity_slope:
 * dg/dB.
 * [unit mixity 1 in [0, 1], adhesion 1 in [0, 1], dissipated F/L, slope F/L <= 0, mixity_slope F/L finite; null user;
 * status problem; thread call's; since 0.1] */
typedef int32_t (*delam_dissipation_callback)(double mixity, double adhesion, double *dissipated, double *slope,
                                              double *mixity_slope, void *user);
/* A law of kind host. adhesion gives zeta*, dissipation g; Go = -dg/dzeta at adhesion 1, Gc = g at adhesion 0. name,
 * not empty, stands for the callbacks in messages and in delam_problem_hash. Callbacks and user must live as long as
 * problems and solvers that took the law, and to the end of a call at work that destroys these. Keys: normal_stiffness, tangential_stiffness, gradient. delam_law_check
 * samples whether both callbacks belong to one such energy and names the first place where they do not;
 * delam_problem_set_law checks likewise.
 * [null user; owns out caller, callbacks and user: the host, as long as problems and solvers that took the law; status
 * argument; since 0.1] */
DELAM_API int32_t delam_law_create_host(delam_context *context, const char *name, delam_adhesion_callback adhesion,
                                        delam_dissipation_callback dissipation, void *user, delam_law **out);
/* All parameters present and admissible? DELAM_ERROR_PROBLEM names the first that is not.
 * [status problem; since 0.1] */
DELAM_API int32_t delam_law_check(const delam_law *law);
/* Onset and total toughness of a law at count mixities B = Y_t/Y; mixity, onset, toughness: [count].
 * [unit mixity 1 in [0, 1], onset F/L, toughness F/L; null onset, toughness; status argument, problem; source of
 * delam_law_create; since 0.1] */
DELAM_API int32_t delam_law_toughness(const delam_law *law, int64_t count, const double *mixity, double *onset,
                                      double *toughness);
/* One damage step at given jumps, without the gradient term: pointwise minimiser over 0 <= zeta <= old adhesion, at the
 * given (frozen) mixity, and the traction zeta k [u]. jump, traction: [count][dimension], local (normal first; a
 * negative normal jump is an error); mixity, adhesion_old, adhesion: [count].
 * [unit jump L finite (normal >= 0), mixity 1 in [0, 1], adhesion_old 1 in [0, 1], adhesion 1 in [0, 1], traction
 * F/L2; null traction; status argument, problem; source of delam_law_create; since 0.1] */
DELAM_API int32_t delam_law_respond(const delam_law *law, int32_t dimension, int64_t count, const double *jump,
                                    const double *mixity, const double *adhesion_old, double *adhesion,
                                    double *traction);
/* Destroys a law; problems that took it have their own.
 * [null law, *law; owns law destroyed; status -; since 0.1] */
DELAM_API void delam_law_destroy(delam_law **law);

/* ---- problem: materials, laws, supports, loads, options ---------------------------------------------------------- */

/* The mesh is taken as it is now; later changes to it are not seen.
 * [null none; owns out caller; status argument; since 0.1] */
DELAM_API int32_t delam_problem_create(delam_context *context, const delam_mesh *mesh, delam_problem **out);
/* Destroys a problem; solvers made of it have their own.
 * [null problem, *problem; owns problem destroyed; status -; since 0.1] */
DELAM_API void delam_problem_destroy(delam_problem **problem);

/* assumption: "plane-strain" (default) or "plane-stress"; 2D only.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_plane(delam_problem *problem, const char *assumption);
/* Isotropic elasticity of a body (-1: of all): young > 0 (F/L2), -1 < poisson < 0.5.
 * [unit young F/L2 > 0, poisson 1 in (-1, 0.5); status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_elastic(delam_problem *problem, int32_t body, double young, double poisson);
/* Orthotropic elasticity of a body (-1: of all) in its material axes 1, 2, 3: constants [9] = E1 E2 E3 nu12 nu13 nu23
 * G12 G13 G23 (moduli F/L2 > 0). nu_ij is the contraction along j under tension along i: nu_ij/E_i = nu_ji/E_j.
 * DELAM_ERROR_ARGUMENT names the constant that makes the elasticity indefinite, and its bound. Transversely isotropic
 * about 1: E3 = E2, nu13 = nu12, G13 = G12, G23 = E2/(2(1 + nu23)). Material axes are those of space unless
 * delam_problem_set_orientation says otherwise. In 2D: plane strain takes the rows xx, yy, xy of the elasticity in
 * space; plane stress sets the stresses zz, yz, zx free. Replaces what delam_problem_set_elastic has set, and the other
 * way round.
 * [unit constants F/L2 or 1 finite (definite); null none; status argument; source S. W. Tsai, H. T. Hahn,
 * Introduction to Composite Materials (1980); since 0.1] */
DELAM_API int32_t delam_problem_set_orthotropic(delam_problem *problem, int32_t body, const double *constants);
/* Material axes of some cells, for orthotropic materials and eigenstrains. axes: [count][2][3], directions of axes 1
 * and 2 in space, also in 2D (z is out of the plane there), any lengths > 0, not parallel; 2 is made normal to 1, 3 = 1
 * x 2. cells: [count] mesh cells, of `body` (-1: of any); NULL with count 1: all cells of the body. Later calls
 * overwrite earlier ones. Cells of equal axes share them.
 * [unit axes 1 finite (not parallel); null cells; status cancelled, argument; since 0.1] */
DELAM_API int32_t delam_problem_set_orientation(delam_problem *problem, int32_t body, int64_t count,
                                                const int64_t *cells, const double *axes, int32_t index_base);
/* How the cells of a body (-1: of all) are computed, formulation: "standard" (default), or "incompatible" for bodies of
 * quad4 or hex8 alone (DELAM_ERROR_ARGUMENT names another cell): internal bending modes after Wilson, Taylor and
 * Beresford, condensed in each cell. Pure bending of rectangular cells is then exact, where standard ones are too stiff
 * (by half for squares). The displacement between nodes may gap or overlap a little. "mean-dilatation", for nearly
 * incompressible bodies, where others lock: the dilatation of each cell is projected, onto constants (quad4, hex8,
 * tri6, tet10) or linear functions (quad8, quad9, hex20). Plane strain and space only; tri3 and tet4 are refused, their
 * dilatation is constant already.
 * [null none; status argument; source R. Taylor, P. Beresford, E. Wilson, Int. J. Numer. Meth. Eng. 10 (1976) 1211-1219
 * and T. Hughes, ibid. 15 (1980) 1413-1418; since 0.1] */
DELAM_API int32_t delam_problem_set_formulation(delam_problem *problem, int32_t body, const char *formulation);
/* The stiffness of whole bodies as the host has assembled it, in the place of cells and material; of bodies with cells
 * and of those without (delam_mesh_add_host_body). A material, if there is one, then serves the stresses of the output
 * alone; eigenstrains of such a body are refused, their forces are the host's (delam_problem_add_forces). Of a body
 * without cells or material stresses are NaN.
 *   nodes       [count] all nodes of one or several bodies, each once
 *   dofs        [count][dimension] row of each displacement, each of 0 .. dimension*count-1 (from index_base) once;
 *               NULL: dimension*i + component of nodes[i]. All rows are displacements of nodes: others are to be
 *               condensed before
 *   row_starts  [dimension*count + 1], from index_base too; columns, values [entries]: CSR, both triangles; entries
 *               that come twice add up. Symmetric to 1e-9, positive on what deforms (one sparse factorisation tells)
 *   kernel      [kernel_count][dimension*count] motions without energy, by row. Parts that hang together in the matrix
 *               are rigid pieces, their free motions rigid ones: a mechanism within is refused. Rows that the host has
 *               emptied but for the diagonal, for supports of its own, are held for ever. kernel_count -1 (NULL then):
 *               the library finds how far a piece is held; a motion whose energy is between 1e-12 and 1e-9 of that of
 *               the diagonal alone must be told
 * DELAM_ERROR_ARGUMENT names the node, row or entry.
 * FETI takes each piece whole. Later calls replace the stiffness of the bodies that they have.
 * [unit values F/L finite, kernel 1 finite; null dofs; status cancelled, argument, numerical; source C. Farhat, M.
 * Geradin, Int. J. Numer. Meth. Eng. 41 (1998) 675-696 (motions without energy); since 0.1] */
DELAM_API int32_t delam_problem_set_stiffness(delam_problem *problem, int64_t count, const int64_t *nodes,
                                              const int64_t *dofs, const int64_t *row_starts, const int64_t *columns,
                                              const double *values, int64_t kernel_count, const double *kernel,
                                              int32_t index_base);
/* The law of an interface; its parameters are taken as they are now. The initial adhesion is as it was: 1
 * everywhere, or what delam_problem_set_adhesion has set.
 * [status argument, problem; since 0.1] */
DELAM_API int32_t delam_problem_set_law(delam_problem *problem, int64_t interface_index, const delam_law *law);
/* The interface is glued perfectly and for ever (zero compliance). Each interface needs a law, this or
 * delam_problem_set_contact.
 * [status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_bonded(delam_problem *problem, int64_t interface_index);
/* The interface has contact alone: faces that may part but not overlap, without friction, and no adhesion: an unglued
 * joint, a unilateral support. Its initial adhesion is 0 (delam_problem_check refuses another).
 * [status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_contact(delam_problem *problem, int64_t interface_index);
/* Initial adhesion of some pairs; 0 makes a notch: no adhesion, contact stays. pairs, adhesion: [count].
 * [unit adhesion 1 in [0, 1]; null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_adhesion(delam_problem *problem, int64_t interface_index, int64_t count,
                                             const int64_t *pairs, const double *adhesion, int32_t index_base);

/* A load pattern: a named factor that follows a piecewise-linear history, constant beyond its ends. times: [count]
 * strictly increasing; values: [count]; count >= 1. name: unique, letters, digits, '_' and '-'. *out_pattern: its
 * index, from 0.
 * [unit times t finite (increasing), values 1 finite; null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_add_pattern(delam_problem *problem, const char *name, int64_t count,
                                            const double *times, const double *values, int64_t *out_pattern);
/* Control nodes: nodes of the mesh without cells. Prescriptions, means, equations, periods, forces and pairs may refer
 * to them; each is then an unknown translation [dimension] without stiffness of its own, wherever it lies: a rigid
 * loading nose, an average strain. Something must hold it. Nodes without cells that nothing refers to are absent. Tied
 * nodes (projected interfaces) may be used too: they stand for what they are tied to. */
/* Prescribes, for each of nodes [count], direction . u = sum over patterns of coefficients[i][p] * factor_p(t).
 * direction: [dimension], any length > 0 (normalised). patterns: [pattern_count]; coefficients: [count][pattern_count],
 * L per factor. pattern_count 0: held at zero.
 * [unit direction 1 finite (not 0), coefficients L finite; null none; status cancelled, argument, problem;
 * since 0.1] */
DELAM_API int32_t delam_problem_prescribe_nodes(delam_problem *problem, int64_t count, const int64_t *nodes,
                                                const double *direction, int64_t pattern_count, const int64_t *patterns,
                                                const double *coefficients, int32_t index_base);
/* Prescribes one weighted mean over nodes: sum_i weights[i] direction . u_i / sum_i weights[i] = sum of coefficients[p]
 * * factor_p(t). With the weights of delam_mesh_find_patch: a support or load spread as a uniform traction over a patch
 * of fixed size, which has a limit as the mesh is refined (a point support has none). nodes: [count], each once;
 * weights: [count], sum > 0; direction: [dimension], any length > 0; patterns, coefficients: [pattern_count].
 * [unit weights 1 sum > 0, direction 1 finite (not 0), coefficients L finite; null none; status cancelled, argument,
 * problem; since 0.1] */
DELAM_API int32_t delam_problem_prescribe_mean(delam_problem *problem, int64_t count, const int64_t *nodes,
                                               const double *weights, const double *direction, int64_t pattern_count,
                                               const int64_t *patterns, const double *coefficients, int32_t index_base);
/* A linear equation among displacements of nodes of any bodies and control nodes:
 *   sum_i coefficients[i][:] . u_nodes[i] = sum over patterns of prescribed[p] * factor_p(t)
 * nodes: [count], count >= 1, a node may come several times; coefficients: [count][dimension], not all 0, taken as they
 * are; patterns, prescribed: [pattern_count]; pattern_count 0: homogeneous. Its reaction is the force that goes with
 * the left side (sum of coefficient * force). Equations of up to 32 displacements are eliminated exactly and cost no
 * unknown, however many there are; those of longer ones stay in the dense stage of the condensed operator. Among rigid
 * lines that turn: write u_i = u_0 + w r_i with equations of three nodes. delam_problem_check refuses, by number, an
 * equation that others imply or contradict.
 * [unit coefficients 1 finite (not all 0), prescribed L finite; null none; status cancelled, argument, problem;
 * since 0.1] */
DELAM_API int32_t delam_problem_add_equation(delam_problem *problem, int64_t count, const int64_t *nodes,
                                             const double *coefficients, int64_t pattern_count, const int64_t *patterns,
                                             const double *prescribed, int32_t index_base);
/* A periodic cell: u(x + period_k) - u(x) = u of control node k, for all nodes on opposite faces of the mesh, which
 * must be a parallelepiped along its periods (with fewer periods than dimensions it may have any shape across them).
 * periods: [period_count][dimension] L, independent, 1 <= period_count <= dimension; control_nodes: [period_count],
 * distinct, without cells. tolerance: largest distance of partners as a fraction of the cells' largest extent; 0 gives
 * 1e-6. Partners are nodes of the same body; where bodies touch at a place and one node is left over on each side (a
 * fibre that the cell's edge cuts into two bodies), these. Edges and corners get no redundant equations.
 * DELAM_ERROR_MESH names nodes without a partner. The displacement of control node k is the average displacement
 * gradient along its period, <grad u> period_k, opening of interfaces included: prescribe it (average strain e: u_k = e
 * period_k), or put dead forces F_k on it (average stress s of a cell of volume V = |det periods|: F_k = V s d_k with
 * the dual vectors d_k . period_l = 1 if k = l, else 0). The average stress is 1/V sum_k F_k (x) period_k, F_k the
 * force on control node k: its reaction where it is prescribed. Of the cell itself one node must be held against
 * translation, and as long as the average rotation is not prescribed, control nodes against it: d(d-1)/2 components,
 * e.g. y of control node 0 in 2D.
 * [unit periods L finite (independent), tolerance 1 in [0, 0.5); null none; status cancelled, argument, mesh;
 * since 0.1] */
DELAM_API int32_t delam_problem_add_periodic(delam_problem *problem, int64_t period_count, const double *periods,
                                             const int64_t *control_nodes, double tolerance, int32_t index_base);
/* Dead forces on nodes [count]: forces [count][dimension] times the factor of the pattern. A pattern drives either
 * forces or prescribed displacements.
 * [unit forces F finite; null none; status cancelled, argument, problem; since 0.1] */
DELAM_API int32_t delam_problem_add_forces(delam_problem *problem, int64_t pattern, int64_t count, const int64_t *nodes,
                                           const double *forces, int32_t index_base);

/* Eigenstrain (thermal expansion, swelling, cure shrinkage) of a body (-1: of all), in its material axes: strain [6] =
 * xx, yy, zz, 2xy, 2yz, 2zx times the factor of the pattern, which drives nothing else. Stress = C (eps - factor
 * strain); stored_bulk is the energy of that stress. Several add up. Plane strain: strain zz makes stress in the plane
 * as well; plane stress: zz, 2yz, 2zx are free and do nothing. reaction:NAME of such a pattern is dE/dfactor = - int
 * strain : stress, and `work` what the change of the eigenstrain has done on the bodies.
 * [unit strain 1 finite; null none; status argument, problem; since 0.1] */
DELAM_API int32_t delam_problem_add_eigenstrain(delam_problem *problem, int64_t pattern, int32_t body,
                                                const double *strain);

/* Options by key; see delam_option_info. Numbers of integer options must be whole.
 * [unit value of key in its range; null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_number(delam_problem *problem, const char *key, double value);
/* A text option by key, with a value of its list.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_text(delam_problem *problem, const char *key, const char *value);
/* How many options there are (delam_option_info).
 * [status -; thread any; since 0.1] */
DELAM_API int64_t delam_option_count(void);
/* An option, by index from 0. type: "real", "integer", "text".
 * [null key, type, unit, initial, range, meaning; owns texts static; status only argument; thread any; since 0.1] */
DELAM_API int32_t delam_option_info(int64_t index, const char **key, const char **type, const char **unit,
                                    const char **initial, const char **range, const char **meaning);

/* Everything there and consistent: materials, laws, supports against every rigid motion of what hangs together.
 * Cells that lie on the same side of a face that they share: DELAM_ERROR_MESH.
 * [status cancelled, mesh, problem; since 0.1] */
DELAM_API int32_t delam_problem_check(delam_problem *problem);
/* Hash of everything that determines the result, as 16 hexadecimal digits and a terminating zero: out[17].
 * [null none; status cancelled, argument; since 0.1] */
DELAM_API int32_t delam_problem_hash(const delam_problem *problem, char *out);
/* *primal DOFs (nodes times dimension) and *dual DOFs (pairs times dimension, notch included).
 * [null primal, dual; status usual; since 0.1] */
DELAM_API int32_t delam_problem_dofs(const delam_problem *problem, int64_t *primal, int64_t *dual);

/* *length of the process zone to be expected on an interface, and *spacing, the mean distance of its pairs (3D: square
 * root of the mean weight): about 3 pairs or more resolve it. With peak traction s = sqrt(2 k Go) and toughness Gc, the
 * shorter of modes I and II: E' Gc/s^2, in slender arms of thickness h (E' Gc/s^2)^(1/4) h^(3/4) in mode I and (h E'
 * Gc)^(1/2)/s in mode II (Yang and Cox, Int. J. Fract. 133, 2005), where these are shorter. E' = E/(1 - nu^2), in plane
 * stress E, of an orthotropic body its smallest Young's modulus, h: volume of the body over area of the interface; of
 * the two bodies the one with the shorter zone. An estimate: a factor of 2 either way. length 0: bonded, a law
 * without softening, or bodies of the host's alone.
 * [unit length L, spacing L; null length, spacing; status cancelled, argument, problem; source Q. Yang, B. Cox, Int. J.
 * Fract. 133 (2005); since 0.1] */
DELAM_API int32_t delam_problem_process_zone(const delam_problem *problem, int64_t interface_index, double *length,
                                             double *spacing);

/* What the library assembled, for hosts that check or reuse it. Stiffness of a body, both triangles, CSR over the
 * body's DOFs: local node i of the body is the i-th ascending mesh node of that body, its DOFs dimension*i + component.
 * Call with NULL arrays for *rows and *entries, then with row_starts [rows+1], columns [entries] and values [entries].
 * [unit values F/L; null rows, entries, row_starts, columns, values; status cancelled, argument, problem; source T.
 * Hughes, The Finite Element Method (1987), chapters 3 and 4; since 0.1] */
DELAM_API int32_t delam_problem_body_matrix(const delam_problem *problem, int32_t body, int64_t *rows, int64_t *entries,
                                            int64_t *row_starts, int64_t *columns, double *values);
/* Constraints (prescribed nodes, means, equations, periods in the order they were added), one a row, CSR over mesh DOFs
 * (dimension*node + component; of bodies and control nodes, tied ones replaced), and their right-hand sides as
 * coefficients [rows][pattern_count]. row_starts [rows+1], columns and values [entries]; NULL arrays ask for the sizes
 * *rows, *entries and *pattern_count.
 * [unit values 1, coefficients L; null rows, entries, pattern_count, row_starts, columns, values, coefficients; status
 * cancelled; source none; since 0.1] */
DELAM_API int32_t delam_problem_constraints(const delam_problem *problem, int64_t *rows, int64_t *entries,
                                            int64_t *pattern_count, int64_t *row_starts, int64_t *columns,
                                            double *values, double *coefficients);
/* Nodal forces of a pattern at factor 1, forces: [primal DOFs]: dead forces, or int B^T C e* of its eigenstrains e*.
 * [unit forces F; null none; status cancelled, argument, problem; source none; since 0.1] */
DELAM_API int32_t delam_problem_forces(const delam_problem *problem, int64_t pattern, int64_t capacity, double *forces);
/* matrix: [pattern_count][pattern_count], W_pq = int e*_p : C : e*_q of the eigenstrains, 0 for other patterns. With it
 * the energy of the bodies is 1/2 u.K u - sum factor_p f_p.u + 1/2 sum factor_p W_pq factor_q, f_p as
 * delam_problem_forces gives it. capacity: pattern_count^2.
 * [unit matrix F L; null none; status cancelled, argument, problem; source none; since 0.1] */
DELAM_API int32_t delam_problem_eigenstrain_energy(const delam_problem *problem, int64_t capacity, double *matrix);
/* Factors of all patterns at a time, factors: [pattern_count].
 * [unit time t finite, factors 1; null none; status argument; source none; since 0.1] */
DELAM_API int32_t delam_problem_factors(const delam_problem *problem, double time, int64_t capacity, double *factors);
/* Number of patterns into *count.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_pattern_count(const delam_problem *problem, int64_t *count);
/* Name of a pattern; NULL on error.
 * [null result; owns result the problem; status argument; since 0.1] */
DELAM_API const char *delam_problem_pattern_name(const delam_problem *problem, int64_t pattern);

/* ---- solver: operator, state, history ---------------------------------------------------------------------------- */

/* Checks the problem, cuts and factors the bodies. The problem is taken as it is now. The state is the initial one at
 * time `time` (step 0): unloaded histories are expected there; the displacement at that time's loads is solved for at
 * the initial adhesion. DELAM_NOT_CONVERGED: that displacement step met a limit; *out is valid all the same.
 * [unit time t finite; null none; owns out caller; status not_converged, cancelled, limit, argument, mesh, problem,
 * numerical; source src/reduction/README.md; since 0.1] */
DELAM_API int32_t delam_solver_create(const delam_problem *problem, double time, delam_solver **out);
/* Destroys a solver and its state.
 * [null solver, *solver; owns solver destroyed; status -; since 0.1] */
DELAM_API void delam_solver_destroy(delam_solver **solver);

/* One load step to `time` (> the committed time): minimisation (option minimisation) from the committed state, under
 * the concept of option solution: local, or energetic, where a search for lower states follows. With option
 * backtracking earlier steps may be replaced (value revised_from; delam_solver_look reads them); with jump_tolerance,
 * step_control or mixity_step_tolerance the step is walked in parts (steps that a return replaces are not: their jumps
 * are not located). The result is pending: it can be read, then committed or rolled back (bit for bit the state
 * before). DELAM_NOT_CONVERGED leaves a pending step too: a limit of iterations was met, or rounding leaves
 * nodal forces out of balance by more than 1e-3 of the largest reaction (plies thousands of times longer than thick);
 * DELAM_LIMIT, DELAM_CANCELLED and errors leave none. Warnings (level 1) say once when that balance is worse than 1e-6,
 * and when a front grew with fewer than 3 pairs in its process zone (laws that soften, solution = local). A process
 * that has used the library and then forks should use it in one of the two only (threads of the linear algebra).
 * [unit time t > committed; status not_converged, cancelled, limit, argument, problem, state, numerical; source A.
 * Mielke, T. Roubicek, J. Zeman, Comput. Methods Appl. Mech. Eng. 199 (2010) 1242-1253, and src/evolution/README.md;
 * since 0.1] */
DELAM_API int32_t delam_solver_advance(delam_solver *solver, double time);
/* Keeps the pending step: it becomes the committed state, and what is recorded (delam_solver_record) gets its values.
 * DELAM_ERROR_PROBLEM: a law of the host's own failed when a recorded front asked it; the step is still pending.
 * [status problem, state; since 0.1] */
DELAM_API int32_t delam_solver_commit(delam_solver *solver);
/* Throws the pending step away.
 * [status state; since 0.1] */
DELAM_API int32_t delam_solver_rollback(delam_solver *solver);
/* *pending: 1 if there is a step to be committed or rolled back, else 0.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_solver_pending(const delam_solver *solver, int32_t *pending);
/* Another history of a load pattern from the committed time on, for hosts that learn of it as they go: straight from
 * the factor there to values[0] at times[0], and on through the points, constant beyond the last. Steps up to the
 * committed one keep theirs. times: [count] strictly increasing, the first after the committed time; values: [count];
 * count >= 1. It is part of what delam_solver_save saves. DELAM_ERROR_STATE: a step is pending.
 * [unit times t > committed (increasing), values 1 finite; null none; status argument, state; since 0.1] */
DELAM_API int32_t delam_solver_set_history(delam_solver *solver, int64_t pattern, int64_t count, const double *times,
                                           const double *values);
/* One displacement step alone: minimal-energy displacements at `time` with the given adhesion held: [pairs of all
 * interfaces, one after another]; NULL takes the committed one. Pending like a step, but the ledger does not move
 * (energies stored are those of the new state; dissipated, work and bounds stay). Once it is committed, steps before it
 * are no longer kept: no return goes behind it.
 * [unit time t finite, adhesion 1 in [0, 1]; null adhesion; status not_converged, cancelled, limit, argument, problem,
 * state, numerical; source M. Hintermueller, K. Ito, K. Kunisch, SIAM J. Optim. 13 (2002) 865-888; since 0.1] */
DELAM_API int32_t delam_solver_equilibrate(delam_solver *solver, double time, const double *adhesion);

/* A scalar of the pending state, else of the committed one, into *value. Keys (delam_solver_value_name lists them),
 * with the unit where it is not 1:
 *   step                   of the state, counted from 0, the initial one
 *   time                   t: of the state
 *   stored_bulk, stored_interface, dissipated, stored_interface_slides, dissipated_slides, load_potential, work, lower,
 *   increment, upper, increment_lower   F L: energies, cumulative but for the last four, which are of the step;
 *                          stored_interface holds the gradient term, if there is one. mixity_rule = variational:
 *                          increment, its bounds and increment_lower are those of the slides' split
 *   defect, defect_slides  F L: what does not close since the start, stored + load_potential + dissipated - work -
 *                          energy of the first state, in the booked and in the slides' split; a state that is set
 *                          (equilibrate) leaves them as they are
 *   mixity_error           of the step: sum w |dzeta| |Gc(B shown) - Gc(B used)| / sum w |dzeta| Gc(B used), where B
 *                          shown is that of the last iterate in which a pair adhered; 0 when nothing was damaged. A
 *                          frozen step above 0.1 has snapped: a warning (level 1) says so
 *   am_iterations, displacement_solves, contact_iterations, linear_iterations   of the step; contact_iterations sums
 *                          the active-set steps over the displacement solves, linear_iterations the Krylov ones
 *   newton_solves, debond_moves   of the step, accelerated minimisation of a condensed scene: dense solves within the
 *                          process zone, and unstable pairs that were taken straight to their debonded branch
 *   contact_iterations_first, contact_iterations_max   of the first displacement solve and of the worst
 *   contact_fallbacks      displacement solves that had to exchange one pair at a time because active sets came back
 *   contact_pairs          pairs in contact
 *   debonded_length        L or L2: weight of the pairs that adhered at first and now have zeta <= 1e-3
 *   front                  L or L2: advance of the front, sum of weight (1 - zeta) over the pairs that adhered at first
 *   process_zone           L or L2: weight of the pairs in the process zone (see delam_solver_front)
 *   backtracks             returns to an earlier step that this step has made (option backtracking)
 *   revisions              how often this step has been replaced after a return
 *   revised_from           first step that the returns of this step have replaced; its own number: none
 *   search_candidates      states that the energetic search compared
 *   search_margin          F L: the lowest of them less the state kept (>= 0 up to rounding); 0 where none was compared
 *   search_gap             F L: the state kept less what bounds the front positions that were left out from below, at
 *                          the mixities and with the contact outside the zone that the search has seen. 0: no further
 *                          advance of a single front by whole rings can be lower; it says nothing of new cracks, of
 *                          fronts together or of partly damaged states. Infinite: no bound (dead loads that nothing
 *                          holds, mixity_rule = variational)
 *   substeps, refused_steps  parts that the step was walked in, and computed parts that were not kept
 *   jumps                  instants within the step at which the state jumps (option jump_tolerance)
 *   released               F L: energy that these set free and nothing stores or dissipates
 *   bulk_factorisations    sparse factorisations of the bodies since the solver was made: condensed 1, FETI one a
 *                          subdomain
 *   field_recoveries       how often displacements were recovered from the interfaces since then: by the fields
 *                          displacement, stress, rotation and (condensed) reaction, by rotation_max,
 *                          delam_solver_average and the kkt_ values; no other value needs them (both count over the
 *                          solver's life; they are no part of its state, nor of saved bytes)
 *   damage_change          what a further damage step would change at this state, max norm: <= damage_tolerance when
 *                          converged
 *   linear_residual        worst relative residual of the iterative linear solves of the step; 0 where they are direct
 *   rotation_max           rad: largest rotation of a cell, the skew part of the displacement gradient at its centre
 *                          (recovers the displacements). Small strains miss about half its square: beyond 0.1 a warning
 *                          (level 1) says so, once. NaN where no body has cells
 *   kkt_gap                deepest penetration of the recovered displacements, over the largest jump (0 = none)
 *   kkt_pressure           largest pull of a closed contact, over the largest force of a pair (0 = none)
 *   kkt_complementarity    largest |gap * force| of a closed contact, over (largest jump * largest force)
 *   kkt_equilibrium        largest out-of-balance nodal force of the recovered displacements, over the largest reaction
 *                          or nodal force of eigenstrains (the kkt_ values recover the displacements: a sparse solve
 *                          each)
 * of the fronts of all interfaces with a law, and with :I behind it (crack_length:0) of interface I:
 *   crack_length           L or L2: initially open part, in 2D up to the pair at the tip, in 3D the faces that touch an
 *                          open pair, and sum of weight (1 - zeta) over the pairs that adhered at first
 *   energy_release_rate    F/L: G at the front point with the largest G; 0: there is no front
 *   front_mixity           (G_II + G_III)/G there
 *   process_zone_length    L: there
 *   process_zone_pairs     there (see delam_solver_front for all of these)
 * and per pattern
 *   load:NAME              its factor
 *   reaction:NAME          F L: its conjugate, positive when the device does work; of a force pattern minus the
 *                          conjugate displacement, of an eigenstrain minus the integral of stress times strain
 * delam_solver_value_count counts all of them.
 * [unit value of key; null none; status cancelled, argument, problem; source of what is computed: at
 * delam_solver_advance and delam_solver_front; since 0.1] */
DELAM_API int32_t delam_solver_value(delam_solver *solver, const char *key, double *value);
/* Number of values into *count.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_solver_value_count(const delam_solver *solver, int64_t *count);
/* Name of value `index`; NULL on error.
 * [null result; owns result the solver; status argument; since 0.1] */
DELAM_API const char *delam_solver_value_name(const delam_solver *solver, int64_t index);

/* Records a value of the committed state and, with each delam_solver_commit from now on, of every further step: a load
 * curve without asking after each step, with what a return has replaced already in place; a state that is set
 * (delam_solver_equilibrate) replaces the entry of its step. key: of delam_solver_value, but for those that recover the
 * displacements (rotation_max and the kkt_ values) and the counts of the solver's life (bulk_factorisations,
 * field_recoveries). Asked for again it changes nothing. What is recorded is part of what delam_solver_save saves;
 * delam_solver_load puts that of the bytes in its place, so record after it what must be there. DELAM_ERROR_STATE: a
 * step is pending. DELAM_ERROR_PROBLEM: a law of the host's own failed when a front asked it; nothing is recorded.
 * [null none; status argument, problem, state; since 0.1] */
DELAM_API int32_t delam_solver_record(delam_solver *solver, const char *key);
/* Recorded are *steps steps, from step *first to the committed one; 0 and 0 where no value is recorded.
 * [null first, steps; status argument; since 0.1] */
DELAM_API int32_t delam_solver_recorded_size(const delam_solver *solver, int64_t *first, int64_t *steps);
/* A recorded value step by step, values: [steps]; NaN at steps before it was asked for.
 * [unit values of key; null none; status argument; source none; since 0.1] */
DELAM_API int32_t delam_solver_recorded(const delam_solver *solver, const char *key, int64_t capacity, double *values);

/* Shape of a field, *rows and *columns. Fields are of the pending state, else of the committed one, as [rows][columns];
 * key:
 *   displacement  [nodes][dimension]    L; recovered from the interfaces when asked for
 *   stress        [cells][4 or 6]       F/L2 at the cell's centre: xx, yy, zz, xy (2D) or xx, yy, zz, xy, yz, zx
 *   rotation      [cells][1 or 3]       rad at the cell's centre, axial vector of the skew part of the displacement
 *                 gradient: about z (2D) or x, y, z
 *   jump          [pairs][dimension]    L, local: normal (>= 0), tangent(s)
 *   traction      [pairs][dimension]    F/L2, local, on face b's side as pull positive; a pressure of contact is
 *                 negative
 *   adhesion, mixity, contact  [pairs][1]   -, mixity B = Y_t/Y that the last step used (mixity_rule = converged: of
 *                          its own solution, and of a pair that broke that of the iterate in which it broke;
 *                          variational: of its own displacements), contact 1 = closed (mixity 0 where the plan left it
 *                          out because the law does not depend on it: option mixity = always)
 *   reaction      [constraints][1]      F: force of the device, positive along the constraint
 * `part`: an interface index for pair fields, -1 for all interfaces one after another; otherwise -1.
 * [null rows, columns; status argument; since 0.1] */
DELAM_API int32_t delam_solver_field_shape(const delam_solver *solver, const char *key, int64_t part, int64_t *rows,
                                           int64_t *columns);
/* The numbers of a field, values: [rows][columns], of the key and part as delam_solver_field_shape takes them.
 * [unit values of key; null none; status cancelled, argument; source none; since 0.1] */
DELAM_API int32_t delam_solver_field(delam_solver *solver, const char *key, int64_t part, int64_t capacity,
                                     double *values);

/* Strain and stress on average over the volume of a body (label; -1: of all), of the state that values and fields speak
 * of; exact. strain, stress: [6] in the order xx, yy, zz, xy, yz, zx, shear strains doubled (prescribed strains are
 * part of them), stress in F/L2; *volume in L2 or L3. In 2D the rest follows from the plane assumption. What cracks
 * open between bodies is not in it. Bodies without cells have no volume; where none has cells all are 0. Recovers the
 * displacements.
 * [unit volume L2 or L3, strain 1, stress F/L2; null volume, strain, stress; status cancelled, argument; source none;
 * since 0.1] */
DELAM_API int32_t delam_solver_average(const delam_solver *solver, int32_t body, double *volume, double *strain,
                                       double *stress);

/* Fronts of the cracks of an interface, of the state that values and fields speak of: where adhesion passes 1/2. In 2D
 * each is a point, in 3D a polyline on the faces, open or a loop. An interface without a law has none, nor has one on
 * which no pair has adhesion below 1/2. Found on request, from the jumps and adhesions alone. *fronts fronts with
 * *points points in all.
 * [null fronts, points; status argument, problem; since 0.1] */
DELAM_API int32_t delam_solver_front_count(const delam_solver *solver, int64_t interface_index, int64_t *fronts,
                                           int64_t *points);
/* The fronts of an interface; front_capacity and point_capacity count fronts and points.
 *   starts      [fronts + 1]  the points of front f are starts[f] .. starts[f+1] - 1
 *   closed      [fronts]      1: a loop, the last point is joined to the first
 *   places      [points][dimension]  L, before deformation. 2D: from the tip of the notch (the first pair that adhered)
 *                             ahead by the sum of weight (1 - zeta), of a crack that began inside half of it to either
 *                             side; 3D: where the adhesion, linear between pairs, is 1/2 (half a cell behind the 2D
 *                             figure at a sharp front)
 *   directions  [points][dimension]  unit vector along the interface, across the front, into what adheres
 *   lengths     [points]      L; 2D: of the crack that ends here; 3D: of front that the point stands for
 *   rates       [points][3]   F/L, energy release rate in modes I, II (shear along the direction) and III (along the
 *                             front): J = - int t . d[u]/dx dx over the interface from the open crack to beyond the
 *                             process zone, plus the energy that the layer holds where that ends (Rice 1968); in all,
 *                             int Y dzeta/dx dx. On a stiff interface with a sharp front this is virtual crack closure,
 *                             1/2 traction times opening behind; it equals Gc where a front grows steadily. The end of
 *                             the path and closed contact have no influence.
 *   zone_lengths, zone_pairs  [points]  process zone, the pairs that have lost 1e-3 of their adhesion and have 1e-3 of
 *                             their toughness, at the mixity of their jump, left to spend: extent along the direction,
 *                             and pairs in it; below about 3 its traction, and with it the load of a local march,
 *                             depends on the mesh
 * Exact in the limit of fine pairs for straight interfaces between bodies that do not vary along them, without
 * eigenstrains; on curved interfaces (radius not much larger than the process zone), with thermal strains or where
 * materials change along the interface it is approximate. 3D: each part of the integral goes to the nearest point of a
 * front; on a single point it scatters more than along the front. Unresolved fronts on the pairs of quadratic cells in
 * space (weights that alternate) are good on average along the front, single points to some ten percent.
 * [unit places L, directions 1, lengths L, rates F/L, zone_lengths L, zone_pairs 1; null starts, closed, places,
 * directions, lengths, rates, zone_lengths, zone_pairs; status argument, problem; source J. Rice, J. Appl. Mech. 35
 * (1968) 379-386; since 0.1] */
DELAM_API int32_t delam_solver_front(const delam_solver *solver, int64_t interface_index, int64_t front_capacity,
                                     int64_t point_capacity, int64_t *starts, int32_t *closed, double *places,
                                     double *directions, double *lengths, double *rates, double *zone_lengths,
                                     double *zone_pairs);

/* Tangent of the load patterns at the adhesion and contact set of the pending state, else of the committed one, held:
 * matrix [pattern_count][pattern_count], d2 E / d factor_p d factor_q, symmetric; row p is the change of reaction:p (of
 * a force pattern: of minus its displacement). With the control nodes of a periodic cell driven by one pattern a
 * component it is the homogenised stiffness times the volume. One displacement solve a pattern; the state does not
 * change. DELAM_ERROR_STATE: a force pattern acts along a motion that nothing holds.
 * [unit matrix of factors; null none; status cancelled, argument, state, numerical; source none; since 0.1] */
DELAM_API int32_t delam_solver_tangent(delam_solver *solver, int64_t capacity, double *matrix);

/* Consistent tangent of the pending step: how reaction:p at its end changes with the factor of pattern q there, damage
 * included, from the committed state on; contact set and the branch of each pair's law as they are. matrix:
 * [pattern_count][pattern_count], row p, column q; symmetric but with mixity_rule = converged. With it a structure with
 * its interfaces is one element of a host that iterates: a pattern for each displacement of its boundary, reactions as
 * the element's forces. It is the derivative of advance where no pair is at the end of a branch and no jump happens;
 * past a limit point it may be indefinite. In the very first loaded step the mixity, that of its elastic solution with
 * mixity_rule = frozen, counts as given. One displacement solve a pattern and one a damaging pair (mixity_rule =
 * variational: a component); the state does not change. DELAM_ERROR_STATE: no step is pending, it has been replaced
 * after a return, or it was walked in parts (value substeps). DELAM_ERROR_NUMERICAL: singular, a jump is about to
 * happen.
 * [unit matrix of factors; null none; status cancelled, argument, state, numerical; source J. Simo, R. Taylor, Comput.
 * Methods Appl. Mech. Eng. 48 (1985) 101-118; since 0.1] */
DELAM_API int32_t delam_solver_step_tangent(delam_solver *solver, int64_t capacity, double *matrix);

/* Sizes of the condensed interface operator (delam_solver_condensed): *unknowns, *entries of the rows.
 * DELAM_ERROR_STATE: the solver works by FETI, which has none (option reduction).
 * [null unknowns, entries; status argument, state; since 0.1] */
DELAM_API int32_t delam_solver_condensed_size(const delam_solver *solver, int64_t *unknowns, int64_t *entries);
/* All bodies condensed onto the interfaces, and the loads with them: with x [unknowns], factors theta [patterns] and
 * the local jumps j [pairs of all interfaces, times dimension] of delam_mesh_interface_pairs,
 *   E = 1/2 x.S x - sum theta_p L_p.x + 1/2 theta.A theta,   j = N x + O theta
 * is the energy of bodies and dead forces, all else minimised out. What the interfaces store comes on top. Where a row
 * of N is empty the loads alone prescribe the jump. stiffness S [unknowns][unknowns], symmetric, semidefinite where
 * bodies float; load L [patterns][unknowns]; constant A [patterns][patterns]; N in rows, row_starts [rows+1], columns
 * and values [entries]; offset O [rows][patterns]. capacity: unknowns^2, of stiffness.
 * [unit stiffness F/L, load F, constant F L, values 1, offset L; null stiffness, load, constant, row_starts, columns,
 * values, offset; status cancelled, argument, state; source src/reduction/README.md; since 0.1] */
DELAM_API int32_t delam_solver_condensed(const delam_solver *solver, int64_t capacity, double *stiffness, double *load,
                                         double *constant, int64_t *row_starts, int64_t *columns, double *values,
                                         double *offset);

/* What the scene needs and what was left out, each with its reason, its predicted cost and what the decision saves. In
 * words, a line each, "subject: decision, reason (cost ..., saves ...)\n". Never NULL.
 * [owns result until the next call with this solver; status -; since 0.1] */
DELAM_API const char *delam_solver_plan(delam_solver *solver);
/* The same as data, settled when the solver is made: *count items. Subjects: condensed operator, FETI, memory,
 * subdomains, threads, longest uninterruptible factorisation, contact of interface I, mixity of interface I (each I),
 * gradient term, acceleration of the minimisation, displacements and stresses inside the bodies, energetic search,
 * backtracking.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_solver_plan_count(const delam_solver *solver, int64_t *count);
/* An item of the plan. decision: "used" or "left out". *cost: predicted, of what is used (0 for what is left out);
 * *saving: predicted, against the other decision; both in `unit` ("flop", "flop/step", "comparison/solve", "byte", "s"
 * at a nominal rate that the reason states; "-" for none); subject and reason are for people.
 * [unit cost of unit, saving of unit; null subject, decision, reason, cost, saving, unit; owns texts the solver; status
 * argument; source src/reduction/README.md; since 0.1] */
DELAM_API int32_t delam_solver_plan_item(const delam_solver *solver, int64_t index, const char **subject,
                                         const char **decision, const char **reason, double *cost, double *saving,
                                         const char **unit);

/* Value of an option as text, as the solver took it, e.g. "energetic" of "solution": what a result should be labelled
 * with. NULL for an unknown key.
 * [null result; owns result until the next call with this solver; status argument; since 0.1] */
DELAM_API const char *delam_solver_option(const delam_solver *solver, const char *key);
/* What the energetic search of the last step looked at, a line for each front and new crack: which states, why no more,
 * the lowest. "" where nothing was searched. Never NULL.
 * [owns result until the next call with this solver; status -; since 0.1] */
DELAM_API const char *delam_solver_searched(const delam_solver *solver);

/* Values and fields then speak of an earlier step: with option backtracking the last backtracking_depth ones are kept,
 * with those that a pending step replaces already in place. step -1: back to the pending state, else the committed one;
 * so do advance, equilibrate, commit, rollback and load where they succeed. DELAM_ERROR_ARGUMENT names the steps that
 * are kept.
 * [status argument; since 0.1] */
DELAM_API int32_t delam_solver_look(delam_solver *solver, int64_t step);

/* *count of jumps that were located (option jump_tolerance) up to the pending or committed state, in the order of time.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_solver_jump_count(const delam_solver *solver, int64_t *count);
/* One of them. It lies within (*before, *time], in step *step. Energies: *stored, change of stored energy and load
 * potential; *dissipated; *released: E(time, state before) - E(time, state after) - dissipated, what neither holds (a
 * dynamic event would radiate it; 0 for energetic jumps up to the tolerance). *debonded: change of sum of weight (1 -
 * zeta); *interface_index: the one that has changed most; *first_pair, *last_pair: of its pairs with changed adhesion
 * (-1: none).
 * [unit before t, time t, stored F L, dissipated F L, released F L, debonded L or L2; null step, before, time, stored,
 * dissipated, released, debonded, interface_index, first_pair, last_pair; status argument; source none; since 0.1] */
DELAM_API int32_t delam_solver_jump(const delam_solver *solver, int64_t index, int64_t *step, double *before,
                                    double *time, double *stored, double *dissipated, double *released,
                                    double *debonded, int64_t *interface_index, int64_t *first_pair,
                                    int64_t *last_pair);

/* The committed state as bytes: [*needed]. Save, load into a solver of the same scene and options, go on: the rest is
 * bitwise the same. *needed receives the size; bytes are written when capacity suffices (capacity 0: ask).
 * [null bytes at capacity 0; status argument; since 0.1] */
DELAM_API int32_t delam_solver_save(const delam_solver *solver, int64_t capacity, uint8_t *bytes, int64_t *needed);
/* Takes bytes: [size] that delam_solver_save has written as the committed state; a pending step is dropped. Damaged
 * bytes, and those of another scene or version, are refused: DELAM_ERROR_SNAPSHOT says what is wrong with them.
 * Histories that were set (delam_solver_set_history) and what was recorded are replaced by those of the bytes.
 * [null none; status cancelled, argument, numerical, snapshot; since 0.1] */
DELAM_API int32_t delam_solver_load(delam_solver *solver, int64_t size, const uint8_t *bytes);
/* The same bytes as a file, path in the encoding of the file system: written beside it first and put in its place when
 * complete and on disk, so that a full disk or an interruption leaves what was there. DELAM_ERROR_FILE says what
 * failed.
 * [null none; status argument, file; since 0.1] */
DELAM_API int32_t delam_solver_save_file(const delam_solver *solver, const char *path);
/* Takes the file at path, of bytes that delam_solver_save or delam_solver_save_file has written, as delam_solver_load.
 * [null none; status cancelled, argument, numerical, snapshot, file; since 0.1] */
DELAM_API int32_t delam_solver_load_file(delam_solver *solver, const char *path);

#ifdef __cplusplus
}
#endif
#endif
