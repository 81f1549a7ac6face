// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/engine/engine_solver.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/sparse/engine/engine_variables.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

namespace {

// Arguments of the callbacks of a solve. An exception waits until the engine has returned.
struct Calls {
    const BodySolver::Forcing& forcing;
    Monitor& monitor;
    bool reading;  // only a request made during the call stops it
    std::int64_t iteration = 0;
    std::exception_ptr stopped{};
};

extern "C" double ask_enough(double first, void* user) {
    auto& calls = *static_cast<Calls*>(user);
    try {
        return calls.forcing(first);
    } catch (...) {
        calls.stopped = std::current_exception();
        return 0.0;
    }
}

extern "C" std::int32_t ask_to_stop(void* user) {
    auto& calls = *static_cast<Calls*>(user);
    try {
        if (calls.stopped) return 1;
        if (calls.reading)
            poll_cancel_now("linear solve");
        else
            calls.monitor.progress("linear solve", ++calls.iteration, 0);
    } catch (...) {
        calls.stopped = std::current_exception();
    }
    return calls.stopped ? 1 : 0;
}

// Entries as the engine takes them.
class Entries {
public:
    explicit Entries(const SparseMatrix& matrix) {
        for (std::int64_t r = 0; r < matrix.rows; ++r)
            for (std::int64_t e = matrix.start[index(r)]; e < matrix.start[index(r) + 1]; ++e)
                add(r, matrix.column[index(e)], matrix.value[index(e)]);
    }
    Entries() = default;
    void add(std::int64_t row, std::int64_t column, double value) {
        if (value == 0.0) return;
        rows_.push_back(row);
        columns_.push_back(column);
        values_.push_back(value);
    }
    delam_experimental_entries view() const {
        return {static_cast<std::int64_t>(rows_.size()), rows_.data(), columns_.data(), values_.data()};
    }

private:
    std::vector<std::int64_t> rows_, columns_;
    std::vector<double> values_;
};

}  // namespace

EngineSolver::EngineSolver(const BodySystem& bodies, std::shared_ptr<Engine> engine, Monitor& monitor)
    : bodies_(bodies),
      engine_(std::move(engine)),
      monitor_(monitor),
      system_(bodies),
      floating_(bodies, system_),
      products_(Engine::kept, Engine::kept),
      renewal_(bodies.problem().options.limits, infinite) {
    const std::size_t n = index(system_.count()), patterns = bodies.problem().patterns.size();
    at_.variables = 0;
    at_.balance = n;
    at_.done = 2 * n;
    at_.lifted = at_.done + patterns;
    at_.weights = at_.lifted + patterns;
    at_.rigid = at_.weights + index(Engine::kept);
    at_.size = at_.rigid + index(floating_.motions());
    for (std::size_t p = 0; p < patterns; ++p)
        for (std::size_t k = 0; k < patterns; ++k)
            lift_force_.push_back(bodies.force()[k].empty() ? 0.0 : dot(bodies.variables().lift[p], bodies.force()[k]));
    claim();
}

EngineSolver::~EngineSolver() {
    if (engine_->owner == this) engine_->owner = nullptr;
}

std::int64_t EngineSolver::state_size() const { return static_cast<std::int64_t>(at_.size); }

void EngineSolver::claim() {
    if (engine_->owner == this) return;
    engine_->owner = nullptr;
    poll_cancel_now("engine");
    const EngineVariables variables(bodies_);
    const delam_experimental_variables view = variables.view();
    std::vector<double> diagonal(index(system_.count()), 0.0);
    load_sizes_.assign(bodies_.problem().patterns.size(), 0.0);
    const delam_experimental_engine& engine = engine_->functions();
    engine_->require(engine.prepare(&view, diagonal.data(), load_sizes_.data(), engine.user), "prepare");
    for (std::size_t i = 0; i < diagonal.size(); ++i)
        if (!(diagonal[i] >= 0.0 && std::isfinite(diagonal[i])))
            fail(DELAM_ERROR_NUMERICAL, "engine: prepare: diagonal[", i, "] = ", diagonal[i], ", allowed: >= 0");
    system_.set_diagonal(std::move(diagonal));
    for (std::size_t p = 0; p < load_sizes_.size(); ++p)
        if (!(load_sizes_[p] >= 0.0 && std::isfinite(load_sizes_[p])))
            fail(DELAM_ERROR_NUMERICAL, "engine: prepare: load_sizes[", p, "] = ", load_sizes_[p], ", allowed: >= 0");
    kept_.assign(index(Engine::kept), {});
    products_ = DenseMatrix(Engine::kept, Engine::kept);
    applied_ = renewed_ = false;
    engine_->owner = this;
}

