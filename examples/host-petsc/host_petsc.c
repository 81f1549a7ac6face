/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A host on many processes that assembles its own stiffness and lets libdelam delaminate it, from C.
 *
 *     mpirun -n 4 host_petsc [CELLS]        CELLS: number of cells along the beam, 30 if absent
 *
 * A double cantilever beam in space: two arms of 45 mm x 9 mm x 1.5 mm, bonded but for a notch of 15 mm at the left
 * end, held at the right end and pulled apart to 1.6 mm at the left one, in 10 steps. Each rank has a slab of the beam,
 * between two sections across it, and integrates the stiffness of its own cells (8 nodes, 2 x 2 x 2 Gauss points).
 * libdelam, on rank 0, knows only the nodes at the interface, the support and the loads. SI units.
 */
#include <math.h>
#include <mpi.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "delam/delam.h"
#include "delam/petsc.h"

static const double length = 45e-3;  /* m */
static const double width = 9e-3;    /* m */
static const double height = 1.5e-3; /* of an arm, m */
static const double notch = 15e-3;   /* m */
static const double young = 60e9;    /* Pa */
static const double poisson = 0.3;
enum { across = 3, upwards = 2, steps = 10 }; /* cells across the width and over the height of an arm; load steps */

/* ---- the host's grid -------------------------------------------------------------------------------------------- */

/* Node (arm, i, j, k): arm 0 below, 1 above; i along the beam, j across it, k away from the interface. */
typedef struct {
    int64_t along;       /* cells along the beam */
    int64_t first, last; /* sections between which this rank's cells lie */
} grid;

static void place(const grid *g, int64_t arm, int64_t i, int64_t j, int64_t k, double *x) {
    x[0] = length * (double)i / (double)g->along;
    x[1] = width * (double)j / across;
    x[2] = height + (arm == 0 ? -1.0 : 1.0) * height * (double)k / upwards;
}

/* Where the numbers of the groups begin: nodes of the interface, held ones, loaded ones, all others. */
static int64_t held_nodes(const grid *g) { return 2 * (g->along + 1) * (across + 1); }
static int64_t loaded_nodes(const grid *g) { return held_nodes(g) + 2 * upwards * (across + 1); }
static int64_t other_nodes(const grid *g) { return loaded_nodes(g) + 2 * (across + 1); }

/* Number of a node, the same on all ranks. libdelam's mesh has the first groups; numbers behind may have gaps. */
static int64_t number(const grid *g, int64_t arm, int64_t i, int64_t j, int64_t k) {
    const int64_t layer = arm * upwards + k - 1;
    if (k == 0) return (arm * (across + 1) + j) * (g->along + 1) + i;
    if (i == g->along) return held_nodes(g) + layer * (across + 1) + j;
    if (i == 0 && k == upwards) return loaded_nodes(g) + arm * (across + 1) + j;
    return other_nodes(g) + (layer * (across + 1) + j) * (g->along + 1) + i;
}

/* ---- the host's elements ---------------------------------------------------------------------------------------- */

/* Gradients of the shape functions at a point of a cell, and the volume that a unit of its cube has there. */
static double gradients(double x[8][3], const double *point, double gradient[8][3]) {
    double slope[8][3]; /* by the coordinates of the cube */
    double jacobian[3][3] = {{0.0}};
    double cofactor[3][3];
    double determinant = 0.0;
    int c, r, s;
    for (c = 0; c < 8; ++c) {
        const double sign[3] = {c & 1 ? 1.0 : -1.0, c & 2 ? 1.0 : -1.0, c & 4 ? 1.0 : -1.0};
        for (r = 0; r < 3; ++r) {
            const int a = (r + 1) % 3, b = (r + 2) % 3;
            slope[c][r] = 0.125 * sign[r] * (1.0 + sign[a] * point[a]) * (1.0 + sign[b] * point[b]);
            for (s = 0; s < 3; ++s) jacobian[r][s] += slope[c][r] * x[c][s];
        }
    }
    for (r = 0; r < 3; ++r) {
        for (s = 0; s < 3; ++s) {
            const int a = (r + 1) % 3, b = (r + 2) % 3, d = (s + 1) % 3, e = (s + 2) % 3;
            cofactor[r][s] = jacobian[a][d] * jacobian[b][e] - jacobian[a][e] * jacobian[b][d];
        }
    }
    for (s = 0; s < 3; ++s) determinant += jacobian[0][s] * cofactor[0][s];
    for (c = 0; c < 8; ++c) {
        for (s = 0; s < 3; ++s) {
            gradient[c][s] = 0.0;
            for (r = 0; r < 3; ++r) gradient[c][s] += slope[c][r] * cofactor[r][s] / determinant;
        }
    }
    return fabs(determinant); /* arm 0 is the mirror image of arm 1 */
}

