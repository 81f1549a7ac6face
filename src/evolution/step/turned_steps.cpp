// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/turned_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/increment/step_account.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

// The state as one of a linearised scene, whose additional pattern has had no factor so far: its loads are never in
// proportion to those before.
State extended(const State& state, std::size_t patterns) {
    State own = state;
    own.theta.resize(patterns + 1, 0.0);
    own.response.conjugate.resize(patterns + 1, 0.0);
    own.response.multipliers.clear();
    own.memory.clear();
    own.search_memory.clear();
    own.search_energies.clear();
    return own;
}

// 1/2 d^T matrix d; 0 without a matrix.
double half_square(std::span<const double> matrix, std::span<const double> d) {
    double sum = 0.0;
    for (std::size_t i = 0; i < d.size() && !matrix.empty(); ++i)
        for (std::size_t j = 0; j < d.size(); ++j) sum += 0.5 * d[i] * matrix[i * d.size() + j] * d[j];
    return sum;
}

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
    std::vector<double> d(a.begin(), a.end());
    for (std::size_t i = 0; i < d.size(); ++i) d[i] -= b[i];
    return d;
}

// True if a stiffness that is not definite may be the reason.
bool unstable(const Error& error) { return error.status() == DELAM_ERROR_NUMERICAL || error.status() == DELAM_LIMIT; }

// Tells whether the forces balance: within the tolerance, or within rounding once linearisations come no nearer.
class Balanced {
public:
    Balanced(double tolerance, std::int64_t most_idle) : tolerance_(tolerance), most_idle_(most_idle) {}
    bool operator()(double off, double rounding) {
        idle_ = off < 0.5 * least_ ? 0 : idle_ + 1;
        least_ = std::min(least_, off);
        return off <= tolerance_ || (idle_ >= most_idle_ && off <= rounding);
    }

private:
    double tolerance_;
    std::int64_t most_idle_;
    double least_ = std::numeric_limits<double>::infinity();
    std::int64_t idle_ = 0;
};

}  // namespace

struct TurnedSteps::Linear {
    explicit Linear(LinearScene scene_) : scene(std::move(scene_)) {}
    LinearScene scene;
    std::unique_ptr<Stepper> stepper;
    TurnedPoint about;                  // its stiffness and frames
    std::vector<double> at, row_force;  // its loads; empty: not set
};

TurnedSteps::TurnedSteps(const Problem& problem, Monitor& monitor, const TurnedOperator& op, const PairLaws& pairs)
    : problem_(problem), monitor_(monitor), op_(op), pairs_(pairs) {}

TurnedSteps::~TurnedSteps() = default;

Stepper& TurnedSteps::linearise(const TurnedPoint& about, std::span<const double> at,
                                std::span<const double> row_force) const {
    if (!linear_) linear_ = std::make_unique<Linear>(op_.scene());
    Linear& linear = *linear_;
    const bool turned = linear.about == about;
    if (turned && std::ranges::equal(linear.at, at) && std::ranges::equal(linear.row_force, row_force))
        return *linear.stepper;
    linear.about = {};
    if (!turned) op_.turn(linear.scene, about);
    op_.load(linear.scene, at, row_force);
    if (!linear.stepper || !linear.stepper->renew(turned ? Renewed::loads : Renewed::all)) {
        linear.stepper.reset();
        linear.stepper = std::make_unique<Stepper>(linear.scene.problem, monitor_, Stepper::Checks::made_before);
    }
    linear.about = about;
    linear.at.assign(at.begin(), at.end());
    linear.row_force.assign(row_force.begin(), row_force.end());
    return *linear.stepper;
}

// Where stresses make a linear scene unstable, as on the way of a large step, they are left out of its stiffness.
Stepper::Result TurnedSteps::solve_about(TurnedPoint& about, std::span<const double> at,
                                         std::span<const double> row_force, const State& from,
                                         const Solve& solve) const {
    try {
        return solve(linearise(about, at, row_force), from);
    } catch (const Error& error) {
        if (about.stresses == Stresses::left_out || !unstable(error)) throw;
    }
    about = {{at.begin(), at.end()}, {}, {}, Stresses::left_out};
    return solve(linearise(about, at, row_force), from);
}

std::vector<double> TurnedSteps::tangent_about(const TurnedPoint& about, const State& state, const State& at) const {
    try {
        return without_last(linearise(about, state.response.multipliers, state.response.force).tangent(at));
    } catch (const Error& error) {
        if (!unstable(error)) throw;
        return {};
    }
}