void EngineSolver::apply() {
    std::vector<Zone::Coupling> acting = system_.couplings();
    // Without a load they have no force: they only choose one of the states that differ by free motions.
    acting.insert(acting.end(), floating_.free_anchors().begin(), floating_.free_anchors().end());
    const std::vector<std::uint8_t> none(system_.rows().size(), 0);
    const Entries entries(from_triplets(system_.count(), system_.count(), spring_entries(system_, acting, none)));
    Entries masters;
    std::vector<std::int64_t> pivots;
    for (const ReducedSpace::Slave& slave : system_.space().slaves()) {
        for (const auto& [i, c] : slave.masters) masters.add(static_cast<std::int64_t>(pivots.size()), i, c);
        pivots.push_back(slave.pivot);
    }
    const std::vector<std::int64_t>& fixed = system_.space().removed();
    const delam_experimental_entries couplings = entries.view(), of_pivots = masters.view();
    const delam_experimental_engine& engine = engine_->functions();
    engine_->require(engine.set(&couplings, static_cast<std::int64_t>(fixed.size()), fixed.data(),
                                static_cast<std::int64_t>(pivots.size()), pivots.data(), &of_pivots, engine.user),
                     "set");
    applied_ = true;
}

void EngineSolver::renew() {
    monitor_.progress("factor", renewals_, 0);
    std::vector<Zone::Coupling> springs;
    for (std::size_t r = 0; r < lagged_.size(); ++r)
        if (lagged_[r] != 0.0)
            springs.push_back({static_cast<std::int64_t>(r), static_cast<std::int64_t>(r), lagged_[r]});
    std::vector<Triplet> added = spring_entries(system_, springs, std::vector<std::uint8_t>(lagged_.size(), 0));
    const double largest = max_abs(system_.diagonal());
    for (const SparseVector& row : system_.rows().equations())
        for (const auto& [i, c] : row) {
            const double d = system_.diagonal()[index(i)];
            added.push_back({i, i, constraint_shift * (d > 0.0 ? d : largest)});
        }
    const Entries entries(from_triplets(system_.count(), system_.count(), std::move(added)));
    const delam_experimental_entries view = entries.view();
    const delam_experimental_engine& engine = engine_->functions();
    ++renewals_;
    engine_->require(engine.renew(&view, &cost_, engine.user), "renew");
    cost_ = cost_ >= 1.0 ? std::min(cost_, renewal_.limits().engine_highest_cost) : 1.0;
    renewed_ = true;
}

void EngineSolver::renew_now() {
    std::vector<double> springs = springs_of(system_);
    for (double& s : springs) s = std::max(0.0, s);
    for (const Zone::Coupling& c : floating_.anchors()) springs[index(c.row)] += c.value;
    lagged_ = std::move(springs);
    renewed_ = false;
    renewal_.renewed();
    renew();
}

bool EngineSolver::set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held) {
    claim();
    applied_ = false;
    system_.set(std::move(couplings), held);
    floating_.update();
    const auto changed = [this] {
        const std::vector<std::uint8_t> rows = differing_rows(system_, lagged_);
        return std::any_of(rows.begin(), rows.end(), [](std::uint8_t row) { return row != 0; });
    };
    // A residual weighs too little where springs have become softer than in the preconditioner: a crack that opens goes
    // unnoticed. Energies are then compared with a new one. (The other way round a residual weighs too much.)
    const bool hidden = comparing_ && !lagged_.empty() && any_softer(system_, lagged_);
    if (lagged_.empty() || hidden || (renewal_.due(cost_) && changed())) renew_now();
    return has_minimum();
}

