// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/turned/turned_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/contact/contact.hpp"
#include "evolution/increment/step_account.hpp"
#include "evolution/step/jump_event.hpp"
#include "evolution/step/load_path.hpp"
#include "evolution/step/turned/balanced.hpp"
#include "evolution/step/turned/mixing.hpp"
#include "evolution/step/turned/path_within.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

// A step leaves at most so many unstable states one after another: bodies that buckle have one or two. (Half and twice
// of this and of the next give the same digits of examples/blister and pass verify/cases/test_buckling.)
constexpr std::int64_t most_modes = 8;
// Beyond this share of its fall, what the energy falls by more than on a branch from the critical load is the release
// of a snap-through. (A strut in 15 steps leaves 0.002, a blister in 60, whose root softens, less than nothing.)
constexpr double snaps = 0.1;
// Pairs that press and have slid by more than this share of their spacing may alternate (mixing.hpp). Shorter slides
// move their forces by less than a pair. (Half and twice pass verify/cases/test_turned_sliding.cpp in the same time.)
constexpr double slides = 0.5;

// 1/2 d^T matrix d; 0 without a matrix.
double half_square(std::span<const double> matrix, std::span<const double> d) {
    double sum = 0.0;
    for (std::size_t i = 0; i < d.size() && !matrix.empty(); ++i)
        for (std::size_t j = 0; j < d.size(); ++j) sum += 0.5 * d[i] * matrix[i * d.size() + j] * d[j];
    return sum;
}

// Returns the node that moves most along a mode, [mesh DOFs].
std::int64_t most_moved(std::span<const double> mode, int dimension) {
    const auto most = std::ranges::max_element(mode, {}, [](double x) { return std::abs(x); });
    return (most - mode.begin()) / dimension;
}

// Returns what a linear step lowers, F L.
double energy_of(const State& state) { return state.ledger.energy() + state.ledger.dissipated; }

}  // namespace

TurnedSteps::TurnedSteps(const Problem& problem, Monitor& monitor, const TurnedOperator& op, const PairLaws& pairs,
                         const ContactScene& contact)
    : problem_(problem),
      monitor_(monitor),
      op_(op),
      pairs_(pairs),
      graph_(problem.mesh->interfaces()),
      loose_(problem, op, pairs, contact),
      linear_(problem, monitor, op),
      tangents_(problem, op, loose_, linear_) {}

// Where stresses make a linear scene unstable, as on the way of a large step, they are left out of its stiffness.
// Bodies that come off in a step have held on to others before, and the forces there go.
Stepper::Result TurnedSteps::solve_about(TurnedPoint& about, const std::vector<double>& at,
                                         std::vector<double> row_force, const State& from, const Solve& solve) const {
    while (true) {
        std::vector<std::uint8_t> loose;
        try {
            Stepper& stepper = linear_.about(about, at, row_force);
            Stepper::Result next = solve(stepper, linear_.resumed(from));
            loose = loose_.translating(next.state);
            if (!about.loosen(loose)) return next;
        } catch (const Error& error) {
            if (!unstable(error)) throw;
            if (about.stresses == Stresses::count) {
                about = {at, {}, {}, Stresses::left_out, about.theta, about.loose};
                continue;
            }
            loose = loose_.all();
            if (!about.loosen(loose)) throw;
        }
        row_force = loose_.without(loose, row_force);
    }
}

[[noreturn]] void TurnedSteps::refuse_buckling(double time) {
    fail(DELAM_LIMIT, "the bodies are in balance at time ", time,
         ", but buckle: their stiffness under their stresses is not positive definite, and no stable state has been ",
         "found from there");
}

void TurnedSteps::make_true(State& state) const {
    std::vector<double> displacement = linear_.stepper().op().displacement(state.theta, state.response);
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

TurnedSteps::Begin TurnedSteps::begin(const State& before) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    const bool first = before.memory.empty();
    Begin from{before.response.multipliers, before.response.force, {}, first, none, none};
    from.displacement.resize(op_.dofs(), 0.0);
    from.row_force.resize(index(problem_.jump_count()), 0.0);
    const std::vector<double> unloaded(problem_.patterns.size(), 0.0);
    from.memory =
        first ? TurnedMemory{{from.displacement, {}, {}, Stresses::count, unloaded}, {}} : tangents_.memory_of(before);
    if (!first) from.row_force = loose_.pressing(from.memory.point.loose, before);
    return from;
}

