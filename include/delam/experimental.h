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
 * over the variables v. K is the stiffness of the bodies, which only the engine knows; theta [patterns] are the factors
 * of the load patterns, f(theta) = sum theta_p f_p their nodal forces, C what the interfaces do at the moment, h forces
 * on single variables. Of the variables the library reads the `visible` ones: those at interfaces and in constraints.
 */

/* The variables of a problem. Variable i < dofs is the displacement of DOF i of the mesh (dimension*node + component);
 * variable dofs + k is the jump k. DOFs in `replaced` [replaced_count] are no variables: row r of T says u[replaced[r]]
 * = sum over e in [row_starts[r], row_starts[r+1]) of coefficients[e] * v[columns[e]]. Every other DOF is a variable of
 * its own. homes [jump_count]: for each jump a replaced DOF that depends on it, a
 * different one for each; the displacements at these DOFs could be the variables in the place of the jumps. U
 * (lift_dofs, lift_values) and f (force_dofs, force_values) by patterns: entries [lift_starts[p], lift_starts[p+1]) and
 * [force_starts[p], force_starts[p+1]) belong to pattern p. visible [visible_count]: variables. */
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

/* Entries of a sparse matrix, `count` of them. Rows and columns are places in `visible`. */
typedef struct delam_experimental_entries {
    int64_t count;
    const int64_t *rows;
    const int64_t *columns;
    const double *values;
} delam_experimental_entries;

/* What is asked of a solve. theta [pattern_count]; force [visible_count]: h; right [pivot_count]: what the expressed
 * variables have besides their masters. The engine keeps `kept` answers, in places 0 to kept-1, as whole vectors v with
 * their theta: place says where to keep this one, start [kept] from which combination of them to begin (NULL: from
 * nothing; the start of least energy along it is better than the combination itself).
 *
 * The solve may end when the residual r, in the norm sqrt(r.M r) of its preconditioner M, is at most `tolerance` times
 * the size of the state, sqrt(|u.K u| + sum of |v_i C_ij v_j|), or at most what enough(first, user) returns for the
 * norm at the start (enough may be NULL). limit: of its iterations. poll(user) returns a value other than 0 if the
 * solve is to be given up; the engine asks in each iteration and then returns DELAM_CANCELLED. */
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

/* What a solve answers; the arrays are the library's, the engine fills them. values [visible_count]: v. balance
 * [visible_count]: T^T (f - K u), in equilibrium C v - h but for expressed variables. correction and
 * correction_balance [visible_count]: M r and T^T K T M r of the true residual r at the end. products [kept]: u.K u_s
 * with the answer in each place s, 0 for empty ones, and with itself in its own. work and lifted [pattern_count]: f_p.u
 * and U_p.(K u). first and norm: sqrt(r.M r) at the start and at the end; size: that of the state. least: about the
 * least eigenvalue of M A that the iteration has met, 1 if it has met none. rounding: relative, of u.K u, about the
 * unit of rounding times sqrt(sum of (d_i v_i^2)^2) / u.K u with the diagonal d of T^T K T. converged: 0 if neither the
 * tolerance nor what rounding allows was reached. definite: 0 if the matrix turned out to be indefinite; the rest is
 * then not set, and the place is empty. */
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

/* An engine. size: sizeof(delam_experimental_engine); kept: number of answers that it keeps: 8. The functions
 * are called in the thread of the running call of the library, return 0 or a status, and must not call the library with
 * objects of the same context. Of the statuses of delam.h they may have DELAM_CANCELLED and those of the errors
 * argument, problem, state, memory and numerical; the library takes any other number for DELAM_ERROR_NUMERICAL. The
 * running call returns that status if its line in brackets lists it, else DELAM_ERROR_NUMERICAL; where the line does
 * not list that either, DELAM_ERROR_PROBLEM (delam_solver_value), or DELAM_ERROR_INTERNAL (delam_solver_field,
 * delam_solver_average). Of a number that is not passed on, the message tells which it was.
 *   prepare   the variables from now on, valid until it returns; all places are empty. Fills diagonal [visible_count],
 *             of T^T K T, and load_sizes [pattern_count], the largest component of |T^T (f_p - K U_p)|.
 *   set       what acts from now on: the entries of C; variables that are zero (places in `visible`); and expressed
 *             variables: places `pivots` [pivot_count], each the sum of values times columns of `masters`, whose rows
 *             are places in `pivots`, plus what a request has for it. No pivot is a master or zero.
 *   renew     a new preconditioner, of T^T K T with these entries added, which make it positive definite. Stores in
 *             *cost how many iterations it is worth.
 *   solve     see above.
 *   recover   the displacements of a combination of kept answers, weights [kept]: u in displacement [dofs], and K u in
 *             force [dofs]. force is NULL in delam_experimental_solver_recover: the engine then keeps them for itself.
 *             displacement is NULL as well, or has rigid motions of bodies, which the engine adds to u; K u stays. An
 *             engine with nodes that the mesh lacks does not know how these move: it returns DELAM_ERROR_PROBLEM and
 *             keeps nothing. The library then solves anew, by set, renew and solve.
 *   release   frees the engine: called once, when the last problem or solver that holds it is gone. May be NULL.
 *   message   says why the last call failed. */
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
 * (delam_mesh_add_host_body) then need no stiffness, and no other nodes than those at interfaces, supports and loads:
 * each of them is one elastic solid, which nothing but the problem's supports and interfaces holds. Solvers made from
 * then on use it. The option `reduction` must be `auto`, `subdomains` 0. No stiffness is assembled here. A saved state
 * goes on to the same results within the tolerances of the solves, not bit by bit.
 * [null engine; owns engine: what it points to, the host, until its function release is called; status argument; since
 * 0.1] */