// Conjugate gradients towards a load need not meet the direction in which the energy falls. If there is such a
// direction, softening rows move in it. The iteration meets it within a few steps from forces of random sign on these
// rows alone, because all other directions are similar for the preconditioner (the largest eigenvalue of what softening
// takes off, by Lanczos).
bool EngineSolver::has_minimum() {
    std::vector<std::uint8_t> softening(system_.rows().size(), 0);
    bool any = false;
    for (const Zone::Coupling& c : system_.couplings()) {
        if (c.row == c.column && c.value >= 0.0) continue;
        softening[index(c.row)] = softening[index(c.column)] = 1;
        any = true;
    }
    if (!any) return true;
    if (!renewed_) renew();
    if (!applied_) apply();
    std::vector<double> force(index(system_.count()), 0.0), state;
    std::uint64_t seed = 1;
    for (std::size_t r = 0; r < softening.size(); ++r) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        if (softening[r] != 0) system_.rows().add(r, (seed >> 63U) == 0 ? 1.0 : -1.0, force);
    }
    const std::vector<double> rest(bodies_.problem().patterns.size(), 0.0), right(system_.space().slaves().size(), 0.0);
    const std::size_t before = newest_;
    const Raw raw =
        ask(rest, force, right, {}, renewal_.limits().engine_probed, renewal_.limits().engine_longest_probe, {}, state);
    if (raw.answer.definite == 0) return false;
    kept_[newest_].forget();
    newest_ = before;
    return true;
}

// h of the rows and what springs and tangents do to what is prescribed of jumps.
std::vector<double> EngineSolver::forces(std::span<const double> theta, std::span<const double> row_force) const {
    std::vector<double> b(index(system_.count()), 0.0);
    for (std::size_t r = 0; r < row_force.size(); ++r)
        if (system_.held()[r] == 0 && row_force[r] != 0.0) system_.rows().add(r, row_force[r], b);
    const std::vector<double> offset = system_.rows().offsets(theta);
    for (const Zone::Coupling& c : system_.couplings())
        if (offset[index(c.column)] != 0.0) system_.rows().add(index(c.row), -c.value * offset[index(c.column)], b);
    return b;
}

std::vector<double> EngineSolver::rights(std::span<const double> theta) const {
    std::vector<double> right;
    for (const ReducedSpace::Slave& slave : system_.space().slaves()) right.push_back(dot(slave.right, theta));
    return right;
}

// The oldest place that the start does not need.
std::size_t EngineSolver::free_place(std::span<const double> start) const {
    std::size_t place = newest_;
    do {
        place = (place + 1) % kept_.size();
    } while (!start.empty() && start[place] != 0.0 && place != newest_);
    return place;
}

