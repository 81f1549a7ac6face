/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Functions that libdelam does not promise yet: any version may change or remove them. Their names start with
 * delam_experimental_, and their version node is DELAM_EXPERIMENTAL, not that of the ABI. A function that has proved
 * itself moves to delam.h under a name of its own. The rules at the head of delam.h apply here as well. No other header
 * includes this one.
 */
#ifndef DELAM_EXPERIMENTAL_H
#define DELAM_EXPERIMENTAL_H

#include <delam/delam.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- engines --------------------------------------------------------------------------------------------------------
 *
 * An engine solves the bodies in the place of the library: on other machines, with another solver. The library keeps
 * the interfaces (damage, contact, energies) and asks the engine for the displacements that minimise
 *
 *   1/2 u.K u - f(theta).u + 1/2 v.C v - h.v     with   u = T v + U theta
 *
 * over the variables v. K is the stiffness of the bodies, which only the engine knows. theta [patterns] are the factors
 * of the load patterns, and f(theta) = sum theta_p f_p their nodal forces. C is what the interfaces do at the moment,
 * and h are forces on single variables. Of the variables the library reads the `visible` ones: those at interfaces and
 * in constraints. */

/* The struct describes the variables of a problem. Variable i < dofs is the displacement of DOF i of the mesh
 * (dimension*node + component). Variable dofs + k is the jump k. Every DOF that is not in `replaced` is a variable of
 * its own.
 *   replaced      [replaced_count]      DOFs that are no variables
 *   row_starts    [replaced_count + 1]  row r of T says u[replaced[r]] = sum over e in [row_starts[r], row_starts[r+1])
 *                                       of coefficients[e] * v[columns[e]]
 *   homes         [jump_count]          for each jump a replaced DOF that depends on it, a different one for each
 *   lift_starts   [pattern_count + 1]   lift_dofs and lift_values in [lift_starts[p], lift_starts[p+1]) are U of
 *                                       pattern p
 *   force_starts  [pattern_count + 1]   force_dofs and force_values in [force_starts[p], force_starts[p+1]) are f of
 *                                       pattern p
 *   visible       [visible_count]       variables that the library reads
 * The displacements at `homes` could be the variables in the place of the jumps. */
typedef struct delam_experimental_variables {
    int64_t dimension;
    int64_t dofs;
    int64_t pattern_count;
    int64_t jump_count;
    const int64_t *homes;
    int64_t replaced_count;
    const int64_t *replaced;
    const int64_t *row_starts;
    const int64_t *columns;
    const double *coefficients;
    const int64_t *lift_starts;
    const int64_t *lift_dofs;
    const double *lift_values;
    const int64_t *force_starts;
    const int64_t *force_dofs;
    const double *force_values;
    int64_t visible_count;
    const int64_t *visible;
} delam_experimental_variables;

/* The struct has the entries of a sparse matrix, `count` of them. Rows and columns are places in `visible`. */
typedef struct delam_experimental_entries {
    int64_t count;
    const int64_t *rows;
    const int64_t *columns;
    const double *values;
} delam_experimental_entries;

/* The struct says what the library asks of a solve.
 *   theta      [pattern_count] factors of the load patterns
 *   force      [visible_count] h
 *   right      [pivot_count] what the expressed variables have besides their masters
 *   place      where to keep this answer
 *   start      [kept] combination of the kept answers from which to begin; NULL: from nothing
 *   tolerance  relative to the size of the state, sqrt(|u.K u| + sum of |v_i C_ij v_j|)
 *   enough     enough(first, user) returns an absolute bound for the norm `first` at the start; may be NULL
 *   limit      largest number of iterations of the solve
 *   poll       poll(user) returns a value other than 0 if the engine is to give up the solve
 *   user       passed to enough and poll unchanged
 * The engine keeps `kept` answers, in places 0 to kept-1, as whole vectors v with their theta. A start of least energy
 * along the combination is better than the combination itself. The solve may end when the residual r is small in the
 * norm sqrt(r.M r) of its preconditioner M. This norm must be at most `tolerance` times the size of the state, or at
 * most what enough returns. The engine calls poll in each iteration and returns DELAM_CANCELLED when it gives up. */
typedef struct delam_experimental_request {
    const double *theta;
    const double *force;
    const double *right;
    const double *start;
    int64_t place;
    double tolerance;
    int64_t limit;
    double (*enough)(double first, void *user);
    int32_t (*poll)(void *user);
    void *user;
} delam_experimental_request;

