/* SPDX-License-Identifier: BSD-3-Clause */
/* The shortest host of delam/petsc.h: two strips, glued, pulled apart in one step by all ranks. It is C and C++. */
#include <delam/petsc.h>
#include <stdio.h>

#define TRY(call) status = status != DELAM_OK ? status : (call)

struct host {
    delam_problem *problem;
    double reaction;
};

/* Rank 0 alone. */
static int32_t analysis(void *user) {
    struct host *host = (struct host *)user;
    delam_solver *solver = NULL;
    int32_t status = delam_solver_create(host->problem, 0, &solver);
    TRY(delam_solver_advance(solver, 1));
    TRY(delam_solver_commit(solver));
    TRY(delam_solver_value(solver, "reaction:open", &host->reaction));
    delam_solver_destroy(&solver);
    return status;
}

/* Of rank 0: 2 x 1 cells of 1 in each strip; the left corners move apart by 0.002, the right ones stay. */
static int32_t scene(delam_context *context, delam_mesh **mesh, delam_problem **problem) {
    const double length = 2, thickness[] = {1, 1}, x[] = {1, 0}, y[] = {0, 1}, half[] = {-0.001, 0.001};
    const double time[] = {0, 1};
    const int64_t cells = 2, layers[] = {1, 1}, left[] = {0, 9}, right[] = {2, 11};
    int64_t glue = 0, open = 0;
    delam_law *law = NULL;
    int32_t status = delam_mesh_create_layers(context, 2, &length, &cells, 2, thickness, layers, DELAM_QUAD4, mesh);
    TRY(delam_mesh_add_interface(*mesh, 0, 1, 0, &glue));
    TRY(delam_law_create(context, "piecewise-linear", &law));
    TRY(delam_law_set(law, "normal_stiffness", 10));
    TRY(delam_law_set(law, "tangential_stiffness", 10));
    TRY(delam_law_set(law, "normal_onset", 1));
    TRY(delam_law_set(law, "tangential_onset", 1));
    TRY(delam_law_set(law, "normal_toughness", 10));
    TRY(delam_law_set(law, "tangential_toughness", 10));
    TRY(delam_problem_create(context, *mesh, problem));
    TRY(delam_problem_set_elastic(*problem, -1, 1e3, 0.3));
    TRY(delam_problem_set_law(*problem, glue, law));
    TRY(delam_problem_add_pattern(*problem, "open", 2, time, time, &open));
    TRY(delam_problem_prescribe_nodes(*problem, 2, left, y, 1, &open, half, 0));
    TRY(delam_problem_prescribe_nodes(*problem, 2, right, x, 0, NULL, NULL, 0));
    TRY(delam_problem_prescribe_nodes(*problem, 2, right, y, 0, NULL, NULL, 0));
    delam_law_destroy(&law);
    return status;
}

int main(int argc, char **argv) {
    int rank = 0, size = 0;
    int32_t status = DELAM_OK;
    double solves = 0;
    struct host host = {NULL, 0};
    delam_context *context = NULL;
    delam_mesh *mesh = NULL;
    delam_petsc *petsc = NULL;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (rank == 0) {
        status = delam_context_create(&context);
        TRY(scene(context, &mesh, &host.problem));
        if (status != DELAM_OK) {
            puts(delam_context_message(context));
            MPI_Abort(MPI_COMM_WORLD, 1);
        }
    }
    TRY(delam_petsc_create(MPI_COMM_WORLD, &petsc));
    TRY(delam_petsc_take_scene(petsc, mesh, host.problem));
    TRY(delam_petsc_attach(petsc, host.problem));
    TRY(delam_petsc_run(petsc, analysis, &host));
    TRY(delam_petsc_value(petsc, "solves", &solves));
    if (rank == 0 && status != DELAM_OK) printf("%s: %s\n", delam_status_name(status), delam_petsc_message(petsc));
    if (rank == 0 && status == DELAM_OK) printf("%d ranks: reaction %.9g, solves %g\n", size, host.reaction, solves);
    delam_petsc_destroy(&petsc);
    delam_problem_destroy(&host.problem);
    delam_mesh_destroy(&mesh);
    delam_context_destroy(&context);
    MPI_Finalize();
    return status != DELAM_OK || (rank == 0 && solves < 1);
}