// Begins at the place to which the energy has fallen. Where faces pass through each other, the energy is too low to be
// a limit, and lower along every way through them.
TurnedSteps::Begin TurnedSteps::begin_at(const EnergyFall& fall, const State& state) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    State at = state;
    op_.complete(at.theta, fall.displacement, at.response);
    const double level = fall.penetrates ? none : fall.energy + state.ledger.dissipated;
    return {fall.displacement,
            state.response.force,
            {{fall.displacement, {}, {}, Stresses::left_out, state.theta, loose_.of(state)},
             tangents_.memory_of(state).of_operator},
            false,
            level,
            op_.unbalanced(at.theta, at.response).off,
            !fall.penetrates};
}

double TurnedSteps::moved(std::span<const double> at, const State& state) const {
    const std::vector<double> move = difference(state.response.multipliers, at);
    return std::sqrt(0.5 * dot(move, linear_.forces(move)) / state.ledger.stored_bulk);
}

// The first linear step is one about where the step before was linearised. The result is where this step is linearised,
// once, and again wherever the stiffness of there brings the forces no nearer to their balance.
Stepper::Result TurnedSteps::iterate(const State& before, Begin from, const Solve& solve, bool& definite) const {
    const Limits& limits = problem_.options.limits;
    std::vector<double> at = std::move(from.displacement), row_force = std::move(from.row_force);
    auto& [about, of_operator] = from.memory;
    bool own = from.own;  // linearised in this step
    linear_.keep_places(before.response.multipliers);
    Effort effort;
    State start = extended(before, problem_.patterns.size()), lowest;
    Balanced at_rest(limits);
    Mixing mixing;
    bool rested = false;
    double level = from.level, off_before = from.off;
    for (std::int64_t n = 1;; ++n) {
        monitor_.progress("rotate", n, 0);
        if (n > std::max<std::int64_t>(limits.turned_free, 2)) start = extended(lowest, problem_.patterns.size());
        start.memory = of_operator;
        Stepper::Result next = solve_about(about, at, row_force, start, solve);
        // A linear step in which a body comes off ends in another zone than the one before.
        const bool held = loose_.none_without_contact(next.state);
        of_operator = held && linear_.keeps_stiffness() ? std::move(next.state.memory) : std::vector<double>();
        definite = about.stresses == Stresses::count;
        effort.add(next.state.effort);
        effort.linearisations = n;
        make_true(next.state);
        next.state.effort = effort;
        const auto [off, rounding] = op_.unbalanced(next.state.theta, next.state.response);
        const double energy = energy_of(next.state), noise = limits.minimise_energy_rounding * std::abs(level);
        // Forces that balance without the stresses get another linear step in which these count. Next to a critical
        // load, forces that let the energy fall are small.
        const bool falls_on = from.falls && energy < level - noise;
        const double move = definite ? moved(at, next.state) : infinite;
        const bool rests = at_rest(off, rounding, move) && (held || loose_.known_forces(next.state, off));
        const bool balanced = rests && (definite || (std::exchange(rested, true) && !falls_on));
        next.state.outcome.turned_off = balanced ? 0.0 : off;
        if (!about.loose.empty() && next.state.outcome.damage_change <= problem_.options.damage_tolerance)
            next.converged = next.converged || loose_.rightly_touches(next.state);
        if (balanced || n == limits.turned_most) {
            // The next step begins with this stiffness, unless that of the result differs.
            const bool near =
                own && definite && off < limits.turned_kept * off_before && about.theta == next.state.theta;
            next.state.memory =
                TurnedMemory{near ? about : tangents_.point_at(next.state), std::move(of_operator)}.numbers();
            next.converged = next.converged && balanced;
            return next;
        }
        if (n == 2 || (n > 2 && energy < energy_of(lowest))) lowest = next.state;
        const bool rises = energy > level + noise && (off > off_before || from.falls);
        std::vector<std::uint8_t> loose = loose_.of(next.state);
        std::vector<double>& image = next.state.response.multipliers;
        const std::vector<double> origin = at;
        std::vector<double> pressing = loose_.pressing(loose, next.state);
        if (!from.falls && op_.longest_slide(next.state.response) > slides)
            mixing.add({at, std::move(row_force)}, {image, pressing}, next.state.adhesion, {off, energy});
        row_force = std::move(pressing);
        const bool kept = own && definite && linear_.keeps_stiffness() && loose == about.loose &&
                          (mixing.needed() || (!rises && off < limits.turned_kept * off_before));
        // On its way from a state that is not stable, a step goes as far along a move as the energy falls: linear
        // steps without stresses are short, those whose stiffness is nearly singular long.
        if (from.falls && (rises || !definite)) {
            const std::vector<double> move = difference(image, at);
            add_scaled(lowest_share(op_, pairs_, next.state, at, move), move, at);
        } else if (mixing.needed()) {
            Iterate mixed = mixing.mixed([this](std::span<const double> d) { return linear_.forces(d); });
            at = std::move(mixed.displacement);
            row_force = std::move(mixed.row_force);
        } else if (rises) {
            for (std::size_t i = 0; i < at.size(); ++i) at[i] = 0.5 * (at[i] + image[i]);
        } else {
            at = std::move(image);
        }
        if (!rises) {
            level = energy;
            off_before = off;
        }
        if (kept) continue;
        about = {at, origin, std::move(about.displacement), Stresses::count, next.state.theta, std::move(loose)};
        own = true;
    }
}

