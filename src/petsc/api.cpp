// SPDX-License-Identifier: BSD-3-Clause
// The functions of petsc.h. None of them lets an exception escape.
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <new>
#include <string>
#include <vector>

#include "delam/petsc.h"
#include "petsc/base/options.hpp"
#include "petsc/callbacks.hpp"
#include "petsc/part/own_cells.hpp"
#include "petsc/part/rows.hpp"
#include "petsc/session.hpp"

static_assert(sizeof(PetscScalar) == sizeof(double),
              "libdelam-petsc needs a PETSc of real numbers, in double precision");

namespace {

constexpr std::uint64_t magic = 0x64656c616d707473;

}  // namespace

// The number at its start identifies handles of another kind and destroyed ones, as long as the memory has not been
// reused.
struct delam_petsc {
    explicit delam_petsc(MPI_Comm comm) : session(comm) {}
    std::uint64_t kind = magic;
    delam::petsc::Session session;
};

namespace {

using delam::petsc::Session;

bool alive(const delam_petsc* petsc) { return petsc != nullptr && petsc->kind == magic; }

// True if MPI can be called. PETSc can be called then, too, because it ends with MPI.
bool mpi_runs() {
    int begun = 0, ended = 0;
    MPI_Initialized(&begun);
    MPI_Finalized(&ended);
    return begun != 0 && ended == 0;
}

// Returns the status that a function may return in the place of one that its line in brackets does not list; every
// function may return three of them. listed: in the order of the line. The test abi/petsc_contract compares it with the
// header.
using Listed = std::initializer_list<int32_t>;
int32_t in_place_of(int32_t status, Listed listed) {
    for (const int32_t understood : {DELAM_OK, DELAM_ERROR_HANDLE, DELAM_ERROR_MEMORY})
        if (status == understood) return status;
    return std::find(listed.begin(), listed.end(), status) != listed.end() ? status : DELAM_ERROR_INTERNAL;
}

template <class Work>
int32_t call(delam_petsc* petsc, Listed listed, Work&& work) noexcept {
    if (!alive(petsc)) return DELAM_ERROR_HANDLE;
    try {
        Session& session = petsc->session;
        if (!mpi_runs()) return session.refuse("MPI has been finalised");
        if (session.running()) return session.refuse("delam_petsc_run is running");
        const int32_t status = session.guard([&] {
            session.comm().in_step([&] { work(session); });
            return DELAM_OK;
        });
        return in_place_of(status, listed);
    } catch (...) {
        return DELAM_ERROR_MEMORY;
    }
}

// A call of one rank alone. Statuses of the host's task pass.
template <class Work>
int32_t here(delam_petsc* petsc, Work&& work) noexcept {
    if (!alive(petsc)) return DELAM_ERROR_HANDLE;
    try {
        int32_t status = DELAM_OK;
        const int32_t own = petsc->session.guard_here([&] { status = work(petsc->session); });
        return own != DELAM_OK ? own : status;
    } catch (...) {
        return DELAM_ERROR_MEMORY;
    }
}
template <class Work>
int32_t here(delam_petsc* petsc, Listed listed, Work&& work) noexcept {
    return in_place_of(here(petsc, work), listed);
}

void require_room(bool wanted, int64_t capacity, int64_t needed, const char* what) {
    if (capacity < 0) delam::petsc::fail(DELAM_ERROR_ARGUMENT, what, ": capacity = ", capacity, ", has to be >= 0");
    if (wanted && capacity < needed)
        delam::petsc::fail(DELAM_ERROR_ARGUMENT, what, ": capacity ", capacity, ", but there are ", needed);
}

}  // namespace

