/* SPDX-License-Identifier: BSD-3-Clause
 *
 * libdelam computes the delamination of layered and fibrous composites by rate-independent energy minimisation.
 *
 * The calling program, here called the host, describes the bodies and the faces where they touch (delam_mesh). It gives
 * these faces traction-separation laws (delam_law), and sets materials, supports and loads (delam_problem). It then
 * advances through the load steps (delam_solver). include/GLOSSARY.md explains the terms.
 *
 * Rules for every function
 *   status     0 means done. A status > 0 is an outcome, and the object stays valid and usable. A status < 0 is an
 *              error, and the object is unchanged. delam_context_message(), called with the object's context, explains
 *              the last status other than 0 of a call with a valid handle. A call without one (DELAM_ERROR_HANDLE)
 *              knows no context and leaves no text.
 *   units      Any consistent set of units will do; the examples use SI (m, N, Pa, J). In 2D, forces and energies are
 *              per unit thickness. Dimensions are products of L (length) and F (force): stress F/L2, interface
 *              stiffness F/L3, toughness F/L (J/m2).
 *   arrays     Arrays are contiguous; `[n][d]` is row-major in C and `(d,n)` in Fortran. The library copies inputs
 *              before the call returns, and writes outputs into the caller's buffer. Pointers must not be NULL unless
 *              the function allows it. An array may be NULL when its count is 0. A call reads all inputs before it
 *              writes an output, so an output may lie in the place of an input. Outputs of one call must not overlap
 *              each other.
 *   indices    Indices are int64_t. Entries of input index arrays count from `index_base` (0 or 1). Single indices and
 *              all outputs count from 0.
 *   handles    Handles are opaque. A create function stores the new handle in *out, or NULL if it makes none. A destroy
 *              function takes the address of the handle, sets the handle to NULL and accepts NULL. The host may destroy
 *              objects in any order. A handle of another kind gives DELAM_ERROR_HANDLE. So does a destroyed handle, as
 *              far as the library can detect it.
 *   numbers    An input number that is not finite is an error, and the message names it.
 *   threads    One thread at a time may use a context and the objects made with it. Different contexts are independent
 *              of each other. delam_context_cancel() is the exception: any thread may call it.
 *   callbacks  Inside a callback, call only delam_context_cancel() with the context and its objects. Other functions
 *              that return a status then return DELAM_ERROR_STATE, and functions that return a text return NULL or "".
 *              Two kinds still work: delam_context_message() returns its text, and a destroy function takes effect when
 *              the running call ends. A callback must return; do not leave it by longjmp or an exception.
 *   promise    The library's own code prints nothing, leaves no signal handler behind, lets no exception escape and
 *              never ends the process. The libraries below it (BLAS, OpenMP, METIS) may print or end the process if
 *              memory or threads run out (src/capi/CONTRACT.md, "Memory").
 *   backticks  Words in backticks stand for themselves: names of parameters, keys, and texts that a key can take, as in
 *              `solution = energetic`.
 *
 * Names that recur
 *   out                       receives the new handle
 *   interface_index, pattern  as returned by the function that added the interface or pattern
 *   index                     place in a list, from 0 to its count - 1
 *   body                      label of a body; -1 means all bodies where the function allows it
 *   capacity                  number of entries that the array can hold. A negative capacity gives
 *                             DELAM_ERROR_ARGUMENT. So does one that is too small, unless the function says that it
 *                             writes as many entries as fit
 *   user                      passed to the callback unchanged
 *   lower, upper              of a box, [dimension] each: its corners with the smallest and with the largest
 *                             coordinates. Of a parameter or an option, they are the ends of its range. The values
 *                             `lower` and `upper` of delam_solver_value are something else: bounds of what a step adds
 *                             to the energy
 *
 * The line in brackets
 * The comment of every function and callback ends with a line in brackets. It states the rest of the contract in fixed
 * words. Where a field is absent, only the rules above apply. The fields, in their order, are:
 *   unit    name, unit and range of every parameter of type double. Inputs always have a range; "finite" means any
 *           finite number. A condition in parentheses applies to the array as a whole or to each vector in it. The unit
 *           is 1 for dimensionless numbers and t for the time of the load histories. Where it depends on the key, on
 *           the factors of the patterns or on a text in `unit`, it is "of key", "of factors" or "of unit"
 *   null    pointers that may be NULL. "result": the function may return NULL
 *   owns    pointers that outlive the call, and who frees or keeps them. "out caller": the caller frees *out with the
 *           object's destroy function. "static": valid as long as the library is loaded. "the problem", "the solver":
 *           valid as long as that object exists
 *   status  statuses that the function may return besides DELAM_OK. Four statuses are understood and not listed,
 *           because every function with a handle may return them. They are DELAM_ERROR_HANDLE, DELAM_ERROR_MEMORY,
 *           DELAM_ERROR_INTERNAL and, inside a callback, DELAM_ERROR_STATE. "usual": the function returns these four
 *           and no other. "only" before a list: it returns those listed, and not these four. "-": it returns no status.
 *           A function that returns a text cannot return a status: its list says why it may return NULL.
 *           delam_context_message() then has the text of the error
 *   thread  "any": any thread may call at any time. If absent, the rule for threads above applies
 *   source  publication or document that describes the method. "none": the function computes no new result; it returns
 *           inputs, counts or results of other functions
 *   since   version of the library that introduced the function
 * In the line of a callback, some fields differ:
 *   null    arguments that the library may pass as NULL
 *   owns    how long the arguments stay valid
 *   status  how the running call ends if the callback returns a value other than 0
 *   thread  "call's" means the thread of the running call */
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

/* Version of the binary interface and of the SONAME; independent of the product's version. */
#define DELAM_ABI 1

/* ---- statuses ---------------------------------------------------------------------------------------------------- */

#define DELAM_OK 0               /* done */
#define DELAM_NOT_CONVERGED 1    /* iteration limit reached or forces unbalanced; the best state found can be read */
#define DELAM_CANCELLED 2        /* stopped on request; the state before the call is restored */
#define DELAM_LIMIT 3            /* no equilibrium: a dead load acts on a part that nothing holds any more */
#define DELAM_ERROR_ARGUMENT -1  /* a value out of range, a NULL pointer, an index past the end */
#define DELAM_ERROR_HANDLE -2    /* a handle that is NULL, destroyed or of another kind */
#define DELAM_ERROR_MESH -3      /* inverted cell, shared node, unmatched faces */
#define DELAM_ERROR_PROBLEM -4   /* incomplete or contradictory scene: missing material, missing support, bad law */
#define DELAM_ERROR_STATE -5     /* a call out of order (e.g. advance while a step is pending) */
#define DELAM_ERROR_MEMORY -6    /* not enough memory for the call */
#define DELAM_ERROR_NUMERICAL -7 /* a factorisation broke down; a result is not finite or violates a support */
#define DELAM_ERROR_SNAPSHOT -8  /* a saved state that is damaged, or of another version or scene */
#define DELAM_ERROR_INTERNAL -9  /* a defect of the library: please report it */
#define DELAM_ERROR_FILE -10     /* a file that cannot be opened, read or written: the message says why */

typedef struct delam_context delam_context; /* messages, log, progress, cancellation; all other objects need one */
typedef struct delam_mesh delam_mesh;       /* nodes, cells, bodies, interfaces */
typedef struct delam_law delam_law;         /* traction-separation law of an interface */
typedef struct delam_problem delam_problem; /* the scene: mesh, materials, laws, supports, loads, options */
typedef struct delam_solver delam_solver;   /* operator, state and history of an analysis */

/* Returns the product version, "major.minor.patch".
 * [owns result static; status -; thread any; since 0.1] */
DELAM_API const char *delam_version(void);
/* Returns the commit that the library was built from, or "unknown".
 * [owns result static; status -; thread any; since 0.1] */
DELAM_API const char *delam_commit(void);
/* Returns the DELAM_ABI with which the loaded library was built. Compare it with the DELAM_ABI of this header.
 * [status -; thread any; since 0.1] */
DELAM_API int32_t delam_abi(void);
/* Returns the name of a status, e.g. "DELAM_ERROR_MESH", or "unknown status" for other numbers.
 * [owns result static; status -; thread any; since 0.1] */
DELAM_API const char *delam_status_name(int32_t status);
/* Returns the number of threads that the host has given to BLAS in this process; 0 if BLAS does not report it. The
 * library uses one thread in its calls of BLAS and restores the number afterwards. Only large sparse factorisations use
 * all of these threads (src/capi/CONTRACT.md, "Threads"). Two runs with such factorisations give identical digits only
 * if the number is the same. Where the process may use too little address space for OpenBLAS' threads, the library sets
 * the number to 1 for good. The option `threads` sets the library's own threads.
 * [status -; thread any; since 0.1] */
DELAM_API int32_t delam_blas_threads(void);

/* ---- context: messages, log, progress, cancel -------------------------------------------------------------------- */

/* Receives log lines, which are texts for people. level is 0 for an error, 1 for a warning or an outcome, and 2 for
 * information.
 * [null user; owns text until the callback returns; status -; thread call's; since 0.1] */
typedef void (*delam_log_callback)(int32_t level, const char *text, void *user);
/* Receives the progress of long calls, on the calling thread. stage is a static text ("factor", "minimise", ...). done
 * and total are the completed and the total work of the stage (total 0: unknown). If the callback returns a value other
 * than 0, the running call stops with DELAM_CANCELLED. Functions that only read ignore this value, so a host that has
 * stopped an analysis can still read its results. These functions are:
 *   delam_mesh_find_patch
 *   delam_problem_hash, _process_zone, _propose, _body_matrix, _constraints, _forces, _eigenstrain_energy
 *   delam_solver_value, _field, _average, _condensed
 * [null user; owns stage static; status cancelled; thread call's; since 0.1] */
typedef int32_t (*delam_progress_callback)(const char *stage, int64_t done, int64_t total, void *user);

/* Creates a context without callbacks; *out receives it.
 * [null none; owns out caller; status only argument, memory; thread any; since 0.1] */
DELAM_API int32_t delam_context_create(delam_context **out);
/* Destroys a context; the objects made with it remain usable.
 * [null context, *context; owns context destroyed; status -; since 0.1] */
DELAM_API void delam_context_destroy(delam_context **context);
/* Returns the text of the last call that ended with a status other than DELAM_OK. Calls with this context count, and
 * calls with a valid object of it. The text says what is wrong, where, the value and the allowed range. Returns "" if
 * there has been no such call; never NULL. Calls with a handle that is NULL, destroyed or of another kind leave no
 * text; delam_status_name names their status.
 * [owns result until the next call with this context or its objects; status -; since 0.1] */
DELAM_API const char *delam_context_message(const delam_context *context);
/* Sets the callback that receives log lines; NULL turns the log off. Errors and outcomes go to the log too;
 * delam_context_message returns their text in any case.
 * [null callback, user; owns callback and user: the host, until replaced or the last object of the context is gone;
 * status usual; since 0.1] */
DELAM_API int32_t delam_context_set_log(delam_context *context, delam_log_callback callback, void *user);
/* Sets the callback that receives the progress of long calls; NULL turns it off.
 * [null callback, user; owns callback and user: as delam_context_set_log; status usual; since 0.1] */
DELAM_API int32_t delam_context_set_progress(delam_context *context, delam_progress_callback callback, void *user);
/* Asks the running call to stop at its next check. Any thread and any signal handler may call this function; it only
 * increments a lock-free counter. A request stops one call. It may find none to stop: no call is running, or the
 * running one makes no further check or fails because of its arguments. The request then waits and stops the next call
 * of one of these functions:
 *   delam_solver_create, _create_like, _advance, _equilibrate, _tangent, _step_tangent, _load, _load_file
 *   delam_problem_set_stiffness
 * The other functions that list `cancelled` only build or read; a request stops them only if it arrives while they run.
 * [status only handle; thread any; since 0.1] */
DELAM_API int32_t delam_context_cancel(delam_context *context);

/* ---- mesh: nodes, cells, bodies, interfaces ---------------------------------------------------------------------- */

/* These constants are the cell types. The nodes are ordered as in VTK. The corners come first (counter-clockwise;
 * bottom face before top face). The nodes midway between two corners (mid-side nodes) and the centre follow. With
 * corners numbered from 0, the mid-side nodes lie between
 *   tri6    0-1 1-2 2-0
 *   quad8   0-1 1-2 2-3 3-0      quad9 likewise, then the centre
 *   tet10   0-1 1-2 2-0 0-3 1-3 2-3                              (Gmsh exchanges the last two)
 *   hex20   0-1 1-2 2-3 3-0  4-5 5-6 6-7 7-4  0-4 1-5 2-6 3-7    (Gmsh has another order)
 *   hex27   as hex20, then the centres of the faces 0473 1265 0154 3267 0123 4567, then the centre (in Gmsh another)
 *   wedge15 0-1 1-2 2-0  3-4 4-5 5-3  0-3 1-4 2-5                (Gmsh has another order)
 * The triangle 012 of a wedge is counter-clockwise seen from outside, and 345 lies opposite, as in VTK. Abaqus and Gmsh
 * list 345 first. The base 0123 of a pyramid is counter-clockwise seen from its apex 4. A body may have cells of
 * several types, which share whole triangles and quadrilaterals.
 * Cells may be curved: a mid-side node need not lie exactly midway. Neighbouring cells share all nodes of their common
 * face. In bending, tri3, tet4, wedge6, pyramid5, and quad4 and hex8 of the standard formulation
 * (delam_problem_set_formulation) are far too stiff unless there are many of them across the thickness. Of the others a
 * few suffice. */
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

/* Returns how many cell types there are (delam_cell_type_info).
 * [status -; thread any; since 0.1] */
DELAM_API int64_t delam_cell_type_count(void);
/* Describes a cell type, by index from 0.
 *   *name                       "tri3" for DELAM_TRI3, and so on
 *   *cell_type                  the constant
 *   *dimension                  2 or 3
 *   *nodes, *corners            number of nodes, the first *corners of which are corners
 *   *faces                      number of faces (2D: edges)
 *   *face_nodes, *face_corners  number of nodes of a face, the first *face_corners of which are corners; where faces
 *                               differ (triangles beside quadrilaterals), the largest numbers
 * [null name, cell_type, dimension, nodes, corners, faces, face_nodes, face_corners; owns texts static; status only
 * argument; thread any; since 0.1] */
DELAM_API int32_t delam_cell_type_info(int64_t index, const char **name, int32_t *cell_type, int32_t *dimension,
                                       int32_t *nodes, int32_t *corners, int32_t *faces, int32_t *face_nodes,
                                       int32_t *face_corners);
/* Describes where the nodes of a cell type lie, by the index of delam_cell_type_info. Local node numbers count from 0.
 *   face    [faces][face_nodes]  for each face its corners, in the order that gives an outward normal, then its
 *                                mid-side nodes. Where these are fewer than face_nodes, -1 follows.
 *   middle  [nodes-corners][2]   for each node of the cell that is not a corner, the two corners between which it lies
 * With corners and mid-side nodes of the face counted from 0, mid-side node k lies between corners k and k+1. In 3D,
 * the last one lies between the last corner and corner 0. The centre of quad9 lies between corners 0 and 2.
 * [null face, middle; status only argument; thread any; since 0.1] */
