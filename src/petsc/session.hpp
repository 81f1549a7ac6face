// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "delam/petsc.h"
#include "petsc/counters.hpp"
#include "petsc/engine.hpp"
#include "petsc/host_task.hpp"
#include "petsc/partition.hpp"
#include "petsc/rank_part.hpp"

namespace delam::petsc {

class Session;

// Argument of an engine's callbacks. The problem may outlive the handle.
struct Link {
    Session* session = nullptr;
};

// A handle: the ranks, their parts, and the engine that rank 0 leads. In `run`, rank 0 does the work; each callback of
// the engine sends a command to the other ranks, which wait for commands until the work is done.
class Session {
public:
    explicit Session(MPI_Comm comm) : comm_(comm), counters_(comm_) {}
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const Communicator& comm() const { return comm_; }
    const std::string& message() const { return message_; }

    // Runs work on all ranks and turns what it throws into a status, the same everywhere.
    template <class Work>
    std::int32_t guard(Work&& work) {
        const ErrorRecord record;
        try {
            std::int32_t status = DELAM_OK;
            comm_.together([&] { status = work(); });
            return status;
        } catch (...) {
            return failed();
        }
    }

    void set_part(Part part, PartCells cells = {});
    void take_scene(const delam_mesh* mesh, const delam_problem* problem, const GivenRanks* given = nullptr);
    void attach(delam_problem* problem, delam_experimental_engine (*callbacks)(Link* link));
    void set_task(HostTask::Function task, void* user);
    std::int32_t run(std::int32_t (*work)(void* user), void* user);
    // Rank 0 alone calls these, in its work.
    std::int32_t everywhere(std::int64_t size, const std::uint8_t* bytes);
    std::int32_t recover_parts(delam_solver* solver);
    double value(const char* key) const;
    bool running() const { return running_; }
    HostTask& task() { return task_; }
    RankPart& part() { return part_; }
    // Runs work of this rank alone and turns what it throws into a status.
    template <class Work>
    std::int32_t guard_here(Work&& work) {
        try {
            work();
            return DELAM_OK;
        } catch (...) {
            return failed();
        }
    }

    // The engine's commands: rank 0 calls them with its pointers, the others with NULL.
    std::int32_t prepare(const delam_experimental_variables* variables, double* diagonal, double* load_sizes);
    std::int32_t set(const delam_experimental_entries* couplings, std::int64_t fixed_count, const std::int64_t* fixed,
                     std::int64_t pivot_count, const std::int64_t* pivots, const delam_experimental_entries* masters);
    std::int32_t renew(const delam_experimental_entries* entries, double* cost);
    std::int32_t solve(const delam_experimental_request* request, delam_experimental_answer* answer);
    std::int32_t recover(const double* weights, double* displacement, double* force);
    std::int32_t refuse(const char* why);

private:
    enum class Command : std::int32_t { stop, prepare, set, renew, solve, recover, task };

    std::int32_t failed();
    // Rank 0 tells the others what to do, and does it with them.
    template <class Work>
    std::int32_t command(Command which, Work&& work) {
        if (comm_.root()) {
            if (!running_) return refuse("the engine works only inside delam_petsc_run");
            if (task_.running())
                return refuse("a task (delam_petsc_set_task) is running: the ranks can do nothing else");
            comm_.broadcast(which);
        }
        return guard([&] {
            comm_.in_step(work);
            return DELAM_OK;
        });
    }
    void serve();
    Engine& engine() const;
    std::int32_t run_task(std::int64_t size, const std::uint8_t* bytes);

    Communicator comm_;
    std::string message_;
    RankPart part_;
    bool kept_ = false;                     // the last command `recover` left the fields with the ranks
    PartState::Eigenstrains eigenstrains_;  // on rank 0, of the state that it has the ranks recover
    HostTask task_;
    bool running_ = false;
    Engine::Counts counts_;
    Counters counters_;
    std::unique_ptr<Engine> engine_;
    std::vector<Link*> links_;  // freed by the engines' release

    friend void forget_link(Link* link);
};

// Release of an engine.
void forget_link(Link* link);

}  // namespace delam::petsc
