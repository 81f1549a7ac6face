// SPDX-License-Identifier: BSD-3-Clause
// The functions of petsc.h. None of them lets an exception escape.
#include <new>
#include <string>

#include "delam/petsc.h"
#include "petsc/options.hpp"
#include "petsc/own_cells.hpp"
#include "petsc/rows.hpp"
#include "petsc/session.hpp"

static_assert(sizeof(PetscScalar) == sizeof(double),
              "libdelam-petsc needs a PETSc of real numbers, in double precision");

struct delam_petsc {
    explicit delam_petsc(MPI_Comm comm) : session(comm) {}
    delam::petsc::Session session;
};

namespace {

using delam::petsc::Session;

template <class Work>
int32_t call(delam_petsc* petsc, Work&& work) noexcept {
    if (petsc == nullptr) return DELAM_ERROR_HANDLE;
    try {
        Session& session = petsc->session;
        if (session.running()) return session.refuse("delam_petsc_run is running");
        return session.guard([&] {
            session.comm().in_step([&] { work(session); });
            return DELAM_OK;
        });
    } catch (...) {
        return DELAM_ERROR_MEMORY;
    }
}

}  // namespace

int32_t delam_petsc_create(MPI_Comm comm, delam_petsc** out) {
    if (out == nullptr) return DELAM_ERROR_ARGUMENT;
    *out = nullptr;
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (initialised == 0 || comm == MPI_COMM_NULL) return DELAM_ERROR_ARGUMENT;
    try {
        delam::petsc::start_petsc(comm);
        *out = new delam_petsc(comm);
        return DELAM_OK;
    } catch (...) {
        return delam::petsc::current_failure().status;
    }
}

int32_t delam_petsc_create_fortran(MPI_Fint comm, delam_petsc** out) {
    return delam_petsc_create(MPI_Comm_f2c(comm), out);
}

void delam_petsc_destroy(delam_petsc** petsc) {
    if (petsc == nullptr || *petsc == nullptr) return;
    if ((*petsc)->session.running()) return;  // the others still serve
    delete *petsc;
    *petsc = nullptr;
}

const char* delam_petsc_message(const delam_petsc* petsc) {
    return petsc == nullptr ? "the handle is NULL" : petsc->session.message().c_str();
}

int32_t delam_petsc_set_part(delam_petsc* petsc, int32_t dimension, int64_t node_count, const int64_t* nodes,
                             const double* coordinates, const int64_t* row_starts, const int64_t* columns,
                             const double* values) {
    return call(petsc, [&](Session& session) {
        delam::petsc::Part part;
        session.comm().together([&] {
            part = delam::petsc::make_part(dimension, node_count, nodes, coordinates, row_starts, columns, values);
        });
        session.set_part(std::move(part));
    });
}

int32_t delam_petsc_take_scene(delam_petsc* petsc, const delam_mesh* mesh, const delam_problem* problem) {
    return call(petsc, [&](Session& session) { session.take_scene(mesh, problem); });
}

int32_t delam_petsc_take_cells(delam_petsc* petsc, const delam_mesh* mesh, const delam_problem* problem,
                               int64_t cell_count, const int32_t* ranks) {
    return call(petsc, [&](Session& session) {
        const delam::petsc::GivenRanks given{cell_count, ranks};
        session.take_scene(mesh, problem, &given);
    });
}

int32_t delam_petsc_set_rows(delam_petsc* petsc, int32_t dimension, int64_t node_count, const int64_t* nodes,
                             const double* coordinates, const int64_t* row_starts, const int64_t* columns,
                             const double* values) {
    return call(petsc, [&](Session& session) {
        session.set_part(delam::petsc::make_rows(session.comm(), dimension, node_count, nodes, coordinates, row_starts,
                                                 columns, values));
    });
}

int32_t delam_petsc_set_cells(delam_petsc* petsc, const delam_mesh* mesh, const delam_problem* problem,
                              int64_t node_count, const int64_t* nodes) {
    return call(petsc, [&](Session& session) {
        session.set_part(delam::petsc::make_own_cells(session.comm(), mesh, problem, node_count, nodes));
    });
}

int32_t delam_petsc_attach(delam_petsc* petsc, delam_problem* problem) {
    return call(petsc, [&](Session& session) { session.attach(problem); });
}

int32_t delam_petsc_run(delam_petsc* petsc, int32_t (*work)(void* user), void* user) {
    if (petsc == nullptr) return DELAM_ERROR_HANDLE;
    try {
        if (petsc->session.running()) return petsc->session.refuse("delam_petsc_run is running");
        const bool lacks = petsc->session.comm().root() && work == nullptr;
        const int32_t status = call(petsc, [&](Session&) {
            if (lacks) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "work is NULL on rank 0");
        });
        return status != DELAM_OK ? status : petsc->session.run(work, user);
    } catch (...) {
        return DELAM_ERROR_MEMORY;
    }
}

int32_t delam_petsc_value(delam_petsc* petsc, const char* key, double* value) {
    return call(petsc, [&](Session& session) {
        session.comm().together([&] {
            if (key == nullptr || value == nullptr) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "key or value is NULL");
        });
        *value = session.value(key);
    });
}