DELAM_API int32_t delam_cell_type_topology(int64_t index, int32_t *face, int32_t *middle);

/* Creates a mesh from its nodes: [node_count][dimension], dimension 2 or 3, node_count >= 1.
 * [unit nodes L finite; null none; owns out caller; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_create(delam_context *context, int32_t dimension, int64_t node_count, const double *nodes,
                                    delam_mesh **out);

/* Creates a block of layers that are stacked along the last axis (y in 2D, z in 3D). Each layer is a body with nodes of
 * its own; body 0 is at the bottom. The block starts at the origin.
 *   lengths, divisions          [dimension-1] extent (L) and number of cells along the other axes
 *   thickness, layer_divisions  [layer_count] thickness and number of cells of each layer
 *   cell_type                   DELAM_TRI3 / QUAD4 / TRI6 / QUAD8 / QUAD9 in 2D, TET4 / HEX8 / TET10 / HEX20 / HEX27
 *                               / WEDGE6 / WEDGE15 / PYRAMID5 in 3D
 * Each box of the divisions is one cell, or 2 triangles or wedges, or 6 tetrahedra or pyramids. The nodes of
 * neighbouring layers coincide; the function adds no interface. The nodes of a layer, corners and others, are numbered
 * with x running fastest and the last axis slowest.
 * [unit lengths L > 0, thickness L > 0; null none; owns out caller; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_create_layers(delam_context *context, int32_t dimension, const double *lengths,
                                           const int64_t *divisions, int64_t layer_count, const double *thickness,
                                           const int64_t *layer_divisions, int32_t cell_type, delam_mesh **out);

/* Adds cells of one type, cell_type.
 *   connectivity  [cell_count][nodes of the type]
 *   bodies        [cell_count] labels >= 0, or NULL if all cells belong to body 0
 * DELAM_ERROR_MESH: a node belongs to two bodies, or a cell is inverted or degenerate. DELAM_ERROR_STATE: the body
 * already has an interface; add all of its cells first.
 * [null bodies; status cancelled, argument, mesh, state; since 0.1] */
DELAM_API int32_t delam_mesh_add_cells(delam_mesh *mesh, int32_t cell_type, int64_t cell_count,
                                       const int64_t *connectivity, const int32_t *bodies, int32_t index_base);

/* Adds cells of a conforming mesh of touching bodies, as a mesher writes it. The arguments are those of
 * delam_mesh_add_cells (cell_type, connectivity: [cell_count][nodes of the type], bodies: [cell_count]), but bodies may
 * share nodes. The first body keeps the node, and every further body receives a copy at the same place. The copies are
 * appended to the mesh, one for each body and original node. Later calls use the same copies, so a body may be added in
 * portions or in cells of several types. connectivity refers to nodes, original or copied, that exist before the call.
 * The number of nodes grows (delam_mesh_size); delam_mesh_node_origins returns the original of each node.
 * delam_mesh_add_all_interfaces then joins the bodies that share faces; it does not join bodies that share only a
 * corner, or in 3D only an edge. DELAM_ERROR_MESH: a cell is inverted or degenerate.
 * [null bodies; status cancelled, argument, mesh, state; since 0.1] */
DELAM_API int32_t delam_mesh_add_conforming_cells(delam_mesh *mesh, int32_t cell_type, int64_t cell_count,
                                                  const int64_t *connectivity, const int32_t *bodies,
                                                  int32_t index_base);

/* Adds an interface that pairs the coinciding boundary faces of two bodies, a = body_a and b = body_b. *out_interface
 * receives its index; the first interface has index 0. The jump of a pair is u_b - u_a. The normal points from a to b,
 * so a positive normal jump is an opening.
 * Two nodes count as coincident if their distance is at most tolerance times the shortest edge of the two bodies. In
 * quadratic cells, an edge goes from corner to mid-side node. tolerance 0 selects 1e-6. DELAM_ERROR_MESH: no face
 * matches, or faces overlap although their nodes, mid-side nodes included, do not coincide. The message names the first
 * place.
 * The weight of a pair is the length (2D) or area (3D) that it represents. It follows from nodal quadrature of the
 * paired faces, curved or not:
 *   2-node edges      trapezoidal rule
 *   3-node edges      Simpson's rule
 *   faces             vertex rule
 *   9-node faces      Simpson's rule in both directions
 *   6-node triangles and 8-node faces (tet10, hex20, wedge15)  integrals of modified shape functions, see below
 * All weights are positive; their sum is the size of the interface. A uniform traction on the pairs has its exact nodal
 * forces on plane faces with straight sides and mid-side nodes in their middle, and its exact resultant on all faces.
 * On 6-node triangles and 8-node faces, no positive weights at the nodes give these forces. A pair at a mid-side node m
 * between the corners c and d therefore compares u_m + s (2 u_m - u_c - u_d) of both sides, not u_m. s is 1/8 on
 * triangles, 1/4 on 8-node faces and on sides where both meet, and larger on distorted faces with too light corners.
 * Such a pair has two tied nodes, which the function appends (delam_mesh_node_ties). They belong to no body, and their
 * originals are those of the mid-side nodes (delam_mesh_node_origins). Where displacements are linear along the side,
 * the value is that at m. If none of these openings is negative, the nodes do not penetrate either.
 * The pairs are sorted by coordinates of the nodes, x first.
 * [unit tolerance 1 in [0, 0.5); null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double tolerance,
                                           int64_t *out_interface);
/* Adds an interface, as delam_mesh_add_interface does, between every two bodies that share matching faces and have no
 * interface yet. The interfaces are ordered by the labels of their bodies, with body_a < body_b. *out_count receives
 * their number, which may be 0. tolerance applies as in delam_mesh_add_interface, for every two bodies. Where three or
 * more bodies meet at a node, every two of them that share faces have a pair there. Bodies whose faces lie farther
 * apart than the tolerance get no interface, e.g. the two sides of a curved interface that were meshed separately.
 * DELAM_ERROR_MESH: faces of two bodies overlap without matching; the message names the first place, and the mesh is
 * unchanged.
 * [unit tolerance 1 in [0, 0.5); null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_all_interfaces(delam_mesh *mesh, double tolerance, int64_t *out_count);
/* Adds an interface for each seam within a body. A seam is a place where outer faces of one body lie on others of the
 * same body, with nodes of their own on either side (a crack, a slit). Without an interface the two sides pass through
 * each other. Both bodies of such an interface are the same, and its sides a and b those that the order of the cells
 * gives. Where seams cross or branch, each arm has an interface of its own; arms that are connected elsewhere share
 * one. Nodes that both sides share, as at the tip of a crack, have no pair. Faces with such a node add to the weights
 * of their other pairs, but are not among the faces of the interface. Faces whose corners do not coincide are no seam;
 * the log of delam_solver_create names them. *out_count receives the number of new interfaces, which may be 0.
 * tolerance applies as in delam_mesh_add_interface. A second call adds nothing.
 * DELAM_ERROR_MESH: more than two faces lie on each other, the nodes of two sides do not match, or a seam is a Moebius
 * strip. The message gives the place, and the mesh is unchanged.
 * [unit tolerance 1 in [0, 0.5); null none; status cancelled, argument, mesh; since 0.2] */
DELAM_API int32_t delam_mesh_add_seams(delam_mesh *mesh, double tolerance, int64_t *out_count);
/* Adds interfaces between outer faces of one body that face each other at a distance of at most gap. Examples are the
 * walls of a slot or a notch, whether their meshes match or not. Without an interface the walls pass through each
 * other. Both bodies of such an interface are the same. Its pairs are as of delam_mesh_add_mortar_interface: nodes of
 * side b, tied to means over faces of side a. delam_problem_set_gaps makes their distances count.
 * Two faces face each other if their normals are opposite within 30 degrees and each lies in front of the other. Faces
 * whose nodes all have pairs already are left out. So are faces that share a node with the other side, as at the tip of
 * a notch. Each two connected walls have an interface of their own. *out_count receives the number of new interfaces,
 * which may be 0.
 * DELAM_ERROR_MESH: a face of b faces side a in part, or a wall faces itself (one surface bent back, without an edge).
 * The message gives the place, and the mesh is unchanged. DELAM_ERROR_ARGUMENT: gap <= 0, or it is not finite.
 * [unit gap L > 0; null none; status cancelled, argument, mesh; since 0.2] */
DELAM_API int32_t delam_mesh_add_self_contact(delam_mesh *mesh, double gap, int64_t *out_count);
/* Adds an interface between two bodies, a = body_a and b = body_b, whose meshes do not match. *out_interface receives
 * its index. The function pairs each face of b that lies on faces of a. A face lies on them if its distance from them
 * is at most gap (L) and its normal is opposite to theirs within 60 degrees. A gap below 1e-6 of the shortest edge of
 * the two bodies, e.g. 0, counts as 1e-6 of that edge.
 * The function projects each node of such a face to the nearest point of a's faces and appends a tied node there, which
 * belongs to no body. A tied node moves with the face of a on which it lies. Its displacement is sum_i N_i u_i over the
 * nodes of that face, curved or not, with the shape functions N_i (delam_mesh_node_ties). node_a of a pair is the tied
 * node and node_b the node of b. Weights, faces and order of the pairs follow from b's faces as in
 * delam_mesh_add_interface. So do the normals, which point from a to b.
 * Take the body with the finer mesh as b. With either choice, linear displacements are continuous across a perfect
 * bond. A uniform traction, however, reaches a as forces at b's nodes, which the N_i distribute to a's nodes. This
 * distribution is exact if every node of a is also a node of b (b refines a). Otherwise it causes an error of the
 * stress in the cells at the interface. This error is about proportional to the square of (edge length of b / edge
 * length of a). The largest errors in a patch test with 3 edges of a are:
 *   edges of b   quad4    hex8
 *   2            2.4 %    36 %
 *   4            0.6 %    7.5 %
 *   7            0.18 %   2.3 %
 *   13           0.05 %   0.6 %
 * If b is coarser than a, as with 2 edges, nothing holds those nodes of a that lie between nodes of b.
 * Where the faces are curved, the chords of the two meshes lie apart. Choose gap no larger than this distance requires.
 * A rigid rotation of both bodies causes a spurious jump, the angle times the distance between a node and its
 * projection. Each face of b must lie either completely on a or completely off it. a may extend beyond b, and b beyond
 * the rim of a. DELAM_ERROR_MESH: a face of b lies partly on a, or no face of b lies on a; the message gives the place.
 * DELAM_ERROR_ARGUMENT: an interface joins the two bodies already.
 * [unit gap L >= 0; null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_projected_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double gap,
                                                     int64_t *out_interface);
/* Adds an interface between two bodies, a = body_a and b = body_b, whose meshes do not match. Pairs, weights, faces,
 * order, normals, gap and errors are those of delam_mesh_add_projected_interface. However, each node of b's faces is
 * paired with a mean over a's faces, and either body may have the finer mesh. *out_interface receives its index.
 * The tied node of a pair has the displacement sum_i M_i u_i over nodes of a. The M_i project a's displacement onto the
 * shape functions of b's faces (L2 projections over the segments in which faces of both bodies meet). Their sum is 1,
 * and some may be negative. Linear displacements are continuous across a perfect bond. Between plane faces a perfect
 * bond transfers a uniform traction exactly. So do a law and contact. On faces that are no parallelograms the integrals
 * have relative errors of about 1e-12. Contact holds in the mean: where b is coarser than a, nodes of a between those
 * of b may penetrate. A face of b that is within gap of a in one part, and farther from it elsewhere, is paired as a
 * whole. delam_problem_check refuses pairs farther apart than gap, unless their gaps count (delam_problem_set_gaps).
 * [unit gap L >= 0; null none; status cancelled, argument, mesh; source B. Wohlmuth, SIAM J. Numer. Anal. 38 (2000)
 * 989-1012; since 0.2] */
DELAM_API int32_t delam_mesh_add_mortar_interface(delam_mesh *mesh, int32_t body_a, int32_t body_b, double gap,
                                                  int64_t *out_interface);
/* Adds a rigid obstacle (loading nose, support, symmetry plane) that nodes of one body may touch. It translates with
 * control_node, a node that belongs to no body (counted from 0, like all single indices). Obstacles that move together
 * share one control node. *out_interface receives the index of the new interface. It has a pair for each node, in the
 * given order. node_a is the control node (body_a is -1), node_b the node, and the jump u_node - u_control.
 *   nodes    [count] of one body, each once
 *   normals  [count][dimension], of any length > 0, from the obstacle into the body
 *   weights  [count] > 0, length (2D) or area (3D) that each pair represents
 * weights NULL: the function computes them as delam_mesh_add_interface does, from boundary faces of the body. These are
 * the faces that face the obstacle and have all their nodes in the list. Each node of the list must lie on such a face.
 * Pairs with an obstacle have the nodes themselves. 6-node triangles and 8-node faces therefore count as linear pieces
 * between their nodes (vertex rule), and the weights are not proportional to the nodal forces of a uniform pressure.
 * [unit normals 1 finite (not 0), weights L or L2 > 0; null weights; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_obstacle(delam_mesh *mesh, int64_t count, const int64_t *nodes, const double *normals,
                                          const double *weights, int64_t control_node, int32_t index_base,
                                          int64_t *out_interface);
/* Adds a body without cells, whose stiffness the host supplies (delam_problem_set_stiffness).
 *   nodes  [count] nodes of the mesh that belong to no body yet, each once
 *   body   a label >= 0 that no cell has
 * To add an interface of this body, supply its pairs (delam_mesh_add_pairs, or delam_mesh_add_obstacle with weights).
 * Node positions affect only the rigid-body modes and the output.
 * [null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_host_body(delam_mesh *mesh, int32_t body, int64_t count, const int64_t *nodes,
                                           int32_t index_base);
/* Adds an interface from pairs that the host supplies, between bodies with or without cells. The pairs keep their
 * order; *out_interface receives the index. The two nodes of a pair need not coincide; its jump is u_b - u_a.
 *   nodes_a, nodes_b  [count], of body_a and of body_b, each once
 *   normals           [count][dimension], of any length > 0, from a to b
 *   weights           [count] > 0, length (2D) or area (3D) that each pair represents
 *   faces             [face_count][nodes_per_face] indices of pairs (also counted from index_base), corners before
 *                     mid-side nodes
 * A face has 2 or 3 nodes in 2D, and 3, 4, 6, 8 or 9 in 3D, counter-clockwise seen from b. A triangle among
 * quadrilaterals repeats its last corner. face_count 0: no faces. Without faces there are no crack fronts, no gradient
 * term, and no neighbouring pairs to which an energetic search could advance a front.
 * [unit normals 1 finite (not 0), weights L or L2 > 0; null none; status cancelled, argument, mesh; since 0.1] */
DELAM_API int32_t delam_mesh_add_pairs(delam_mesh *mesh, int32_t body_a, int32_t body_b, int64_t count,
                                       const int64_t *nodes_a, const int64_t *nodes_b, const double *normals,
                                       const double *weights, int64_t face_count, int32_t nodes_per_face,
                                       const int64_t *faces, int32_t index_base, int64_t *out_interface);
/* Destroys a mesh; problems keep their own copies.
 * [null mesh, *mesh; owns mesh destroyed; status -; since 0.1] */
DELAM_API void delam_mesh_destroy(delam_mesh **mesh);