int32_t delam_petsc_create(MPI_Comm comm, delam_petsc** out) {
    if (out == nullptr) return DELAM_ERROR_ARGUMENT;
    *out = nullptr;
    // Some MPI have a null pointer or a zero for a communicator that does not exist.
    if (!mpi_runs() || comm == MPI_COMM_NULL || comm == MPI_Comm{}) return DELAM_ERROR_ARGUMENT;
    int two_groups = 0;
    MPI_Comm_test_inter(comm, &two_groups);
    if (two_groups != 0) return DELAM_ERROR_ARGUMENT;
    try {
        delam::petsc::start_petsc(comm);
        *out = new delam_petsc(comm);
        return DELAM_OK;
    } catch (...) {
        return in_place_of(delam::petsc::current_failure().status, {DELAM_ERROR_ARGUMENT});
    }
}

int32_t delam_petsc_create_fortran(MPI_Fint comm, delam_petsc** out) {
    if (out == nullptr) return DELAM_ERROR_ARGUMENT;
    *out = nullptr;
    if (!mpi_runs()) return DELAM_ERROR_ARGUMENT;  // MPI_Comm_f2c would end the process
    return delam_petsc_create(MPI_Comm_f2c(comm), out);
}

void delam_petsc_destroy(delam_petsc** petsc) {
    if (petsc == nullptr || *petsc == nullptr) return;
    if (alive(*petsc)) {
        if ((*petsc)->session.running()) return;  // the others still serve
        (*petsc)->kind = 0;
        if (mpi_runs()) delete *petsc;  // else the objects of PETSc and MPI are gone, and cannot be freed any more
    }
    *petsc = nullptr;
}

const char* delam_petsc_message(const delam_petsc* petsc) {
    if (!alive(petsc)) return "the handle is NULL, foreign or destroyed";
    return petsc->session.message().c_str();
}

int32_t delam_petsc_set_part(delam_petsc* petsc, int32_t dimension, int64_t node_count, const int64_t* nodes,
                             const double* coordinates, const int64_t* row_starts, const int64_t* columns,
                             const double* values) {
    return call(petsc, {DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE}, [&](Session& session) {
        delam::petsc::Part part;
        session.comm().together([&] {
            part = delam::petsc::make_part(dimension, node_count, nodes, coordinates, row_starts, columns, values);
        });
        session.set_part(std::move(part));
    });
}

int32_t delam_petsc_take_scene(delam_petsc* petsc, const delam_mesh* mesh, const delam_problem* problem) {
    return call(petsc,
                {DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM, DELAM_ERROR_NUMERICAL, DELAM_ERROR_STATE},
                [&](Session& session) { session.take_scene(mesh, problem); });
}

int32_t delam_petsc_take_cells(delam_petsc* petsc, const delam_mesh* mesh, const delam_problem* problem,
                               int64_t cell_count, const int32_t* ranks) {
    return call(petsc, {DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM, DELAM_ERROR_STATE},
                [&](Session& session) {
                    const delam::petsc::GivenRanks given{cell_count, ranks};
                    session.take_scene(mesh, problem, &given);
                });
}

int32_t delam_petsc_set_rows(delam_petsc* petsc, int32_t dimension, int64_t node_count, const int64_t* nodes,
                             const double* coordinates, const int64_t* row_starts, const int64_t* columns,
                             const double* values) {
    return call(petsc, {DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE}, [&](Session& session) {
        session.set_part(delam::petsc::make_rows(session.comm(), dimension, node_count, nodes, coordinates, row_starts,
                                                 columns, values));
    });
}

int32_t delam_petsc_set_cells(delam_petsc* petsc, const delam_mesh* mesh, const delam_problem* problem,
                              int64_t node_count, const int64_t* nodes) {
    return call(petsc, {DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM, DELAM_ERROR_STATE},
                [&](Session& session) {
                    session.set_part(delam::petsc::make_own_cells(session.comm(), mesh, problem, node_count, nodes));
                });
}

int32_t delam_petsc_attach(delam_petsc* petsc, delam_problem* problem) {
    return call(petsc, {DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE},
                [&](Session& session) { session.attach(problem, delam::petsc::make_callbacks); });
}