/* The struct has what a solve answers; the arrays are the library's, and the engine fills them.
 *   values              [visible_count] v
 *   balance             [visible_count] T^T (f - K u), in equilibrium C v - h but for expressed variables
 *   correction          [visible_count] M r, with the true residual r at the end
 *   correction_balance  [visible_count] T^T K T M r
 *   products            [kept] u.K u_s with the answer in each place s, 0 for empty ones, and with itself in its own
 *   work                [pattern_count] f_p.u
 *   lifted              [pattern_count] U_p.(K u)
 *   first, norm         sqrt(r.M r) at the start and at the end
 *   size                that of the state
 *   least               about the least eigenvalue of M A that the iteration has met, 1 if it has met none
 *   rounding            relative, of u.K u, about the unit of rounding times sqrt(sum of (d_i v_i^2)^2) / u.K u
 *   iterations          number of iterations
 *   converged           0 if neither the tolerance nor what rounding allows was reached
 *   definite            0 if the matrix turned out to be indefinite
 * In rounding, d is the diagonal of T^T K T. If definite is 0, the engine does not set the other members, and the place
 * is empty. */
typedef struct delam_experimental_answer {
    double *values;
    double *balance;
    double *correction;
    double *correction_balance;
    double *products;
    double *work;
    double *lifted;
    double first;
    double norm;
    double size;
    double least;
    double rounding;
    int64_t iterations;
    int32_t converged;
    int32_t definite;
} delam_experimental_answer;

/* The struct is an engine. size is sizeof(delam_experimental_engine). kept is the number of answers that the engine
 * keeps, 8. user is passed to its functions unchanged. The library calls them in the thread of the running call. They
 * return 0 or a status, and must not call the library with objects of the same context.
 * Of the statuses of delam.h they may return DELAM_CANCELLED and those of the errors argument, problem, state, memory
 * and numerical. The library takes any other number for DELAM_ERROR_NUMERICAL. The running call returns that status if
 * its line in brackets lists it, else DELAM_ERROR_NUMERICAL. If the line does not list this either, delam_solver_value
 * returns DELAM_ERROR_PROBLEM. delam_solver_field and delam_solver_average then return DELAM_ERROR_INTERNAL. If the
 * running call returns another number than the engine, the message tells which it was.
 *   prepare  takes the variables from now on, valid until it returns; all places are empty. Fills diagonal
 *            [visible_count], of T^T K T, and load_sizes [pattern_count], the largest component of |T^T (f_p - K U_p)|.
 *   set      takes what acts from now on. couplings are the entries of C. fixed [fixed_count] are variables that are
 *            zero (places in `visible`). pivots [pivot_count] are places of expressed variables. Each is the sum of
 *            values times columns of `masters`, whose rows are places in `pivots`, plus what a request has for it. No
 *            pivot is a master or zero.
 *   renew    makes a new preconditioner, of T^T K T with these entries added, which make it positive definite. Stores
 *            in *cost how many iterations it is worth.
 *   solve    answers a request.
 *   recover  computes the displacements of a combination of kept answers, weights [kept]: u in displacement [dofs], and
 *            K u in force [dofs].
 *   release  frees the engine: called once, when the last problem or solver that holds it is gone. May be NULL.
 *   message  says why the last call failed.
 * In delam_experimental_solver_recover, force of recover is NULL, and the engine keeps the displacements for itself.
 * displacement is then NULL as well, or has rigid motions of bodies, which the engine adds to u; K u stays. An engine
 * with nodes that the mesh lacks does not know how these move. It returns DELAM_ERROR_PROBLEM and keeps nothing, and
 * the library then solves again, by set, renew and solve. */
typedef struct delam_experimental_engine {
    int64_t size;
    int64_t kept;
    void *user;
    int32_t (*prepare)(const delam_experimental_variables *variables, double *diagonal, double *load_sizes, void *user);
    int32_t (*set)(const delam_experimental_entries *couplings, int64_t fixed_count, const int64_t *fixed,
                   int64_t pivot_count, const int64_t *pivots, const delam_experimental_entries *masters, void *user);
    int32_t (*renew)(const delam_experimental_entries *entries, double *cost, void *user);
    int32_t (*solve)(const delam_experimental_request *request, delam_experimental_answer *answer, void *user);
    int32_t (*recover)(const double *weights, double *displacement, double *force, void *user);
    void (*release)(void *user);
    const char *(*message)(void *user);
} delam_experimental_engine;