/* Returns the sizes of a mesh: *dimension, *node_count, *cell_count, *body_count (distinct labels) and
 * *interface_count.
 * [null dimension, node_count, cell_count, body_count, interface_count; status usual; since 0.1] */
DELAM_API int32_t delam_mesh_size(const delam_mesh *mesh, int32_t *dimension, int64_t *node_count, int64_t *cell_count,
                                  int64_t *body_count, int64_t *interface_count);
/* Returns the coordinates of all nodes: [node_count][dimension].
 * [unit nodes L; null none; status argument; source none; since 0.1] */
DELAM_API int32_t delam_mesh_nodes(const delam_mesh *mesh, int64_t capacity, double *nodes);
/* Returns the label of the body of each node, bodies: [node_count]; -1 for a node that belongs to no body.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_node_bodies(const delam_mesh *mesh, int64_t capacity, int32_t *bodies);
/* Returns the original of each node, origins: [node_count]. The original of a copy is the node from which
 * delam_mesh_add_conforming_cells made it, and that of a tied node beside a mid-side node is the latter's. Every other
 * node is its own original.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_node_origins(const delam_mesh *mesh, int64_t capacity, int64_t *origins);
/* Returns the tied nodes in ascending order: those of delam_mesh_add_projected_interface,
 * delam_mesh_add_mortar_interface and delam_mesh_add_self_contact, and those of pairs at mid-side nodes of tet10, hex20
 * and wedge15 (delam_mesh_add_interface). *count and *entries receive the numbers of tied nodes and of
 * weights. The arrays are nodes [count], starts [count+1], of and weights [entries]. The displacement of nodes[i] is
 * the sum of weights[e] times the displacement of node of[e], over e = starts[i] .. starts[i+1]-1. The weights of a
 * tied node sum to 1; some may be negative.
 * [unit weights 1; null count, entries, nodes, starts, of, weights; status usual; source none; since 0.1] */
DELAM_API int32_t delam_mesh_node_ties(const delam_mesh *mesh, int64_t *count, int64_t *entries, int64_t *nodes,
                                       int64_t *starts, int64_t *of, double *weights);
/* Returns the cells in the order in which they were added: types, bodies [cell_count], offsets [cell_count+1] into
 * connectivity [*needed]. capacity counts entries of connectivity; *needed receives the number of entries.
 * [null types, bodies, offsets, connectivity, needed; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_cells(const delam_mesh *mesh, int32_t *types, int32_t *bodies, int64_t *offsets,
                                   int64_t capacity, int64_t *connectivity, int64_t *needed);
/* Returns the sizes of an interface: its bodies *body_a (-1 for an obstacle) and *body_b, *pair_count pairs,
 * *face_count paired faces of *nodes_per_face nodes.
 * [null body_a, body_b, pair_count, face_count, nodes_per_face; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_interface_size(const delam_mesh *mesh, int64_t interface_index, int32_t *body_a,
                                            int32_t *body_b, int64_t *pair_count, int64_t *face_count,
                                            int32_t *nodes_per_face);
/* Returns the pairs of an interface.
 *   nodes_a, nodes_b, weights  [pair_count]
 *   frames                     [pair_count][dimension][dimension], orthonormal rows: the normal and the tangent or
 *                              tangents
 * [unit weights L or L2 > 0, frames 1; null nodes_a, nodes_b, weights, frames; status argument; source none; since
 * 0.1] */
DELAM_API int32_t delam_mesh_interface_pairs(const delam_mesh *mesh, int64_t interface_index, int64_t *nodes_a,
                                             int64_t *nodes_b, double *weights, double *frames);
/* Returns the faces of an interface as indices of pairs, faces: [face_count][nodes_per_face], corners before mid-side
 * nodes. A face has 2, 3 or 4 nodes; 3, 6, 8 or 9 on quadratic cells. Among quadrilaterals, a triangle repeats its last
 * corner; the mid-side node of the resulting side of zero length is that corner too.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_interface_faces(const delam_mesh *mesh, int64_t interface_index, int64_t *faces);
/* Finds the nodes of a body inside the closed box from lower [dimension] to upper [dimension], widened by 1e-9 of the
 * mesh's size. body -1 selects all nodes except tied ones, those that belong to no body included. *count receives the
 * number of nodes found. The function writes as many as fit to nodes [capacity], in ascending order.
 * [unit lower L finite, upper L >= lower; null none; status argument; since 0.1] */
DELAM_API int32_t delam_mesh_find_nodes(const delam_mesh *mesh, int32_t body, const double *lower, const double *upper,
                                        int64_t capacity, int64_t *nodes, int64_t *count);
/* Computes the nodal weights of a uniform traction on a patch of a body (-1: of every body, faces at interfaces
 * included). They are the integrals of the nodal shape functions over boundary faces. The patch lies inside the box
 * from lower [dimension] to upper [dimension]. Only faces whose outward normal lies within 45 degrees of direction
 * [dimension] (any length > 0) count. Faces that cross the boundary of the box are cut there, so the size of the patch
 * does not depend on the mesh. In 3D, the function divides each face into triangles for this purpose.
 * *count receives the number of nodes. The function writes as many as fit to nodes, weights: [capacity]. The weights
 * are lengths (2D) or areas (3D) with a sum > 0. Those of linear cells are all > 0. Quadratic cells also have negative
 * ones (at a corner of an 8-node face: -1/12 of its area). DELAM_ERROR_MESH: two cells lie on the same side of a face
 * that they share.
 * [unit lower L finite, upper L >= lower, direction 1 finite (not 0), weights L or L2 sum > 0; null none; status
 * cancelled, argument, mesh; source none; since 0.1] */
DELAM_API int32_t delam_mesh_find_patch(const delam_mesh *mesh, int32_t body, const double *lower, const double *upper,
                                        const double *direction, int64_t capacity, int64_t *nodes, double *weights,
                                        int64_t *count);

/* ---- interface law ----------------------------------------------------------------------------------------------- */

/* Creates a traction-separation law of a kind. These are its quantities:
 *   Y           driving energy, Y = Y_n + Y_t, of the components Y_c = k_c [u]_c^2 / 2 (c is n or t)
 *   B           mode mixity Y_t/Y
 *   zeta        adhesion, which minimises zeta Y + g(B, zeta) over 0 <= zeta <= old adhesion
 *   g(B, zeta)  dissipated energy, convex in zeta; it decreases from g(B, 0) = Gc(B) to g(B, 1) = 0
 *   Gc(B)       toughness
 *   Go(B)       onset; -Go(B) is the slope of g at zeta = 1
 * On first loading at fixed mixity the traction peaks at sqrt(2 k Go) with k = (1-B) k_n + B k_t. The area under the
 * traction-separation curve is Gc. The list has the values of kind:
 *   piecewise-linear  the bilinear law: the traction falls linearly (Valoroso and Champaney 2006)
 *   exponential       the traction decays exponentially and never reaches zero. The decay length is (Gc/Go - 1)/2 times
 *                     the jump at the onset
 *   trapezoidal       the traction stays at its peak over the fraction `plateau` of the way from the onset to complete
 *                     debonding, then falls linearly
 *   tabulated         the traction follows the points of delam_law_set_table
 *   griffith          no softening and no onset of its own: the interface debonds at once when Y reaches Gc
 *   host              callbacks of the host: delam_law_create_host (delam_law_create refuses this kind)
 * Numbers are set by key with delam_law_set; delam_law_parameter_info lists those of each kind:
 *   normal_stiffness, tangential_stiffness  F/L3  > 0       k_n, k_t
 *   second_tangential_stiffness             F/L3  > 0       k_t along the second tangent of a pair in space, where
 *                                                           tangential_stiffness is along the first; not given: the
 *                                                           same along both
 *   normal_onset, tangential_onset          F/L   > 0       Go at B = 0, at B = 1
 *   normal_strength, tangential_strength    F/L2  > 0       peak s of the traction of that mode, in the place of its
 *                                                           onset: Go is s^2/(2 k_n) or s^2/(2 k_t)
 *   normal_toughness, tangential_toughness  F/L   >= onset  Gc at B = 0, at B = 1
 *   second_tangential_onset                 F/L   > 0       Go at B = 1 along the second tangent of a pair in space,
 *                                                           where tangential_onset is along the first; not given: the
 *                                                           same along both
 *   second_tangential_strength              F/L2  > 0       peak s of the traction along the second tangent, in the
 *                                                           place of its onset: Go is s^2/(2 k_t), k_t being that
 *                                                           along this tangent
 *   second_tangential_toughness             F/L   >= onset  Gc at B = 1 along the second tangent; not given: the same
 *                                                           along both
 *   plateau                                 -     [0, 1)    trapezoidal only
 *   gradient                                F L   >= 0      coefficient kappa (default 0) of the energy kappa/2 |grad
 *                                                           zeta|^2
 * The text `criterion`, set with delam_law_set_text, selects how onset and toughness depend on the mixity. Below, G is
 * the onset Go(B) or the toughness Gc(B). G_n and G_t are its values at B = 0 and B = 1, i.e. the numbers normal_...
 * and tangential_... above.
 *   valoroso-champaney (default)  ((1-B) G/G_n)^p + (B G/G_t)^q = 1 (Eng. Fract. Mech. 73, 2006), p and q:
 *                                 onset_exponent_1, onset_exponent_2, toughness_exponent_1, toughness_exponent_2
 *   power                         the same with p = q: onset_exponent, toughness_exponent
 *   benzeggagh-kenane             G = G_n + (G_t - G_n) B^eta (Compos. Sci. Technol. 56, 1996), eta: onset_exponent,
 *                                 toughness_exponent
 * The exponents of a criterion are numbers > 0 with default 2; a change of the criterion resets them to 2. The text
 * `onset_criterion` selects another criterion for the onset alone. With power and onset_exponent = 1, damage begins at
 * (t_n/s_n)^2 + (t_t/s_t)^2 = 1, t being tractions and s their peaks in the pure modes.
 * With other numbers along the second tangent, G_t depends on the share S = Y_2/Y_t of the energy of sliding along it.
 * It follows by the same criterion with an exponent of 1 from the numbers G_1 and G_2 of the first and second tangent:
 *   valoroso-champaney, power  1/G_t = (1-S)/G_1 + S/G_2
 *   benzeggagh-kenane          G_t = G_1 + (G_2 - G_1) S
 * mixity_rule = variational does not know such laws; frozen and converged do.
 * Gc >= Go must hold for every mixity B in [0,1] and every share S in [0,1]. A key that does not belong to the kind or
 * to the criterion gives DELAM_ERROR_ARGUMENT. Of an onset and a strength of the same mode, the one set last counts.
 * With kappa > 0, the damage of all pairs of an interface is coupled and follows from one minimisation. It spreads over
 * a length of about sqrt(kappa/Gc), which the mesh of the interface must resolve. The gradient term acts only on faces
 * whose pairs all have an initial adhesion > 0.
 * [null none; owns out caller; status argument; source in the table above; since 0.1] */
DELAM_API int32_t delam_law_create(delam_context *context, const char *kind, delam_law **out);
/* Sets a number of a law by its key; delam_law_create lists the keys and their ranges.
 * [unit value of key in its range; null none; status argument; since 0.1] */
DELAM_API int32_t delam_law_set(delam_law *law, const char *key, double value);
/* Sets a text of a law by its key: `criterion` or `onset_criterion`, to a value from the list at delam_law_create.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_law_set_text(delam_law *law, const char *key, const char *value);
/* Sets the softening curve of a tabulated law: straight lines through the points (xi, s), from (0, 1) to (1, 0).
 *   xi  [count] jump beyond the onset, divided by its largest value; it must not decrease
 *   s   [count] traction divided by its peak; it must not increase
 * count must be >= 2. The law scales xi so that the area under the curve is Gc at every mixity. DELAM_ERROR_ARGUMENT:
 * the points violate one of these conditions; the law is unchanged.
 * [unit xi 1 in [0, 1], s 1 in [0, 1]; null none; status argument; since 0.1] */
DELAM_API int32_t delam_law_set_table(delam_law *law, int64_t count, const double *xi, const double *s);
/* Returns the number of parameters of a kind, those of all its criteria included; 0 for an unknown kind.
 * [null kind; status -; thread any; since 0.1] */
DELAM_API int64_t delam_law_parameter_count(const char *kind);
/* Describes one parameter of a kind, by index from 0.
 *   key, unit, range, meaning  texts about the parameter
 *   type                       "real", "text" or "table", set with delam_law_set, delam_law_set_text or
 *                              delam_law_set_table
 *   initial                    default value, "" if the parameter must be given
 * DELAM_ERROR_ARGUMENT: the kind or the index is unknown.
 * [null kind, key, type, unit, initial, range, meaning; owns texts static; status only argument; thread any; since
 * 0.1] */
DELAM_API int32_t delam_law_parameter_info(const char *kind, int64_t index, const char **key, const char **type,
                                           const char **unit, const char **initial, const char **range,
                                           const char **meaning);
/* Returns the bounds of a parameter, by the kind and index of delam_law_parameter_info, so that a host can check a
 * number before it sets it. Allowed numbers are finite and lie between *lower and *upper. *lower_open and *upper_open
 * are 1 if the bound itself is excluded, else 0. Where there is no bound, *lower is -INFINITY or *upper is INFINITY.
 * The bounds of a table hold for each of its numbers; a text has none.
 * [unit lower of key, upper of key; null kind, lower, upper, lower_open, upper_open; status only argument; thread any;
 * source none; since 0.1] */
DELAM_API int32_t delam_law_parameter_bounds(const char *kind, int64_t index, double *lower, double *upper,
                                             int32_t *lower_open, int32_t *upper_open);
/* Returns the number of kinds of laws (delam_law_kind_info).
 * [status -; thread any; since 0.1] */
DELAM_API int64_t delam_law_kind_count(void);
/* Describes a kind of law, by index from 0: its name *kind and its *meaning. *hosted is 1 for the kind that takes
 * callbacks (delam_law_create_host), and 0 for the kinds that delam_law_create accepts.
 * [null kind, meaning, hosted; owns texts static; status only argument; thread any; since 0.1] */
DELAM_API int32_t delam_law_kind_info(int64_t index, const char **kind, const char **meaning, int32_t *hosted);

/* The next two callbacks compute a law of the host. They run on the calling thread, inside calls that check or use the
 * law. They must not call the library, except for delam_context_cancel. They must always give the same results for the
 * same arguments. A callback that returns a value other than 0 has failed, and the library's call ends with
 * DELAM_ERROR_PROBLEM. */
/* Computes *adhesion on first loading at fixed mixity: the zeta* in [0,1] that minimises zeta Y + g(B, zeta), where B
 * is mixity and Y is driving. zeta* must not increase with Y. *slope = d zeta* / dY is finite, and it is 0 where zeta*
 * is 0 or 1.
 * [unit mixity 1 in [0, 1], driving F/L >= 0, adhesion 1 in [0, 1], slope L/F <= 0; null user; status problem; thread
 * call's; since 0.1] */
typedef int32_t (*delam_adhesion_callback)(double mixity, double driving, double *adhesion, double *slope, void *user);
/* Computes *dissipated = g(B, zeta) >= 0, where B is mixity and zeta is adhesion. *slope = dg/dzeta may be -INFINITY at
 * adhesion 0, and *mixity_slope is dg/dB.
 * [unit mixity 1 in [0, 1], adhesion 1 in [0, 1], dissipated F/L, slope F/L <= 0, mixity_slope F/L finite; null user;
 * status problem; thread call's; since 0.1] */
