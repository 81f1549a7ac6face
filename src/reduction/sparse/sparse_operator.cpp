// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/sparse_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/operator/body_reactions.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

namespace {

// A start larger than the load by 2^900 is not used: it would hardly be finite.
constexpr int largest_start_power = 900;

bool any_of(std::span<const double> values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
}

}  // namespace

SparseOperator::SparseOperator(const Problem& problem, Monitor& monitor, std::unique_ptr<BodySystem> bodies,
                               const SolverOf& solver)
    : problem_(problem),
      monitor_(monitor),
      bodies_(std::move(bodies)),
      strain_energy_(bodies_->find_loads().energy),
      own_(solver(*bodies_)),
      solver_(*own_) {}

SparseOperator::~SparseOperator() = default;

// Loads of any size: what is solved has its largest force between 1/2 and 1.
void SparseOperator::solve(const Springs& springs, std::span<const double> theta, Response& response) {
    monitor_.progress("displacement", 0, 0);
    if (zone_ != nullptr) zone_->forget_models();
    const JumpSystem& system = solver_.system();
    std::vector<Zone::Coupling> couplings;
    std::vector<std::uint8_t> held(springs.held);
    std::vector<double> pulled(springs.force);
    for (std::size_t r = 0; r < held.size(); ++r) {
        if (system.rows().prescribed()[r] != 0) {  // constant: no variable, whether held or not
            held[r] = 0;
            if (!pulled.empty()) pulled[r] = 0.0;
        } else if (held[r] == 0 && springs.stiffness[r] > 0.0) {
            couplings.push_back({static_cast<std::int64_t>(r), static_cast<std::int64_t>(r), springs.stiffness[r]});
        }
        if (!pulled.empty() && held[r] != 0) pulled[r] = 0.0;
    }
    const double load = solver_.load_size(theta);
    std::vector<double> moved = system.rows().offsets(theta);
    for (std::size_t e = 0; e < system.rows().equations().size(); ++e)
        moved.push_back(dot(system.rows().equation_right(e), theta));
    // Without a load nothing moves, exactly.
    bool loaded = load > 0.0 || any_of(pulled) || any_of(moved);
    for (std::size_t p = 0; p < theta.size(); ++p)
        loaded = loaded || (theta[p] != 0.0 && any_of(bodies_->variables().lift[p]));
    if (!loaded) {
        rest(springs, theta, response);
        // Supports may carry dead forces all the same.
        find_energies(theta, std::vector<double>(system.rows().equations().size(), 0.0), response);
        return;
    }
    if (!solver_.set(std::move(couplings), held))
        fail(DELAM_ERROR_NUMERICAL, "the stiffness of a part of the bodies is not positive definite");
    int power = exponent(std::max(load, max_abs(pulled)));
    if (power == 0) power = exponent(max_abs(moved));
    std::vector<double> unit(theta.begin(), theta.end()), x = std::move(response.multipliers);
    scale_by_power(unit, -power);
    scale_by_power(pulled, -power);
    if (exponent(max_abs(x)) - power > largest_start_power) x.clear();
    scale_by_power(x, -power);
    const BodySolver::Answer answer = solver_.solve(unit, pulled, tolerance(), x);
    response.balanced = answer.balanced;
    response.iterations = answer.iterations;
    response.residual = answer.residual;
    response.converged = answer.converged && answer.definite;
    scale_by_power(x, power);
    response.multipliers = std::move(x);
    response.error = {};
    if (!response.balanced) return;
    // An engine that finds the matrix indefinite leaves no state.
    if (!answer.definite && response.multipliers.size() != index(solver_.state_size()))
        fail(DELAM_ERROR_NUMERICAL, "the stiffness of the bodies is not positive definite");
    respond(springs, theta, response);
    response.error = {std::ldexp(answer.error.jump, power), std::ldexp(answer.error.force, power)};
}

bool SparseOperator::aim(Accuracy accuracy) {
    accuracy_ = accuracy;
    return tolerance() != std::max(problem_.options.linear_tolerance, BodySolver::finest);
}

double SparseOperator::tolerance() const {
    const double usual = problem_.options.linear_tolerance;
    if (accuracy_ == Accuracy::rough) return std::max(usual, problem_.options.limits.sparse_rough);
    return accuracy_ == Accuracy::tight ? BodySolver::finest : std::max(usual, BodySolver::finest);
}

void SparseOperator::rest(const Springs& springs, std::span<const double> theta, Response& response) const {
    response = {};
    response.jump.assign(springs.stiffness.size(), 0.0);
    response.force.assign(springs.stiffness.size(), 0.0);
    response.conjugate.assign(theta.size(), 0.0);
    response.multipliers.assign(index(solver_.state_size()), 0.0);
}