DELAM_API int32_t delam_experimental_problem_set_engine(delam_problem *problem,
                                                        const delam_experimental_engine *engine);

/* Writes some of the problem's cells, with all that their stiffness follows from, as bytes that another process can
 * turn into a matrix (delam_experimental_part_matrix). cells: [count] from 0 on, ascending, at least one, of bodies
 * with a material; the host's own stiffness has no parts. *size receives the number of bytes; call it with bytes NULL
 * and capacity 0 to get it, and again with bytes [capacity].
 * [null bytes, size; status cancelled, argument, problem; source none; since 0.1] */
DELAM_API int32_t delam_experimental_problem_part(const delam_problem *problem, int64_t count, const int64_t *cells,
                                                  int64_t capacity, uint8_t *bytes, int64_t *size);
/* Returns the stiffness of a part: CSR with both triangles over the DOFs of its nodes, dimension*i + component for
 * local node i. bytes: [size]. nodes [node_count] receives the nodes in the numbering of the problem's mesh, ascending,
 * coordinates [node_count][dimension] their places. The matrices of all parts of a body, added up, are that of
 * delam_problem_body_matrix. Call it with NULL arrays to get *dimension, *node_count and *entries, and again with
 * row_starts [dimension*node_count+1], columns [entries] and values [entries].
 * [unit coordinates L, values F/L; null dimension, node_count, entries, nodes, coordinates, row_starts, columns,
 * values; status cancelled, argument, snapshot; source T. Hughes, The Finite Element Method (1987), chapters 3 and 4;
 * since 0.1] */
DELAM_API int32_t delam_experimental_part_matrix(delam_context *context, int64_t size, const uint8_t *bytes,
                                                 int64_t *dimension, int64_t *node_count, int64_t *entries,
                                                 int64_t *nodes, double *coordinates, int64_t *row_starts,
                                                 int64_t *columns, double *values);
/* Computes fields at the centres of a part's cells: stress [cell_count][4 or 6] and rotation [cell_count][1 or 3], as
 * the fields `stress` and `rotation` of delam_solver_field have them. bytes: [size]. displacement: [node_count]
 * [dimension], at the part's nodes. bodies [body_count]: labels >= 0, each once, with the eigenstrains [body_count][6]
 * of these bodies; others have none. node_count and cell_count have to be those of the part.
 * [unit displacement L finite, eigenstrains 1 finite, stress F/L2, rotation rad; null stress, rotation; status
 * cancelled, argument, snapshot; source T. Hughes, The Finite Element Method (1987), chapters 3 and 4; since 0.1] */
DELAM_API int32_t delam_experimental_part_fields(delam_context *context, int64_t size, const uint8_t *bytes,
                                                 int64_t node_count, const double *displacement, int64_t body_count,
                                                 const int32_t *bodies, const double *eigenstrains, int64_t cell_count,
                                                 double *stress, double *rotation);

/* Has the engine of a solver's problem recover the displacements of its present state, pending or committed, and keep
 * them: for those whom the engine serves. The library does not get them.
 * [null none; status cancelled, numerical, state; source none; since 0.1] */
DELAM_API int32_t delam_experimental_solver_recover(delam_solver *solver);
/* Returns the eigenstrains of the bodies in the present state: the sum over the patterns of factor times strain, xx,
 * yy, zz, 2xy, 2yz, 2zx in material axes. *count receives the number of bodies in the mesh, or 0 if the problem has no
 * eigenstrains; call it with NULL arrays for that, and again with bodies [capacity] for their labels and eigenstrains
 * [capacity][6].
 * [unit eigenstrains 1; null bodies, eigenstrains, count; status argument; source none; since 0.1] */
DELAM_API int32_t delam_experimental_solver_eigenstrains(delam_solver *solver, int64_t capacity, int32_t *bodies,
                                                         double *eigenstrains, int64_t *count);

/* ---- sensitivities ---------------------------------------------------------------------------------------------- */

/* Follows the derivative of the analysis with respect to a number of the laws: key, as of delam_law_set, e.g.
 * normal_toughness, in all of the interfaces [interface_count] together, at least one and each once, which must have
 * the same value, not 0. *parameter: its index, 0 for the first. Call it before the first step. It costs one
 * displacement solve per parameter in each step, and one per damaging pair. DELAM_ERROR_ARGUMENT: no such interface,
 * law or number; `gradient`. DELAM_ERROR_STATE: there are steps already; a law has a gradient term; `mixity_rule =
 * variational`.
 * [null parameter; status cancelled, argument, state, numerical; source none; since 0.2] */
DELAM_API int32_t delam_experimental_solver_follow(delam_solver *solver, int64_t interface_count,
                                                   const int64_t *interfaces, const char *key, int64_t *parameter);

/* Returns the derivatives of the reactions in the state described (delam_solver_value): matrix [pattern_count]
 * [parameters], row p that of reaction:p, in its unit over that of the parameter. They are derivatives of the branch on
 * which the march is: at a jump of the state, at a change of the contact set and where a pair reaches a corner of its
 * law, the march has none. *unknown: the number of pairs whose adhesion came to rest within a step and is taken as
 * constant, or that damaged in the very first loaded step with `mixity_rule = frozen`, whose mixity is taken as
 * constant. It is usually 0 in marches that do not jump. DELAM_ERROR_STATE: the state was loaded or set.
 * [unit matrix of factors; null unknown; status argument, state; source P. Michaleris, D. Tortorelli, C. Vidal, Int. J.
 * Numer. Meth. Engng 37 (1994) 2471-2499; since 0.2] */
DELAM_API int32_t delam_experimental_solver_sensitivity(const delam_solver *solver, int64_t capacity, double *matrix,
                                                        int64_t *unknown);

#ifdef __cplusplus
}
#endif
#endif