typedef int32_t (*delam_dissipation_callback)(double mixity, double adhesion, double *dissipated, double *slope,
                                              double *mixity_slope, void *user);
/* Creates a law of kind host: adhesion computes zeta* and dissipation computes g. Then Go = -dg/dzeta at adhesion 1,
 * and Gc = g at adhesion 0. name, which must not be empty, identifies the callbacks in messages and in
 * delam_problem_hash. The callbacks and user must stay valid as long as the law is used, and as long as any problem or
 * solver that took it exists. If such an object is destroyed during a call, the callbacks and user must stay valid
 * until that call ends. The keys are `normal_stiffness`, `tangential_stiffness`,
 * `second_tangential_stiffness` and `gradient`. The callbacks do not know the direction of sliding, so that onset and
 * toughness in shear are the same along both tangents. delam_law_check and delam_problem_set_law test at samples
 * whether the two callbacks belong to the same g. If they do not, the message names the first such sample.
 * [null user; owns out caller, callbacks and user: the host, as long as problems and solvers that took the law; status
 * argument; since 0.1] */
DELAM_API int32_t delam_law_create_host(delam_context *context, const char *name, delam_adhesion_callback adhesion,
                                        delam_dissipation_callback dissipation, void *user, delam_law **out);
/* Checks that all parameters of a law are present and admissible. DELAM_ERROR_PROBLEM: the message names the first that
 * is not.
 * [status problem; since 0.1] */
DELAM_API int32_t delam_law_check(const delam_law *law);
/* Computes the onset Go and the toughness Gc of a law at count mixities B = Y_t/Y; mixity, onset, toughness: [count].
 * Where the law has other numbers along the second tangent, they are those of sliding along the first (S = 0).
 * [unit mixity 1 in [0, 1], onset F/L, toughness F/L; null onset, toughness; status argument, problem; source of
 * delam_law_create; since 0.1] */
DELAM_API int32_t delam_law_toughness(const delam_law *law, int64_t count, const double *mixity, double *onset,
                                      double *toughness);
/* Performs one damage step at each of the given jumps, without the gradient term. It holds the given mixity fixed. It
 * finds the adhesion zeta that minimises the energy over 0 <= zeta <= adhesion_old, and the traction zeta k [u]. The
 * share S of the second tangent is that of the jump.
 *   jump, traction                  [count][dimension] in local components, normal first; a negative normal jump is an
 *                                   error
 *   mixity, adhesion_old, adhesion  [count]
 * [unit jump L finite (normal >= 0), mixity 1 in [0, 1], adhesion_old 1 in [0, 1], adhesion 1 in [0, 1], traction F/L2;
 * null traction; status argument, problem; source of delam_law_create; since 0.1] */
DELAM_API int32_t delam_law_respond(const delam_law *law, int32_t dimension, int64_t count, const double *jump,
                                    const double *mixity, const double *adhesion_old, double *adhesion,
                                    double *traction);
/* Destroys a law; problems keep their own copies.
 * [null law, *law; owns law destroyed; status -; since 0.1] */
DELAM_API void delam_law_destroy(delam_law **law);

/* ---- problem: materials, laws, supports, loads, options ---------------------------------------------------------- */

/* Creates a problem with a copy of the mesh; later changes to the mesh do not affect the problem.
 * [null none; owns out caller; status argument; since 0.1] */
DELAM_API int32_t delam_problem_create(delam_context *context, const delam_mesh *mesh, delam_problem **out);
/* Destroys a problem; solvers keep their own copies.
 * [null problem, *problem; owns problem destroyed; status -; since 0.1] */
DELAM_API void delam_problem_destroy(delam_problem **problem);

/* Sets the plane assumption of a 2D problem; assumption: "plane-strain" (default) or "plane-stress".
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_plane(delam_problem *problem, const char *assumption);
/* Sets isotropic elasticity for a body (-1: for all): young > 0 (F/L2), -1 < poisson < 0.5.
 * [unit young F/L2 > 0, poisson 1 in (-1, 0.5); status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_elastic(delam_problem *problem, int32_t body, double young, double poisson);
/* Sets orthotropic elasticity for a body (-1: for all) in its material axes 1, 2, 3. constants [9] are E1 E2 E3 nu12
 * nu13 nu23 G12 G13 G23 (moduli F/L2 > 0). nu_ij is the contraction along j under tension along i:
 * nu_ij/E_i = nu_ji/E_j. A material that is transversely isotropic about axis 1 has E3 = E2, nu13 = nu12, G13 = G12,
 * G23 = E2/(2(1 + nu23)). The material axes are the coordinate axes unless delam_problem_set_orientation sets others.
 * In 2D, plane strain takes the rows xx, yy, xy of the three-dimensional elasticity; plane stress makes the stresses
 * zz, yz, zx zero. The last call of this function or of delam_problem_set_elastic determines the material.
 * DELAM_ERROR_ARGUMENT: the elasticity is not positive definite; the message names the constant responsible and its
 * bound.
 * [unit constants F/L2 or 1 finite (definite); null none; status argument; source S. W. Tsai, H. T. Hahn, Introduction
 * to Composite Materials (1980); since 0.1] */
DELAM_API int32_t delam_problem_set_orthotropic(delam_problem *problem, int32_t body, const double *constants);
/* Sets the material axes of cells, for orthotropic materials and eigenstrains.
 *   axes   [count][2][3]  directions of axes 1 and 2, with three components also in 2D (z points out of the plane)
 *   cells  [count]        cells of the mesh, all in `body` (-1: in any body); NULL with count 1 selects all cells of
 *                         the body
 * The axes may have any length > 0 but must not be parallel. The function makes axis 2 normal to axis 1 and sets axis
 * 3 = 1 x 2. Later calls overwrite earlier ones. Cells with equal axes share their storage.
 * [unit axes 1 finite (not parallel); null cells; status cancelled, argument; since 0.1] */
DELAM_API int32_t delam_problem_set_orientation(delam_problem *problem, int32_t body, int64_t count,
                                                const int64_t *cells, const double *axes, int32_t index_base);
/* Sets the element formulation of a body (-1: of all). These are the values of formulation:
 *   "incompatible"     the default of bodies with quad4 or hex8 cells: adds internal bending modes to these cells,
 *                      condensed in each; other cells of the body are standard
 *   "standard"         without such modes; the default of other bodies
 *   "mean-dilatation"  for nearly incompressible bodies, in which the other formulations lock. Projects the dilatation
 *                      of each cell onto constants (quad4, hex8, wedge6, pyramid5, tri6, tet10) or linear functions
 *                      (quad8, quad9, hex20, hex27, wedge15).
 * With incompatible modes, rectangular cells are exact in pure bending, in which standard cells are too stiff (square
 * ones by half). Between the nodes, displacements may be slightly discontinuous from cell to cell. For a body without
 * quad4 or hex8 "incompatible" returns DELAM_ERROR_ARGUMENT. The mean dilatation works in plane strain and in 3D, but
 * not for tri3 and tet4, whose dilatation is constant already.
 * [null none; status argument; source R. Taylor, P. Beresford, E. Wilson, Int. J. Numer. Meth. Eng. 10 (1976) 1211-1219
 * and T. Hughes, ibid. 15 (1980) 1413-1418; since 0.1] */
DELAM_API int32_t delam_problem_set_formulation(delam_problem *problem, int32_t body, const char *formulation);
/* Gives whole bodies a stiffness matrix that the host has assembled; it replaces the stiffness of their cells. The
 * bodies may also have no cells (delam_mesh_add_host_body). If they have cells and a material, these serve only to
 * compute the stresses in the output; otherwise the stresses are NaN. Such a body cannot have eigenstrains; the host
 * adds their forces itself (delam_problem_add_forces).
 *   nodes            [count] all nodes of one or several bodies, each once
 *   dofs             [count][dimension] matrix row of each displacement; every row 0 .. dimension*count-1 (counted from
 *                    index_base) occurs once. NULL: dimension*i + component for nodes[i]
 *   row_starts       [dimension*count + 1], also counted from index_base
 *   columns, values  [entries] CSR with both triangles; repeated entries add up
 *   kernel           [kernel_count][dimension*count] zero-energy motions, each in the order of the matrix rows
 * Every row is a displacement of a node; the host condenses other unknowns beforehand. The matrix must be symmetric to
 * 1e-9 and positive on deformations (the library factorises it once to check). A row in which the host has kept only
 * the diagonal, because of a support of its own, is fixed permanently.
 * Nodes that the matrix connects form a piece. The zero-energy motions of a piece must be rigid-body motions; the call
 * refuses a mechanism inside a piece. FETI does not subdivide a piece. kernel_count -1 (kernel NULL): the library finds
 * the zero-energy motions of each piece. It compares x.K x with x.D x for the rigid motions x of the piece, D being the
 * diagonal of K. A ratio of at most 1e-12 means free, and a ratio of at least 1e-9 means held. In between, the call
 * fails and the host must supply the kernel.
 * DELAM_ERROR_ARGUMENT: the message names the node, row, entry or piece. A later call replaces the stiffness of the
 * bodies to which its nodes belong.
 * [unit values F/L finite, kernel 1 finite; null dofs; status cancelled, argument, numerical; source C. Farhat, M.
 * Geradin, Int. J. Numer. Meth. Eng. 41 (1998) 675-696 (motions without energy); since 0.1] */
DELAM_API int32_t delam_problem_set_stiffness(delam_problem *problem, int64_t count, const int64_t *nodes,
                                              const int64_t *dofs, const int64_t *row_starts, const int64_t *columns,
                                              const double *values, int64_t kernel_count, const double *kernel,
                                              int32_t index_base);
/* Sets the law of an interface, with a copy of the law's parameters. The initial adhesion stays as it is: 1, or as set
 * with delam_problem_set_adhesion. If the interface was one of contact (delam_problem_set_contact), the call sets it to
 * 1.
 * [status argument, problem; since 0.1] */
DELAM_API int32_t delam_problem_set_law(delam_problem *problem, int64_t interface_index, const delam_law *law);
/* Bonds an interface perfectly and permanently (zero compliance). Its initial adhesion must be 1 (delam_problem_check
 * refuses any other). If the interface was one of contact, the call sets it to 1. Every interface needs a law, a
 * perfect bond (this function) or contact without adhesion (delam_problem_set_contact).
 * [status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_bonded(delam_problem *problem, int64_t interface_index);
/* Makes an interface one of frictionless contact without adhesion. The faces may separate but not overlap, as in an
 * unglued joint or a unilateral support. The call sets its initial adhesion to 0 (delam_problem_check refuses any
 * other).
 * [status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_contact(delam_problem *problem, int64_t interface_index);
/* Sets the initial adhesion of pairs; 0 makes a notch, in which contact still acts.
 *   pairs, adhesion  [count]
 * [unit adhesion 1 in [0, 1]; null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_adhesion(delam_problem *problem, int64_t interface_index, int64_t count,
                                             const int64_t *pairs, const double *adhesion, int32_t index_base);
/* Sets the initial adhesion of the pairs inside the closed box from lower [dimension] to upper [dimension], e.g. of a
 * notch. The box may be flat or higher than the interface. The place of a pair is that of its node_b. *count receives
 * the number of these pairs, which may be 0. If count is NULL, a box without any pair is an error. Where the interface
 * goes on beyond a side of the box, that side is the tip of a crack. The pairs exactly on this side keep their adhesion
 * (tolerance: 1e-6 of the shortest edge of the two bodies). Where the interface ends, the pairs on the side belong to
 * the box. If a side lies between two pairs, the log (level 1) names the next pair, which is the tip then.
 * [unit lower L finite, upper L >= lower, adhesion 1 in [0, 1]; null count; status argument; since 0.2] */
DELAM_API int32_t delam_problem_set_adhesion_box(delam_problem *problem, int64_t interface_index, const double *lower,
                                                 const double *upper, double adhesion, int64_t *count);

/* Adds a load pattern: a named factor with a piecewise-linear history, constant before the first and after the last
 * point. *out_pattern receives its index; the first pattern has index 0.
 *   name    unique, of letters, digits, '_' and '-'
 *   times   [count] strictly increasing; count >= 1
 *   values  [count]
 * [unit times t finite (increasing), values 1 finite; null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_add_pattern(delam_problem *problem, const char *name, int64_t count,
                                            const double *times, const double *values, int64_t *out_pattern);
/* A control node belongs to no body and is not tied (projected interfaces), but something refers to it. This is a
 * prescribed displacement or mean, an equation, a period, a force or a pair. A control node represents an unknown
 * translation [dimension] without stiffness, e.g. that of a rigid loading nose, or an average strain. Its position has
 * no effect, and something must hold it. The library ignores nodes of no body to which nothing refers. The functions
 * below accept tied nodes as well and replace them by the nodes to which they are tied. */
/* Prescribes a displacement component of each of nodes [count]:
 *   direction . u_i = sum over patterns of coefficients[i][p] * factor_p(t)
 * The arguments are
 *   direction     [dimension], any length > 0 (the function normalises it)
 *   patterns      [pattern_count]
 *   coefficients  [count][pattern_count], L per unit of the factor
 * pattern_count 0: the displacement is held at zero.
 * [unit direction 1 finite (not 0), coefficients L finite; null none; status cancelled, argument, problem; since
 * 0.1] */
DELAM_API int32_t delam_problem_prescribe_nodes(delam_problem *problem, int64_t count, const int64_t *nodes,
                                                const double *direction, int64_t pattern_count, const int64_t *patterns,
                                                const double *coefficients, int32_t index_base);
/* Prescribes the weighted mean displacement of nodes:
 *   sum_i weights[i] direction . u_i / sum_i weights[i] = sum over patterns of coefficients[p] * factor_p(t)
 * With the weights of delam_mesh_find_patch, the support or load acts as a uniform traction on a patch of fixed size.
 * The results then converge as the mesh is refined; with a point support they do not.
 *   nodes                   [count], each once
 *   weights                 [count], sum > 0
 *   direction               [dimension], any length > 0
 *   patterns, coefficients  [pattern_count]
 * [unit weights 1 sum > 0, direction 1 finite (not 0), coefficients L finite; null none; status cancelled, argument,
 * problem; since 0.1] */
DELAM_API int32_t delam_problem_prescribe_mean(delam_problem *problem, int64_t count, const int64_t *nodes,
                                               const double *weights, const double *direction, int64_t pattern_count,
                                               const int64_t *patterns, const double *coefficients, int32_t index_base);
