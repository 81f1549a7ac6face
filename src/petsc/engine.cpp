// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/numbers.hpp"

namespace delam::petsc {

namespace {

Operator::Entries copy(const delam_experimental_entries* entries) {
    Operator::Entries result;
    if (entries == nullptr) return result;
    result.rows.assign(entries->rows, entries->rows + entries->count);
    result.columns.assign(entries->columns, entries->columns + entries->count);
    result.values.assign(entries->values, entries->values + entries->count);
    return result;
}

void give(const std::vector<double>& values, double* out) { std::copy(values.begin(), values.end(), out); }

}  // namespace

Engine::Engine(const Communicator& comm, const Part& part, const delam_experimental_variables* variables,
               Counts& counts)
    : comm_(comm),
      counts_(counts),
      scene_(share_variables(comm, variables)),
      bodies_(comm, part, scene_),
      visible_(bodies_, scene_.visible),
      constraints_(bodies_, visible_),
      operator_(bodies_, visible_, constraints_),
      preconditioner_(bodies_, visible_, constraints_, scene_),
      solve_(bodies_, visible_, constraints_, operator_, preconditioner_),
      kept_(bodies_) {}

void Engine::sizes(double* diagonal, double* load_sizes) const {
    const std::vector<double> values = visible_.read(bodies_.diagonal());
    if (comm_.root()) give(values, diagonal);
    for (std::size_t p = 0; p < bodies_.patterns(); ++p) {
        PetscReal size = 0.0;
        check(VecNorm(bodies_.load(p), NORM_INFINITY, &size));
        if (comm_.root()) load_sizes[p] = size;
    }
}

void Engine::set(const delam_experimental_entries* couplings, std::int64_t fixed_count, const std::int64_t* fixed,
                 std::int64_t pivot_count, const std::int64_t* pivots, const delam_experimental_entries* masters) {
    Operator::Entries entries, expressed;
    std::vector<std::int64_t> zero;
    Constraints::Expressed by;
    comm_.together([&] {
        entries = copy(couplings);
        expressed = copy(masters);
        if (!comm_.root()) return;
        zero.assign(fixed, fixed + fixed_count);
        by.pivots.assign(pivots, pivots + pivot_count);
        by.rows = std::move(expressed.rows);
        by.columns = std::move(expressed.columns);
        by.values = std::move(expressed.values);
    });
    pivot_count_ = pivot_count;
    constraints_.set(zero, by);
    operator_.set_couplings(entries);
}

void Engine::renew(const delam_experimental_entries* entries, double* cost) {
    Operator::Entries copied;
    comm_.together([&] { copied = copy(entries); });
    const double worth = preconditioner_.renew(copied);
    solve_.forget_rounding();
    counts_.renewals += 1.0;
    if (comm_.root()) *cost = worth;
}

Question Engine::share(const delam_experimental_request* request) const {
    Question question;
    comm_.together([&] {
        if (!comm_.root()) return;
        const delam_experimental_request& r = *request;
        const auto count = static_cast<std::int64_t>(visible_.count());
        question.theta.assign(r.theta, r.theta + bodies_.patterns());
        question.force.assign(r.force, r.force + count);
        question.right.assign(r.right, r.right + pivot_count_);
        if (r.start != nullptr) question.start.assign(r.start, r.start + KeptStates::count);
        question.place = r.place;
        if (r.place < 0 || r.place >= static_cast<std::int64_t>(KeptStates::count))
            fail(DELAM_ERROR_ARGUMENT, "place ", r.place, " is not in [0, ", KeptStates::count, ")");
        question.tolerance = r.tolerance;
        question.limit = r.limit;
        question.enough = r.enough;
        question.poll = r.poll;
        question.user = r.user;
    });
    comm_.broadcast(question.theta);
    comm_.broadcast(question.start);
    comm_.broadcast(question.place);
    return question;
}

bool Engine::solve(const delam_experimental_request* request, delam_experimental_answer* out) {
    const Question question = share(request);
    const Result result = solve_.run(question, kept_);
    counts_.solves += 1.0;
    counts_.iterations += static_cast<double>(result.iterations);
    if (result.cancelled) return false;
    if (out != nullptr) {
        out->first = result.first;
        out->norm = result.norm;
        out->size = result.size;
        out->least = result.least;
        out->iterations = result.iterations;
        out->converged = result.converged ? 1 : 0;
        out->definite = result.definite ? 1 : 0;
    }
    if (result.definite)
        answer(question, out);
    else
        kept_.forget(index(question.place));
    return true;
}

void Engine::answer(const Question& question, delam_experimental_answer* out) {
    const Vec v = solve_.answer();
    const OwnedVec forces = bodies_.vector(), work = bodies_.vector();
    const BodyState state = bodies_.state(question.theta, v);
    const std::vector<double> values = visible_.read(v);
    bodies_.forces(state, forces);
    check(VecAXPBY(work, -1.0, 0.0, forces));
    bodies_.add_nodal_forces(question.theta, work);
    const std::vector<double> balance = visible_.read(work);
    const std::vector<double> correction = visible_.read(solve_.correction());
    operator_.apply_bodies(solve_.correction(), work);
    const std::vector<double> correction_balance = visible_.read(work);
    kept_.keep(index(question.place), v, question.theta);
    const std::vector<double> products = kept_.products(forces, state.lifted);
    const double rounding = relative_rounding(state, v, work);
    comm_.together([&] {
        if (!std::isfinite(state.stored)) fail(DELAM_ERROR_NUMERICAL, "the energy of the bodies is not finite");
    });
    if (out == nullptr) return;
    give(values, out->values);
    give(balance, out->balance);
    give(correction, out->correction);
    give(correction_balance, out->correction_balance);
    give(products, out->products);
    give(state.work, out->work);
    give(state.lifted, out->lifted);
    out->rounding = rounding;
}

// Returns the rounding of u.K u, a sum of d_i v_i^2 that cancel.
double Engine::relative_rounding(const BodyState& state, Vec v, Vec work) const {
    PetscReal terms = 0.0;
    check(VecPointwiseMult(work, v, v));
    check(VecPointwiseMult(work, work, bodies_.diagonal()));
    check(VecNorm(work, NORM_2, &terms));
    return state.stored > 0.0 ? std::numeric_limits<double>::epsilon() * terms / state.stored : 0.0;
}

Recovered Engine::recover(const double* weights, double* displacement, double* force,
                          const PartState::Eigenstrains& eigenstrains, PartState& kept) {
    std::vector<double> shared;
    bool keeps = force == nullptr, moves = keeps && displacement != nullptr;
    comm_.together([&] {
        if (comm_.root()) shared.assign(weights, weights + KeptStates::count);
    });
    comm_.broadcast(shared);
    comm_.broadcast(keeps);
    comm_.broadcast(moves);
    if (moves && has_other_nodes()) return Recovered::nothing;
    const OwnedVec v = bodies_.vector();
    const std::vector<double> theta = kept_.combine(shared, v);
    BodyState state = bodies_.state(theta, v);
    if (!keeps) {
        if (fields_ == nullptr) fields_ = std::make_unique<MeshFields>(bodies_, scene_.dofs);
        fields_->gather(state, displacement, force);
        return Recovered::on_root;
    }
    if (moves) {
        const std::vector<double> moved = here(displacement);
        for (std::size_t i = 0; i < moved.size(); ++i) state.displacement[i] += moved[i];
    }
    PartState::Eigenstrains at_state;
    comm_.together([&] { at_state = eigenstrains; });
    comm_.broadcast(at_state.known);
    comm_.broadcast(at_state.bodies);
    comm_.broadcast(at_state.strains);
    kept.take(bodies_, std::move(state), std::move(at_state));
    return Recovered::on_ranks;
}

bool Engine::has_other_nodes() const {
    const std::vector<std::int64_t>& nodes = bodies_.part().nodes;
    const std::int64_t of_mesh = scene_.dofs / bodies_.local().dimension;
    const bool has = std::any_of(nodes.begin(), nodes.end(), [&](std::int64_t node) { return node >= of_mesh; });
    return comm_.largest(std::int64_t{has ? 1 : 0}) != 0;
}

// Returns the rows of this rank's nodes of rank 0's field over the mesh.
std::vector<double> Engine::here(const double* field) const {
    const LocalVariables& local = bodies_.local();
    std::vector<std::vector<std::int64_t>> asked;
    std::vector<std::vector<double>> told;
    comm_.together([&] {
        asked.resize(index(comm_.size()));
        told.resize(asked.size());
        asked[0].assign(local.nodes.begin(), local.nodes.begin() + local.dofs / local.dimension);
    });
    const std::vector<std::vector<std::int64_t>> wanted = comm_.exchange(asked);
    comm_.together([&] {
        for (std::size_t r = 0; r < wanted.size(); ++r)
            for (const std::int64_t node : wanted[r])
                told[r].insert(told[r].end(), field + local.dimension * node, field + local.dimension * (node + 1));
    });
    return comm_.exchange(told)[0];
}

}  // namespace delam::petsc
