// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/operator/jump_operator.hpp"

namespace delam {

IteratedZone::IteratedZone(BodySolver& solver, const Options& options)
    : solver_(solver),
      limits_(options.limits),
      tolerance_(std::clamp(limits_.sparse_part_of_tolerance * options.damage_tolerance, limits_.sparse_finest,
                            limits_.sparse_coarsest)),
      jump_rows_(solver.system().rows().size()) {
    std::iota(jump_rows_.begin(), jump_rows_.end(), std::int64_t{0});
}

void IteratedZone::begin_model() {
    before_ = model_;
    model_ = {-1.0, 0.0};
}

void IteratedZone::forget_models() { model_ = before_ = {}; }

void IteratedZone::ask_for_energies(double allowed) {
    forget_models();
    allowed_ = allowed;
    solver_.compare_energies(allowed > 0.0);
}

bool IteratedZone::factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) {
    const std::span<const std::uint8_t> prescribed = solver_.system().rows().prescribed();
    std::vector<Coupling> acting;
    for (const Coupling& c : couplings)
        if (prescribed[index(c.row)] == 0 || prescribed[index(c.column)] == 0) acting.push_back(c);
    return solver_.set(std::move(acting), held);
}

void IteratedZone::move(std::span<const double> combination, std::span<double> unknowns) const {
    solver_.move(solver_.floating().rigid_displacement(combination), combination, unknowns);
}

Zone::Solution IteratedZone::solve(std::span<const double> theta, std::span<const double> row_force) {
    Solution solution;
    solution.unknowns = start_;
    // As much as the model before has missed of the bodies' answer (S. Eisenstat, H. Walker, SIAM J. Sci. Comput. 17,
    // 1996, choice 1).
    const BodySolver::Forcing forcing = [this](double first) {
        if (model_.begun == 0.0) return std::sqrt(2.0 * limits_.sparse_foreseen * allowed_);
        if (model_.begun < 0.0) {
            model_.begun = first;
            const double missed =
                before_.begun > 0.0 ? std::abs(first - before_.left) / before_.begun : limits_.sparse_most_of_model;
            part_ = std::clamp(missed, limits_.sparse_least_of_model, limits_.sparse_most_of_model);
        }
        return part_ * model_.begun;
    };
    const BodySolver::Answer answer = solver_.solve(theta, row_force, tolerance_, solution.unknowns, forcing);
    model_.left = answer.norm;
    solution.left = answer.residual > tolerance_ && model_.begun > 0.0 ? model_.left / model_.begun : 0.0;
    solution.balanced = answer.balanced;
    solution.definite = answer.definite;
    solution.iterations = answer.iterations;
    solution.converged = answer.converged;
    if (!solution.balanced || !solution.definite || !solution.converged) return solution;
    std::vector<double> jump = jumps(theta, solution.unknowns), force(jump.size(), 0.0);
    for (std::size_t r = 0; r < row_force.size(); ++r) force[r] = -row_force[r];
    for (const Coupling& c : solver_.system().couplings()) force[index(c.row)] += c.value * jump[index(c.column)];
    solver_.held_forces(theta, solution.unknowns, force);
    solution.multiplier.assign(force.size(), 0.0);
    for (std::size_t r = 0; r < force.size(); ++r)
        if (solver_.system().held()[r] != 0) solution.multiplier[r] = force[r];
    solution.error = answer.error;
    if (allowed_ > 0.0) solution.energy_error = answer.energy_error;
    start_ = solution.unknowns;
    return solution;
}

void IteratedZone::start_anew() {
    start_.clear();
    rounding_ = -1.0;
    allowed_ = 0.0;
    solver_.compare_energies(false);
}

std::vector<double> IteratedZone::unknowns_at(std::span<const double>, const Response& response) {
    rounding_ = -1.0;
    start_ = response.multipliers;
    start_.resize(index(solver_.state_size()), 0.0);
    return start_;
}

void IteratedZone::keep(std::span<const double> unknowns, Response& response) const {
    response.multipliers.assign(unknowns.begin(), unknowns.end());
}

std::vector<double> IteratedZone::jumps(std::span<const double> theta, std::span<const double> unknowns) const {
    std::vector<double> j = solver_.system().rows().offsets(theta);
    for (std::size_t r = 0; r < j.size(); ++r) j[r] += solver_.system().rows().value(r, unknowns);
    return j;
}

void IteratedZone::complete_forces(std::span<const double>, const Solution& solution,
                                   std::span<double> row_force) const {
    for (std::size_t r = 0; r < row_force.size(); ++r)
        if (solver_.system().held()[r] != 0) row_force[r] = solution.multiplier[r];
}

double IteratedZone::energy_of(std::span<const double> theta, std::span<const double> unknowns) {
    const BodySolver::Work work = solver_.work(theta, unknowns);
    double energy = work.strain;
    for (std::size_t p = 0; p < theta.size(); ++p) energy -= theta[p] * work.done[p];
    if (rounding_ < 0.0) rounding_ = energy != 0.0 ? std::min(1e-6, solver_.energy_rounding(theta, unknowns)) : 0.0;
    return energy;
}

double IteratedZone::energy_rounding() const { return std::max(1e-14, rounding_) + tolerance_ * tolerance_; }

}  // namespace delam