/* Adds a linear equation between displacements of nodes of any bodies and of control nodes:
 *   sum_i coefficients[i][:] . u_nodes[i] = sum over patterns of prescribed[p] * factor_p(t)
 * The arguments are
 *   nodes                 [count], count >= 1; a node may occur several times
 *   coefficients          [count][dimension], not all 0, not normalised
 *   patterns, prescribed  [pattern_count]; pattern_count 0: the right-hand side is 0
 * The reaction of the equation is the force conjugate to its left-hand side, so each coefficient times the reaction is
 * a nodal force. Equations between at most 32 displacements are eliminated exactly and add no unknowns, however many
 * equations there are. Longer ones remain in the dense part of the condensed operator. If an equation follows from
 * other equations or contradicts them, delam_problem_check refuses it, and the message gives its number.
 * Two control nodes describe a rigid line that may rotate. One carries the displacement u_0 of a point of the line, the
 * other, in one of its components, the small rotation w. Let r_i be the distance of node i of the line from that point.
 * For each node i, add u_i - u_0 - r_i w = 0 across the line, between the three nodes, and u_i - u_0 = 0 along it. Hold
 * what remains of the second control node.
 * [unit coefficients 1 finite (not all 0), prescribed L finite; null none; status cancelled, argument, problem; since
 * 0.1] */
DELAM_API int32_t delam_problem_add_equation(delam_problem *problem, int64_t count, const int64_t *nodes,
                                             const double *coefficients, int64_t pattern_count, const int64_t *patterns,
                                             const double *prescribed, int32_t index_base);
/* Lets the constraints first .. first + count - 1 begin within the analysis, for supports and grips that come later.
 * Constraints are numbered in the order in which they were added (delam_problem_constraints counts them). Up to `time`
 * the analysis goes on without them. From then on they hold, and begin where the displacements are:
 *   left-hand side = right-hand side + excess * factor(t) / factor(`time`)
 * The excess is the left-hand side less the right-hand side at `time`, and the factor is that of `pattern`. With a
 * constant factor, displacements count from where the support found them. With one that falls from 1 to 0, they go to
 * the right-hand side meanwhile. Nothing moves at `time` itself, and the reactions begin at zero. An analysis that
 * begins at `time` or later has the constraints from its beginning, without an excess.
 * A step must end at `time`; delam_solver_advance refuses to go beyond it from before. The step after it factorises the
 * bodies anew, and backtracking does not return to steps before it. A second call replaces the first.
 * [unit time t finite; null none; status argument, problem; since 0.2] */
DELAM_API int32_t delam_problem_begin_constraints(delam_problem *problem, int64_t first, int64_t count, double time,
                                                  int64_t pattern);
/* Lets the constraints first .. first + count - 1 end within the analysis, for supports that are taken away. From
 * `time` on, they are replaced by the forces that they had, times factor(t) / factor(`time`) of `pattern`. This pattern
 * drives forces; with a factor that falls from 1 to 0, the parts are let go gradually. The value `work` then takes up
 * the potential of these forces, so that the balance goes on. Everything else is as in delam_problem_begin_constraints.
 * Displacements of the same nodes may be prescribed again after this call, for times that do not overlap.
 * [unit time t finite; null none; status argument, problem; since 0.2] */
DELAM_API int32_t delam_problem_end_constraints(delam_problem *problem, int64_t first, int64_t count, double time,
                                                int64_t pattern);
/* Makes the mesh a periodic cell: u(x + period_k) - u(x) = u of control node k for all nodes on opposite faces. The
 * mesh must be a parallelepiped whose edges are the periods. If there are fewer periods than dimensions, it may have
 * any shape in the other directions.
 *   periods        [period_count][dimension] L, independent, 1 <= period_count <= dimension
 *   control_nodes  [period_count], distinct, of no body
 *   tolerance      largest deviation of a partner from x + period_k, as a fraction of the largest extent of the bodies;
 *                  0 selects 1e-6
 * Two nodes at x and x + period_k on opposite faces are partners if they belong to the same body. The boundary of the
 * periodic cell may cut a fibre into two bodies. If this leaves just one node at x and one at x + period_k without a
 * partner, these two are partners as well. Edges and corners get no redundant equations. DELAM_ERROR_MESH: nodes have
 * no partner; the message names them (the first eight).
 * The displacement of control node k is the average displacement gradient along its period, <grad u> period_k,
 * including the opening of interfaces. For an average strain e, prescribe u_k = e period_k. For an average stress s,
 * apply the dead forces F_k = V s d_k to the control nodes. V = |det periods| is the volume of the cell, and the dual
 * vectors are d_k . period_l = 1 if k = l, else 0. The average stress is 1/V sum_k F_k (x) period_k. F_k is the force
 * on control node k, i.e. its reaction if it is prescribed.
 * Hold one node of the cell against translation. If the average rotation is not prescribed, hold d(d-1)/2 components of
 * the control nodes, d being the dimension: in 2D, e.g. y of control node 0.
 * [unit periods L finite (independent), tolerance 1 in [0, 0.5); null none; status cancelled, argument, mesh; since
 * 0.1] */
DELAM_API int32_t delam_problem_add_periodic(delam_problem *problem, int64_t period_count, const double *periods,
                                             const int64_t *control_nodes, double tolerance, int32_t index_base);
/* Adds dead forces on nodes [count]: forces [count][dimension] times the factor of the pattern. A pattern drives
 * prescribed displacements, forces, eigenstrains or gaps, but only one of these.
 * [unit forces F finite; null none; status cancelled, argument, problem; since 0.1] */
DELAM_API int32_t delam_problem_add_forces(delam_problem *problem, int64_t pattern, int64_t count, const int64_t *nodes,
                                           const double *forces, int32_t index_base);

/* Adds an eigenstrain (thermal expansion, swelling, cure shrinkage) to a body (-1: to all) in its material axes. It is
 * strain [6] = xx, yy, zz, 2xy, 2yz, 2zx times the factor of the pattern, which must drive nothing else. Several
 * eigenstrains add up. The stress is C (eps - factor strain), and `stored_bulk` is the energy of that stress. In plane
 * strain, strain zz causes in-plane stress as well. In plane stress, zz, 2yz and 2zx are free and have no effect. For
 * such a pattern, `reaction:NAME` is dE/dfactor = - int strain : stress. `work` then includes the work that the
 * changing eigenstrain does on the bodies.
 * [unit strain 1 finite; null none; status argument, problem; since 0.1] */
DELAM_API int32_t delam_problem_add_eigenstrain(delam_problem *problem, int64_t pattern, int32_t body,
                                                const double *strain);

/* Sets the distances that the faces of an interface have before they move: gaps [pair_count] along the normals, times
 * the factor of the pattern, which must drive nothing else. Without this call the faces of every pair touch. The jump
 * of a pair is then u_b - u_a plus its gap along the normal, i.e. the distance that is left, and contact acts only
 * where that is 0. A negative gap is an interference, which presses the bodies apart (a press fit). Its pattern can
 * raise it from 0. If gaps is NULL, the function computes the distances in the mesh, n . (x_b - x_a). Those within 1e-6
 * of the largest extent of the mesh along an axis count as 0. So do those within the height of the arcs that facets of
 * curved faces cut off.
 * Gaps of magnitude adjust or less count as 0: these faces touch, as if moved there without strain. The initial
 * adhesion of a pair with a gap becomes 0, because nothing joins faces that are apart (delam_problem_check refuses any
 * other). If the interface has a law, the log (level 1) tells how many pairs lose their adhesion. For such a pattern,
 * `reaction:NAME` is dE/dfactor, the sum of gap times normal force (negative where the faces press), and `work`
 * includes the work of changing gaps. A later call for the same interface replaces the gaps.
 * DELAM_ERROR_MESH: gaps is NULL and faces overlap by more than adjust; the message gives the largest overlap and its
 * place. DELAM_ERROR_ARGUMENT: gaps is NULL for an obstacle, whose place the mesh does not know.
 * [unit gaps L finite, adjust L >= 0; null gaps; status cancelled, argument, problem, mesh; since 0.2] */
DELAM_API int32_t delam_problem_set_gaps(delam_problem *problem, int64_t interface_index, int64_t pattern,
                                         const double *gaps, double adjust);

/* Sets a number option by its key or alias; delam_option_info lists the options. Integer options take whole numbers
 * only.
 * [unit value of key in its range; null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_number(delam_problem *problem, const char *key, double value);
/* Sets a text option by its key or alias, to a value from its list.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_set_text(delam_problem *problem, const char *key, const char *value);
/* Returns the number of options (delam_option_info).
 * [status -; thread any; since 0.1] */
DELAM_API int64_t delam_option_count(void);
/* Describes an option, by index from 0. type is "real", "integer" or "text", and initial is its default.
 * [null key, type, unit, initial, range, meaning; owns texts static; status only argument; thread any; since 0.1] */
DELAM_API int32_t delam_option_info(int64_t index, const char **key, const char **type, const char **unit,
                                    const char **initial, const char **range, const char **meaning);
/* Returns the alias of an option, by index from 0: a second key that every function accepts. It is "" if there is none.
 * [null none; owns alias static; status only argument; thread any; since 0.1] */
DELAM_API int32_t delam_option_alias(int64_t index, const char **alias);
/* Returns the bounds of a number option, by index from 0: *lower and *upper. *lower_open and *upper_open are 1 if the
 * bound itself is excluded, else 0. DELAM_ERROR_ARGUMENT: the index is out of range, or the option is a text.
 * [unit lower of key, upper of key; null lower, upper, lower_open, upper_open; status only argument; thread any;
 * source none; since 0.1] */
DELAM_API int32_t delam_option_bounds(int64_t index, double *lower, double *upper, int32_t *lower_open,
                                      int32_t *upper_open);

/* Checks that the scene is complete and consistent: that materials and laws are present and admissible, and that
 * supports prevent every rigid motion of each connected part. DELAM_ERROR_MESH: two cells lie on the same side of a
 * face that they share.
 * [status cancelled, mesh, problem; since 0.1] */
DELAM_API int32_t delam_problem_check(delam_problem *problem);
/* Computes a hash of everything that determines the result, as 16 hexadecimal digits and a terminating zero: out[17].
 * [null none; status cancelled, argument; since 0.1] */
DELAM_API int32_t delam_problem_hash(const delam_problem *problem, char *out);
/* Returns the numbers of *primal DOFs (nodes times dimension) and *dual DOFs (pairs times dimension; the pairs of a
 * notch count too).
 * [null primal, dual; status usual; since 0.1] */
DELAM_API int32_t delam_problem_dofs(const delam_problem *problem, int64_t *primal, int64_t *dual);

/* Estimates *length, the length of the process zone on an interface. Returns *spacing, the mean distance between its
 * pairs with initial adhesion > 0 (3D: square root of their mean weight). At least about 3 pairs should lie in the
 * process zone. The estimate is the shortest of these lengths over modes I and II and over both bodies:
 *   E' Gc/s^2                  peak traction s = sqrt(2 k Go), toughness Gc
 *   (E' Gc/s^2)^(1/4) h^(3/4)  mode I, slender arms of thickness h (Yang and Cox, Int. J. Fract. 133, 2005)
 *   (h E' Gc)^(1/2)/s          mode II, likewise
 * It may be off by a factor of 2 either way. E' is E/(1 - nu^2), in plane stress E, and for an orthotropic body the
 * smallest of E1, E2 and E3. h is the volume of the body divided by the area of the interface. length 0: the interface
 * is bonded, its law has no softening, or none of its bodies has both cells and a material.
 * [unit length L, spacing L; null length, spacing; status cancelled, argument, problem; source Q. Yang, B. Cox, Int. J.
 * Fract. 133 (2005); since 0.1] */
DELAM_API int32_t delam_problem_process_zone(const delam_problem *problem, int64_t interface_index, double *length,
                                             double *spacing);
/* Proposes numbers for the law of an interface (delam_law_set).
 *   *stiffness                              50 E3/t, the least stiffness that adds little compliance
 *   *share                                  1/(1 + E3/(k t)), what the law's present normal stiffness k leaves of that
 *                                           body's stiffness
 *   *normal_strength, *tangential_strength  largest strengths with which the process zone of that mode is predicted to
 *                                           have `pairs` pairs of the present spacing (3 is enough)
 * E3 is the modulus of an adjacent body along the normal and t its extent along the normal. The body with the larger
 * E3/t counts. With *stiffness, *share would be 0.98. Both are 0 if the interface is curved or none of its bodies has
 * both cells and a material, because t is then unknown.
 * The strengths follow from delam_problem_process_zone, inverted. A law whose strength is lower already keeps it. Both
 * are 0 where that function returns the length 0, or if no pair adheres. A lower strength changes the load at which
 * damage begins. It hardly changes the load at which a crack grows, which follows from the toughness. If the interface
 * has no law, all four numbers are 0.
 * [unit pairs 1 > 0, stiffness F/L3, share 1, normal_strength F/L2, tangential_strength F/L2; null stiffness, share,
 * normal_strength, tangential_strength; status cancelled, argument, problem; source A. Turon, C. Davila, P. Camanho, J.
 * Costa, Eng. Fract. Mech. 74 (2007) 1665-1682; since 0.2] */
DELAM_API int32_t delam_problem_propose(const delam_problem *problem, int64_t interface_index, double pairs,
                                        double *stiffness, double *share, double *normal_strength,
                                        double *tangential_strength);

/* Returns the stiffness of a body as the library assembled it, for hosts that check or reuse it. The matrix is CSR with
 * both triangles over the DOFs of the body. Local node i is the i-th node of the body in ascending order, and its DOFs
 * are dimension*i + component. Call the function with NULL arrays to get *rows and *entries, and again with row_starts
 * [rows+1], columns [entries] and values [entries].
 * [unit values F/L; null rows, entries, row_starts, columns, values; status cancelled, argument, problem; source T.
 * Hughes, The Finite Element Method (1987), chapters 3 and 4; since 0.1] */
DELAM_API int32_t delam_problem_body_matrix(const delam_problem *problem, int32_t body, int64_t *rows, int64_t *entries,
                                            int64_t *row_starts, int64_t *columns, double *values);
/* Returns the constraints (prescribed nodes, means, equations, periods) as a matrix in CSR, one row each, in the order
 * in which they were added. The columns are the DOFs of the mesh, dimension*node + component. They are only DOFs of
 * bodies and control nodes, because tied nodes are replaced. coefficients [rows][pattern_count] are the right-hand
 * sides per unit of each factor. Call the function with NULL arrays to get *rows, *entries and *pattern_count. Call it
 * again with row_starts [rows+1], columns and values [entries].
 * [unit values 1, coefficients L; null rows, entries, pattern_count, row_starts, columns, values, coefficients; status
 * cancelled; source none; since 0.1] */
DELAM_API int32_t delam_problem_constraints(const delam_problem *problem, int64_t *rows, int64_t *entries,
                                            int64_t *pattern_count, int64_t *row_starts, int64_t *columns,
                                            double *values, double *coefficients);
/* Returns the nodal forces of a pattern at factor 1, forces: [primal DOFs]. These are its dead forces, or int B^T C e*
 * of its eigenstrains e*, and 0 for other patterns.
 * [unit forces F; null none; status cancelled, argument, problem; source none; since 0.1] */
DELAM_API int32_t delam_problem_forces(const delam_problem *problem, int64_t pattern, int64_t capacity, double *forces);
/* Returns matrix: [pattern_count][pattern_count], W_pq = int e*_p : C : e*_q of the eigenstrains, 0 for other patterns.
 * The energy of the bodies is then 1/2 u.K u - sum factor_p f_p.u + 1/2 sum factor_p W_pq factor_q, with f_p from
 * delam_problem_forces. capacity is pattern_count^2.
 * [unit matrix F L; null none; status cancelled, argument, problem; source none; since 0.1] */