// Factors are compared at the stresses of both states, with the energy of the mode that they soften taken as equal:
// along a way on which stresses grow in proportion, this is exact.
double TurnedSteps::critical_share(const State& before, const BucklingMode& mode, const State& state) const {
    const auto softened = [&](const State& of) {
        const std::vector<SparseMatrix> soft = op_.softening(of.theta, of.response.multipliers, loose_.of(of));
        return dot(op_.multiply_bodies(soft, mode.displacement), mode.displacement);
    };
    const double share_before = softened(before) / softened(state);  // of the factor
    const double share = (1.0 / mode.factor - share_before) / (1.0 - share_before);
    return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 1.0;
}

BucklingMode TurnedSteps::mode_of(const State& state, std::span<const std::uint8_t> held) const {
    const std::vector<double>& place = state.response.multipliers;
    const TurnedPoint about = tangents_.point_at(state, Stresses::left_out);
    const Stepper& unstressed = linear_.about(about, place, state.response.force);
    const std::vector<SparseMatrix> soft = op_.softening(state.theta, place, about.loose);
    const Springs springs{spring_stiffness(pairs_, state.adhesion), held_rows(unstressed.contact(), held)};
    std::vector<double> theta(problem_.patterns.size() + 1, 0.0);
    theta.back() = 1.0;
    const auto solve = [&](std::span<const double> force) {
        JumpOperator& op = linear_.under(force).op();
        op.recall({});
        Response response;
        op.solve(springs, theta, response);
        if (!response.balanced || !response.converged)
            fail(DELAM_LIMIT, "the bodies buckle at time ", state.time, ", and their mode has not been found");
        return op.displacement(theta, response);
    };
    return buckling_mode(op_.dofs(), solve, [&](std::span<const double> v) { return op_.multiply_bodies(soft, v); });
}