/* Stiffness of a cell from the places of its nodes: block (a, b) holds the forces on node a due to node b. */
static void cell_stiffness(double x[8][3], double stiffness[8][8][3][3]) {
    const double lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    const double mu = 0.5 * young / (1.0 + poisson);
    const double gauss = 1.0 / sqrt(3.0);
    double *entries = &stiffness[0][0][0][0];
    int point, a, b, p, q;
    for (a = 0; a < 8 * 8 * 3 * 3; ++a) entries[a] = 0.0;
    for (point = 0; point < 8; ++point) {
        const double at[3] = {point & 1 ? gauss : -gauss, point & 2 ? gauss : -gauss, point & 4 ? gauss : -gauss};
        double g[8][3];
        const double volume = gradients(x, at, g);
        for (a = 0; a < 8; ++a) {
            for (b = 0; b < 8; ++b) {
                const double along = g[a][0] * g[b][0] + g[a][1] * g[b][1] + g[a][2] * g[b][2];
                for (p = 0; p < 3; ++p) {
                    for (q = 0; q < 3; ++q) {
                        const double shear = g[a][q] * g[b][p] + (p == q ? along : 0.0);
                        stiffness[a][b][p][q] += volume * (lambda * g[a][p] * g[b][q] + mu * shear);
                    }
                }
            }
        }
    }
}

/* ---- the part of a rank ----------------------------------------------------------------------------------------- */

typedef struct {
    int64_t node_count;
    int64_t *nodes;
    double *coordinates;
    int64_t *row_starts;
    int64_t *columns;
    double *values;
} part;

static void free_part(part *p) {
    free(p->nodes);
    free(p->coordinates);
    free(p->row_starts);
    free(p->columns);
    free(p->values);
}

/* Place of a node in the part. */
static int64_t local(const grid *g, int64_t arm, int64_t i, int64_t j, int64_t k) {
    return ((arm * (upwards + 1) + k) * (across + 1) + j) * (g->last - g->first + 1) + i - g->first;
}