DELAM_API int32_t delam_problem_eigenstrain_energy(const delam_problem *problem, int64_t capacity, double *matrix);
/* Returns the factors of all patterns at a time, factors: [pattern_count].
 * [unit time t finite, factors 1; null none; status argument; source none; since 0.1] */
DELAM_API int32_t delam_problem_factors(const delam_problem *problem, double time, int64_t capacity, double *factors);
/* Returns the number of patterns in *count.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_pattern_count(const delam_problem *problem, int64_t *count);
/* Returns the name of a pattern; NULL on error.
 * [null result; owns result the problem; status argument; since 0.1] */
DELAM_API const char *delam_problem_pattern_name(const delam_problem *problem, int64_t pattern);
/* Returns the value of an option of the problem, as text, e.g. "energetic" for `solution`. Returns NULL for an unknown
 * key.
 * [null result; owns result until the next call with this problem; status argument; since 0.1] */
DELAM_API const char *delam_problem_option(const delam_problem *problem, const char *key);
/* Returns the number of values that a solver of this problem has in *count, as delam_solver_value_count does.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_problem_value_count(const delam_problem *problem, int64_t *count);
/* Returns the key and the alias of one of these values, by index from 0. alias is "" if there is none.
 * [null key, alias; owns key until the next call with this problem, alias static; status argument; since 0.1] */
DELAM_API int32_t delam_problem_value_info(const delam_problem *problem, int64_t index, const char **key,
                                           const char **alias);
/* Plans an analysis without beginning it. The function checks the problem, chooses the operator as delam_solver_create
 * would, and assembles and analyses the bodies, but factors nothing. In large scenes, this takes a small part of the
 * time and of the memory of delam_solver_create.
 *   *plan    the text of delam_solver_plan; with FETI the sizes in it are predictions
 *   *setup   seconds of the factorisations before the first step, at the nominal rate that the plan states
 *   *memory  bytes at the predicted peak of an analysis
 * [unit setup 1, memory 1; null plan, setup, memory; owns plan until the next call with this problem; status cancelled,
 * mesh, problem, numerical; source src/reduction/README.md; since 0.1] */
DELAM_API int32_t delam_problem_plan(delam_problem *problem, const char **plan, double *setup, double *memory);

/* ---- solver: operator, state, history ---------------------------------------------------------------------------- */

/* Creates a solver with a copy of the problem. The function checks the problem, partitions and factorises the bodies,
 * and computes the initial state (step 0). This state has the displacements under the loads at `time` with the initial
 * adhesion. All factors should be 0 at that time, because `work` does not include the energy of the initial state.
 * DELAM_NOT_CONVERGED: this displacement step reached an iteration limit, or its forces are out of balance. *out is a
 * valid solver nevertheless. DELAM_CANCELLED, DELAM_LIMIT: *out is NULL.
 * [unit time t finite; null none; owns out caller; status not_converged, cancelled, limit, argument, mesh, problem,
 * numerical; source src/reduction/README.md; since 0.1] */
DELAM_API int32_t delam_solver_create(const delam_problem *problem, double time, delam_solver **out);
/* Creates a solver, as delam_solver_create does, that shares the condensed bodies of another solver of the same
 * context. They are shared if meshes, materials, formulations, supports, loads and gaps of both are equal. Laws,
 * initial adhesion, histories of patterns and options may differ, e.g. from one trial of a fit to the next. States and
 * results are those of delam_solver_create, digit by digit; assembly and condensation of the bodies are saved.
 * If the bodies differ, or if one of the two solvers does not condense them, the new solver makes its own operator. The
 * plan tells which: "set by a solver that has condensed the same bodies". `other` may be destroyed at any time; what is
 * shared lives as long as the last solver that uses it. If `other` is NULL, nothing is shared.
 * DELAM_ERROR_ARGUMENT: `other` belongs to another context.
 * [unit time t finite; null other; owns out caller; status not_converged, cancelled, limit, argument, mesh, problem,
 * numerical; source src/reduction/README.md; since 0.2] */
DELAM_API int32_t delam_solver_create_like(const delam_problem *problem, const delam_solver *other, double time,
                                           delam_solver **out);
/* Tells whether delam_solver_create_like would share the condensed bodies of this solver. *shares is 1 if they are
 * equal, and neither the solver nor the options of the problem ask for another operator; else 0. In that case a host
 * that lacks memory can destroy this solver first. It is 0 for problems whose constraints begin or end.
 * [null none; status argument; since 0.2] */
DELAM_API int32_t delam_solver_shares_bodies(const delam_solver *solver, const delam_problem *problem, int32_t *shares);
/* Destroys a solver and its state.
 * [null solver, *solver; owns solver destroyed; status -; since 0.1] */
DELAM_API void delam_solver_destroy(delam_solver **solver);

/* Computes one load step to `time` (> the committed time): minimises the energy, starting from the committed state
 * (option `minimisation`). The option `solution` selects the concept: `local`, or `energetic`, which adds a search for
 * states of lower energy. The result is the pending step: read it, then commit it or roll it back. A rollback restores
 * the previous state bit for bit.
 * With the option `backtracking`, the call may replace earlier steps (the value `revised_from` gives the first;
 * delam_solver_look shows each). With `jump_tolerance`, `step_control` or `mixity_step_tolerance`, it may divide the
 * step into substeps. Earlier steps that backtracking replaces are not divided, and jumps of the state in them are not
 * located.
 * DELAM_NOT_CONVERGED also leaves a pending step. Either an iteration limit was reached, or rounding leaves nodal
 * forces out of balance by more than 1e-3 of the largest reaction. The latter happens in plies thousands of times
 * longer than thick. DELAM_LIMIT, DELAM_CANCELLED and errors leave no pending step. The solver warns once (log level 1)
 * if forces are out of balance by more than 1e-6 of the largest reaction. It also warns once if a front grows with
 * fewer than 3 pairs in its process zone (softening laws, `solution = local`).
 * If the host's process forks after it has used the library, only one of the two processes should continue to use it,
 * because the linear algebra has threads.
 * [unit time t > committed; status not_converged, cancelled, limit, argument, problem, state, numerical; source J.
 * Zeman, M. Kruzik, P. Gruber, PANM 15 (2010), eq. (2), A. Mielke, T. Roubicek, J. Zeman, Comput. Methods Appl. Mech.
 * Eng. 199 (2010) 1242-1253, and src/evolution/README.md; since 0.1] */
DELAM_API int32_t delam_solver_advance(delam_solver *solver, double time);
/* Commits the pending step: it becomes the committed state, and its values are recorded (delam_solver_record).
 * DELAM_ERROR_PROBLEM: a host law failed while the values of a front were recorded; the step is still pending.
 * [status problem, state; since 0.1] */
DELAM_API int32_t delam_solver_commit(delam_solver *solver);
/* Discards the pending step.
 * [status state; since 0.1] */
DELAM_API int32_t delam_solver_rollback(delam_solver *solver);
/* Returns *pending: 1 if a step is pending, to be committed or rolled back, else 0.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_solver_pending(const delam_solver *solver, int32_t *pending);
/* Replaces the history of a load pattern after the committed time, for hosts that do not know it beforehand. From its
 * value at the committed time, the factor runs along straight lines through the points (times[i], values[i]). After the
 * last point it is constant. Steps up to the committed one keep their history. delam_solver_save includes this history.
 *   times   [count] strictly increasing, the first after the committed time; count >= 1
 *   values  [count]
 * DELAM_ERROR_STATE: a step is pending.
 * [unit times t > committed (increasing), values 1 finite; null none; status argument, state; since 0.1] */
DELAM_API int32_t delam_solver_set_history(delam_solver *solver, int64_t pattern, int64_t count, const double *times,
                                           const double *values);
/* Performs one displacement step alone: finds the displacements of least energy at `time` for a given adhesion, which
 * is held fixed. This is adhesion [pairs of all interfaces, one after another]; NULL takes the committed one. The
 * result is a pending step with the number of the committed one. It does not enter the energy balance. The stored
 * energies and `load_potential` (delam_solver_value) are those of the new state. The values `dissipated`, `work`,
 * `lower`, `increment` and `upper` do not change. Once it is committed, the solver discards the earlier steps, so
 * backtracking cannot return to them.
 * [unit time t finite, adhesion 1 in [0, 1]; null adhesion; status not_converged, cancelled, limit, argument, problem,
 * state, numerical; source M. Hintermueller, K. Ito, K. Kunisch, SIAM J. Optim. 13 (2002) 865-888; since 0.1] */
DELAM_API int32_t delam_solver_equilibrate(delam_solver *solver, double time, const double *adhesion);

