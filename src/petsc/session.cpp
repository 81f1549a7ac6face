// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/session.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"

namespace delam::petsc {

Session::~Session() {
    for (Link* link : links_) link->session = nullptr;
}

void forget_link(Link* link) {
    if (link->session != nullptr) std::erase(link->session->links_, link);
    delete link;
}

std::int32_t Session::failed() {
    const Failure failure = current_failure();
    message_ = failure.what();
    return failure.status;
}

std::int32_t Session::refuse(const char* why) {
    message_ = why;
    return DELAM_ERROR_STATE;
}

void Session::set_part(Part part, PartCells cells) {
    require_same_dimension(comm_, part.dimension);
    engine_.reset();
    part_.set(std::move(part), std::move(cells));
}

void Session::take_scene(const delam_mesh* mesh, const delam_problem* problem, const GivenRanks* given) {
    comm_.together([&] {
        if (comm_.root() && (mesh == nullptr || problem == nullptr))
            fail(DELAM_ERROR_ARGUMENT, "mesh or problem is NULL on rank 0");
    });
    ReceivedPart received = receive_part(comm_, mesh, problem, given);
    set_part(std::move(received.part), std::move(received.cells));
}

void Session::attach(delam_problem* problem, delam_experimental_engine (*callbacks)(Link* link)) {
    comm_.together([&] {
        if (!comm_.root()) return;
        if (problem == nullptr) fail(DELAM_ERROR_ARGUMENT, "problem is NULL on rank 0");
        auto link = std::make_unique<Link>(Link{this});
        links_.push_back(link.get());
        const delam_experimental_engine engine = callbacks(link.release());
        const std::int32_t status = delam_experimental_problem_set_engine(problem, &engine);
        if (status == DELAM_OK) return;
        forget_link(links_.back());
        fail(status, "delam_experimental_problem_set_engine returned ", delam_status_name(status),
             " (delam_context_message on rank 0 says why)");
    });
}

void Session::set_task(HostTask::Function task, void* user) {
    comm_.together([&] {
        if (task == nullptr) fail(DELAM_ERROR_ARGUMENT, "task is NULL on rank ", comm_.rank());
    });
    task_.set(task, user);
}

std::int32_t Session::run(std::int32_t (*work)(void* user), void* user) {
    message_.clear();
    std::int32_t status = DELAM_OK;
    running_ = true;
    if (comm_.root()) {
        try {
            status = work(user);
        } catch (...) {
            status = failed();
        }
        Command stop = Command::stop;
        comm_.broadcast(stop);
    } else {
        serve();
    }
    running_ = false;
    comm_.broadcast(status);
    if (comm_.root() && status != DELAM_OK && message_.empty())
        message_ = std::string("the work on rank 0 returned ") + delam_status_name(status);
    comm_.broadcast(message_);
    return status;
}

// Failures are ignored here: the ranks have agreed on them, and rank 0 deals with them.
void Session::serve() {
    while (true) {
        Command next = Command::stop;
        comm_.broadcast(next);
        switch (next) {
            case Command::stop:
                return;
            case Command::prepare:
                prepare(nullptr, nullptr, nullptr);
                break;
            case Command::set:
                set(nullptr, 0, nullptr, 0, nullptr, nullptr);
                break;
            case Command::renew:
                renew(nullptr, nullptr);
                break;
            case Command::solve:
                solve(nullptr, nullptr);
                break;
            case Command::recover:
                recover(nullptr, nullptr, nullptr);
                break;
            case Command::task:
                run_task(0, nullptr);
                break;
        }
    }
}

Engine& Session::engine() const {
    if (engine_ == nullptr) fail(DELAM_ERROR_STATE, "the parts have changed: a solver made before is of no use now");
    return *engine_;
}

std::int32_t Session::prepare(const delam_experimental_variables* variables, double* diagonal, double* load_sizes) {
    return command(Command::prepare, [&] {
        comm_.together([&] {
            if (!part_.known())
                fail(DELAM_ERROR_STATE,
                     "there are no parts: delam_petsc_set_part, _set_rows, _set_cells, _take_scene or _take_cells "
                     "comes first");
            if (comm_.root() && variables->dimension != part_.part().dimension)
                fail(DELAM_ERROR_ARGUMENT, "the mesh has dimension ", variables->dimension, ", the parts ",
                     part_.part().dimension);
        });
        engine_.reset();
        engine_ = std::make_unique<Engine>(comm_, part_.part(), variables, counts_);
        engine_->sizes(diagonal, load_sizes);
    });
}

std::int32_t Session::set(const delam_experimental_entries* couplings, std::int64_t fixed_count,
                          const std::int64_t* fixed, std::int64_t pivot_count, const std::int64_t* pivots,
                          const delam_experimental_entries* masters) {
    return command(Command::set, [&] { engine().set(couplings, fixed_count, fixed, pivot_count, pivots, masters); });
}

std::int32_t Session::renew(const delam_experimental_entries* entries, double* cost) {
    return command(Command::renew, [&] { engine().renew(entries, cost); });
}

std::int32_t Session::solve(const delam_experimental_request* request, delam_experimental_answer* answer) {
    bool cancelled = false;
    const std::int32_t status = command(Command::solve, [&] { cancelled = !engine().solve(request, answer); });
    return status == DELAM_OK && cancelled ? DELAM_CANCELLED : status;
}

std::int32_t Session::recover(const double* weights, double* displacement, double* force) {
    Recovered done = Recovered::nothing;
    const std::int32_t status = command(Command::recover, [&] {
        done = engine().recover(weights, displacement, force, eigenstrains_, part_.recovered());
    });
    kept_ = status == DELAM_OK && done == Recovered::on_ranks;
    return status == DELAM_OK && done == Recovered::nothing ? DELAM_ERROR_PROBLEM : status;
}

// A solver of another engine, or of none, does not come here for its displacements.
std::int32_t Session::recover_parts(delam_solver* solver) {
    if (!comm_.root() || !running_) return refuse("only rank 0 may call this, in the work of delam_petsc_run");
    if (task_.running()) return refuse("a task (delam_petsc_set_task) is running: the ranks can do nothing else");
    kept_ = false;
    std::int64_t count = 0;
    PartState::Eigenstrains found;
    std::int32_t status = delam_experimental_solver_eigenstrains(solver, 0, nullptr, nullptr, &count);
    if (status == DELAM_OK) {
        found.bodies.resize(index(count));
        found.strains.resize(6 * found.bodies.size());
        found.known = true;
        status =
            delam_experimental_solver_eigenstrains(solver, count, found.bodies.data(), found.strains.data(), &count);
    }
    if (status == DELAM_OK) {
        eigenstrains_ = std::move(found);
        status = delam_experimental_solver_recover(solver);
        eigenstrains_ = {};
    }
    if (status == DELAM_OK && kept_) return DELAM_OK;
    if (status == DELAM_OK)
        return refuse(
            "the ranks are not the engine of the solver's problem: delam_petsc_attach comes before the solver");
    message_ = std::string("the state cannot be recovered: ") + delam_status_name(status) +
               " (delam_context_message says why)";
    return status;
}

std::int32_t Session::everywhere(std::int64_t size, const std::uint8_t* bytes) {
    if (!comm_.root() || !running_) return refuse("only rank 0 may call this, in the work of delam_petsc_run");
    if (!task_.known()) return refuse("there is no task: delam_petsc_set_task comes first");
    return run_task(size, bytes);
}

std::int32_t Session::run_task(std::int64_t size, const std::uint8_t* bytes) {
    return command(Command::task, [&] {
        std::vector<std::uint8_t> told;
        comm_.together([&] {
            if (comm_.root()) told.assign(bytes, bytes + size);
        });
        comm_.broadcast(told);
        comm_.in_task([&] { task_.call(told, comm_.rank()); });
    });
}

double Session::value(const char* key) const {
    return counters_.value(key, counts_, engine_ == nullptr ? nullptr : &engine_->preconditioner());
}

}  // namespace delam::petsc