/* Adds up the cells: 27 blocks of 3 x 3 for each node, one for each node of the 3 x 3 x 3 around it. */
static void add_cells(const grid *g, double (*blocks)[27][3][3]) {
    int64_t arm, i, j, k;
    int a, b, p, q;
    for (arm = 0; arm < 2; ++arm) {
        for (k = 0; k < upwards; ++k) {
            for (j = 0; j < across; ++j) {
                for (i = g->first; i < g->last; ++i) {
                    double x[8][3];
                    double stiffness[8][8][3][3];
                    for (a = 0; a < 8; ++a) place(g, arm, i + (a & 1), j + (a >> 1 & 1), k + (a >> 2), x[a]);
                    cell_stiffness(x, stiffness);
                    for (a = 0; a < 8; ++a) {
                        const int64_t row = local(g, arm, i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
                        for (b = 0; b < 8; ++b) {
                            const int to =
                                13 + (b & 1) - (a & 1) + 3 * ((b >> 1 & 1) - (a >> 1 & 1)) + 9 * ((b >> 2) - (a >> 2));
                            for (p = 0; p < 3; ++p)
                                for (q = 0; q < 3; ++q) blocks[row][to][p][q] += stiffness[a][b][p][q];
                        }
                    }
                }
            }
        }
    }
}

/* Writes the rows of a node behind the entries so far; returns how many there are then. */
static int64_t write_rows(const grid *g, int64_t arm, int64_t i, int64_t j, int64_t k, double blocks[27][3][3],
                          part *out, int64_t entries) {
    const int64_t row = local(g, arm, i, j, k);
    int p, q, to;
    for (p = 0; p < 3; ++p) {
        for (to = 0; to < 27; ++to) {
            const int64_t di = i + to % 3 - 1, dj = j + to / 3 % 3 - 1, dk = k + to / 9 - 1;
            if (di < g->first || di > g->last || dj < 0 || dj > across || dk < 0 || dk > upwards) continue;
            for (q = 0; q < 3; ++q) {
                out->columns[entries] = 3 * local(g, arm, di, dj, dk) + q;
                out->values[entries++] = blocks[to][p][q];
            }
        }
        out->row_starts[3 * row + p + 1] = entries;
    }
    return entries;
}

/* Returns 0, or 1 if there is not enough memory. A rank without cells has an empty part. */
static int make_part(const grid *g, part *out) {
    const int64_t sections = g->last > g->first ? g->last - g->first + 1 : 0;
    const size_t count = (size_t)(2 * (upwards + 1) * (across + 1) * sections);
    double(*blocks)[27][3][3];
    int64_t arm, i, j, k, entries = 0;
    out->node_count = (int64_t)count;
    if (count == 0) return 0;
    blocks = calloc(count, sizeof *blocks);
    out->nodes = malloc(count * sizeof *out->nodes);
    out->coordinates = malloc(3 * count * sizeof *out->coordinates);
    out->row_starts = calloc(3 * count + 1, sizeof *out->row_starts);
    out->columns = malloc(count * 9 * 27 * sizeof *out->columns);
    out->values = malloc(count * 9 * 27 * sizeof *out->values);
    if (blocks == NULL || out->nodes == NULL || out->coordinates == NULL || out->row_starts == NULL ||
        out->columns == NULL || out->values == NULL) {
        free(blocks);
        return 1;
    }
    add_cells(g, blocks);
    for (arm = 0; arm < 2; ++arm) {
        for (k = 0; k <= upwards; ++k) {
            for (j = 0; j <= across; ++j) {
                for (i = g->first; i <= g->last; ++i) {
                    const int64_t row = local(g, arm, i, j, k);
                    out->nodes[row] = number(g, arm, i, j, k);
                    place(g, arm, i, j, k, out->coordinates + 3 * row);
                    entries = write_rows(g, arm, i, j, k, blocks[row], out, entries);
                }
            }
        }
    }
    free(blocks);
    return 0;
}

/* ---- what libdelam knows, on rank 0 ----------------------------------------------------------------------------- */

typedef struct {
    grid g;
    delam_context *context;
    delam_mesh *mesh;
    delam_law *law;
    delam_problem *problem;
    delam_solver *solver;
    int64_t opening; /* the load pattern */
    delam_petsc *petsc;
    double largest; /* displacement of a node that libdelam does not know, m */
} scene;

/* Each call of the library goes through here: on failure tell what the context says, and return the status. */
#define TRY(call)                                                                                                   \
    do {                                                                                                            \
        const int32_t status_ = (call);                                                                             \
        if (status_ != DELAM_OK) {                                                                                  \
            fprintf(stderr, "host_petsc: %s: %s\n", delam_status_name(status_), delam_context_message(s->context)); \
            return status_;                                                                                         \
        }                                                                                                           \
    } while (0)

static int32_t make_mesh_of(scene *s, double *x, int64_t *list, double *normals, double *weights, int64_t *faces) {
    const grid *g = &s->g;
    const int64_t pairs = (g->along + 1) * (across + 1);
    const double area = length / (double)g->along * width / across;
    int64_t arm, i, j, k, count, face = 0, interface_index = 0;
    for (arm = 0; arm < 2; ++arm)
        for (k = 0; k <= upwards; ++k)
            for (j = 0; j <= across; ++j)
                for (i = 0; i <= g->along; ++i)
                    if (number(g, arm, i, j, k) < other_nodes(g))
                        place(g, arm, i, j, k, x + 3 * number(g, arm, i, j, k));
    TRY(delam_mesh_create(s->context, 3, other_nodes(g), x, &s->mesh));
    for (arm = 0; arm < 2; ++arm) {
        count = 0;
        for (i = 0; i < other_nodes(g); ++i) {
            const int above = i < held_nodes(g)     ? i >= pairs
                              : i < loaded_nodes(g) ? i >= held_nodes(g) + upwards * (across + 1)
                                                    : i >= loaded_nodes(g) + across + 1;
            if (above == arm) list[count++] = i;
        }
        TRY(delam_mesh_add_host_body(s->mesh, (int32_t)arm, count, list, 0));
    }
    /* A pair stands for a quarter of each cell around it. */
    for (j = 0; j <= across; ++j) {
        for (i = 0; i <= g->along; ++i) {
            const int64_t pair = number(g, 0, i, j, 0);
            normals[3 * pair] = normals[3 * pair + 1] = 0.0;
            normals[3 * pair + 2] = 1.0;
            weights[pair] = area * (i == 0 || i == g->along ? 0.5 : 1.0) * (j == 0 || j == across ? 0.5 : 1.0);
            list[pair] = pair;
            list[pairs + pair] = number(g, 1, i, j, 0);
            if (i < g->along && j < across) {
                faces[face++] = pair;
                faces[face++] = pair + 1;
                faces[face++] = number(g, 0, i + 1, j + 1, 0);
                faces[face++] = number(g, 0, i, j + 1, 0);
            }
        }
    }
    TRY(delam_mesh_add_pairs(s->mesh, 0, 1, pairs, list, list + pairs, normals, weights, face / 4, 4, faces, 0,
                             &interface_index));
    return DELAM_OK;
}

static int32_t make_mesh(scene *s) {
    const size_t nodes = (size_t)other_nodes(&s->g);
    double *x = malloc(3 * nodes * sizeof *x);
    int64_t *list = malloc(nodes * sizeof *list);
    double *normals = malloc(3 * nodes * sizeof *normals);
    double *weights = malloc(nodes * sizeof *weights);
    int64_t *faces = malloc(4 * nodes * sizeof *faces);
    int32_t status = DELAM_ERROR_MEMORY;
    if (x != NULL && list != NULL && normals != NULL && weights != NULL && faces != NULL)
        status = make_mesh_of(s, x, list, normals, weights, faces);
    free(x);
    free(list);
    free(normals);
    free(weights);
    free(faces);
    return status;
}

static int32_t make_law(scene *s) {
    TRY(delam_law_create(s->context, "piecewise-linear", &s->law));
    TRY(delam_law_set(s->law, "normal_stiffness", 3e12));
    TRY(delam_law_set(s->law, "tangential_stiffness", 3e12));
    TRY(delam_law_set(s->law, "normal_onset", 5.0));
    TRY(delam_law_set(s->law, "tangential_onset", 5.0));
    TRY(delam_law_set(s->law, "normal_toughness", 250.0));
    TRY(delam_law_set(s->law, "tangential_toughness", 250.0));
    return DELAM_OK;
}

/* Pairs left of the notch tip have no adhesion from the start. */
static int32_t make_notch(scene *s) {
    const double none = 0.0;
    int64_t i, j;
    for (j = 0; j <= across; ++j) {
        for (i = 0; i <= s->g.along; ++i) {
            const int64_t pair = number(&s->g, 0, i, j, 0);
            double x[3];
            place(&s->g, 0, i, j, 0, x);
            if (x[0] < notch - 1e-9) TRY(delam_problem_set_adhesion(s->problem, 0, 1, &pair, &none, 0));
        }
    }
    return DELAM_OK;
}

/* The right end is held, the outer edges of the left one are driven apart. */
static int32_t make_loads(scene *s) {
    const double times[2] = {0.0, 1.0};
    const double values[2] = {0.0, 1.6e-3};
    const double axes[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const double outwards[2][3] = {{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}};
    int64_t nodes[(upwards + 1) * (across + 1)];
    double coefficients[across + 1];
    int64_t arm, j, k, count;
    int axis;
    TRY(delam_problem_add_pattern(s->problem, "opening", 2, times, values, &s->opening));
    for (arm = 0; arm < 2; ++arm) {
        count = 0;
        for (k = 0; k <= upwards; ++k)
            for (j = 0; j <= across; ++j) nodes[count++] = number(&s->g, arm, s->g.along, j, k);
        for (axis = 0; axis < 3; ++axis)
            TRY(delam_problem_prescribe_nodes(s->problem, count, nodes, axes[axis], 0, NULL, NULL, 0));
        for (j = 0; j <= across; ++j) {
            nodes[j] = number(&s->g, arm, 0, j, upwards);
            coefficients[j] = 0.5;
        }
        TRY(delam_problem_prescribe_nodes(s->problem, across + 1, nodes, outwards[arm], 1, &s->opening, coefficients,
                                          0));
    }
    return DELAM_OK;
}

static int32_t make_scene(void *user) {
    scene *s = user;
    int32_t status = delam_context_create(&s->context);
    if (status == DELAM_OK) status = make_mesh(s);
    if (status == DELAM_OK) status = make_law(s);
    if (status != DELAM_OK) return status;
    TRY(delam_problem_create(s->context, s->mesh, &s->problem));
    TRY(delam_problem_set_law(s->problem, 0, s->law));
    TRY(delam_problem_set_number(s->problem, "damage_tolerance", 1e-10)); /* to compare hosts closely */
    status = make_notch(s);
    return status == DELAM_OK ? make_loads(s) : status;
}

static int32_t write_row(scene *s, int step) {
    static const char *const keys[4] = {"load:opening", "reaction:opening", "dissipated", "debonded_length"};
    double values[4];
    int i;
    for (i = 0; i < 4; ++i) TRY(delam_solver_value(s->solver, keys[i], &values[i]));
    /* In space libdelam counts the debonded area. */
    printf("%4d %16.9e %16.9e %16.9e %16.9e\n", step, values[0], values[1], values[2], values[3] / width);
    return DELAM_OK;
}

/* The task of each rank: the largest displacement of the nodes that only the ranks know, for rank 0. */
static int32_t find_largest(int64_t size, const uint8_t *bytes, void *user) {
    scene *s = user;
    int64_t count = 0, i;
    int64_t *nodes = NULL;
    double *u = NULL;
    double largest = 0.0;
    int32_t status = delam_petsc_part_nodes(s->petsc, 0, NULL, NULL, &count);
    (void)size;
    (void)bytes;
    if (status == DELAM_OK && count > 0) {
        nodes = malloc((size_t)count * sizeof *nodes);
        u = malloc(3 * (size_t)count * sizeof *u);
        status = nodes == NULL || u == NULL ? DELAM_ERROR_MEMORY
                                            : delam_petsc_part_nodes(s->petsc, count, nodes, NULL, NULL);
        if (status == DELAM_OK) status = delam_petsc_part_field(s->petsc, "displacement", 3 * count, u, NULL, NULL);
        for (i = 0; i < count && status == DELAM_OK; ++i) {
            const double length2 = u[3 * i] * u[3 * i] + u[3 * i + 1] * u[3 * i + 1] + u[3 * i + 2] * u[3 * i + 2];
            if (nodes[i] >= other_nodes(&s->g) && length2 > largest * largest) largest = sqrt(length2);
        }
        free(nodes);
        free(u);
    }
    MPI_Reduce(&largest, &s->largest, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD); /* all ranks come here */
    return status;
}

static int32_t tell_displacement(scene *s) {
    int32_t status = delam_petsc_recover(s->petsc, s->solver);
    if (status == DELAM_OK) status = delam_petsc_everywhere(s->petsc, 0, NULL);
    if (status != DELAM_OK) {
        fprintf(stderr, "host_petsc: displacement: %s\n", delam_petsc_message(s->petsc));
        return status;
    }
    printf("largest displacement of nodes that only the ranks know: %.9e m\n", s->largest);
    return DELAM_OK;
}

static int32_t march(void *user) {
    scene *s = user;
    int step;
    TRY(delam_problem_check(s->problem));
    TRY(delam_solver_create(s->problem, 0.0, &s->solver));
    printf("step          load/m       reaction/N     dissipated/J       debonded/m\n");
    for (step = 1; step <= steps; ++step) {
        int32_t status;
        TRY(delam_solver_advance(s->solver, (double)step / steps));
        TRY(delam_solver_commit(s->solver));
        status = write_row(s, step);
        if (status != DELAM_OK) return status;
    }
    return tell_displacement(s);
}

/* ---- all ranks -------------------------------------------------------------------------------------------------- */

/* Tells on rank 0 what has failed; all ranks have the same status. */
static int failed(const delam_petsc *petsc, int rank, int32_t status, const char *what) {
    if (status != DELAM_OK && rank == 0)
        fprintf(stderr, "host_petsc: %s: %s: %s\n", what, delam_status_name(status), delam_petsc_message(petsc));
    return status != DELAM_OK;
}

static int work(delam_petsc *petsc, int rank, scene *s, part *p) {
    int lacks = make_part(&s->g, p);
    MPI_Allreduce(MPI_IN_PLACE, &lacks, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    if (failed(petsc, rank, lacks ? DELAM_ERROR_MEMORY : DELAM_OK, "assembly")) return 1;
    if (failed(petsc, rank,
               delam_petsc_set_part(petsc, 3, p->node_count, p->nodes, p->coordinates, p->row_starts, p->columns,
                                    p->values),
               "part"))
        return 1;
    if (failed(petsc, rank, delam_petsc_run(petsc, make_scene, s), "scene")) return 1;
    if (failed(petsc, rank, delam_petsc_attach(petsc, s->problem), "engine")) return 1;
    if (failed(petsc, rank, delam_petsc_set_task(petsc, find_largest, s), "task")) return 1;
    return failed(petsc, rank, delam_petsc_run(petsc, march, s), "march");
}

int main(int argc, char **argv) {
    scene s = {{30, 0, 0}, NULL, NULL, NULL, NULL, NULL, 0, NULL, 0.0};
    part p = {0, NULL, NULL, NULL, NULL, NULL};
    delam_petsc *petsc = NULL;
    int rank, ranks, result;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    if (argc > 1) s.g.along = strtol(argv[1], NULL, 10);
    if (s.g.along < 3 || s.g.along > 100000) {
        if (rank == 0) fprintf(stderr, "usage: host_petsc [CELLS]     3 to 100000 cells along the beam\n");
        MPI_Finalize();
        return 2;
    }
    s.g.first = s.g.along * rank / ranks;
    s.g.last = s.g.along * (rank + 1) / ranks;
    result = failed(petsc, rank, delam_petsc_create(MPI_COMM_WORLD, &petsc), "PETSc");
    s.petsc = petsc;
    if (result == 0) result = work(petsc, rank, &s, &p);
    delam_solver_destroy(&s.solver);
    delam_problem_destroy(&s.problem);
    delam_law_destroy(&s.law);
    delam_mesh_destroy(&s.mesh);
    delam_context_destroy(&s.context);
    delam_petsc_destroy(&petsc);
    free_part(&p);
    MPI_Finalize();
    return result;
}