/* Returns in *value a scalar of the state described. This is the step that delam_solver_look has selected. If none is
 * selected, it is the pending state, or the committed state if no step is pending. delam_solver_value_name lists the
 * keys.
 * The table has a row for each key: its unit ("-": none) and its meaning. Sums run over the pairs; w is the weight of a
 * pair. For B, zeta, Y, g and Gc see delam_law_create.
 *   key                       unit     meaning
 *   step                      -        number of the step; the initial state is step 0
 *   time                      t        time of the state
 *   stored_bulk               F L      elastic energy of the bodies
 *   stored_interface          F L      sum of w zeta Y, plus the energy of the gradient term if there is one
 *   dissipated                F L      energy dissipated by damage since the start
 *   stored_interface_linear   F L      `stored_interface` in the _linear split
 *   dissipated_linear         F L      `dissipated` in the _linear split
 *   load_potential            F L      potential of the dead forces
 *   work                      F L      work of the reactions since the start
 *   lower                     F L      lower bound of `increment`: two-sided estimate (PANM 15, eq. (3))
 *   increment                 F L      what the step adds to stored energy, `load_potential` and dissipated energy
 *   upper                     F L      upper bound of `increment`: two-sided estimate (PANM 15, eq. (3))
 *   increment_lower           F L      increment at the mixities of the step before
 *   defect                    F L      error of the energy balance since the start
 *   defect_linear             F L      `defect` in the _linear split
 *   stored_interface_slides   F L      older name of `stored_interface_linear`
 *   dissipated_slides         F L      older name of `dissipated_linear`
 *   defect_slides             F L      older name of `defect_linear`
 *   mixity_error              -        estimated relative error of the dissipation, because the mode mixity changes
 *   am_iterations             -        alternate minimisation steps of the step
 *   displacement_solves       -        displacement solves of the step
 *   contact_iterations        -        active-set steps, summed over these solves
 *   linear_iterations         -        Krylov iterations, summed over these solves
 *   newton_solves             -        solves of the step in the zone, i.e. for the pairs that a Newton step changes
 *   debond_moves              -        unstable pairs that the step moved directly to their debonded branch
 *   contact_iterations_first  -        active-set steps of the first displacement solve
 *   contact_iterations_max    -        active-set steps of the worst displacement solve
 *   contact_fallbacks         -        displacement solves in which the active sets cycled
 *   contact_pairs             -        number of pairs in contact
 *   debonded_length           L or L2  weight of the pairs with initial adhesion > 0 that now have zeta <= 1e-3
 *   front                     L or L2  advance of the front: sum of w (1 - zeta) over pairs with initial adhesion > 0
 *   process_zone              L or L2  weight of the pairs in the process zone (delam_solver_front)
 *   backtracks                -        number of returns to an earlier step during this step (option `backtracking`)
 *   revisions                 -        number of times that backtracking has replaced this step
 *   revised_from              -        first step that the returns of this step have replaced; its own number if none
 *   search_candidates         -        number of states that the energetic search compared
 *   search_margin             F L      lowest energy of these minus that of the accepted state; 0 if none was compared
 *   search_gap                F L      how much energy the search may have missed
 *   substeps                  -        number of accepted substeps of the step
 *   refused_steps             -        number of substeps that were computed and rejected
 *   jumps                     -        jumps of the state (instabilities) within the step (delam_solver_jump_count)
 *   released                  F L      energy that the step releases, i.e. that is neither stored nor dissipated
 *   bulk_factorisations       -        number of sparse factorisations of the bodies since the solver was created
 *   field_recoveries          -        number of recoveries of the displacements since the solver was created
 *   damage_change             -        largest change of a pair's traction in one further damage step, over its peak
 *   linear_residual           -        worst relative residual of the iterative linear solves; 0 if they are direct
 *   rotation_max              rad      largest rotation of a cell; NaN if no body has cells
 *   kkt_gap                   -        deepest penetration over the largest jump (0: none)
 *   kkt_pressure              -        largest tension of a closed contact over the largest force of a pair (0: none)
 *   kkt_complementarity       -        largest |gap * force| of a closed contact over (largest jump * largest force)
 *   kkt_equilibrium           -        largest out-of-balance nodal force over the largest reaction or nodal force of
 *                                      eigenstrains
 *   free_bodies               -        number of bodies of which nothing holds all motions (field free_since)
 *   pops                      -        pairs that came apart one by one at one load: the mesh resolves no process zone
 *   popped                    F L      part of `released` that these pairs set free
 *   mesh_error                -        estimated discretisation error of the bodies' elastic energy, relative to it,
 *                                      away from the fronts of cracks
 *   mesh_error_fronts         -        the same in the cells at fronts, where stresses are singular
 *   mesh_excess               -        part of that energy that incompatible modes would take off standard cells
 *   buckling_modes            -        number of modes along which the step has left states in balance that are not
 *                                      stable (`kinematics = corotational`)
 *   buckling_time             -        time at which the first of these states began to buckle
 *   buckling_released         F L      part of `released` that is set free where the bodies snap through
 *   rotation_error            -        estimated relative error of strains that are linear in the displacements: half
 *                                      the square of the largest rotation, or a larger share of the energy that
 *                                      rotations would add. They add it by the work of the stresses on them and by
 *                                      stretching. It is 0 with `kinematics = corotational`, and may cost a
 *                                      factorisation of all bodies.
 *   buckling_ratio            -        stresses over those at which the bodies buckle, at the present adhesion and
 *                                      contact. Above 1 they would buckle with `kinematics = corotational`. Faces that
 *                                      touch without a force are open. It is NaN where a part is free to move, in an
 *                                      engine, and with `kinematics = corotational`. It costs a factorisation of all
 *                                      bodies.
 * Values of the fronts of all interfaces with a law or, with :I appended (crack_length:0), of interface I:
 *   crack_length              L or L2  initially open part, plus sum of w (1 - zeta) over the pairs with initial
 *                                      adhesion > 0
 *   energy_release_rate       F/L      G at the point of the fronts with the largest G; 0 if there is no front
 *   front_mixity              -        (G_II + G_III)/G at that point, at most 1
 *   process_zone_length       L        length of the process zone at that point
 *   process_zone_pairs        -        number of pairs in the process zone at that point
 *   energy_release_rate_mean  F/L      mean of G along the fronts, in 3D weighted by length, in 2D over the tips
 *   front_mixity_mean         -        (G_II + G_III)/G of that mean, at most 1
 *   crack_area                L or L2  initially open part, plus what the middle of the process zone has swept
 *   process_zone_length_mean  L        mean length of the process zone along the fronts, weighted likewise
 *   process_zone_pairs_mean   -        mean number of pairs in it, weighted likewise
 * Values of the load pattern NAME:
 *   load:NAME                 -        factor of the pattern
 *   reaction:NAME             F L      derivative of the energy by the factor
 * delam_solver_value_count counts all of them. Some keys have a second name (delam_solver_value_info), and both names
 * work for ever:
 *   staggered_iterations for am_iterations
 *   unstable_debonds for debond_moves
 *   state_jumps for jumps
 *   the names in _linear for the older ones in _slides
 *
 * The stored energies and `load_potential` belong to the state. `dissipated`, `dissipated_linear` and `work` accumulate
 * from the start. `lower`, `increment`, `upper` and `increment_lower` belong to the step. A step adds the sum of w
 * (g(B, zeta) - g(B, zeta_old)) to `dissipated`, with `mixity_rule = converged` as an integral along the jumps of each
 * pair. The _linear split divides stored from dissipated energy as in Zeman, Kruzik and Gruber (PANM 15, 2010). The sum
 * of w f(B, zeta), f = g - Gc (1 - zeta), belongs to the stored energy. A step dissipates the sum of w
 * Gc(B) (zeta_old - zeta).
 * Each step adds to `work` the mean of the reactions before and after it, times the changes of the factors. A jump that
 * bisection has located adds `upper` instead. A step that was followed in parts (`mixity_rule = converged`, loads in
 * proportion) adds the work along these parts. Each part happens at the load within the step that first drives it.
 * `lower` and `upper` are what the same change of the loads would add to the energy if the damage did not change. They
 * differ in the damage: `upper` is computed with the damage before the step, `lower` with the damage after it. A step
 * to a state of least energy has lower <= increment <= upper. The tolerance is `backtracking_tolerance` times the
 * larger of |stored energy + load_potential| and |work|. Backtracking tests the lower bound only. Let E be stored
 * energy + load_potential without the gradient term. If the factors of all patterns before the step are a > 0 times
 * those after it, lower = (1 - a^2) E(after) and upper = (1/a^2 - 1) E(before). In a step that damages nothing, all
 * three are then equal. For other changes of the loads, and always with `mixity_rule = variational`, a displacement
 * field that carries the change of the loads gives the bounds. They are then wider.
 * With `mixity_rule = converged`, `increment_lower` equals `increment`. With `variational`, both use the _linear split.
 * `defect` is stored energies + load_potential + dissipated + released (sum over all steps) - work - energy of the
 * initial state. `defect_linear` uses the _linear split for all of these. delam_solver_equilibrate changes neither:
 * what it adds to the energy of the state counts as energy of the initial state.
 * `mixity_error` is 0 if no pair was damaged. With `mixity_rule = converged`, it is the difference from an integral of
 * the next lower order along the jumps of the pairs. Otherwise it is
 *   sum w |dzeta| |Gc(B shown) - Gc(B used)| / sum w |dzeta| Gc(B used)
 * B used determined the toughness of a pair. B shown is the mixity of that pair's own jump in the last iterate in which
 * the pair still adhered. Except with `variational`, the solver warns (log level 1) once of a value above 0.1.
 * The solver counts `newton_solves` and `debond_moves` where the minimisation is accelerated and no law has a gradient
 * term. With `reduction = iterated`, the solves are those of all bodies, or of those about the process zone alone. In
 * the displacement solves of `contact_fallbacks`, an active set came back, and a descent from a state without
 * penetration went on.
 * `search_margin` is >= 0 up to rounding. `search_gap` is a bound, because the search does not try every position of a
 * front. The states at the other positions have at least the energy of the accepted state minus this value (0: none of
 * them has less). The estimate assumes the mixities that the search has found, and outside the zone about each front
 * also the contact. It covers advances of a single front by whole rings of pairs. It does not cover new cracks, fronts
 * that advance together or partly damaged states. `search_gap` is infinite where there is no such bound (dead loads on
 * parts that nothing holds, `mixity_rule = variational`).
 * Where steps follow their load (`step_control = auto` or `load`), jumps and pairs that pop release what their path at
 * one load neither stores nor dissipates, and the rest releases 0. Otherwise, with `mixity_rule = converged` and loads
 * in proportion, `released` is what the parts of the step release while the load stands still. Otherwise, a located
 * jump releases upper - increment.
 * A step in which a pair loses more than 0.1 of its toughness releases its work less `increment` where that is
 * positive. All other steps release 0.
 * `bulk_factorisations` is 1 with the condensed operator, and one per subdomain with FETI. With the iterated operator,
 * it is one for each renewal of the factor. `bulk_factorisations` and `field_recoveries` are part neither of the state
 * nor of saved bytes.
 * `field_recoveries` counts recoveries of the displacements from the interfaces, each of one sparse solve. The fields
 * displacement, stress, rotation and mesh_error need one for each state, and with the condensed operator reaction. The
 * values rotation_max, mesh_... and kkt_... need one, and so does delam_solver_average. No other field or value needs
 * one; a step needs one only where rounding may spoil its balance of forces.
 * `damage_tolerance` bounds `damage_change`, which is <= `damage_tolerance` when converged.
 * `rotation_max` follows from the skew part of the displacement gradient at the centre of the cell. The theory of small
 * strains has a relative error of about half the square of this rotation. The solver warns once (log level 1) if it
 * exceeds 0.1. With `kinematics = corotational` it is the angle of the frame of a cell, up to pi, and nothing warns.
 * delam_solver_condensed and sensitivities then answer DELAM_ERROR_STATE. Scenes that this option does not know are
 * refused by name when the solver is created.
 * `mesh_error` R comes from the stresses (Zienkiewicz and Zhu 1987, field mesh_error). It tells whether the mesh is too
 * coarse or its cells lock. Under prescribed displacements, the loads are too high by about R/(1 - R). NaN: no energy
 * is stored, or a body has no material.
 * `crack_length` is at most the size of the interface, and in 3D an area. The initially open part goes up to the pair
 * at the tip in 2D. In 3D, it consists of the faces that touch a pair without initial adhesion.
 * `crack_area` is the area behind a line between the pairs, in 2D the length up to a point. On that line, 4/9 of the
 * toughness that was left at the start is dissipated, at the mixity of the jumps. This share is linear between pairs.
 * The line lies in the middle of the process zone. `crack_length` follows the adhesion, which falls at the outer rim of
 * the zone on a stiff interface. Where a front grows steadily, the change of `dissipated` over that of `crack_area` is
 * the toughness, on curved fronts as well. The area is at most the size of the interface. At the start it is the
 * initially open part of `crack_length`.
 * On an interface without faces, it is the weight of the pairs behind that line.
 * delam_solver_front explains `energy_release_rate` and the other values of the fronts.
 * For prescribed displacements, `reaction:NAME` is the force that the testing machine exerts along each of them, times
 * its coefficient, summed. It is positive when it acts in the direction of a growing factor, also while the factor
 * falls. For a force pattern, it is minus the displacement along its forces, each times its force, summed. For an
 * eigenstrain, it is minus the integral of stress times strain.
 * [unit value of key; null none; status cancelled, argument, problem; source of what is computed: at
 * delam_solver_advance and delam_solver_front; since 0.1] */
DELAM_API int32_t delam_solver_value(delam_solver *solver, const char *key, double *value);
/* Returns the number of values in *count.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_solver_value_count(const delam_solver *solver, int64_t *count);
/* Returns the name of value `index`; NULL on error.
 * [null result; owns result the solver; status argument; since 0.1] */
DELAM_API const char *delam_solver_value_name(const delam_solver *solver, int64_t index);
/* Describes value `index`, in the order of delam_solver_value_name.
 *   alias      another name for its key, accepted wherever the key is; "": none
 *   unit       "-": none
 *   cost       what the solver must do to return the value. "free": nothing, because it stores the number. "reads":
 *              evaluate the pairs or the crack fronts of the state. "recovers": recover the displacements, one sparse
 *              solve for each state
 *   scope      what the value describes. "whole": the whole scene. "interface": all interfaces or, with :I behind the
 *              key, one of them. "pattern": one load pattern
 *   meaning    a short text
 *   *recorded  1 where delam_solver_record takes the value, else 0
 * [null alias, unit, cost, scope, meaning, recorded; owns texts static; status argument; since 0.1] */
DELAM_API int32_t delam_solver_value_info(const delam_solver *solver, int64_t index, const char **alias,
                                          const char **unit, const char **cost, const char **scope,
                                          const char **meaning, int32_t *recorded);

/* Records a value, e.g. for a load curve. The call records the value of the committed state; from then on,
 * delam_solver_commit records the value of each step. After backtracking, the record holds the values of the replacing
 * steps. delam_solver_equilibrate keeps the number of the committed step, so its commit replaces the entry of that
 * step.
 * key is one of delam_solver_value, with two exceptions. One is the values that recover the displacements
 * (`rotation_max`, the mesh_ and kkt_ values), the other those that count since the solver was created
 * (`bulk_factorisations`, `field_recoveries`). A second request for the same key has no effect. delam_solver_save
 * includes the record. delam_solver_load replaces the record by the one in the bytes; therefore load first, and then
 * request the keys. DELAM_ERROR_STATE: a step is pending.
 * DELAM_ERROR_PROBLEM: a host law failed while the values of a front were computed; the key is not recorded.
 * [null none; status argument, problem, state; since 0.1] */
DELAM_API int32_t delam_solver_record(delam_solver *solver, const char *key);
/* Returns the extent of the record: *steps steps, from step *first to the committed one; both are 0 if nothing is
 * recorded.
 * [null first, steps; status argument; since 0.1] */
DELAM_API int32_t delam_solver_recorded_size(const delam_solver *solver, int64_t *first, int64_t *steps);
/* Returns a recorded value for every step, values: [steps]; NaN for the steps before delam_solver_record requested it.
 * [unit values of key; null none; status argument; source none; since 0.1] */
DELAM_API int32_t delam_solver_recorded(const delam_solver *solver, const char *key, int64_t capacity, double *values);

/* Returns the shape of a field, *rows and *columns, in the state described (delam_solver_value). The table has key,
 * shape, unit and meaning:
 *   displacement  [nodes][dimension]  L     recovered from the interfaces on request
 *   stress        [cells][4 or 6]     F/L2  at the centre of the cell: xx, yy, zz, xy (2D) or xx, yy, zz, xy, yz, zx
 *   rotation      [cells][1 or 3]     rad   at the centre of the cell, axial vector of the skew part of the
 *                                           displacement gradient: about z (2D) or x, y, z
 *   jump          [pairs][dimension]  L     local components: normal (>= 0), then tangential
 *   traction      [pairs][dimension]  F/L2  local components of the traction that b exerts on a; tension is positive
 *   adhesion      [pairs][1]          -     zeta, from 1 (intact) to 0 (debonded)
 *   mixity        [pairs][1]          -     the B = Y_t/Y that the last step used
 *   contact       [pairs][1]          -     1 if the pair is closed
 *   reaction      [constraints][1]    F     force that the testing machine exerts, positive along the constraint
 *   free_since    [bodies][1]         -     step since which neither adhesion, supports nor contact hold all motions of
 *                                           the body; -1: they are held
 *   free_motion   [bodies][3 or 6]    -     1: nothing holds this motion. x, y, rotation; or x, y, z, rotations about
 *                                           x, y, z
 *   mesh_error    [cells][1]          F L   estimated error of the cell's elastic energy; NaN for unknown materials
 * An open pair has the traction zeta k [u] (and with `mixity_rule = variational` the traction that this rule adds). A
 * closed pair has the contact pressure as normal component, which is negative.
 * mixity is 0 where the law does not depend on it, unless the option `mixity` is `always`. With `mixity_rule = frozen`,
 * it is that of the state before the step (in the first loaded step, of the elastic solution). With `converged`, it is
 * that of the end of the step; a pair that broke keeps the B of the last iterate in which it still adhered. With
 * `variational`, it is that of the step's own displacements.
 * part is an interface index for pair fields, or -1 for all interfaces one after another. For displacement it may be a
 * node: the field has its row alone, and where the bodies are condensed, the others are not recovered. It is -1
 * otherwise.
 * [null rows, columns; status argument; since 0.1] */
DELAM_API int32_t delam_solver_field_shape(const delam_solver *solver, const char *key, int64_t part, int64_t *rows,
                                           int64_t *columns);
/* Returns a field of the state described, values: [rows][columns]; key and part are those of delam_solver_field_shape.
 * [unit values of key; null none; status cancelled, argument; source none; since 0.1] */
DELAM_API int32_t delam_solver_field(delam_solver *solver, const char *key, int64_t part, int64_t capacity,
                                     double *values);

/* Returns the exact averages of strain and stress over the volume of a body (-1: of all), in the state described
 * (delam_solver_value).
 *   strain, stress  [6] in the order xx, yy, zz, xy, yz, zx
 *   *volume         in L2 or L3
 * Shear strains are doubled, and the strain includes eigenstrains. In 2D the out-of-plane components follow from the
 * plane assumption. With large rotations, strains and stresses are those in the frames of the cells, turned with them.
 * The averages do not include the opening of interfaces between bodies. Bodies without cells have no volume; all
 * results are 0 if no body has cells. The function recovers the displacements, unless the bodies are condensed: then
 * the averages follow from jumps and loads, which the first call prepares with a few sparse solves.
 * [unit volume L2 or L3, strain 1, stress F/L2; null volume, strain, stress; status cancelled, argument; source none;
 * since 0.1] */
DELAM_API int32_t delam_solver_average(const delam_solver *solver, int32_t body, double *volume, double *strain,
                                       double *stress);

/* Counts the crack fronts of an interface in the state described (delam_solver_value): *fronts fronts with *points
 * points in total. A front separates pairs with an adhesion below 1/2 from the others. It is a point in 2D, and in 3D a
 * polyline on the faces, open or closed. delam_solver_front gives its exact place. An interface has no front if it has
 * no law, or if no pair has an adhesion below 1/2. The function finds the fronts on request, from the jumps and
 * adhesions alone.
 * [null fronts, points; status argument, problem; since 0.1] */
DELAM_API int32_t delam_solver_front_count(const delam_solver *solver, int64_t interface_index, int64_t *fronts,
                                           int64_t *points);
