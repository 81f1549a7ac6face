// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/derivative/step_tangent.hpp"
#include "evolution/increment/unstrained.hpp"
#include "evolution/minimise/proportional_loads.hpp"
#include "evolution/step/contact_work.hpp"
#include "evolution/step/energetic_jump.hpp"
#include "evolution/step/pairs_of_scene.hpp"
#include "scene/check/validate.hpp"

namespace delam {

namespace {

// Measured by verify/bench/constants.py with verify/cases/search/energetic.py. Candidates from which a step is
// minimised (half and twice end in the same states, with 0.49 and 1.56 times the solves).
constexpr std::size_t most_starts = 2;
// As `promising`, for following the path to a candidate, whose energy is an estimate (half and twice change nothing).
constexpr double promising_way = 0.05;
// Parts by which the square of the load grows where fronts are continued, first and then; half and twice of both move
// the energies of two analyses in mixed mode by 4e-5 and 1.5e-4, with 1.07 and 0.96 times the solves.
constexpr double least_overload = 0.02, overload_growth = 0.04, most_overload = 4.0;
// Fronts are continued until by `beyond` more is dissipated than down to a candidate (half and twice end in the same
// states, with 1.00 and 1.03 times the solves), or until, after `first_part` of that, the energy is `too_high` of the
// dissipated one above the step's.
constexpr double beyond = 0.2, too_high = 0.25, first_part = 0.1;
// Error of the toughness of a pair whose mixity is held, over the accuracy of what dissipates. (Measured by
// verify/cases/load_path/settling.py: half and twice change no printed energy, and take 675 and 621 alternations.)
constexpr double held_of_accuracy = 0.1;

// Returns what a step has cost the pairs that it broke; none, where that is not known.
PathCosts costs_of(const PairLaws& pairs, std::span<const double> along, const State& state) {
    if (along.empty()) return {};
    std::vector<std::uint8_t> broken = adhering_pairs(pairs, state.adhesion, toughnesses(pairs, state.mixity));
    for (std::uint8_t& b : broken) b = b == 0 ? 1 : 0;
    return {{along.begin(), along.end()}, std::move(broken)};
}

}  // namespace

Stepper::Stepper(const Problem& problem, Monitor& monitor, Checks checks, const Stepper* other)
    : problem_(problem), monitor_(monitor) {
    const Poll checking = [this] { monitor_.progress("check", 0, 0); };
    if (checks == Checks::made_here) validate(problem_, checking);
    parts_ = std::make_unique<const FreeParts>(problem_);
    pairs_ = pair_laws(problem_);
    contact_ = contact_scene(problem_, *parts_);
    for (const InterfaceProperties& own : problem_.interfaces)
        initial_adhesion_.insert(initial_adhesion_.end(), own.adhesion.begin(), own.adhesion.end());
    graph_ = PairGraph(problem_.mesh->interfaces());
    rule_.emplace(pairs_, problem_.options.mixity_rule);
    call_if_set(checking);
    design_ = other ? design_operator(problem_, monitor_, other->design_) : design_operator(problem_, monitor_);
    if (problem_.options.kinematics != "linear") {
        // Bodies that rotate have no operator that would hold in all steps (turned_steps.hpp).
        design_ = Design(std::move(design_.choice));
        return;
    }
    operator_ = build_operator(design_, problem_, monitor_);
    lift();
}

void Stepper::lift() {
    const std::size_t dim = index(problem_.mesh->dimension());
    std::vector<std::uint8_t> bonded_rows;
    for (const std::uint8_t b : contact_.bonded) bonded_rows.insert(bonded_rows.end(), dim, b);
    contact_.row_stiffness.clear();
    contact_.carried_force.clear();
    lift_ = Lift(*operator_, bonded_rows, design_.bound, problem_.patterns.size(),
                 [this](std::span<const double> theta, const Response& response) {
                     if (contact_.row_stiffness.empty()) contact_.row_stiffness = operator_->row_stiffness();
                     contact_.carried_force.push_back(carried_force(problem_, *operator_, contact_, theta, response));
                 });
}

Minimiser Stepper::minimiser() {
    const Options& options = problem_.options;
    return {*operator_,
            contact_,
            monitor_,
            options.limits,
            options.damage_tolerance,
            options.minimisation_limit,
            places_ ? &*places_ : nullptr,
            options.solution == "energetic"};
}

std::unique_ptr<StepRule> Stepper::increment(const State& before, const PairMixities& mixity) const {
    return rule_->increment(pairs_, before, mixity, problem_.options.damage_tolerance);
}

Stepper::Result Stepper::initial(double time) {
    if (other_) return other_->initial(time);
    Result result;
    State& state = result.state;
    state.time = time;
    state.theta = problem_.factors(time);
    state.adhesion = initial_adhesion_;
    // A notch starts closed, and stays closed unless something opens it.
    for (std::size_t p = 0; p < state.adhesion.size(); ++p)
        state.closed.push_back(state.adhesion[p] == 0.0 && contact_.may_close(p, operator_->prescribed_rows()) ? 1 : 0);
    state.mixity = opening(pairs_);
    const Response none;
    places_.emplace(*operator_, state.theta, none, kept_places_);
    result.converged = minimiser().displace(state, *increment(state, state.mixity));
    places_.reset();
    state.mixity = mixities(pairs_, state.response.jump, state.mixity);
    state.mixity_before = state.mixity;
    state.loaded = any_jump(pairs_, state.response.jump) ? 1 : 0;
    drop_rounding(problem_, *operator_, contact_, state);
    record_energies(pairs_, state);
    state.ledger.initial = state.ledger.energy();
    state.ledger.initial_linear = state.ledger.energy_linear();
    state.memory = operator_->memory();
    state.free_since = free_since(*operator_, contact_, pairs_, state, {});
    return result;
}

void Stepper::begin(State& next, const State& before, double time) {
    next.time = time;
    next.theta = problem_.factors(time);
    next.effort = {};
    next.outcome = {};
    next.history = {};
    next.jump_before.clear();
    next.history.revised_from = before.step;
    operator_->recall(before.memory);
}

// The work of the reactions by the trapezoidal rule, which is exact where nothing is damaged. In a step that damages a
// pair abruptly, the part of the work that is neither stored nor dissipated is released, into a motion that a
// quasi-static model does not have. A step that was followed in parts knows when they happen, and records the work of
// the load between them (within_step.hpp).
void Stepper::record_step(State& next, const StepRule& step, const InnerPath* path) const {
    drop_rounding(problem_, *operator_, contact_, next);
    step.record_ledger(next, path != nullptr ? &path->dissipated() : nullptr);
    const State& before = step.before();
    Ledger& ledger = next.ledger;
    std::vector<double> d(next.theta.size());
    for (std::size_t p = 0; p < d.size(); ++p) d[p] = next.theta[p] - before.theta[p];
    const EnergyBounds bounds = step_bounds(lift_, pairs_, before, next, step.quadratic());
    const double work = 0.5 * (dot(d, before.response.conjugate) + dot(d, next.response.conjugate));
    ledger.lower = bounds.lower;
    ledger.upper = bounds.upper;
    next.jump_within = {};
    const std::optional<double> begin = load_ratio(before.theta, next.theta);
    if (path != nullptr && (path->points().size() > 1 || path->started_elsewhere()) && begin && *begin <= 1.0) {
        std::vector<PathPoint> points{path_point(pairs_, graph_, before, 0.0)};
        points.front().energy =
            (points.front().energy - points.front().gradient) / (*begin * *begin) + points.front().gradient;
        for (double& q : points.front().conjugate) q /= *begin;
        points.insert(points.end(), path->points().begin(), path->points().end());
        const WithinStep within = within_step(points, *begin, path->started_elsewhere());
        next.jump_within = within.jump;
        next.jump_within.known = 1;
        next.outcome.released = within.released;
        ledger.work = before.ledger.work + within.work;
        ledger.released = before.ledger.released + within.released;
        return;
    }
    next.outcome.released = damages_abruptly(step, next.adhesion) ? std::max(0.0, work - ledger.increment) : 0.0;
    ledger.work = before.ledger.work + work;
    ledger.released = before.ledger.released + next.outcome.released;
}

InnerPath Stepper::inner_path() {
    return {pairs_, graph_, stride_,
            [this](const State& before, const PairMixities& mixity, double stride) {
                const Options& options = problem_.options;
                return rule_->increment(pairs_, before, mixity,
                                        {options.damage_tolerance, stride, held_of_accuracy * options.accuracy});
            },
            [this](State& state, StepRule& increment, bool displaced) {
                return problem_.options.minimisation == "alternate"
                           ? minimiser().alternate(state, increment, displaced)
                           : minimiser().accelerate(state, increment, displaced);
            }};
}

// Starts from the adhesion and the mixity of `next`.
Stepper::Result Stepper::minimise(State next, const StepRule& step, const Dissipation* begun, bool displaced) {
    InnerPath path = inner_path();
    // A step in several parts at the load of its end turns off the path that has led to its begin.
    const std::span<const double> last = stride_ < 1.0 ? std::span<const double>() : step.before().jump_before;
    const bool converged = step.in_parts() ? path.follow(next, step, begun, {}, displaced, last)
                                           : path.minimise(next, *step.starting_at(next.mixity), displaced);
    refuse_runaway(next, step);
    next.loaded = step.before().loaded != 0 || any_jump(pairs_, next.response.jump) ? 1 : 0;
    record_step(next, step, step.in_parts() ? &path : nullptr);
    next.memory = operator_->memory();
    return {std::move(next), converged, {}, step.in_parts() ? path.dissipated().of_pair : std::vector<double>()};
}

// Beyond the limit of a dead load, alternation takes adhesion to zero by ever smaller steps and displacements to
// infinity: pairs with less than the tolerance left of their toughness do not hold a part. Without them the
// displacement step finds no equilibrium (DELAM_LIMIT).
void Stepper::refuse_runaway(const State& state, const StepRule& step) {
    bool dead = false, faint = false;
    for (std::size_t p = 0; p < state.theta.size(); ++p)
        dead = dead || (problem_.patterns[p].drives == Pattern::Drives::force && state.theta[p] != 0.0);
    State without;
    for (std::size_t p = 0; dead && p < state.adhesion.size(); ++p) {
        if (pairs_.law[p] == nullptr || !(state.adhesion[p] > 0.0) ||
            step.left(p, state.adhesion[p]) > problem_.options.damage_tolerance)
            continue;
        if (!faint) without = state;
        faint = true;
        without.adhesion[p] = 0.0;
    }
    if (!faint) return;
    const std::vector<double> memory = operator_->memory();
    minimiser().displace(without, step);
    operator_->recall(memory);
}

double Stepper::lower_excess(const State& state) const {
    const double scale = state.ledger.scale();
    return scale > 0.0 ? (state.ledger.lower - state.ledger.increment) / scale : 0.0;
}

// No jump gives a mixity before the first load; the elastic solution of the step itself gives it.
bool Stepper::start(State& next, const State& before, double time) {
    next = before;
    begin(next, before, time);
    ++next.step;
    next.history.revised_from = next.step;
    if (before.loaded != 0) {
        rule_->begin(pairs_, before, next);
        return true;
    }
    State elastic = next;
    const bool converged = minimiser().displace(elastic, *increment(before, next.mixity), true);
    next.effort = elastic.effort;
    rule_->begin(pairs_, before, elastic.response, next);
    next.response = std::move(elastic.response);
    next.closed = std::move(elastic.closed);
    return converged;
}

Stepper::Result Stepper::step(const State& before, double time, std::span<const Start> also, double stride) {
    if (other_) return other_->step(before, time, stride);
    stride_ = stride > 0.0 ? stride : problem_.options.path_step;
    places_.emplace(*operator_, before.theta, before.response, kept_places_);
    State first;
    const bool converged = start(first, before, time);
    const std::unique_ptr<StepRule> step = increment(before, first.mixity);
    // Plain alternation solves for the displacements in every step, as the reference solver does.
    const bool displaced = problem_.options.minimisation != "alternate" && step->quadratic() &&
                           (before.loaded == 0 || displaced_in_proportion(*operator_, pairs_, contact_, first, before));
    Result best = minimise(first, *step, nullptr, displaced);
    best.converged = best.converged && converged;
    for (const Start& from : also) {
        State other = first;
        other.effort = best.state.effort;
        bool later = true;  // than the state before, so that the difference was dissipated in between
        for (std::size_t p = 0; p < other.adhesion.size(); ++p) {
            later = later && !(from.adhesion[p] > before.adhesion[p]);
            other.adhesion[p] = std::min(from.adhesion[p], before.adhesion[p]);
        }
        step->adopt(from.mixity, other);
        const Dissipation dissipated{from.dissipated - before.ledger.dissipated,
                                     from.dissipated_linear - before.ledger.dissipated_linear, 0.0};
        keep_lower(best, std::move(other), *step, from.descends && later ? &dissipated : nullptr);
    }
    if (problem_.options.solution == "energetic") search(best, *step);
    best.state.free_since = free_since(*operator_, contact_, pairs_, best.state, before);
    integrate_work(minimiser(), *step, best.state);
    places_.reset();
    if (before.sensitivity.known()) best.state.sensitivity = differentiate(before, best.state, followed_);
    return best;
}

// The mixities of the first loaded step begin as those of its elastic solution, and depend on what that depends on.
Sensitivity Stepper::differentiate(const State& before, const State& state,
                                   std::span<const FollowedParameter> parameters) {
    const std::unique_ptr<StepRule> step = increment(before, state.mixity);
    const auto of = [&](const State& at) { return Linearised(*operator_, pairs_, contact_, at); };
    if (before.loaded != 0) return sensitivity(of(state), parameters, problem_.patterns, step.get());
    State elastic;
    places_.emplace(*operator_, before.theta, before.response);
    start(elastic, before, state.time);
    places_.reset();
    const Sensitivity begun = sensitivity(of(elastic), parameters, problem_.patterns, nullptr);
    return sensitivity(of(state), parameters, problem_.patterns, step.get(), &begun);
}

Sensitivity Stepper::follow(std::vector<FollowedParameter> parameters, const State& initial) {
    if (!increment(initial, initial.mixity)->quadratic())
        fail(DELAM_ERROR_STATE,
             "sensitivities are not followed where the traction depends on the mixity itself (mixity_rule = "
             "variational)");
    followed_ = std::move(parameters);
    return sensitivity(Linearised(*operator_, pairs_, contact_, initial), followed_, problem_.patterns, nullptr);
}

// Minimises from another start and keeps the lower state. All effort is counted.
void Stepper::keep_lower(Result& best, State other, const StepRule& step, const Dissipation* begun) {
    Result found = minimise(std::move(other), step, begun);
    const Effort effort = found.state.effort;
    if (best.state.ledger.undercut_by(found.state.ledger.increment)) best = std::move(found);
    best.state.effort = effort;
}

// The load grows until fronts have run so far that `extent` is dissipated beyond the step's own state. E of a state at
// the load of the step is that at the larger one over the square of their ratio, but for the gradient energy.
Stepper::Continuation Stepper::continue_fronts(Result& best, const StepRule& step, double extent) {
    const State& from = best.state;
    const Ledger &now = from.ledger, &then = step.before().ledger;
    const Dissipation own{now.dissipated - then.dissipated, now.dissipated_linear - then.dissipated_linear,
                          now.mixity_error * (now.dissipated - then.dissipated), best.along};
    Continuation found;
    State at = from;
    Dissipation reached = own;
    for (double square = 1.0 + least_overload; square < most_overload && found.farthest < extent && !found.given_up;
         square *= 1.0 + overload_growth) {
        const State begin = at;
        for (std::size_t p = 0; p < at.theta.size(); ++p) at.theta[p] = from.theta[p] * std::sqrt(square);
        InnerPath path = inner_path();
        try {
            path.follow(
                at, *increment(begin, begin.mixity), &reached, [&](const State& state, const Dissipation& dissipated) {
                    const double gradient = gradient_energy(pairs_, state.adhesion);
                    const double energy = state.response.stored_bulk + state.response.load_potential +
                                          stored_energy(pairs_, state.adhesion, state.response.jump) - gradient;
                    const double incremental = energy / square + gradient - then.energy() + dissipated.recorded;
                    ++found.compared;
                    if (incremental < found.incremental) {
                        found.incremental = incremental;
                        found.state = state;
                        found.dissipated = dissipated;
                    }
                    found.farthest = dissipated.recorded - own.recorded;
                    found.given_up =
                        found.farthest > first_part * extent && incremental > now.increment + too_high * found.farthest;
                    return found.farthest < extent && !found.given_up;
                });
        } catch (const Error& error) {
            // A larger load than the parts can carry.
            if (error.status() != DELAM_LIMIT && error.status() != DELAM_ERROR_NUMERICAL) throw;
            break;
        }
        reached = path.dissipated();
    }
    found.costs = costs_of(pairs_, reached.of_pair, at);
    best.state.effort = at.effort;
    best.state.effort.search_candidates += found.compared;
    return found;
}

// A zone's energy keeps the contact outside as it was, unless a check has shown otherwise, and may be too low.
// Candidates that seem lower than the kept state are therefore compared by displacement steps of their own. Returns the
// lowest candidate, but for those that the step itself has compared (`known`), whose mixities are those of a sharp
// front.
double Stepper::compare_candidates(Result& best, const SearchResult& found, const StepRule& step,
                                   const std::function<bool(const Candidate&)>& known) {
    double lowest = std::numeric_limits<double>::infinity();
    bool compared = false;
    for (const Candidate& candidate : found.starts) {
        if (known(candidate)) {
            compared = true;
            continue;
        }
        const double kept = best.state.ledger.increment;
        if (!best.state.ledger.undercut_by(candidate.incremental))
            return std::min(lowest, compared ? candidate.incremental : found.lowest);
        compared = true;
        State own = best.state;
        own.adhesion = candidate.adhesion;
        own.mixity = candidate.mixity;
        minimiser().displace(own, step);
        own.mixity = step.shown(own.response.jump, std::move(own.mixity));
        record_step(own, step);
        lowest = std::min(lowest, own.ledger.increment);
        best.state.effort = own.effort;
        if (own.ledger.increment < kept) keep_lower(best, std::move(own), step);
    }
    return compared ? lowest : found.lowest;
}

void Stepper::search(Result& best, const StepRule& step) {
    if (!search_) {
        twin_ = operator_->twin();
        search_.emplace(problem_, pairs_, contact_, monitor_, twin_ ? *twin_ : *operator_);
    }
    const State from = best.state;
    const double level = from.ledger.increment;
    const State& before = step.before();
    if (twin_) twin_->recall(before.search_memory);
    SearchResult found = search_->run(step, step, from, step.memory().used);
    if (!twin_) operator_->recall(from.memory);
    const bool one_mode = step.in_parts() && inner_path().one_mode(from, from.mixity, nullptr);
    std::size_t minimised = 0;
    bool followed = false;
    PathCosts costs = costs_of(pairs_, best.along, best.state);
    double lowest = std::numeric_limits<double>::infinity();
    const auto along_path = [&](const Candidate& candidate) {
        return step.in_parts() && !(one_mode && same_toughness(pairs_, candidate, from.adhesion));
    };
    const auto known = [&](const Candidate& candidate) {
        return along_path(candidate) && within_zone(candidate.adhesion, from.adhesion);
    };
    for (const Candidate& candidate : found.starts) {
        const double dissipated = dissipation(pairs_, candidate.mixity, before.adhesion, candidate.adhesion);
        if (minimised == most_starts || followed) break;
        if (candidate.incremental > level + promising * dissipated) continue;
        State other = best.state;
        if (along_path(candidate)) {
            const double own = from.ledger.dissipated - before.ledger.dissipated;
            if (candidate.incremental > level + promising_way * (dissipated - own) || known(candidate)) continue;
            ++minimised;
            const double extent = (1.0 + beyond) * (dissipated - own);
            Continuation continued = continue_fronts(best, step, extent);
            costs = std::move(continued.costs);
            followed = continued.given_up || !(continued.farthest < extent);
            if (followed) {
                lowest = continued.incremental;
                other.effort = best.state.effort;
                other.adhesion = std::move(continued.state.adhesion);
                other.mixity = std::move(continued.state.mixity);
                if (lowest < level + promising_way * continued.farthest)
                    keep_lower(best, std::move(other), step, &continued.dissipated);
                break;
            }
            other.effort = best.state.effort;
        } else {
            ++minimised;
        }
        other.adhesion = candidate.adhesion;
        other.mixity = candidate.mixity;
        keep_lower(best, std::move(other), step);
    }
    if (!followed) lowest = compare_candidates(best, found, step, known);
    if (twin_) best.state.search_memory = twin_->memory();
    best.state.search_energies = std::move(found.energies);
    if (auto jump = energetic_jump(pairs_, graph_, initial_adhesion_, found.profiles, before, best.state))
        best.state.jump_within = std::move(*jump);
    StepOutcome& outcome = best.state.outcome;
    const double kept = best.state.ledger.increment;
    best.state.effort.search_candidates += found.candidates;
    outcome.search_margin = std::isfinite(lowest) ? lowest - kept : 0.0;
    // Candidates under the variational rule have energies at the mixities of the start, which are no bound.
    outcome.search_gap =
        step.bounds_candidates() ? std::max(0.0, kept - found.bound(costs)) : std::numeric_limits<double>::infinity();
    best.searched =
        text("step ", best.state.step, " at time ", best.state.time, ": ", found.candidates,
             " candidates, the step was minimised from ", minimised,
             " of them; energy of the lowest candidate less that of the state kept: ", outcome.search_margin, "\n",
             found.words);
}

Stepper::Result Stepper::equilibrate(const State& before, double time, std::span<const double> adhesion,
                                     std::vector<double> displacement) {
    if (other_) return other_->equilibrate(before, time, adhesion);
    Result result{before, true};
    State& next = result.state;
    begin(next, before, time);
    next.sensitivity = {};
    if (!adhesion.empty()) next.adhesion.assign(adhesion.begin(), adhesion.end());
    for (std::size_t p = 0; p < next.adhesion.size(); ++p)
        if (!(next.adhesion[p] >= 0.0 && next.adhesion[p] <= 1.0))
            fail(DELAM_ERROR_ARGUMENT, "adhesion of pair ", p, " is ", next.adhesion[p], ", allowed: 0 to 1");
    const std::unique_ptr<StepRule> still = increment(before, next.mixity);
    places_.emplace(*operator_, before.theta, before.response, displacement.empty() ? kept_places_ : displacement);
    result.converged = minimiser().displace(next, *still);
    places_.reset();
    next.mixity = still->shown(next.response.jump, std::move(next.mixity));
    drop_rounding(problem_, *operator_, contact_, next);
    record_energies(pairs_, next);
    next.ledger.initial += next.ledger.energy() - before.ledger.energy();
    next.ledger.initial_linear += next.ledger.energy_linear() - before.ledger.energy_linear();
    next.memory = operator_->memory();
    next.free_since = free_since(*operator_, contact_, pairs_, next, before);
    return result;
}

std::vector<double> Stepper::tangent(const State& state) {
    if (other_) return other_->tangent(state);
    return Linearised(*operator_, pairs_, contact_, state).tangent(problem_.patterns, *increment(state, state.mixity));
}

std::vector<double> Stepper::step_tangent(const State& before, const State& state) {
    if (other_) return other_->step_tangent(before, state);
    const std::unique_ptr<StepRule> step = increment(before, state.mixity);
    const std::size_t patterns = problem_.patterns.size();
    // Where several loads give the first mixities, these depend on each of them.
    if (before.loaded == 0 && patterns > 1 && step->quadratic() && !step->in_parts())
        return by_loads(differentiate(before, state, followed_loads(patterns, state.adhesion.size(), 1.0)), patterns);
    return Linearised(*operator_, pairs_, contact_, state).step_tangent(problem_.patterns, *step);
}

}  // namespace delam