EngineSolver::Raw EngineSolver::ask(std::span<const double> theta, std::span<const double> force,
                                    std::span<const double> right, std::span<const double> start, double tolerance,
                                    std::int64_t limit, const Forcing& forcing, std::vector<double>& x, bool reading) {
    const std::size_t n = index(system_.count()), place = free_place(start);
    Raw raw;
    raw.correction.assign(n, 0.0);
    raw.correction_balance.assign(n, 0.0);
    std::vector<double> products(kept_.size(), 0.0), state(at_.size, 0.0);
    raw.answer.values = state.data() + at_.variables;
    raw.answer.balance = state.data() + at_.balance;
    raw.answer.correction = raw.correction.data();
    raw.answer.correction_balance = raw.correction_balance.data();
    raw.answer.products = products.data();
    raw.answer.work = state.data() + at_.done;
    raw.answer.lifted = state.data() + at_.lifted;
    Calls calls{forcing, monitor_, reading};
    delam_experimental_request request{};
    request.theta = theta.data();
    request.force = force.data();
    request.right = right.data();
    request.start = start.empty() ? nullptr : start.data();
    request.place = static_cast<std::int64_t>(place);
    request.tolerance = tolerance;
    request.limit = limit;
    request.enough = forcing ? ask_enough : nullptr;
    request.poll = ask_to_stop;
    request.user = &calls;
    kept_[place].forget();
    const delam_experimental_engine& engine = engine_->functions();
    const std::int32_t status = engine.solve(&request, &raw.answer, engine.user);
    if (calls.stopped) std::rethrow_exception(calls.stopped);
    engine_->require(status, "solve");
    raw.answer.values = raw.answer.balance = raw.answer.work = raw.answer.lifted = raw.answer.products = nullptr;
    if (raw.answer.definite == 0) return raw;
    require_numbers(raw, state, products);
    state[at_.weights + place] = 1.0;
    kept_[place] = {
        {state.begin(), state.begin() + static_cast<std::ptrdiff_t>(n)}, {theta.begin(), theta.end()}, true};
    for (std::size_t s = 0; s < kept_.size(); ++s)
        products_(static_cast<std::int64_t>(place), static_cast<std::int64_t>(s)) =
            products_(static_cast<std::int64_t>(s), static_cast<std::int64_t>(place)) = products[s];
    newest_ = place;
    x = std::move(state);
    return raw;
}

BodySolver::Answer EngineSolver::solve(std::span<const double> theta, std::span<const double> row_force,
                                       double tolerance, std::vector<double>& x, const Forcing& forcing) {
    claim();
    Answer answer;
    const std::vector<double> force = forces(theta, row_force), right = rights(theta);
    answer.balanced = floating_.balances(theta, row_force);
    if (!answer.balanced) return answer;
    if (!renewed_) renew();
    if (!applied_) apply();
    std::vector<double> start;
    if (x.size() == at_.size) {
        if (const std::optional<std::vector<double>> known = known_weights(x, {})) {
            start = *known;
        } else if (kept_[newest_].there) {
            start.assign(kept_.size(), 0.0);
            start[newest_] = 1.0;
        }
    }
    const double careful = any_softer(system_, lagged_) ? renewal_.limits().renewal_cautious : 1.0;
    const double target = std::max(finest, careful * tolerance);
    double enough = 0.0;
    const Forcing carefully = [&](double first) { return careful * (enough = forcing(first)); };
    const std::int64_t most = bodies_.problem().options.linear_limit;
    const bool old = renewal_.used();
    const auto attempt = static_cast<std::int64_t>(
        std::min(renewal_.first() + std::max(0.0, cost_ - renewal_.excess()), static_cast<double>(most)));
    const std::int64_t limit = old ? std::min(most, std::max(renewal_.limits().engine_least_attempt, attempt)) : most;
    Raw raw = ask(theta, force, right, start, target, limit, forcing ? carefully : Forcing{}, x);
    std::int64_t iterations = raw.answer.iterations;
    if (raw.answer.definite != 0 && raw.answer.converged == 0 && old && iterations < most) {
        const double first = raw.answer.first;
        renew_now();
        start.assign(kept_.size(), 0.0);
        start[newest_] = 1.0;
        const double again = any_softer(system_, lagged_) ? renewal_.limits().renewal_cautious : 1.0;
        const Forcing as_before = [&](double) { return again * enough; };
        raw = ask(theta, force, right, start, std::max(finest, again * tolerance), most,
                  forcing ? as_before : Forcing{}, x);
        raw.answer.first = first;
        iterations += raw.answer.iterations;
    }
    const auto own = static_cast<double>(raw.answer.iterations);
    renewal_.solved(own, 1.0);
    answer.iterations = iterations;
    answer.definite = raw.answer.definite != 0;
    answer.converged = raw.answer.converged != 0;
    if (!answer.definite) return answer;
    rounding_ = raw.answer.rounding;
    settle(x);
    answer.first = raw.answer.first;
    answer.norm = raw.answer.norm;
    answer.residual = raw.answer.norm == 0.0 ? 0.0 : raw.answer.norm / std::max(raw.answer.size, raw.answer.norm);
    answer.energy_error =
        0.5 * answer.norm * answer.norm / std::max(raw.answer.least, renewal_.limits().renewal_softest);
    answer.error = error_of(raw);
    return answer;
}