int32_t delam_petsc_run(delam_petsc* petsc, int32_t (*work)(void* user), void* user) {
    if (!alive(petsc)) return DELAM_ERROR_HANDLE;
    try {
        if (!mpi_runs()) return petsc->session.refuse("MPI has been finalised");
        if (petsc->session.running()) return petsc->session.refuse("delam_petsc_run is running");
        const bool lacks = petsc->session.comm().root() && work == nullptr;
        const int32_t status = call(petsc, {DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE}, [&](Session&) {
            if (lacks) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "work is NULL on rank 0");
        });
        return status != DELAM_OK ? status : petsc->session.run(work, user);
    } catch (...) {
        return DELAM_ERROR_MEMORY;
    }
}

int32_t delam_petsc_set_task(delam_petsc* petsc, int32_t (*task)(int64_t size, const uint8_t* bytes, void* user),
                             void* user) {
    return call(petsc, {DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE},
                [&](Session& session) { session.set_task(task, user); });
}

int32_t delam_petsc_everywhere(delam_petsc* petsc, int64_t size, const uint8_t* bytes) {
    return here(petsc, [&](Session& session) {
        if (size < 0) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "size = ", size, ": has to be at least 0");
        if (size > 0 && bytes == nullptr) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "bytes: NULL with size ", size);
        return session.everywhere(size, bytes);
    });
}

int32_t delam_petsc_explain(delam_petsc* petsc, const char* text) {
    return here(petsc, {DELAM_ERROR_ARGUMENT}, [&](Session& session) {
        if (text == nullptr) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "text is NULL");
        session.task().explain(text);
        return DELAM_OK;
    });
}

int32_t delam_petsc_recover(delam_petsc* petsc, delam_solver* solver) {
    return here(petsc, {DELAM_CANCELLED, DELAM_ERROR_NUMERICAL, DELAM_ERROR_STATE},
                [&](Session& session) { return session.recover_parts(solver); });
}

int32_t delam_petsc_part_nodes(delam_petsc* petsc, int64_t capacity, int64_t* nodes, int32_t* owned, int64_t* count) {
    return here(petsc, {DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE}, [&](Session& session) {
        const delam::petsc::PartState& state = session.part().state();
        const auto needed = static_cast<int64_t>(state.nodes().size());
        require_room(nodes != nullptr || owned != nullptr, capacity, needed, "nodes, owned");
        if (nodes != nullptr) std::copy(state.nodes().begin(), state.nodes().end(), nodes);
        if (owned != nullptr) std::copy(state.owned().begin(), state.owned().end(), owned);
        if (count != nullptr) *count = needed;
        return DELAM_OK;
    });
}

int32_t delam_petsc_part_cells(delam_petsc* petsc, int64_t capacity, int64_t* cells, int64_t* count) {
    return here(petsc, {DELAM_ERROR_ARGUMENT}, [&](Session& session) {
        const std::vector<int64_t>& all = session.part().cells().cells;
        const auto needed = static_cast<int64_t>(all.size());
        require_room(cells != nullptr, capacity, needed, "cells");
        if (cells != nullptr) std::copy(all.begin(), all.end(), cells);
        if (count != nullptr) *count = needed;
        return DELAM_OK;
    });
}

int32_t delam_petsc_part_field(delam_petsc* petsc, const char* key, int64_t capacity, double* values, int64_t* rows,
                               int64_t* columns) {
    return here(petsc, {DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE}, [&](Session& session) {
        if (key == nullptr) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "key is NULL");
        const delam::petsc::PartState::Field field = session.part().field(key);
        require_room(values != nullptr, capacity, field.rows * field.columns, "values");
        if (values != nullptr) std::copy(field.values->begin(), field.values->end(), values);
        if (rows != nullptr) *rows = field.rows;
        if (columns != nullptr) *columns = field.columns;
        return DELAM_OK;
    });
}

int32_t delam_petsc_value(delam_petsc* petsc, const char* key, double* value) {
    return call(petsc, {DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE}, [&](Session& session) {
        session.comm().together([&] {
            if (key == nullptr) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "key is NULL");
            if (value == nullptr) delam::petsc::fail(DELAM_ERROR_ARGUMENT, "value is NULL");
        });
        *value = session.value(key);
    });
}
