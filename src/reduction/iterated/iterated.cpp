// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/iterated/iterated.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "linalg/dense.hpp"

namespace delam {

namespace {

// A start larger than the load by 2^900 is none: it would hardly be finite.
constexpr int largest_start_power = 900;

// A rough solve's. 3e-3 and 1e-2 need about the same iterations to find a first contact set, 3e-2 twice as many: pairs
// then close and open again.
constexpr double rough_tolerance = 1e-2;

bool any_of(std::span<const double> values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
}

}  // namespace

Iterated::Iterated(const Problem& problem, Monitor& monitor)
    : Iterated(problem, assemble_bodies(problem, monitor), monitor) {}

Iterated::Iterated(const Problem& problem, AssembledBodies bodies, Monitor& monitor)
    : problem_(problem),
      monitor_(monitor),
      system_(std::move(bodies.system)),
      bodies_(*system_),
      strain_energy_(bodies_.find_loads().energy),
      reanalysis_(bodies_, std::move(bodies.transformed), monitor) {}

// Loads of any size: what is solved has its largest force between 1/2 and 1.
void Iterated::solve(const Springs& springs, std::span<const double> theta, Response& response) {
    monitor_.progress("displacement", 0, 0);
    if (zone_ != nullptr) zone_->forget_models();
    const JumpSystem& system = reanalysis_.system();
    std::vector<Zone::Coupling> couplings;
    std::vector<std::uint8_t> held(springs.held);
    std::vector<double> pulled(springs.force);
    for (std::size_t r = 0; r < held.size(); ++r) {
        if (system.prescribed()[r] != 0) {  // constant: no variable, whether held or not
            held[r] = 0;
            if (!pulled.empty()) pulled[r] = 0.0;
        } else if (held[r] == 0 && springs.stiffness[r] > 0.0) {
            couplings.push_back({static_cast<std::int64_t>(r), static_cast<std::int64_t>(r), springs.stiffness[r]});
        }
        if (!pulled.empty() && held[r] != 0) pulled[r] = 0.0;
    }
    std::vector<double> load = reanalysis_.load(theta);
    std::vector<double> moved = system.offsets(theta);
    for (std::size_t e = 0; e < system.equations().size(); ++e) moved.push_back(dot(system.equation_right(e), theta));
    // Without a load nothing moves, exactly.
    bool loaded = any_of(load) || any_of(pulled) || any_of(moved);
    for (std::size_t p = 0; p < theta.size(); ++p)
        loaded = loaded || (theta[p] != 0.0 && any_of(bodies_.variables().lift[p]));
    if (!loaded) {
        rest(springs, theta, response);
        return;
    }
    if (!reanalysis_.set(std::move(couplings), held))
        fail(DELAM_ERROR_NUMERICAL, "the stiffness of a patch of the bodies (", reanalysis_.patches().variables(),
             " variables) is not positive definite");
    int power = exponent(std::max(max_abs(load), max_abs(pulled)));
    if (power == 0) power = exponent(max_abs(moved));
    std::vector<double> unit(theta.begin(), theta.end()), x = std::move(response.multipliers);
    scale_by_power(unit, -power);
    scale_by_power(pulled, -power);
    if (exponent(max_abs(x)) - power > largest_start_power) x.clear();
    scale_by_power(x, -power);
    const Reanalysis::Answer answer = reanalysis_.solve(unit, pulled, tolerance(), x);
    response.balanced = answer.balanced;
    response.iterations = answer.iterations;
    response.residual = answer.residual;
    response.converged = answer.converged && answer.definite;
    scale_by_power(x, power);
    response.multipliers = std::move(x);
    response.error = {};
    if (!response.balanced) return;
    respond(springs, theta, response);
    response.error = {std::ldexp(answer.error.jump, power), std::ldexp(answer.error.force, power)};
}

bool Iterated::aim(Accuracy accuracy) {
    accuracy_ = accuracy;
    return tolerance() != std::max(problem_.options.linear_tolerance, Reanalysis::finest);
}

double Iterated::tolerance() const {
    const double usual = problem_.options.linear_tolerance;
    if (accuracy_ == Accuracy::rough) return std::max(usual, rough_tolerance);
    return accuracy_ == Accuracy::tight ? Reanalysis::finest : std::max(usual, Reanalysis::finest);
}

void Iterated::rest(const Springs& springs, std::span<const double> theta, Response& response) const {
    response = {};
    response.jump.assign(springs.stiffness.size(), 0.0);
    response.force.assign(springs.stiffness.size(), 0.0);
    response.conjugate.assign(theta.size(), 0.0);
    response.multipliers.assign(index(reanalysis_.system().count()), 0.0);
}

void Iterated::respond(const Springs& springs, std::span<const double> theta, Response& response) const {
    const JumpSystem& system = reanalysis_.system();
    const std::vector<double>& x = response.multipliers;
    const std::size_t rows = springs.stiffness.size();
    const std::vector<double> offset = system.offsets(theta);
    response.jump.assign(rows, 0.0);
    response.force.assign(rows, 0.0);
    for (std::size_t r = 0; r < rows; ++r) {
        if (springs.held[r] != 0) {
            response.jump[r] = system.prescribed()[r] != 0 ? 0.0 : held_jump(system.rows()[r], offset[r], x);
            continue;
        }
        response.jump[r] = offset[r] + system.row_value(r, x);
        response.force[r] = springs.stiffness[r] * response.jump[r];
        if (!springs.force.empty()) response.force[r] -= springs.force[r];
    }
    const std::vector<double> mu = reanalysis_.held_forces(theta, x, response.force);
    response.rigid.clear();
    response.support = {};
    find_energies(theta, mu, response);
}

// From the displacements: a stored energy is a sum of squares, and its error is that of the solution squared.
void Iterated::find_energies(std::span<const double> theta, std::span<const double> mu, Response& response) const {
    const std::size_t patterns = theta.size();
    std::vector<double> u = bodies_.lift(theta), stressed(u.size());
    bodies_.add_variables(response.multipliers, u);
    multiply(bodies_.stiffness(), u, stressed);
    response.stored_bulk = 0.5 * dot(u, stressed);
    response.load_potential = 0.0;
    for (std::size_t p = 0; p < patterns; ++p)
        if (!bodies_.force()[p].empty() && theta[p] != 0.0) add_scaled(-theta[p], bodies_.force()[p], stressed);
    response.conjugate.assign(patterns, 0.0);
    const std::vector<JumpRow>& rows = reanalysis_.system().rows();
    for (std::size_t p = 0; p < patterns; ++p) {
        double q = dot(bodies_.variables().lift[p], stressed);
        const double moved = bodies_.force()[p].empty() ? 0.0 : dot(bodies_.force()[p], u);
        q -= moved;
        double strained = 0.0;
        for (std::size_t k = 0; k < patterns; ++k) strained += strain_energy_[p * patterns + k] * theta[k];
        q += strained;
        for (std::size_t r = 0; r < rows.size(); ++r)
            if (!rows[r].offset.empty()) q += rows[r].offset[p] * response.force[r];
        for (std::size_t e = 0; e < mu.size(); ++e) q -= reanalysis_.system().equation_right(e)[p] * mu[e];
        response.conjugate[p] = q;
        if (problem_.patterns[p].drives == Pattern::Drives::force)
            response.load_potential -= theta[p] * moved;
        else
            response.stored_bulk += theta[p] * (0.5 * strained - moved);
    }
    // Strains that can freely follow an eigenstrain store only the rounding of terms that cancel.
    if (!problem_.eigenstrains.empty()) response.stored_bulk = std::max(0.0, response.stored_bulk);
}

Zone* Iterated::zone(const Springs&, std::span<const std::uint8_t>, bool) {
    if (zone_ == nullptr) zone_ = std::make_unique<IteratedZone>(bodies_, reanalysis_);
    zone_->start_anew();
    return zone_.get();
}

Zone* Iterated::part(std::span<const double> theta, const Response& response, std::span<const std::uint8_t> wanted) {
    if (!reanalysis_.floating().free().empty()) return nullptr;  // the whole knows how to solve then
    if (part_ == nullptr)
        part_ = std::make_unique<LocalZone>(reanalysis_.system(), bodies_.problem().mesh->dimension());
    const auto poll = [this] { monitor_.progress("patch", 0, 0); };
    return part_->enter(wanted, theta, reanalysis_.load(theta), response.multipliers, poll) ? part_.get() : nullptr;
}

std::vector<double> Iterated::displacement(std::span<const double> theta, const Response& response) const {
    poll_cancel("recover", bodies_.dofs() / 64);
    std::vector<double> u = bodies_.lift(theta);
    bodies_.add_variables(response.multipliers, u);
    ++recoveries_;
    return u;
}

std::vector<double> Iterated::reaction(std::span<const double> theta, const Response& response) const {
    return bodies_.reaction(theta, displacement(theta, response), response.force);
}

double Iterated::equilibrium_defect(std::span<const double> theta, const Response& response) const {
    const std::vector<double> u = displacement(theta, response);
    return bodies_.defect(theta, u, response.force, bodies_.reaction(theta, u, response.force));
}

// As of the condensed operator: entries of the stiffness have an error of the rounding unit times the diagonal.
double Iterated::rounding_energy(std::span<const double>, const Response& response) const {
    const std::span<const double> diagonal = reanalysis_.system().diagonal();
    const std::vector<double>& x = response.multipliers;
    double sum = 0.0;
    for (std::size_t i = index(bodies_.variables().leading); i < x.size(); ++i) sum += diagonal[i] * x[i] * x[i];
    return std::numeric_limits<double>::epsilon() * sum;
}

IteratedSize Iterated::size() const {
    const WholeFactor& whole = *reanalysis_.whole();
    return {static_cast<double>(reanalysis_.system().count()),
            static_cast<double>(bodies_.stiffness().entries()),
            static_cast<double>(reanalysis_.system().matrix().entries()),
            whole.size(),
            whole.entries(),
            static_cast<double>(reanalysis_.system().equations().size()),
            Reanalysis::keeps_two_factors(problem_) ? 2.0 : 1.0,
            static_cast<double>(problem_.softening_count())};
}

std::string Iterated::description() const {
    const WholeFactor& whole = *reanalysis_.whole();
    return text("iterated: ", reanalysis_.system().count(), " variables, ", reanalysis_.system().rows().size(),
                " jump rows, factor of the whole with ", whole.size().entries, " entries");
}

}  // namespace delam