// The change of the reactions at fixed damage and contact exists where the stiffness under all stresses is positive
// definite. Faces that touch without a force hold nothing: a flat strip would stay flat. Where nothing but they holds a
// part, whatever the stresses, they do.
TurnedSteps::Known TurnedSteps::know(const State& state) const {
    Known known{state.response.multipliers, state.response.force, state.adhesion, state.closed, point_of(state), {}};
    State at = extended(state, problem_.patterns.size());
    at.theta.back() = 1.0;
    State open = at;
    const double load = max_abs(op_.reaction(state.theta, state.response));
    const auto dim = index(problem_.mesh->dimension());
    for (std::size_t p = 0; p < open.closed.size(); ++p)
        if (!(-state.response.force[p * dim] > problem_.options.limits.turned_balance * load)) open.closed[p] = 0;
    if (known.about.stresses == Stresses::count) known.tangent = tangent_about(known.about, state, open);
    if (!known.tangent.empty()) return known;
    known.about = {state.response.multipliers, {}, {}};
    known.tangent = tangent_about(known.about, state, open);
    if (!known.tangent.empty()) return known;
    const TurnedPoint unstressed{state.response.multipliers, {}, {}, Stresses::left_out};
    if (open.closed != at.closed && tangent_about(unstressed, state, open).empty())
        known.tangent = tangent_about(known.about, state, at);
    if (known.tangent.empty()) known.about = unstressed;
    return known;
}

[[noreturn]] void TurnedSteps::refuse_buckling(double time) {
    fail(DELAM_LIMIT, "time ", time,
         ": the bodies are in balance, but buckle: their stiffness under their stresses is ",
         "not positive definite, and kinematics = corotational does not follow them there");
}

void TurnedSteps::make_true(State& state) const {
    std::vector<double> displacement = linear_->stepper->op().displacement(state.theta, state.response);
    const std::size_t patterns = problem_.patterns.size();
    state.theta.resize(patterns);
    state.response.conjugate.resize(patterns);
    state.memory.clear();
    state.jump_within = {};
    const double energy = state.ledger.energy(), linear_energy = state.ledger.energy_linear();
    op_.complete(state.theta, std::move(displacement), state.response);
    record_energies(pairs_, state);
    state.ledger.increment += state.ledger.energy() - energy;
    state.ledger.increment_lower += state.ledger.energy() - energy;
    if (state.step > 0) return;
    state.ledger.initial += state.ledger.energy() - energy;
    state.ledger.initial_linear += state.ledger.energy_linear() - linear_energy;
}

// The first linear step is one about where the step before was linearised. The result is where this step is linearised,
// once, and again wherever the stiffness of there brings the forces no nearer to their balance.
Stepper::Result TurnedSteps::iterate(const State& before, const Solve& solve) const {
    const Limits& limits = problem_.options.limits;
    std::vector<double> at = before.response.multipliers, row_force = before.response.force;
    at.resize(op_.dofs(), 0.0);
    row_force.resize(index(problem_.jump_count()), 0.0);
    TurnedPoint about = before.memory.empty() ? TurnedPoint{at, {}, {}} : point_of(before);
    bool own = before.memory.empty();  // linearised in this step
    Effort effort;
    State start = extended(before, problem_.patterns.size()), lowest;
    Balanced at_rest(limits.turned_balance, limits.minimise_most_idle);
    bool rested = false;
    double level = std::numeric_limits<double>::infinity(), off_before = level, least = level;
    for (std::int64_t n = 1;; ++n) {
        monitor_.progress("rotate", n, 0);
        if (n > limits.turned_free && std::isfinite(least)) start = extended(lowest, problem_.patterns.size());
        Stepper::Result next = solve_about(about, at, row_force, start, solve);
        const bool definite = about.stresses == Stresses::count;
        effort.add(next.state.effort);
        effort.linearisations = n;
        make_true(next.state);
        next.state.effort = effort;
        const auto [off, rounding] = op_.unbalanced(next.state.theta, next.state.response);
        const bool still = at_rest(off, rounding), balanced = still && definite;
        if (still && !definite && std::exchange(rested, true)) refuse_buckling(next.state.time);
        next.state.outcome.turned_off = balanced ? 0.0 : off;
        // The next step begins with this stiffness, unless that of the result differs.
        const bool near = own && definite && off < limits.turned_kept * off_before;
        next.state.memory = (near ? about : TurnedPoint{next.state.response.multipliers, {}, {}}).numbers();
        if (balanced || n == limits.turned_most) {
            next.converged = next.converged && balanced;
            return next;
        }
        const double energy = next.state.ledger.energy() + next.state.ledger.dissipated;
        if (n > 1 && energy < least) {
            least = energy;
            lowest = next.state;
        }
        const bool rises = energy > level + limits.minimise_energy_rounding * std::abs(level) && off > off_before;
        const bool kept = own && !rises && definite && off < limits.turned_kept * off_before && keeps_stiffness();
        const std::vector<double> from = at;
        std::vector<double>& image = next.state.response.multipliers;
        row_force = next.state.response.force;
        if (rises) {
            for (std::size_t i = 0; i < at.size(); ++i) at[i] = 0.5 * (at[i] + image[i]);
        } else {
            at = std::move(image);
            level = energy;
            off_before = off;
        }
        if (kept) continue;
        about = {at, from, std::move(about.displacement)};
        own = true;
    }
}

