// SPDX-License-Identifier: BSD-3-Clause
// Functions that use the states whose displacements the engine keeps.
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/sparse/engine/engine_solver.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

namespace {

// Largest difference, relative to the largest variable, between a state and a combination of kept answers that stands
// for it.
constexpr double same_state = 1e-11;

}  // namespace

// Weights are valid if the combination has the variables of the state and its loads: where all pairs are bonded, the
// variables are zero at any load.
std::optional<std::vector<double>> EngineSolver::known_weights(std::span<const double> x,
                                                               std::span<const double> theta) const {
    if (x.size() != at_.size) return {};
    const std::span<const double> weights = part(x, at_.weights, at_.rigid);
    std::vector<double> sum = floating_.in_variables(part(x, at_.rigid, at_.size));
    std::vector<double> loads(theta.size(), 0.0);
    for (std::size_t s = 0; s < kept_.size(); ++s) {
        if (weights[s] == 0.0) continue;
        if (!kept_[s].there) return {};
        add_scaled(weights[s], kept_[s].variables, sum);
        for (std::size_t p = 0; p < loads.size(); ++p) loads[p] += weights[s] * kept_[s].theta[p];
    }
    for (std::size_t p = 0; p < loads.size(); ++p)
        if (!(std::abs(loads[p] - theta[p]) <= same_state * max_abs(theta))) return {};
    const double allowed = same_state * max_abs(x.first(sum.size()));
    for (std::size_t i = 0; i < sum.size(); ++i)
        if (!(std::abs(sum[i] - x[i]) <= allowed)) return {};
    return std::vector<double>(weights.begin(), weights.end());
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
    const std::vector<double> moved =
        with_rigid ? std::vector<double>(n, 0.0) : floating_.in_variables(part(x, at_.rigid, at_.size));
    std::vector<double> given(n), none(n, 0.0), state;
    std::vector<std::int64_t> all(n);
    std::vector<Triplet> stiff;
    const double largest = max_abs(system_.diagonal());
    for (std::size_t i = 0; i < n; ++i) {
        given[i] = x[i] - moved[i];
        all[i] = static_cast<std::int64_t>(i);
        const double d = system_.diagonal()[i];
        stiff.push_back({all[i], all[i], held_as * (d > 0.0 ? d : largest)});
    }
    applied_ = renewed_ = false;
    std::vector<double> values;
    for (const Triplet& t : stiff) values.push_back(t.value);
    const delam_experimental_entries nothing{0, nullptr, nullptr, nullptr},
        entries{static_cast<std::int64_t>(n), all.data(), all.data(), values.data()};
    const delam_experimental_engine& engine = engine_->functions();
    double cost = 0.0;
    engine_->require(engine.renew(&entries, &cost, engine.user), "renew");
    engine_->require(engine.set(&nothing, 0, nullptr, static_cast<std::int64_t>(n), all.data(), &nothing, engine.user),
                     "set");
    const Raw raw = ask(theta, none, given, {}, finest, bodies_.problem().options.linear_limit, {}, state, true);
    if (state.empty()) fail(DELAM_ERROR_NUMERICAL, "engine: the stiffness of the bodies is not positive definite");
    if (raw.answer.converged == 0)
        fail(DELAM_ERROR_NUMERICAL, "engine: the displacements of this state cannot be found again within ",
             raw.answer.iterations, " iterations (option linear_limit)");
    const std::span<const double> weights = part(state, at_.weights, at_.rigid);
    return {weights.begin(), weights.end()};
}

BodySolver::Work EngineSolver::work(std::span<const double> theta, std::span<const double> x) {
    const std::vector<double> weights = weights_of(theta, x);
    Work work;
    for (std::size_t s = 0; s < weights.size(); ++s)
        for (std::size_t t = 0; t < weights.size(); ++t)
            if (weights[s] != 0.0 && weights[t] != 0.0)
                work.strain += 0.5 * weights[s] * weights[t] *
                               products_(static_cast<std::int64_t>(s), static_cast<std::int64_t>(t));
    const std::size_t patterns = theta.size();
    for (std::size_t p = 0; p < patterns; ++p) {
        work.done.push_back(x[at_.done + p]);
        double lifted = x[at_.lifted + p];
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
    const delam_experimental_engine& engine = engine_->functions();
    engine_->require(engine.recover(weights.data(), displacement.data(), stressed.data(), engine.user), "recover");
    for (const std::vector<double>* field : {&displacement, &stressed})
        if (!std::all_of(field->begin(), field->end(), [](double v) { return std::isfinite(v); }))
            fail(DELAM_ERROR_NUMERICAL, "engine: recover: the fields are not finite");
    if (at_.rigid == at_.size) return;
    const std::vector<double> moved = floating_.rigid_displacement(part(x, at_.rigid, at_.size));
    for (std::size_t i = 0; i < moved.size(); ++i) displacement[i] += moved[i];
}

// The kept answers lack the rigid motions, which the engine gets as displacements of the mesh. An engine with other
// nodes refuses them: with all variables given as they are, the bodies are then solved for once more.
void EngineSolver::recover_in_engine(std::span<const double> theta, std::span<const double> x) {
    std::vector<double> weights = weights_of(theta, x);
    const delam_experimental_engine& engine = engine_->functions();
    if (x.size() == at_.size && max_abs(part(x, at_.rigid, at_.size)) > 0.0) {
        std::vector<double> moved = floating_.rigid_displacement(part(x, at_.rigid, at_.size));
        const std::int32_t status = engine.recover(weights.data(), moved.data(), nullptr, engine.user);
        if (status != DELAM_ERROR_PROBLEM) return engine_->require(status, "recover");
        weights = solve_again(theta, x, true);
    }
    engine_->require(engine.recover(weights.data(), nullptr, nullptr, engine.user), "recover");
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