void SparseOperator::respond(const Springs& springs, std::span<const double> theta, Response& response) const {
    const JumpSystem& system = solver_.system();
    const std::vector<double>& x = response.multipliers;
    const std::size_t rows = springs.stiffness.size();
    const std::vector<double> offset = system.rows().offsets(theta);
    response.jump.assign(rows, 0.0);
    response.force.assign(rows, 0.0);
    for (std::size_t r = 0; r < rows; ++r) {
        if (springs.held[r] != 0) {
            response.jump[r] = system.rows().prescribed()[r] != 0 ? 0.0 : held_jump(system.rows()[r], offset[r], x);
            continue;
        }
        response.jump[r] = offset[r] + system.rows().value(r, x);
        response.force[r] = springs.stiffness[r] * response.jump[r];
        if (!springs.force.empty()) response.force[r] -= springs.force[r];
    }
    const std::vector<double> mu = solver_.held_forces(theta, x, response.force);
    response.rigid.clear();
    response.support = {};
    find_energies(theta, mu, response);
}

// Computes the energies from the displacements: a stored energy is a sum of squares, and its error is that of the
// solution squared.
void SparseOperator::find_energies(std::span<const double> theta, std::span<const double> mu,
                                   Response& response) const {
    const std::size_t patterns = theta.size();
    const BodySolver::Work work = solver_.work(theta, response.multipliers);
    response.stored_bulk = work.strain;
    response.load_potential = 0.0;
    response.conjugate.assign(patterns, 0.0);
    const JumpRows& rows = solver_.system().rows();
    for (std::size_t p = 0; p < patterns; ++p) {
        double q = work.lifted[p] - work.done[p];
        double strained = 0.0;
        for (std::size_t k = 0; k < patterns; ++k) strained += strain_energy_[p * patterns + k] * theta[k];
        q += strained;
        for (std::size_t r = 0; r < rows.size(); ++r)
            if (!rows[r].offset.empty()) q += rows[r].offset[p] * response.force[r];
        for (std::size_t e = 0; e < mu.size(); ++e) q -= solver_.system().rows().equation_right(e)[p] * mu[e];
        response.conjugate[p] = q;
        if (problem_.patterns[p].drives == Pattern::Drives::force)
            response.load_potential -= theta[p] * work.done[p];
        else
            response.stored_bulk += theta[p] * (0.5 * strained - work.done[p]);
    }
    // Strains that can freely follow an eigenstrain store only the rounding of terms that cancel.
    if (!problem_.eigenstrains.empty()) response.stored_bulk = std::max(0.0, response.stored_bulk);
}

Zone* SparseOperator::zone(const Springs&, std::span<const std::uint8_t>, bool) {
    if (zone_ == nullptr) zone_ = std::make_unique<IteratedZone>(solver_, problem_.options);
    zone_->start_anew();
    return zone_.get();
}

// K u of a response, and u where it is wanted.
std::vector<double> SparseOperator::stressed(std::span<const double> theta, const Response& response,
                                             std::vector<double>& displacement) const {
    poll_cancel("recover", bodies_->dofs() / 64);
    std::vector<double> force;
    solver_.recover(theta, response.multipliers, displacement, force);
    return force;
}

std::vector<double> SparseOperator::displacement(std::span<const double> theta, const Response& response) const {
    std::vector<double> u;
    (void)stressed(theta, response, u);
    return u;
}

std::vector<double> SparseOperator::reaction(std::span<const double> theta, const Response& response) const {
    std::vector<double> u;
    return body_reactions(*bodies_, theta, stressed(theta, response, u), response.force);
}

double SparseOperator::equilibrium_defect(std::span<const double> theta, const Response& response) const {
    std::vector<double> u;
    return delam::equilibrium_defect(*bodies_, theta, stressed(theta, response, u), response.force);
}

void SparseOperator::move(std::span<const double> displacement, std::span<const double> combination,
                          std::span<const double> jump, Response& response) const {
    JumpOperator::move(displacement, combination, jump, response);
    solver_.move(displacement, combination, response.multipliers);
}

std::vector<double> SparseOperator::row_stiffness() const {
    const JumpSystem& system = solver_.system();
    std::vector<double> stiffness(system.rows().size(), 0.0);
    for (std::size_t r = 0; r < stiffness.size() && !system.diagonal().empty(); ++r)
        if (system.rows().prescribed()[r] == 0) stiffness[r] = row_diagonal(system, r);
    return stiffness;
}

// Estimates the rounding as the condensed operator does: entries of the stiffness have an error of the rounding unit
// times the diagonal.
double SparseOperator::rounding_energy(std::span<const double>, const Response& response) const {
    const std::span<const double> diagonal = solver_.system().diagonal();
    const std::vector<double>& x = response.multipliers;
    double sum = 0.0;
    const std::size_t first = diagonal.size() - index(bodies_->variables().trailing());
    for (std::size_t i = first; i < diagonal.size(); ++i) sum += diagonal[i] * x[i] * x[i];
    return std::numeric_limits<double>::epsilon() * sum;
}

}  // namespace delam