/* Returns the crack fronts of an interface in the state described. front_capacity counts fronts, and point_capacity
 * counts points.
 *   starts        [fronts + 1]         the points of front f are starts[f] .. starts[f+1] - 1
 *   closed        [fronts]             1: a closed line, whose last point is joined to its first
 *   places        [points][dimension]  L, in the undeformed body
 *   directions    [points][dimension]  unit vector along the interface, normal to the front, into the adhering part
 *   lengths       [points]             L; 2D: length of the crack that ends here; 3D: length of front that the point
 *                                      represents
 *   rates         [points][3]          F/L, energy release rates in modes I, II (shear along the direction) and III
 *                                      (along the front)
 *   zone_lengths  [points]             L, length of the process zone along the direction
 *   zone_pairs    [points]             number of pairs in the process zone
 * places: in 2D, the place is the tip of the notch (the first pair with initial adhesion > 0), moved ahead by the sum
 * of weight (1 - zeta). A crack that began inside the bond extends by half that sum to either side. In 3D, the place is
 * where the adhesion, interpolated linearly between pairs, is 1/2. At a sharp front, this is half a cell behind the 2D
 * definition.
 * rates: J = - int t . d[u]/dx dx over the interface, plus the energy stored in the interface at the end of the path
 * (Rice 1968). The path goes from the open crack to beyond the process zone. The total is int Y dzeta/dx dx. It equals
 * Gc where a front grows steadily. It depends neither on where the path ends nor on closed contact. On a stiff
 * interface with a sharp front, J is the virtual crack closure technique, 1/2 traction times the opening behind the
 * front. The traction is that of the interface and of contact. Mode I is negative where contact takes more than the
 * interface gives.
 * As the mesh is refined, the rates become exact if the interface is straight, the bodies do not vary along it, and
 * there are no eigenstrains. They are approximate on curved interfaces (radius not much larger than the process zone),
 * with eigenstrains, and where materials change along the interface. In 3D, the rates of a point are means over a band
 * of two faces to either side along the front, or an eighth of a small loop. The weights fall linearly to 0. The
 * integral over the band is divided by the length of front in the middle of its process zone. With 5 pairs in the
 * zone, the rates of single points in growth are within about 3 % of the toughness. The band does not show what
 * changes along the front within fewer faces, such as the last faces at a free edge.
 * directions: in 3D, the mean over the same band.
 * zone_lengths, zone_pairs: a pair in the process zone has lost at least 1e-3 of its adhesion. It also has at least
 * 1e-3 of its toughness left to dissipate, at the mixity of its jump. With fewer than about 3 pairs in the process
 * zone, the traction there depends on the mesh, and so does the load of a local solution. In 3D, both are means over
 * the band of the rates.
 * [unit places L, directions 1, lengths L, rates F/L, zone_lengths L, zone_pairs 1; null starts, closed, places,
 * directions, lengths, rates, zone_lengths, zone_pairs; status argument, problem; source J. Rice, J. Appl. Mech. 35
 * (1968) 379-386; since 0.1] */
DELAM_API int32_t delam_solver_front(const delam_solver *solver, int64_t interface_index, int64_t front_capacity,
                                     int64_t point_capacity, int64_t *starts, int32_t *closed, double *places,
                                     double *directions, double *lengths, double *rates, double *zone_lengths,
                                     double *zone_pairs);

/* Returns the tangent of the load patterns at fixed adhesion and contact set, in the state described
 * (delam_solver_value). matrix [pattern_count][pattern_count] has the entries d2 E / d factor_p d factor_q and is
 * symmetric. Row p is the derivative of reaction:p (for a force pattern, of minus its displacement). With
 * `mixity_rule = variational`, the traction that this rule adds changes with the jumps as well. The call costs one
 * displacement solve per pattern (with `mixity_rule = variational`, also one per component of a partly damaged pair);
 * the state does not change.
 * For a periodic cell, let each component of <grad u> be the factor of a pattern of its own. If the periods lie along
 * the axes, each component of control node k has a pattern whose coefficient is the length of period k. The matrix is
 * then the homogenised stiffness times the volume. DELAM_ERROR_STATE: a force pattern acts along a motion that nothing
 * holds. DELAM_ERROR_NUMERICAL: the tangent is singular.
 * [unit matrix of factors; null none; status cancelled, argument, state, numerical; source none; since 0.1] */
DELAM_API int32_t delam_solver_tangent(delam_solver *solver, int64_t capacity, double *matrix);

/* Returns the consistent tangent of the pending step, damage included. This is matrix [pattern_count][pattern_count],
 * symmetric unless `mixity_rule = converged`. Row p, column q is the derivative of reaction:p with respect to the
 * factor of pattern q, both at the end of the step. The committed state from which the step starts is fixed. With this
 * tangent, a structure with its interfaces can be one element of a host that iterates. Define one pattern for each
 * displacement of the element's boundary, and use the reactions as the element's forces.
 * The tangent is the derivative of delam_solver_advance as long as the contact set does not change and no jump happens.
 * Nor must any pair reach the end of a branch of its law. Past a limit point it may be indefinite. With `mixity_rule =
 * converged`, a long step is followed in parts. A pair that damages in one part and unloads in a later one keeps an
 * adhesion that depends on the end of the step. The tangent takes this adhesion as fixed. Hosts that iterate set
 * `path_step = 1`, with which a step has one part. In the very first loaded step with `mixity_rule = frozen`, the
 * mixity is that of the elastic solution, and the tangent, which is then not symmetric, contains its change. With
 * `mixity_rule = variational`, the tangent treats this mixity as fixed.
 * In a step of several substeps, each ends at its share of the change of the loads. A pair that comes to rest in one of
 * them keeps the derivative of its adhesion. The call then follows the substeps once more.
 * With `step_control = auto`, later steps are taken whole, because a host's Newton method wants a smooth step. Saved
 * states keep this.
 * The call costs one displacement solve per pattern and one per damaging pair (`mixity_rule = variational`: per
 * component of such a pair). The state does not change otherwise. DELAM_ERROR_NUMERICAL: the tangent is singular, i.e.
 * a jump is about to happen. DELAM_ERROR_STATE: one of these is true:
 *   - no step is pending
 *   - the pending step comes from delam_solver_equilibrate
 *   - the pending step has replaced earlier steps (backtracking), or has more than one substep (value `substeps`) with
 *     a search, backtracking or large rotations in each, or with `mixity_rule = variational`
 *   - `mixity_rule = variational` is used with a gradient term
 *   - a force pattern acts along a motion that nothing holds
 * [unit matrix of factors; null none; status cancelled, argument, state, numerical; source J. Simo, R. Taylor, Comput.
 * Methods Appl. Mech. Eng. 48 (1985) 101-118; since 0.1] */
DELAM_API int32_t delam_solver_step_tangent(delam_solver *solver, int64_t capacity, double *matrix);

/* Returns the sizes of the condensed interface operator (delam_solver_condensed): *unknowns, and *entries of the sparse
 * matrix N. DELAM_ERROR_STATE: the solver iterates or uses FETI and has no such operator (option `reduction`).
 * [null unknowns, entries; status argument, state; since 0.1] */
DELAM_API int32_t delam_solver_condensed_size(const delam_solver *solver, int64_t *unknowns, int64_t *entries);
/* Returns all bodies and loads, condensed onto the interfaces. E is the energy of bodies and dead forces, minimised
 * over everything but x [unknowns]. j [pairs of all interfaces, times dimension] are the local jumps in the frames of
 * delam_mesh_interface_pairs. With the factors theta [patterns],
 *   E = 1/2 x.S x - sum theta_p L_p.x + 1/2 theta.A theta,   j = N x + O theta
 * E does not contain the energy stored in the interfaces. Where a row of N is empty, the loads alone prescribe the
 * jump.
 *   stiffness        S [unknowns][unknowns], symmetric, semidefinite if bodies float
 *   load             L [patterns][unknowns]
 *   constant         A [patterns][patterns]
 *   row_starts       [rows+1] of N, with one row per component of j
 *   columns, values  [entries] of N
 *   offset           O [rows][patterns]
 *   capacity         number of entries that stiffness can hold, at least unknowns^2
 * [unit stiffness F/L, load F, constant F L, values 1, offset L; null stiffness, load, constant, row_starts, columns,
 * values, offset; status cancelled, argument, state; source src/reduction/README.md; since 0.1] */
DELAM_API int32_t delam_solver_condensed(const delam_solver *solver, int64_t capacity, double *stiffness, double *load,
                                         double *constant, int64_t *row_starts, int64_t *columns, double *values,
                                         double *offset);

/* Returns the plan as text: what the scene needs and what the solver omits, each with the reason, the predicted cost
 * and what the decision saves. Each item is one line, "subject: decision, reason (cost ..., saves ...)\n". The text is
 * never NULL.
 * [owns result until the next call with this solver; status -; since 0.1] */
DELAM_API const char *delam_solver_plan(delam_solver *solver);
/* Returns the number of items of the plan in *count. The plan is fixed when the solver is created. These are its
 * subjects:
 *   condensed operator, iterated operator, FETI, subdomains
 *   time of a load step, memory, threads, longest uninterruptible factorisation
 *   contact of interface I, mixity of interface I (for each I), gradient term
 *   acceleration of the minimisation, energetic search, backtracking
 *   displacements and stresses inside the bodies
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_solver_plan_count(const delam_solver *solver, int64_t *count);
/* Returns one item of the plan.
 *   subject, reason  texts for people
 *   decision         "used" or "left out"
 *   *cost            predicted cost of what is used (0 if left out)
 *   *saving          predicted saving over the other decision
 *   unit             unit of both: "flop", "flop/step", "comparison/solve", "byte", "s" at a nominal rate that the
 *                    reason states, or "-" for none
 * [unit cost of unit, saving of unit; null subject, decision, reason, cost, saving, unit; owns texts the solver; status
 * argument; source src/reduction/README.md; since 0.1] */
DELAM_API int32_t delam_solver_plan_item(const delam_solver *solver, int64_t index, const char **subject,
                                         const char **decision, const char **reason, double *cost, double *saving,
                                         const char **unit);

/* Returns the value of an option that the solver uses, as text, e.g. "energetic" for `solution`; hosts may label
 * results with it. Returns NULL for an unknown key.
 * [null result; owns result until the next call with this solver; status argument; since 0.1] */
DELAM_API const char *delam_solver_option(const delam_solver *solver, const char *key);
/* Returns a text about the energetic search of the last step, with one line for each front and each new crack. A line
 * names the states that the search compared, why it stopped, and the lowest energy. A step in substeps has such a text
 * for each of them. The last step is the pending one, or the committed one if none is pending. The text is "" if there
 * was no search, and never NULL. Saved states do not hold it.
 * [owns result until the next call with this solver; status -; since 0.1] */
DELAM_API const char *delam_solver_searched(const delam_solver *solver);

/* Selects the state described (delam_solver_value), i.e. the step to which values, fields, fronts, averages and
 * delam_solver_tangent belong. With the option `backtracking`, the solver keeps the last `backtracking_depth` steps. If
 * the pending step replaces earlier steps, the function selects the replacements. step -1 selects the pending state
 * again, or the committed state if no step is pending. Successful calls of advance, equilibrate, commit, rollback and
 * load do the same. DELAM_ERROR_ARGUMENT: the step is not kept; the message names the steps that are.
 * [status argument; since 0.1] */
DELAM_API int32_t delam_solver_look(delam_solver *solver, int64_t step);

/* Returns in *count the number of jumps of the state, i.e. abrupt changes, up to the pending state, or up to the
 * committed state if no step is pending. delam_solver_look does not change it. The jumps are ordered by time. With the
 * option `jump_tolerance`, jumps are the located ones. Without it, a step is a jump if all of this is true:
 *   - it releases energy (value `released`)
 *   - on some interface, it debonds more than 1.5 rows of pairs
 *   - the load falls by more than 2 %, or the step releases more than 1e-3 of the larger of |stored energy +
 *     load_potential| and |work|
 * The debonded size is the sum of weight times loss of adhesion. 1.5 rows are 1.5 mean weights times the number of
 * pairs that the step damages right next to the debonded region. A front in the plane has one such pair, and a front in
 * space a row of them. The load is the sum of factor times reaction over the norm of the factors.
 * The parts of a step may be known (`mixity_rule = converged`, loads in proportion). Those that happen at one load and
 * release more than 1e-3 of what they dissipate then count together. The conditions apply to the longest advance among
 * them, of all interfaces together, and to the pairs of the interface that debonds most. An energetic step to another
 * state counts even if it releases nothing.
 * Where steps follow their load (`step_control = auto` or `load`), a jump is an advance da during which the load M
 * hardly rises, dlnM <= 0.03 da/A. A is the area of the interface, and da that on which the toughness is dissipated. It
 * extends over more than 2.5 pairs of each front or over half of the interface, and may release nothing. Where nothing
 * adheres between fronts afterwards, more than one pair of each is a jump.
 * [null none; status argument; since 0.1] */
DELAM_API int32_t delam_solver_jump_count(const delam_solver *solver, int64_t *count);
/* Returns one jump of the state, in step *step. It lies between *before and *time: in the interval that bisection has
 * found (option `jump_tolerance`), or else in the whole step or substep.
 *   *stored                  change of stored energy and load potential
 *   *dissipated              energy dissipated
 *   *released                energy that is neither stored nor dissipated; in reality, waves would carry it away
 *   *debonded                change of the sum of weight (1 - zeta)
 *   *interface_index         the interface that changed most
 *   *first_pair, *last_pair  the first and last of its pairs whose adhesion changed (-1: none)
 * Where the instant follows from the parts of the step (`mixity_rule = converged`, loads in proportion), *before and
 * *time are both this instant. *released is then what this jump alone releases, while the other energies and *debonded
 * are those of the whole step. Of a located jump, *released is E(time, state before) - E(time, state after) -
 * dissipated. Of any other jump, *released is the value `released` of the step. For energetic jumps it is 0 up to the
 * tolerance.
 * [unit before t, time t, stored F L, dissipated F L, released F L, debonded L or L2; null step, before, time, stored,
 * dissipated, released, debonded, interface_index, first_pair, last_pair; status argument; source none; since 0.1] */
DELAM_API int32_t delam_solver_jump(const delam_solver *solver, int64_t index, int64_t *step, double *before,
                                    double *time, double *stored, double *dissipated, double *released,
                                    double *debonded, int64_t *interface_index, int64_t *first_pair,
                                    int64_t *last_pair);
/* Returns the reactions at a jump (values `reaction:NAME`): before, after: [pattern_count], NULL for those not wanted.
 * Where the instant follows from the parts of the step, both belong to this instant. before is then the load that the
 * structure carries at most, however long the step. Otherwise they belong to the states before and after the jump. Both
 * are NaN for jumps in states that an earlier version saved.
 * [unit before F L, after F L; null before, after; status argument; source none; since 0.1] */
DELAM_API int32_t delam_solver_jump_reactions(const delam_solver *solver, int64_t index, int64_t capacity,
                                              double *before, double *after);

/* Saves the committed state as bytes: [*needed]. *needed receives the size; with capacity 0 the function returns only
 * the size. A solver of the same scene and options that loads these bytes continues with bitwise identical results.
 * [null bytes at capacity 0; status argument; since 0.1] */
DELAM_API int32_t delam_solver_save(const delam_solver *solver, int64_t capacity, uint8_t *bytes, int64_t *needed);
/* Loads bytes: [size] that delam_solver_save wrote; they become the committed state, and a pending step is discarded.
 * The bytes also replace the histories (delam_solver_set_history) and the record. DELAM_ERROR_SNAPSHOT: the bytes are
 * damaged, or of another scene or version; the message says what is wrong.
 * [null none; status cancelled, argument, numerical, snapshot; since 0.1] */
DELAM_API int32_t delam_solver_load(delam_solver *solver, int64_t size, const uint8_t *bytes);
/* Saves the bytes of delam_solver_save in the file at path (in the encoding of the file system). The function first
 * writes a temporary file in the same folder and gives it the name path once it is complete and on disk. A full disk or
 * an interruption therefore leaves the old file intact. DELAM_ERROR_FILE: the message says what failed.
 * [null none; status argument, file; since 0.1] */
DELAM_API int32_t delam_solver_save_file(const delam_solver *solver, const char *path);
/* Loads the file at path, which holds bytes of delam_solver_save or delam_solver_save_file, as delam_solver_load does.
 * [null none; status cancelled, argument, numerical, snapshot, file; since 0.1] */
DELAM_API int32_t delam_solver_load_file(delam_solver *solver, const char *path);

#ifdef __cplusplus
}
#endif
#endif