bool TurnedSteps::keeps_stiffness() const { return linear_->stepper->op().traits().renewable; }

Stepper::Result TurnedSteps::initial(double time) const {
    return iterate({}, [&](Stepper& stepper, const State&) { return stepper.initial(time); });
}

// The work of the reactions by the trapezoidal rule. The estimate follows from the true energy: with R = dE/dtheta and
// its change C at fixed adhesion, E(theta_k, .) - E(theta_k-1, .) is R_k d - 1/2 d C_k d at the adhesion after the step
// and R_k-1 d + 1/2 d C_k-1 d at the one before, to third order in d.
Stepper::Result TurnedSteps::step(const State& before, double time, double stride) const {
    const std::vector<double> d = difference(problem_.factors(time), before.theta);
    Known known = known_ && known_->of(before) ? std::move(*known_) : know(before);
    known_.reset();
    const double upper_change = half_square(known.tangent, d);
    Stepper::Result result =
        iterate(before, [&](Stepper& stepper, const State& from) { return stepper.step(from, time, {}, stride); });
    State& next = result.state;
    known = know(next);
    if (known.about.stresses == Stresses::left_out && result.converged) refuse_buckling(time);
    next.memory = known.about.numbers();
    const double lower_change = half_square(known.tangent, d);
    const double work = 0.5 * (dot(d, before.response.conjugate) + dot(d, next.response.conjugate));
    const std::unique_ptr<StepRule> rule = linear_->stepper->increment(before, before.mixity);
    next.step = before.step + 1;
    next.history.revised_from = next.step;
    next.mixity_before = before.mixity;
    Ledger& ledger = next.ledger;
    ledger.increment_lower -= ledger.increment;
    ledger.increment = ledger.energy() - before.ledger.energy() + ledger.dissipated - before.ledger.dissipated;
    ledger.increment_lower += ledger.increment;
    ledger.lower = dot(d, next.response.conjugate) - lower_change;
    ledger.upper = dot(d, before.response.conjugate) + upper_change;
    if (next.adhesion == before.adhesion) ledger.lower = ledger.upper = ledger.increment;
    next.outcome.released = damages_abruptly(*rule, next.adhesion) ? std::max(0.0, work - ledger.increment) : 0.0;
    ledger.work = before.ledger.work + work;
    ledger.released = before.ledger.released + next.outcome.released;
    known_ = std::move(known);
    return result;
}

Stepper::Result TurnedSteps::equilibrate(const State& before, double time, std::span<const double> adhesion) const {
    const State own = extended(before, problem_.patterns.size());
    Stepper::Result result =
        iterate(before, [&](Stepper& stepper, const State&) { return stepper.equilibrate(own, time, adhesion); });
    // The cumulative columns count from the state that is set.
    Ledger& ledger = result.state.ledger;
    ledger.initial = before.ledger.initial + ledger.energy() - before.ledger.energy();
    ledger.initial_linear = before.ledger.initial_linear + ledger.energy_linear() - before.ledger.energy_linear();
    return result;
}

std::vector<double> TurnedSteps::without_last(std::span<const double> matrix) const {
    const std::size_t patterns = problem_.patterns.size();
    std::vector<double> own;
    for (std::size_t i = 0; i < patterns; ++i)
        for (std::size_t j = 0; j < patterns; ++j) own.push_back(matrix[i * (patterns + 1) + j]);
    return own;
}

std::vector<double> TurnedSteps::tangent(const State& state) const {
    Stepper& about = linearise({state.response.multipliers, {}, {}}, state.response.multipliers, state.response.force);
    State own = extended(state, problem_.patterns.size());
    own.theta.back() = 1.0;
    return without_last(about.tangent(own));
}

std::vector<double> TurnedSteps::step_tangent(const State& before, const State& state) const {
    Stepper& about = linearise({state.response.multipliers, {}, {}}, state.response.multipliers, state.response.force);
    State own = extended(state, problem_.patterns.size());
    own.theta.back() = 1.0;
    return without_last(about.step_tangent(extended(before, problem_.patterns.size()), own));
}

void delegate_to_turned_steps(Stepper& stepper, const Problem& problem, Monitor& monitor) {
    auto op = std::make_unique<TurnedOperator>(problem, [&monitor] { monitor.progress("assemble", 0, 0); });
    auto steps = std::make_unique<const TurnedSteps>(problem, monitor, *op, stepper.pairs());
    stepper.delegate(std::move(op), std::move(steps));
}

}  // namespace delam
