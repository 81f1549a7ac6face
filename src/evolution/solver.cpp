// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/solver.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "interface/contact_levels.hpp"

namespace delam {

Solver::Solver(const Problem& problem, Monitor& monitor, double time) : problem_(problem), monitor_(monitor) {
    validate(problem_);
    const Mesh& mesh = *problem_.mesh;
    pairs_.dimension = contact_.dimension = mesh.dimension();
    contact_.limit = problem_.options.contact_limit;
    contact_.always = problem_.options.contact == "always";
    for (std::size_t i = 0; i < mesh.interfaces().size(); ++i) {
        const InterfaceProperties& properties = problem_.interfaces[i];
        std::optional<Toughness> fixed;
        if (!properties.bonded && problem_.options.mixity == "auto" && !properties.law->depends_on_mixity()) fixed = properties.law->toughness(0.0);
        for (const double weight : mesh.interfaces()[i].weight) {
            pairs_.weight.push_back(weight);
            pairs_.law.push_back(properties.bonded ? nullptr : &*properties.law);
            pairs_.fixed.push_back(fixed);
            contact_.bonded.push_back(properties.bonded ? 1 : 0);
        }
        initial_adhesion_.insert(initial_adhesion_.end(), properties.adhesion.begin(), properties.adhesion.end());
    }
    contact_.level = contact_levels(mesh.interfaces());
    ChosenOperator chosen = choose_operator(problem_, monitor_);
    operator_ = std::move(chosen.op);
    reduction_ = std::move(chosen.choice);
    std::vector<std::uint8_t> bonded_rows;
    for (const std::uint8_t b : contact_.bonded) bonded_rows.insert(bonded_rows.end(), static_cast<std::size_t>(mesh.dimension()), b);
    lift_ = Lift(*operator_, bonded_rows, bound_rows(problem_), problem_.patterns.size());
    double largest = 0.0;
    for (const double c : problem_.prescribed_matrix()) largest = std::max(largest, std::abs(c));
    for (const std::size_t row : lift_.driven_rows(1e-9 * largest)) {
        const std::size_t pair = row / static_cast<std::size_t>(mesh.dimension());
        if (contact_.bonded[pair] != 0)
            fail(DELAM_ERROR_PROBLEM, "prescribed displacements tear pair ", pair, " apart, whose interface is bonded for ever");
    }

    State& state = committed_;
    state.time = time;
    state.theta = problem_.factors(time);
    state.adhesion = initial_adhesion_;
    // A notch starts closed: that is where it stays unless something opens it.
    for (std::size_t p = 0; p < state.adhesion.size(); ++p)
        state.closed.push_back(contact_.bonded[p] == 0 && state.adhesion[p] == 0.0 && operator_->prescribed_rows()[p * static_cast<std::size_t>(mesh.dimension())] == 0 ? 1 : 0);
    if (!minimiser().displace(state)) initial_outcome_ = unconverged_displacement(state);
    state.mixity = mixities(pairs_, state.response.jump, std::vector<double>(state.adhesion.size(), 0.0));
    state.mixity_before = state.mixity;
    state.loaded = any_jump(pairs_, state.response.jump) ? 1 : 0;
    book_energies(state);
    state.ledger.initial = state.ledger.energy();
    state.ledger.initial_slides = state.ledger.energy_slides();
    state.memory = operator_->memory();
}

Outcome Solver::unconverged_displacement(const State& state) const {
    return {DELAM_NOT_CONVERGED,
            text("displacement step at time ", state.time, ": worst linear residual ", state.counts.linear_residual, ", tolerance ",
                 problem_.options.linear_tolerance, "; ", state.counts.contact_iterations, " active-set steps")};
}

Minimiser Solver::minimiser() const {
    return {*operator_, pairs_, contact_, monitor_, problem_.options.damage_tolerance, problem_.options.minimisation_limit,
            mixity_rule(pairs_, problem_.options.mixity_rule)};
}

void Solver::begin(State& next, double time) const {
    if (pending_) fail(DELAM_ERROR_STATE, "a step is pending: commit it or roll it back first");
    if (!std::isfinite(time)) fail(DELAM_ERROR_ARGUMENT, "time is not finite");
    next.time = time;
    next.theta = problem_.factors(time);
    next.counts = Counts{};
    operator_->recall(committed_.memory);
}

// Energies of a state at its own mixity; cumulative columns are not touched.
void Solver::book_energies(State& state) const {
    Ledger& ledger = state.ledger;
    ledger.stored_bulk = state.response.stored_bulk;
    ledger.load_potential = state.response.load_potential;
    ledger.stored_interface = stored_energy(pairs_, state.adhesion, state.response.jump);
    ledger.stored_interface_slides = ledger.stored_interface + stored_slides(pairs_, state.mixity, state.adhesion);
}

void Solver::book_step(State& next) const {
    const State& last = committed_;
    book_energies(next);
    Ledger& ledger = next.ledger;
    const double dissipated = dissipation(pairs_, next.mixity, last.adhesion, next.adhesion);
    const double dissipated_before = dissipation(pairs_, next.mixity_before, last.adhesion, next.adhesion);
    const double change = ledger.energy() - last.ledger.energy();
    ledger.increment = change + dissipated;
    ledger.increment_lower = change + dissipated_before;
    std::vector<double> d(next.theta.size());
    for (std::size_t p = 0; p < d.size(); ++p) d[p] = next.theta[p] - last.theta[p];
    ledger.lower = dot(d, next.response.conjugate) - lift_.half_quadratic(d, spring_stiffness(pairs_, next.adhesion));
    ledger.upper = dot(d, last.response.conjugate) + lift_.half_quadratic(d, spring_stiffness(pairs_, last.adhesion));
    ledger.work = last.ledger.work + 0.5 * (ledger.lower + ledger.upper);
    ledger.dissipated = last.ledger.dissipated + dissipated;
    ledger.dissipated_slides = last.ledger.dissipated_slides;
    if (minimiser().rule != MixityRule::variational) {
        ledger.dissipated_slides += dissipation_slides(pairs_, next.mixity, last.adhesion, next.adhesion);
        return;
    }
    // What was minimised is the slides' split, with the dissipation at the mixity of the state before.
    const double change_slides = ledger.energy_slides() - last.ledger.energy_slides();
    const double spent = dissipation_slides(pairs_, next.mixity_before, last.adhesion, next.adhesion);
    const std::vector<double>& before_last = last.loaded != 0 ? last.mixity_before : next.mixity_before;
    ledger.dissipated_slides += spent;
    ledger.increment = change_slides + spent;
    ledger.increment_lower = change_slides + dissipation_slides(pairs_, before_last, last.adhesion, next.adhesion);
}

Outcome Solver::advance(double time) {
    State next = committed_;
    begin(next, time);
    if (time <= committed_.time)
        fail(DELAM_ERROR_ARGUMENT, "time ", time, " is not after the committed time ", committed_.time);
    ++next.step;
    bool converged = true;
    if (committed_.loaded == 0) {
        // Before the first load there is no jump to take the mixity from: the elastic solution of this step gives it.
        State elastic = next;
        converged = minimiser().displace(elastic, true);
        next.counts = elastic.counts;
        next.mixity = mixities(pairs_, elastic.response.jump, committed_.mixity);
        next.mixity_before = next.mixity;
        next.response = std::move(elastic.response);
        next.closed = std::move(elastic.closed);
    } else {
        next.mixity_before = committed_.mixity;
        next.mixity = starting_mixity(pairs_, minimiser().rule, committed_);
    }
    if (minimiser().rule == MixityRule::variational) next.mixity_before = next.mixity;
    converged = (problem_.options.minimisation == "alternate" ? minimiser().alternate(next, committed_.adhesion)
                                                             : minimiser().accelerate(next, committed_.adhesion)) && converged;
    warn_of_snap(monitor_, minimiser().rule, next);
    next.loaded = committed_.loaded != 0 || any_jump(pairs_, next.response.jump) ? 1 : 0;
    book_step(next);
    next.memory = operator_->memory();
    Outcome outcome;
    if (!converged) {
        outcome.status = DELAM_NOT_CONVERGED;
        outcome.text = text("step ", next.step, " at time ", time, ": not converged after ", next.counts.am_iterations,
                            " alternations (last change of adhesion ", next.counts.damage_change, ", tolerance ",
                            problem_.options.damage_tolerance, "; worst linear residual ", next.counts.linear_residual,
                            ", tolerance ", problem_.options.linear_tolerance, ")");
        if (next.counts.mixity_held > 0)
            outcome.text += text("; the mixity of ", next.counts.mixity_held, " pairs would not settle and was held");
    }
    displacement_.clear();
    pending_ = std::move(next);
    return outcome;
}

Outcome Solver::equilibrate(double time, std::span<const double> adhesion) {
    State next = committed_;
    begin(next, time);
    if (!adhesion.empty()) next.adhesion.assign(adhesion.begin(), adhesion.end());
    for (std::size_t p = 0; p < next.adhesion.size(); ++p)
        if (!(next.adhesion[p] >= 0.0 && next.adhesion[p] <= 1.0))
            fail(DELAM_ERROR_ARGUMENT, "adhesion of pair ", p, " is ", next.adhesion[p], ", allowed: 0 to 1");
    Outcome outcome;
    if (!minimiser().displace(next)) outcome = unconverged_displacement(next);
    if (minimiser().rule == MixityRule::variational) next.mixity = mixities(pairs_, next.response.jump, next.mixity);
    book_energies(next);
    next.ledger.initial += next.ledger.energy() - committed_.ledger.energy();
    next.ledger.initial_slides += next.ledger.energy_slides() - committed_.ledger.energy_slides();
    next.memory = operator_->memory();
    displacement_.clear();
    pending_ = std::move(next);
    return outcome;
}

void Solver::commit() {
    if (!pending_) fail(DELAM_ERROR_STATE, "nothing to commit: no step is pending");
    committed_ = std::move(*pending_);
    pending_.reset();
}

void Solver::rollback() {
    if (!pending_) fail(DELAM_ERROR_STATE, "nothing to roll back: no step is pending");
    pending_.reset();
    displacement_.clear();
}

void Solver::restore(State restored) {
    operator_->recall(restored.memory);
    committed_ = std::move(restored);
    pending_.reset();
    displacement_.clear();
}

const std::vector<double>& Solver::displacement() const {
    if (displacement_.empty()) displacement_ = operator_->displacement(state().theta, state().response);
    return displacement_;
}

double Solver::equilibrium_defect() const {
    double reaction = 0.0;
    for (const double r : this->reaction()) reaction = std::max(reaction, std::abs(r));
    const double defect = operator_->equilibrium_defect(state().theta, state().response);
    return reaction > 0.0 ? defect / reaction : defect;
}

}  // namespace delam