/* Solves the bodies of the problem by an engine, which the library copies; NULL takes it back. Bodies without cells
 * (delam_mesh_add_host_body) then need no stiffness. They need no other nodes than those at interfaces, supports and
 * loads. Each such body is one elastic solid, which nothing but the problem's supports and interfaces holds. Solvers
 * made from then on use the engine. The option `reduction` must be `auto`, and `subdomains` 0. The library assembles no
 * stiffness here. A saved state goes on to the same results within the tolerances of the solves, not bit by bit.
 * [null engine; owns engine: what it points to, the host, until its function release is called; status argument; since
 * 0.1] */
DELAM_API int32_t delam_experimental_problem_set_engine(delam_problem *problem,
                                                        const delam_experimental_engine *engine);

/* Writes some of the problem's cells, with all that their stiffness follows from, as bytes. Another process can turn
 * them into a matrix (delam_experimental_part_matrix). cells: [count] from 0 on, ascending, at least one, belong to
 * bodies with a material; the host's own stiffness has no parts. *size receives the number of bytes. Call the function
 * with bytes NULL and capacity 0 to get it, and again with bytes [capacity].
 * [null bytes, size; status cancelled, argument, problem; source none; since 0.1] */
DELAM_API int32_t delam_experimental_problem_part(const delam_problem *problem, int64_t count, const int64_t *cells,
                                                  int64_t capacity, uint8_t *bytes, int64_t *size);
/* Returns the stiffness of a part: CSR with both triangles over the DOFs of its nodes, dimension*i + component for
 * local node i. bytes: [size] describe the part. nodes [node_count] receives the nodes in the numbering of the
 * problem's mesh, ascending, and coordinates [node_count][dimension] their places. The matrices of all parts of a body,
 * added up, are that of delam_problem_body_matrix. Call the function with NULL arrays to get *dimension, *node_count
 * and *entries. Call it again with row_starts [dimension*node_count+1], columns [entries] and values [entries].
 * [unit coordinates L, values F/L; null dimension, node_count, entries, nodes, coordinates, row_starts, columns,
 * values; status cancelled, argument, snapshot; source T. Hughes, The Finite Element Method (1987), chapters 3 and 4;
 * since 0.1] */
DELAM_API int32_t delam_experimental_part_matrix(delam_context *context, int64_t size, const uint8_t *bytes,
                                                 int64_t *dimension, int64_t *node_count, int64_t *entries,
                                                 int64_t *nodes, double *coordinates, int64_t *row_starts,
                                                 int64_t *columns, double *values);
/* Computes fields at the centres of a part's cells, as the fields `stress` and `rotation` of delam_solver_field have
 * them.
 *   bytes         [size] of the part
 *   displacement  [node_count][dimension], at the part's nodes
 *   bodies        [body_count] labels >= 0, each once
 *   eigenstrains  [body_count][6] of these bodies; others have none
 *   stress        [cell_count][4 or 6]
 *   rotation      [cell_count][1 or 3]
 * node_count and cell_count must be those of the part.
 * [unit displacement L finite, eigenstrains 1 finite, stress F/L2, rotation rad; null stress, rotation; status
 * cancelled, argument, snapshot; source T. Hughes, The Finite Element Method (1987), chapters 3 and 4; since 0.1] */
DELAM_API int32_t delam_experimental_part_fields(delam_context *context, int64_t size, const uint8_t *bytes,
                                                 int64_t node_count, const double *displacement, int64_t body_count,
                                                 const int32_t *bodies, const double *eigenstrains, int64_t cell_count,
                                                 double *stress, double *rotation);

/* Makes the engine of a solver's problem recover the displacements of its present state, pending or committed, and keep
 * them. They are for those whom the engine serves; the library does not get them.
 * [null none; status cancelled, numerical, state; source none; since 0.1] */
DELAM_API int32_t delam_experimental_solver_recover(delam_solver *solver);
/* Returns the eigenstrains of the bodies in the present state. They are the sum over the patterns of factor times
 * strain, xx, yy, zz, 2xy, 2yz, 2zx in material axes. *count receives the number of bodies in the mesh, or 0 if the
 * problem has no eigenstrains. Call the function with NULL arrays for that, and again with bodies [capacity] for their
 * labels and eigenstrains [capacity][6].
 * [unit eigenstrains 1; null bodies, eigenstrains, count; status argument; source none; since 0.1] */
DELAM_API int32_t delam_experimental_solver_eigenstrains(delam_solver *solver, int64_t capacity, int32_t *bodies,
                                                         double *eigenstrains, int64_t *count);

/* ---- interfaces ------------------------------------------------------------------------------------------------- */