SolveError EngineSolver::error_of(const Raw& raw) const {
    SolveError error;
    std::vector<double> left = raw.correction_balance, force(system_.rows().size(), 0.0);
    system_.add_couplings(raw.correction, left);
    (void)system_.space().multipliers(left, force);
    for (std::size_t r = 0; r < force.size(); ++r)
        if (system_.held()[r] == 0)
            error.jump = std::max(error.jump, std::abs(system_.rows().value(r, raw.correction)));
    const double factor = renewal_.doubt(raw.answer.least);
    return {factor * error.jump, factor * max_abs(force)};
}

void EngineSolver::settle(std::vector<double>& x) const {
    if (floating_.free().empty()) return;
    const std::span<double> variables = std::span<double>(x).first(index(system_.count()));
    const std::vector<double> moved = floating_.settle(variables);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        std::vector<double> combination(floating_.free_combination(i).begin(), floating_.free_combination(i).end());
        for (double& c : combination) c *= moved[i];
        count_motion(floating_.rigid_displacement(combination), combination, x);
    }
}

void EngineSolver::move(std::span<const double> displacement, std::span<const double> combination,
                        std::span<double> x) const {
    add_scaled(1.0, floating_.in_variables(combination), x.first(index(system_.count())));
    count_motion(displacement, combination, x);
}

// The parts of a state that its variables do not show: its rigid motions, and what dead forces do along them.
void EngineSolver::count_motion(std::span<const double> displacement, std::span<const double> combination,
                                std::span<double> x) const {
    add_scaled(1.0, combination, x.subspan(at_.rigid, at_.size - at_.rigid));
    for (std::size_t p = 0; p < bodies_.force().size(); ++p)
        if (!bodies_.force()[p].empty()) x[at_.done + p] += dot(bodies_.force()[p], displacement);
}

void EngineSolver::require_numbers(const Raw& raw, std::span<const double> state,
                                   std::span<const double> products) const {
    const delam_experimental_answer& a = raw.answer;
    const double scalars[] = {a.first, a.norm, a.size, a.least, a.rounding};
    for (const std::span<const double> list :
         {state, products, std::span<const double>(raw.correction), std::span<const double>(raw.correction_balance),
          std::span<const double>(scalars)})
        if (!std::all_of(list.begin(), list.end(), [](double v) { return std::isfinite(v); }))
            fail(DELAM_ERROR_NUMERICAL, "engine: solve: the answer is not finite");
    // 64 bits hold the sum of more solves than an analysis can make.
    constexpr std::int64_t most = std::int64_t{1} << 32;
    if (a.iterations < 0 || a.iterations > most)
        fail(DELAM_ERROR_NUMERICAL, "engine: solve: iterations = ", a.iterations, ", allowed: 0 to ", most);
}

std::vector<double> EngineSolver::held_forces(std::span<const double>, std::span<const double> x,
                                              std::span<double> force) const {
    const std::span<const double> balance = part(x, at_.balance, at_.done);
    std::vector<double> left(balance.begin(), balance.end());
    for (std::size_t r = 0; r < force.size(); ++r) {
        if (system_.held()[r] != 0)
            force[r] = 0.0;
        else
            system_.rows().add(r, -force[r], left);
    }
    return system_.space().multipliers(left, force);
}

double EngineSolver::load_size(std::span<const double> theta) const {
    double size = 0.0;
    for (std::size_t p = 0; p < theta.size(); ++p) size += std::abs(theta[p]) * load_sizes_[p];
    return size;
}

}  // namespace delam