double TurnedSteps::leave_unstable(const State& before, const Solve& solve, Stepper::Result& result,
                                   Known& known) const {
    const Limits& limits = problem_.options.limits;
    // A factor as near to 1 is critical at this very load: the energy falls by its square, which is rounding.
    const double neutral = std::sqrt(limits.minimise_energy_rounding);
    const State first = result.state;
    const std::vector<double> d = difference(first.theta, before.theta);
    double share = 1.0;
    bool definite = false;
    Buckling buckling;
    while (!known.stable()) {
        const State& top = result.state;
        const BucklingMode mode = mode_of(top, known.held);
        if (std::abs(mode.factor - 1.0) < neutral) break;  // only a later load makes it unstable
        if (buckling.modes == most_modes || !(mode.factor > 1.0)) refuse_buckling(top.time);
        if (buckling.modes == 0) share = critical_share(before, mode, top);
        const std::optional<EnergyFall> fall = energy_fall(op_, pairs_, top, mode.displacement);
        Stepper::Result lower;
        if (fall) lower = iterate(before, begin_at(*fall, top), solve, definite);
        const double level = energy_of(top), rounding = limits.minimise_energy_rounding * std::abs(level);
        if (!fall || (lower.converged && !(energy_of(lower.state) < level - rounding))) {
            if (!tangents_.held_by_faces(top, known)) refuse_buckling(top.time);
            break;
        }
        if (buckling.modes == 0) {
            buckling.time = before.time + share * (top.time - before.time);
            buckling.node = most_moved(mode.displacement, problem_.mesh->dimension());
        }
        ++buckling.modes;
        Effort effort = top.effort;
        effort.displacement_solves += mode.solves;
        effort.add(lower.state.effort);
        result = std::move(lower);
        result.state.effort = effort;
        if (!result.converged) break;
        known = tangents_.know(result.state);
    }
    const State& next = result.state;
    // Where the branch begins at the critical load, what the energy falls by is the work that it does not take. What
    // else it falls by, at a load at which the bodies snap through, is released.
    const double saved = 0.5 * (1.0 - share) * (dot(d, first.response.conjugate) - dot(d, next.response.conjugate));
    const double drop = energy_of(first) - energy_of(next);
    if (drop - saved > snaps * drop) buckling.released = drop - saved;
    result.state.outcome.buckling = buckling;
    return buckling.modes == 0 ? 0.5 * (dot(d, before.response.conjugate) + dot(d, next.response.conjugate))
                               : 0.5 * (dot(d, before.response.conjugate) + dot(d, first.response.conjugate)) - saved;
}

Stepper::Result TurnedSteps::initial(double time) const {
    bool definite = false;
    Stepper::Result result = iterate(
        {}, begin({}), [&](Stepper& stepper, const State&) { return stepper.initial(time); }, definite);
    if (result.converged && !definite) refuse_buckling(time);
    result.state.free_since = loose_.since(result.state, {});
    return result;
}

// Damage and displacements of the end depend little on how the step has come there, so that this takes one linear step
// or two.
PathWithin TurnedSteps::follow_load(const State& before, double time, Stepper::Result& result) const {
    if (!follows_load(problem_.options) || !result.converged || result.state.adhesion == before.adhesion ||
        linear_.stepper().one_mode(before, result.state))
        return {};
    PathWithin within;
    const Solve solve = [&](Stepper& stepper, const State& from) {
        return follow_within(stepper, graph_, from, time, problem_.options, within);
    };
    try {
        bool definite = false;
        Stepper::Result followed = iterate(before, at_rest(result.state), solve, definite);
        Effort effort = result.state.effort;
        effort.add(followed.state.effort);
        const bool kept = followed.converged && definite;
        if (kept) result = std::move(followed);
        result.state.effort = effort;
        return kept ? within : PathWithin{};
    } catch (const Error& error) {
        if (!unstable(error)) throw;
        return {};  // the step stays whole
    }
}

TurnedSteps::Begin TurnedSteps::at_rest(const State& balance) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    return {balance.response.multipliers,
            balance.response.force,
            {tangents_.point_at(balance), tangents_.memory_of(balance).of_operator},
            true,
            none,
            none};
}

Stepper::Result TurnedSteps::lowest_state(const State& before, double time, double stride, Stepper::Result best) const {
    const LowerStates states{[&](const State& balance) {
                                 const Begin from = at_rest(balance);
                                 const State start = extended(before, problem_.patterns.size());
                                 const Stepper::Start own(balance, false);
                                 Stepper& stepper = linear_.about(from.memory.point, from.displacement, from.row_force);
                                 return linear_.searching([&] { return stepper.step(start, time, {&own, 1}, stride); });
                             },
                             [&](const State& balance, const Stepper::Start& start) {
                                 const Solve solve = [&](Stepper& stepper, const State& from) {
                                     return stepper.step(from, time, {&start, 1}, stride);
                                 };
                                 bool definite = false;
                                 return iterate(before, at_rest(balance), solve, definite);
                             }};
    const Options& options = problem_.options;
    const State local = best.state;
    Stepper::Result lowest =
        states.lowest(std::move(best), options.limits.minimise_energy_rounding, options.damage_tolerance);
    if (moves_far(pairs_, graph_, local, lowest.state))
        lowest.state.jump_within = jump_to_lower(pairs_, local, lowest.state);
    return lowest;
}

