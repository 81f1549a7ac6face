// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/feti_solve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "reduction/feti/projected_cg.hpp"

namespace delam {

namespace {

// A warm start larger than the load by 2^900 is not used: its squares would not be finite.
constexpr int largest_start = 900;

// The force of its own that a spring has.
double pulled(const Springs& springs, std::size_t row) {
    return springs.force.empty() || springs.held[row] != 0 ? 0.0 : springs.force[row];
}

bool any(std::span<const double> values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
}

// A force of its own needs a spring to act on.
void require_springs(const Springs& springs) {
    for (std::size_t i = 0; i < springs.stiffness.size(); ++i)
        if (pulled(springs, i) != 0.0 && !(springs.stiffness[i] > 0.0))
            fail(DELAM_ERROR_NUMERICAL, "interface row ", i, " has a force of its own but no spring");
}

}  // namespace

FetiSolve::FetiSolve(const Problem& problem, Monitor& monitor, DualOperator& dual, const DualLoads& loads,
                     const Springs& springs, std::span<const double> theta)
    : problem_(problem),
      monitor_(monitor),
      dual_(dual),
      loads_(loads),
      theta_(theta.begin(), theta.end()),
      team_(useful_threads(problem.options.threads)) {
    require_springs(springs);
    dual.set(springs);
    load_ = loads.at(theta);
    springs_ = springs;
}

// Conjugate gradients square forces and jumps: at jumps of 1e-170 all energies would be 0, and no residual would ask
// for a force. The problem is linear, so it is solved at a load of size 1; powers of two change no digit. A warm start
// much larger than the load leaves its rounding behind: where that violates the supports or the balance of parts, the
// solve begins with no forces.
void FetiSolve::run(Response& response) {
    std::vector<double> rest(springs_.stiffness.size());
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = dual_.compliance()[i] * pulled(springs_, i);
    const int size = exponent(std::max({max_abs(load_.jump), max_abs(load_.resultant), max_abs(rest)}));
    load_.scale(-size);
    scale_by_power(springs_.force, -size);
    if (exponent(max_abs(response.multipliers)) - size > largest_start) response.multipliers.clear();
    scale_by_power(response.multipliers, -size);
    const bool warm = !response.multipliers.empty();
    solve_unit(response);
    if (warm && (!response.balanced || response.support.violated(problem_.options.linear_tolerance))) {
        response.multipliers.clear();
        solve_unit(response);
    }
    scale_by_power(response.multipliers, size);
    if (!response.balanced) return;
    for (std::vector<double>* result : {&response.rigid, &response.jump, &response.force})
        scale_by_power(*result, size);
    response.support.error = std::ldexp(response.support.error, size);
    response.support.size = std::ldexp(response.support.size, size);
    load_.scale(size);
    find_energies(response.multipliers, response);
}

// Rows whose jump is prescribed have a known force s j: the system is solved without them, and that force is
// divided between spring and constraints afterwards (B_i = sum_k y_k B_k).
void FetiSolve::solve_unit(Response& response) {
    const std::vector<double> right = right_side();
    std::vector<double> lambda = first_guess(right, response);
    const double resultant = max_abs(load_.resultant);
    const double left = dual_.coarse().balance(load_.resultant, lambda, resultant);
    response.balanced = resultant == 0.0 || left <= unbalanced_part;
    if (!response.balanced) return;
    find_forces(resultant, right, lambda, response);
    find_jumps(right, lambda, response);
    share_prescribed(lambda, response);
    response.multipliers = std::move(lambda);
}

// A spring with a force of its own has the rest jump C h.
std::vector<double> FetiSolve::right_side() const {
    std::vector<double> right = load_.jump;
    for (std::size_t i = 0; i < springs_.stiffness.size(); ++i) right[i] -= dual_.compliance()[i] * pulled(springs_, i);
    dual_.mask(right);
    return right;
}

// Without a load nothing moves, exactly; a warm start would leave its rounding behind.
std::vector<double> FetiSolve::first_guess(std::span<const double> right, const Response& response) const {
    const bool loaded = any(load_.resultant) || any(load_.jump) || any(right);
    std::vector<double> lambda = loaded ? response.multipliers : std::vector<double>();
    lambda.resize(right.size(), 0.0);
    for (const Scaling::Prescribed& p : dual_.scaling().prescribed_jumps)
        for (std::size_t i = 0; i < p.row.size(); ++i) lambda[index(p.row[i])] += p.y[i] * lambda[index(p.jump_row)];
    dual_.mask(lambda);
    return lambda;
}

void FetiSolve::find_forces(double resultant, std::span<const double> right, std::span<double> lambda,
                            Response& response) {
    ProjectedSystem system;
    system.apply = [&](std::span<const double> x, std::span<double> y) { dual_.apply(team_, x, y); };
    system.precondition = [&](std::span<const double> r, std::span<double> z) { dual_.precondition(team_, r, z); };
    system.balance = [&](std::span<double> x) { dual_.coarse().balance(load_.resultant, x, resultant); };
    system.project = [&](std::span<double> x) { dual_.coarse().project(x); };
    system.project_transposed = [&](std::span<double> x) {
        dual_.coarse().project_transposed(x);
        dual_.mask(x);
    };
    double size = 0.0;  // energy of the loads if nothing could give way: the scale of rounding
    for (std::size_t i = 0; i < right.size(); ++i) size += dual_.weight()[i] * right[i] * right[i];
    // Eigenstrains that are free to act cancel in B u: their rounding is that of larger numbers.
    const Options& options = problem_.options;
    const double cancelled = problem_.eigenstrains.empty() ? 1.0 : options.limits.feti_eigenstrains;
    const double floor = cancelled * options.limits.feti_rounding * std::sqrt(size);
    const CgResult cg =
        projected_cg(system, right, lambda, {options.linear_tolerance, floor, options.linear_limit, options.limits},
                     [&](std::int64_t iteration) { monitor_.progress("linear solve", iteration, 0); });
    response.iterations = cg.iterations;
    response.residual = cg.residual;
    response.converged = cg.converged;
}

// A lambda - b = G^T alpha, and B u = B K^+ f - F lambda + G^T alpha.
void FetiSolve::find_jumps(std::span<const double> right, std::span<const double> lambda, Response& response) {
    const std::span<const double> compliance = dual_.compliance();
    std::vector<double> f_lambda(right.size()), residual(right.size());
    dual_.flexibility(team_, lambda, f_lambda);
    for (std::size_t i = 0; i < residual.size(); ++i)
        residual[i] = dual_.active(i) ? f_lambda[i] + compliance[i] * lambda[i] - right[i] : 0.0;
    // The second pass removes the rounding of the first: contacts that hold with a short lever move parts far.
    response.rigid = dual_.coarse().rigid_coefficients(residual);
    std::vector<double> rigid_jump = dual_.coarse().apply_transposed(response.rigid);
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= rigid_jump[i];
    add_scaled(1.0, dual_.coarse().rigid_coefficients(residual), response.rigid);
    rigid_jump = dual_.coarse().apply_transposed(response.rigid);
    response.jump.assign(springs_.stiffness.size(), 0.0);
    for (std::size_t i = 0; i < response.jump.size(); ++i) {
        // A stiff spring knows its jump best from its force, a soft one (or none) from the bodies.
        if (!dual_.active(i) || compliance[i] > dual_.flexibility_diagonal()[i])
            response.jump[i] = load_.jump[i] - f_lambda[i] + rigid_jump[i];
        else
            response.jump[i] = compliance[i] * (lambda[i] + pulled(springs_, i));
    }
    response.support = find_support_error(f_lambda, rigid_jump);
}

// B_d u - c, per displacement that the row adds up, so that its units and its number of nodes do not matter.
SupportError FetiSolve::find_support_error(std::span<const double> f_lambda, std::span<const double> rigid_jump) const {
    const SparseMatrix& b = dual_.rows().b;
    const std::int64_t first = dual_.rows().count() - dual_.rows().constraint_count;
    SupportError found;
    for (std::size_t i = 0; i < f_lambda.size() && !std::isnan(found.error); ++i) {
        double sum = 0.0;
        for (std::int64_t e = b.start[i]; e < b.start[i + 1]; ++e) sum += std::abs(b.value[index(e)]);
        if (!(sum > 0.0)) continue;
        const std::int64_t d = static_cast<std::int64_t>(i) - first;
        found.size =
            std::max({found.size, std::abs(load_.jump[i]) / sum, std::abs(f_lambda[i]) / sum,
                      std::abs(rigid_jump[i]) / sum, d < 0 ? 0.0 : std::abs(load_.prescribed[index(d)]) / sum});
        const double error = std::abs(load_.jump[i] - f_lambda[i] + rigid_jump[i]) / sum;
        if (d < 0 || error <= found.error) continue;
        found.constraint = d;
        found.error = error;
    }
    return found;
}

void FetiSolve::share_prescribed(std::span<double> lambda, Response& response) const {
    const std::size_t first_constraint = lambda.size() - load_.prescribed.size();
    for (const Scaling::Prescribed& p : dual_.scaling().prescribed_jumps) {
        const auto row = index(p.jump_row);
        double jump = load_.gap[row];
        for (std::size_t i = 0; i < p.row.size(); ++i)
            if (index(p.row[i]) >= first_constraint)
                jump += p.y[i] * load_.prescribed[index(p.row[i]) - first_constraint];
        if (springs_.held[row] == 0) lambda[row] = springs_.stiffness[row] * jump - pulled(springs_, row);
        for (std::size_t i = 0; i < p.row.size(); ++i) lambda[index(p.row[i])] -= p.y[i] * lambda[row];
        response.jump[row] = springs_.held[row] == 0 ? jump : 0.0;
    }
    response.force.assign(lambda.begin(), lambda.begin() + dual_.rows().jump_count);
}

void FetiSolve::find_energies(std::span<const double> lambda, Response& response) const {
    const std::size_t patterns = theta_.size(), first_constraint = lambda.size() - load_.prescribed.size();
    double work_of_multipliers = dot(response.force, response.jump) - dot(response.force, load_.gap);
    for (std::size_t d = 0; d < load_.prescribed.size(); ++d)
        work_of_multipliers += lambda[first_constraint + d] * load_.prescribed[d];
    response.conjugate.assign(patterns, 0.0);
    for (const GapRow& gap : loads_.gaps)
        response.conjugate[index(gap.pattern)] += gap.value * response.force[index(gap.row)];
    response.load_potential = 0.0;
    double stretched = 0.0;  // f.u of eigenstrains less theta^T W theta
    for (std::size_t p = 0; p < patterns; ++p) {
        const auto at = static_cast<std::int64_t>(p);
        if (loads_.jump[p].empty()) {
            for (std::size_t d = 0; d < load_.prescribed.size(); ++d)
                response.conjugate[p] -= loads_.prescribed[d * patterns + p] * lambda[first_constraint + d];
            continue;
        }
        double displacement = dot(loads_.resultant[p], response.rigid) - dot(loads_.jump[p], lambda);
        for (std::size_t q = 0; q < patterns; ++q)
            displacement += loads_.work(at, static_cast<std::int64_t>(q)) * theta_[q];
        response.conjugate[p] = -displacement;
        if (problem_.patterns[p].drives == Pattern::Drives::force) {
            response.load_potential -= theta_[p] * displacement;
            continue;
        }
        for (std::size_t q = 0; q < patterns; ++q)
            response.conjugate[p] += loads_.strain_energy(at, static_cast<std::int64_t>(q)) * theta_[q];
        stretched -= theta_[p] * response.conjugate[p];
    }
    // 1/2 int (eps - e*) : C : (eps - e*) = 1/2 (f_dead - f_strain).u - 1/2 lambda.B u + 1/2 theta^T W theta; zero but
    // for rounding where the strains are free to follow e*.
    response.stored_bulk = 0.5 * (-response.load_potential - stretched - work_of_multipliers);
    if (!problem_.eigenstrains.empty()) response.stored_bulk = std::max(0.0, response.stored_bulk);
}

}  // namespace delam
