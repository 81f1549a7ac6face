// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/engine/engine_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

EngineSolver::EngineSolver(const BodySystem& bodies, std::shared_ptr<Engine> engine, Monitor& monitor)
    : bodies_(bodies),
      monitor_(monitor),
      calls_(std::move(engine), monitor),
      system_(bodies),
      floating_(bodies, system_),
      at_(index(system_.count()), bodies.problem().patterns.size(), index(Engine::kept), index(floating_.motions())),
      kept_(index(Engine::kept)),
      renewal_(bodies.problem().options.limits, infinite) {
    const std::size_t patterns = bodies.problem().patterns.size();
    for (std::size_t p = 0; p < patterns; ++p)
        for (std::size_t k = 0; k < patterns; ++k)
            lift_force_.push_back(bodies.force()[k].empty() ? 0.0 : dot(bodies.variables().lift[p], bodies.force()[k]));
    claim();
}

void EngineSolver::claim() {
    if (calls_.prepared()) return;
    kept_.clear();
    applied_ = renewed_ = false;
    EngineCalls::Sizes sizes = calls_.prepare(bodies_);
    system_.set_diagonal(std::move(sizes.diagonal));
    load_sizes_ = std::move(sizes.loads);
}

void EngineSolver::apply() {
    std::vector<Zone::Coupling> acting = system_.couplings();
    // Without a load they have no force: they only choose one of the states that differ by free motions.
    acting.insert(acting.end(), floating_.free_anchors().begin(), floating_.free_anchors().end());
    const std::vector<std::uint8_t> none(system_.rows().size(), 0);
    const EngineEntries entries(from_triplets(system_.count(), system_.count(), spring_entries(system_, acting, none)));
    EngineEntries masters;
    std::vector<std::int64_t> pivots;
    for (const ReducedSpace::Slave& slave : system_.space().slaves()) {
        for (const auto& [i, c] : slave.masters)
            if (c != 0.0) masters.add(static_cast<std::int64_t>(pivots.size()), i, c);
        pivots.push_back(slave.pivot);
    }
    calls_.set(entries, system_.space().removed(), pivots, masters);
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
    const EngineEntries entries(from_triplets(system_.count(), system_.count(), std::move(added)));
    ++renewals_;
    cost_ = calls_.renew(entries);
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
    const std::size_t before = kept_.newest();
    const EngineCalls::Answer raw =
        ask(rest, force, right, {}, renewal_.limits().engine_probed, renewal_.limits().engine_longest_probe, {}, state);
    if (!raw.definite()) return false;
    kept_.take_back(before);
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

// The answer's state goes to x.
EngineCalls::Answer EngineSolver::ask(std::span<const double> theta, std::span<const double> force,
                                      std::span<const double> right, std::span<const double> start, double tolerance,
                                      std::int64_t limit, const Forcing& forcing, std::vector<double>& x,
                                      bool reading) {
    const std::size_t place = kept_.free_place(start);
    kept_.forget(place);
    EngineCalls::Answer answer =
        calls_.solve({theta, force, right, start, place, tolerance, limit, forcing, reading}, at_);
    if (!answer.definite()) return answer;
    const std::span<double> state = answer.state;
    at_.weights(state)[place] = 1.0;
    kept_.keep(place, at_.variables(state), theta, answer.products);
    x = std::move(answer.state);
    return answer;
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
    if (x.size() == at_.size()) {
        if (const std::optional<std::vector<double>> known = known_weights(x, {}))
            start = *known;
        else
            start = kept_.newest_alone();
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
    EngineCalls::Answer raw = ask(theta, force, right, start, target, limit, forcing ? carefully : Forcing{}, x);
    std::int64_t iterations = raw.numbers.iterations;
    if (raw.definite() && !raw.converged() && old && iterations < most) {
        const double first = raw.numbers.first;
        renew_now();
        start = kept_.newest_alone();
        const double again = any_softer(system_, lagged_) ? renewal_.limits().renewal_cautious : 1.0;
        const Forcing as_before = [&](double) { return again * enough; };
        raw = ask(theta, force, right, start, std::max(finest, again * tolerance), most,
                  forcing ? as_before : Forcing{}, x);
        raw.numbers.first = first;
        iterations += raw.numbers.iterations;
    }
    const auto own = static_cast<double>(raw.numbers.iterations);
    renewal_.solved(own, 1.0);
    answer.iterations = iterations;
    answer.definite = raw.definite();
    answer.converged = raw.converged();
    if (!answer.definite) return answer;
    rounding_ = raw.numbers.rounding;
    settle(x);
    answer.first = raw.numbers.first;
    answer.norm = raw.numbers.norm;
    answer.residual = raw.numbers.norm == 0.0 ? 0.0 : raw.numbers.norm / std::max(raw.numbers.size, raw.numbers.norm);
    answer.energy_error =
        0.5 * answer.norm * answer.norm / std::max(raw.numbers.least, renewal_.limits().renewal_softest);
    answer.error = error_of(raw);
    return answer;
}

SolveError EngineSolver::error_of(const EngineCalls::Answer& raw) const {
    SolveError error;
    std::vector<double> left = raw.correction_balance, force(system_.rows().size(), 0.0);
    system_.add_couplings(raw.correction, left);
    (void)system_.space().multipliers(left, force);
    for (std::size_t r = 0; r < force.size(); ++r)
        if (system_.held()[r] == 0)
            error.jump = std::max(error.jump, std::abs(system_.rows().value(r, raw.correction)));
    const double factor = renewal_.doubt(raw.numbers.least);
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
    add_scaled(1.0, combination, at_.rigid(x));
    const std::span<double> done = at_.done(x);
    for (std::size_t p = 0; p < bodies_.force().size(); ++p)
        if (!bodies_.force()[p].empty()) done[p] += dot(bodies_.force()[p], displacement);
}

std::vector<double> EngineSolver::held_forces(std::span<const double>, std::span<const double> x,
                                              std::span<double> force) const {
    const std::span<const double> balance = at_.balance(x);
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

std::optional<std::vector<double>> EngineSolver::known_weights(std::span<const double> x,
                                                               std::span<const double> theta) const {
    if (x.size() != at_.size()) return {};
    return kept_.weights_of(at_, x, theta, floating_.in_variables(at_.rigid(x)));
}

std::vector<double> EngineSolver::weights_of(std::span<const double> theta, std::span<const double> x) {
    claim();
    if (std::optional<std::vector<double>> known = known_weights(x, theta)) return *std::move(known);
    return solve_again(theta, x);
}

// With all trailing variables given, the rest of the bodies is definite. The engine's preconditioner is then one for
// other solves no longer.
std::vector<double> EngineSolver::solve_again(std::span<const double> theta, std::span<const double> x,
                                              bool with_rigid) {
    const std::size_t n = index(system_.count());
    const std::vector<double> moved = with_rigid ? std::vector<double>(n, 0.0) : floating_.in_variables(at_.rigid(x));
    std::vector<double> given(n), none(n, 0.0), state;
    std::vector<std::int64_t> all(n);
    EngineEntries stiff;
    const double largest = max_abs(system_.diagonal());
    for (std::size_t i = 0; i < n; ++i) {
        given[i] = x[i] - moved[i];
        all[i] = static_cast<std::int64_t>(i);
        const double d = system_.diagonal()[i];
        stiff.add(all[i], all[i], held_as * (d > 0.0 ? d : largest));
    }
    applied_ = renewed_ = false;
    (void)calls_.renew(stiff);
    calls_.set({}, {}, all, {});
    const EngineCalls::Answer raw =
        ask(theta, none, given, {}, finest, bodies_.problem().options.linear_limit, {}, state, true);
    if (state.empty()) fail(DELAM_ERROR_NUMERICAL, "engine: the stiffness of the bodies is not positive definite");
    if (!raw.converged())
        fail(DELAM_ERROR_NUMERICAL, "engine: the displacements of this state cannot be found again within ",
             raw.numbers.iterations, " iterations (option linear_limit)");
    const std::span<const double> weights = at_.weights(std::span<const double>(state));
    return {weights.begin(), weights.end()};
}

BodySolver::Work EngineSolver::work(std::span<const double> theta, std::span<const double> x) {
    const std::vector<double> weights = weights_of(theta, x);
    Work work;
    work.strain = kept_.strain(weights);
    const std::span<const double> done = at_.done(x), on_lift = at_.lifted(x);
    const std::size_t patterns = theta.size();
    for (std::size_t p = 0; p < patterns; ++p) {
        work.done.push_back(done[p]);
        double lifted = on_lift[p];
        for (std::size_t k = 0; k < patterns; ++k) lifted -= theta[k] * lift_force_[p * patterns + k];
        work.lifted.push_back(lifted);
    }
    return work;
}

void EngineSolver::recover(std::span<const double> theta, std::span<const double> x, std::vector<double>& displacement,
                           std::vector<double>& stressed) {
    const std::vector<double> weights = weights_of(theta, x);
    displacement.assign(index(bodies_.dofs()), 0.0);
    stressed.assign(index(bodies_.dofs()), 0.0);
    calls_.recover(weights, displacement, stressed);
    if (!at_.has_motions()) return;
    const std::vector<double> moved = floating_.rigid_displacement(at_.rigid(x));
    for (std::size_t i = 0; i < moved.size(); ++i) displacement[i] += moved[i];
}

// The kept answers lack the rigid motions, which the engine gets as displacements of the mesh. An engine with other
// nodes refuses them: with all variables given as they are, the bodies are then solved for once more.
void EngineSolver::recover_in_engine(std::span<const double> theta, std::span<const double> x) {
    const std::vector<double> weights = weights_of(theta, x);
    std::vector<double> moved;
    if (x.size() == at_.size() && max_abs(at_.rigid(x)) > 0.0) moved = floating_.rigid_displacement(at_.rigid(x));
    if (calls_.recover_within(weights, std::move(moved))) return;
    (void)calls_.recover_within(solve_again(theta, x, true), {});
}

// Springs of the preconditioner, the iterations that a new one would have saved, the iterations of its first solve, its
// worth.
std::vector<double> EngineSolver::memory() {
    std::vector<double> m = lagged_;
    if (m.empty()) return m;
    m.push_back(renewal_.excess());
    m.push_back(renewal_.first());
    m.push_back(cost_);
    return m;
}

void EngineSolver::require_memory(std::span<const double> memory) const {
    if (memory.empty()) return;
    const std::size_t expected = system_.rows().size() + 3;
    if (memory.size() != expected ||
        !std::all_of(memory.begin(), memory.end(), [](double m) { return m >= 0.0 && std::isfinite(m); }))
        fail(DELAM_ERROR_SNAPSHOT, "snapshot holds springs that the operator of an engine cannot have");
}

void EngineSolver::recall(std::span<const double> memory) {
    if (std::ranges::equal(memory, this->memory())) return;
    require_memory(memory);
    const std::size_t rows = system_.rows().size();
    lagged_.assign(memory.begin(),
                   memory.empty() ? memory.begin() : memory.begin() + static_cast<std::ptrdiff_t>(rows));
    renewal_.restore(memory.empty() ? 0.0 : memory[rows], memory.empty() ? 0.0 : memory[rows + 1]);
    cost_ = memory.empty() ? 1.0 : memory[rows + 2];
    renewed_ = false;
}

}  // namespace delam