// The work of the reactions by the trapezoidal rule. The estimate follows from the true energy: with R = dE/dtheta and
// its change C at fixed adhesion, E(theta_k, .) - E(theta_k-1, .) is R_k d - 1/2 d C_k d at the adhesion after the step
// and R_k-1 d + 1/2 d C_k-1 d at the one before, to third order in d.
Stepper::Result TurnedSteps::step(const State& before, double time, double stride) const {
    const std::vector<double> d = difference(problem_.factors(time), before.theta);
    Known known = known_ && known_->of(before) ? std::move(*known_) : tangents_.know(before);
    known_.reset();
    const double upper_change = half_square(known.tangent, d);
    const Solve solve = [&](Stepper& stepper, const State& from) { return stepper.step(from, time, {}, stride); };
    bool definite = false;
    Stepper::Result result = iterate(before, begin(before), solve, definite);
    PathWithin within = follow_load(before, time, result);
    if (problem_.options.solution == "energetic") result = lowest_state(before, time, stride, std::move(result));
    known = tangents_.know(result.state);
    double work = 0.5 * (dot(d, before.response.conjugate) + dot(d, result.state.response.conjugate));
    if (result.converged && !known.stable()) work = leave_unstable(before, solve, result, known);
    if (result.state.outcome.buckling.modes > 0) within = {};  // the path led to the state that has been left
    work += within.beyond;
    State& next = result.state;
    next.memory = TurnedMemory{known.about, tangents_.memory_of(next).of_operator}.numbers();
    const double lower_change = half_square(known.tangent, d);
    const std::unique_ptr<StepRule> rule = linear_.stepper().increment(before, before.mixity);
    next.step = before.step + 1;
    next.free_since = loose_.since(next, before);
    next.history.revised_from = next.step;
    next.mixity_before = before.mixity;
    Ledger& ledger = next.ledger;
    ledger.increment_lower -= ledger.increment;
    ledger.increment = ledger.energy() - before.ledger.energy() + ledger.dissipated - before.ledger.dissipated;
    ledger.increment_lower += ledger.increment;
    ledger.lower = dot(d, next.response.conjugate) - lower_change;
    ledger.upper = dot(d, before.response.conjugate) + upper_change;
    if (next.adhesion == before.adhesion) ledger.lower = ledger.upper = ledger.increment;
    // The tangent after the step is that of another branch.
    if (next.outcome.buckling.modes > 0) ledger.lower = ledger.increment;
    // A state that is as high at the load before as the one before may have come about without a release: what the
    // trapezoidal rule leaves open then is its own error.
    const bool falls = ledger.increment < ledger.lower && damages_abruptly(*rule, next.adhesion);
    next.outcome.released =
        falls ? std::max(0.0, work - ledger.increment) : within.released + next.outcome.buckling.released;
    ledger.work = before.ledger.work + work;
    ledger.released = before.ledger.released + next.outcome.released;
    known_ = std::move(known);
    return result;
}

Stepper::Result TurnedSteps::equilibrate(const State& before, double time, std::span<const double> adhesion) const {
    const State own = extended(before, problem_.patterns.size());
    bool definite = false;
    Stepper::Result result = iterate(
        before, begin(before), [&](Stepper& stepper, const State&) { return stepper.equilibrate(own, time, adhesion); },
        definite);
    if (result.converged && !definite) refuse_buckling(time);
    result.state.free_since = loose_.since(result.state, before);
    // The cumulative columns count from the state that is set.
    Ledger& ledger = result.state.ledger;
    ledger.initial = before.ledger.initial + ledger.energy() - before.ledger.energy();
    ledger.initial_linear = before.ledger.initial_linear + ledger.energy_linear() - before.ledger.energy_linear();
    return result;
}

std::vector<double> TurnedSteps::tangent(const State& state) const { return tangents_.of_loads(state); }

std::vector<double> TurnedSteps::step_tangent(const State& before, const State& state) const {
    return tangents_.of_step(before, state);
}

void delegate_to_turned_steps(Stepper& stepper, const Problem& problem, Monitor& monitor) {
    auto op = std::make_unique<TurnedOperator>(problem, [&monitor] { monitor.progress("assemble", 0, 0); });
    auto steps = std::make_unique<const TurnedSteps>(problem, monitor, *op, stepper.pairs(), stepper.contact());
    stepper.delegate(std::move(op), std::move(steps));
}

}  // namespace delam