/* Cuts a body open along faces between its cells, as for a crack that ends within it. The nodes of these faces are
 * doubled, so that both sides are outer faces that lie on each other: a seam for delam_mesh_add_seams. A node around
 * which the cells stay connected across other faces, as at the tip of the crack, stays one.
 *   faces  [face_count][nodes_per_face] nodes of each face, its corners or all of them, in any order
 * A triangle among quadrilaterals repeats a node, and the original of a copied node stands for the copy.
 * The copies are appended to the mesh. *out_nodes receives their number, and delam_mesh_node_origins returns their
 * originals. Cells of the body cannot be added any more. Cuts come before the interfaces of the body.
 * DELAM_ERROR_MESH: no two cells of one body share a face, or the faces open nothing. DELAM_ERROR_STATE: the body has
 * an interface already.
 * [null none; status cancelled, argument, mesh, state; source none; since 0.2] */
DELAM_API int32_t delam_experimental_mesh_cut(delam_mesh *mesh, int64_t face_count, int32_t nodes_per_face,
                                              const int64_t *faces, int32_t index_base, int64_t *out_nodes);
/* Turns the frames of an interface in space about their normals, so that the first tangent of each pair lies along the
 * projection of a direction. Without this call it is the projection of the x axis, or of the y axis where the normal is
 * within 26 degrees of x. Laws with a `second_tangential_stiffness`, onset, strength or toughness act along these
 * tangents, and so do the components of jumps and tractions. A problem keeps the frames that the mesh has when the
 * problem is created.
 *   directions  [count][3], any length > 0; count is 1, for all pairs, or the number of pairs
 * DELAM_ERROR_MESH: a direction is the normal of a pair.
 * [unit directions 1 finite; null none; status cancelled, argument, mesh; source none; since 0.3] */
DELAM_API int32_t delam_experimental_mesh_set_tangents(delam_mesh *mesh, int64_t interface_index, int64_t count,
                                                       const double *directions);
/* Moves pairs [count] of an interface into a new one between the same two bodies, so that both have laws or bonds of
 * their own. An example are bodies that share nodes on one part of their common surface and are glued on the rest.
 * *out_interface receives the index of the new interface. The pairs of both keep their order, weights and frames, and
 * are numbered anew. A face of the interface goes where all of its pairs are. A face with pairs of both is one of
 * neither. DELAM_ERROR_ARGUMENT: a pair occurs twice, or one of the interfaces would have
 * no pair.
 * [null none; status argument; source none; since 0.2] */
DELAM_API int32_t delam_experimental_mesh_split_interface(delam_mesh *mesh, int64_t interface_index, int64_t count,
                                                          const int64_t *pairs, int32_t index_base,
                                                          int64_t *out_interface);

/* ---- sensitivities ---------------------------------------------------------------------------------------------- */

/* Follows the derivative of the analysis with respect to a number of the laws: key, as of delam_law_set, e.g.
 * normal_toughness. The derivative is with respect to this number in all of the interfaces [interface_count] together,
 * at least one and each once. They must have the same value, not 0. *parameter receives the index, 0 for the first.
 * Call the function before the first step. It costs one displacement solve per parameter in each step, and one per
 * damaging pair. DELAM_ERROR_ARGUMENT: there is no such interface, law or number, or the key is `gradient`.
 * DELAM_ERROR_STATE: there are steps already, a law has a gradient term, or `mixity_rule = variational`.
 * [null parameter; status cancelled, argument, state, numerical; source none; since 0.2] */
DELAM_API int32_t delam_experimental_solver_follow(delam_solver *solver, int64_t interface_count,
                                                   const int64_t *interfaces, const char *key, int64_t *parameter);

/* Returns the derivatives of the reactions in the state described (delam_solver_value). Row p of matrix
 * [pattern_count][parameters] is that of reaction:p, in its unit over that of the parameter. The derivatives are those
 * of the branch on which the analysis is. At a jump of the state, at a change of the contact set and where a pair
 * reaches a corner of its law, the analysis has none.
 * *unknown receives the number of pairs whose adhesion is taken as constant, because it came to rest within a step.
 * *unknown is usually 0 in analyses that do not jump. With `mixity_rule = converged`, long steps have parts, after
 * which pairs come to rest, unless `path_step = 1`. DELAM_ERROR_STATE: the state was loaded or set.
 * [unit matrix of factors; null unknown; status argument, state; source P. Michaleris, D. Tortorelli, C. Vidal, Int. J.
 * Numer. Meth. Engng 37 (1994) 2471-2499; since 0.2] */
DELAM_API int32_t delam_experimental_solver_sensitivity(const delam_solver *solver, int64_t capacity, double *matrix,
                                                        int64_t *unknown);

#ifdef __cplusplus
}
#endif
#endif
