// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/reanalysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/costs.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/restarts.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/sparse/body_states.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

namespace {

// Rounding of a sum that cancels, relative to the work of all tangents along a rigid motion.
constexpr double cancelled = 1e-13;

// Numbers of a saved state between the springs and the seeds.
constexpr std::size_t saved_numbers = 3;

}  // namespace

bool Reanalysis::keeps_two_factors(const Problem& problem) { return problem.options.solution == "energetic"; }

Reanalysis::Reanalysis(const BodySystem& bodies, SparseMatrix transformed, Monitor& monitor)
    : bodies_(bodies),
      monitor_(monitor),
      system_(bodies, std::move(transformed), [&monitor] { monitor.progress("assemble", 0, 0); }),
      floating_(bodies, system_),
      patches_(system_),
      factor_(system_, keeps_two_factors(bodies.problem()), monitor),
      preconditioner_(system_, patches_, factor_),
      renewal_(bodies.problem().options.limits, bodies.problem().options.limits.renewal_most_first) {
    const std::size_t patterns = bodies_.problem().patterns.size();
    std::vector<double> nodal(index(bodies_.dofs()));
    for (std::size_t p = 0; p < patterns; ++p) {
        multiply(bodies_.stiffness(), bodies_.variables().lift[p], nodal);
        const std::vector<double>& force = bodies_.force()[p];
        for (std::size_t i = 0; i < nodal.size(); ++i) nodal[i] = (force.empty() ? 0.0 : force[i]) - nodal[i];
        load_.emplace_back(index(system_.count()));
        multiply_transposed(bodies_.variables().transform, nodal, load_.back());
    }
}

std::vector<double> Reanalysis::load(std::span<const double> theta) const {
    std::vector<double> g(index(system_.count()), 0.0);
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (theta[p] != 0.0) add_scaled(theta[p], load_[p], g);
    return g;
}

bool Reanalysis::plain() const {
    return std::all_of(system_.couplings().begin(), system_.couplings().end(),
                       [](const Zone::Coupling& c) { return c.row == c.column && c.value >= 0.0; });
}

std::vector<std::int64_t> Reanalysis::changed() const {
    const std::vector<std::uint8_t> row = differing_rows(system_, factor_.springs());
    std::vector<std::int64_t> variables;
    for (std::size_t r = 0; r < row.size(); ++r)
        for (const auto& [i, n] : system_.rows()[r].unknowns)
            if (row[r] != 0) variables.push_back(i);
    std::sort(variables.begin(), variables.end());
    variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
    return variables;
}

double Reanalysis::iteration_cost() const {
    const double matrix = static_cast<double>(system_.matrix().entries());
    return triangular_slowdown * (4.0 * factor_.whole().entries() + 6.0 * matrix + 8.0 * patches_.entries());
}

std::int64_t Reanalysis::affordable() const {
    const Limits& limits = bodies_.problem().options.limits;
    const double worth = (factor_.whole().size().flops - renewal_.excess()) / iteration_cost();
    return std::clamp(static_cast<std::int64_t>(worth), limits.patch_least_attempt, limits.patch_longest_attempt);
}

void Reanalysis::renew(std::vector<double> springs) {
    factor_.leave();
    patches_.forget();
    factor_.factorise(std::move(springs));
    renewal_.renewed();
    rounded_ = 0.0;
}

void Reanalysis::renew_now() {
    std::vector<double> springs = springs_of(system_);
    for (double& s : springs) s = std::max(0.0, s);
    for (const Zone::Coupling& c : floating_.anchors()) springs[index(c.row)] += c.value;
    renew(std::move(springs));
}

// Patches about what differs. False: without any_size they would have too many variables.
bool Reanalysis::cover(bool any_size) {
    const double before = patches_.cost();
    const bool covered =
        patches_.cover(changed(), any_size, [this] { monitor_.progress("patch", patches_.count(), 0); });
    attempt_ = patches_.narrow();
    renewal_.spent(patches_.cost() - before);
    return covered;
}

// At the springs that act. False: a patch is not positive definite.
bool Reanalysis::factorise_patches() {
    std::vector<Zone::Coupling> acting = system_.couplings();
    acting.insert(acting.end(), floating_.anchors().begin(), floating_.anchors().end());
    renewal_.spent(patches_.flops());  // also of those whose springs are as before: a saved state does not know
    return patches_.factorise(spring_entries(system_, acting, system_.held()),
                              [this] { monitor_.progress("patch", patches_.count(), 0); });
}

bool Reanalysis::set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held) {
    system_.set(std::move(couplings), held);
    floating_.update();
    const bool renewed = factor_.empty() || (renewal_.due(factor_.whole().size().flops) && !changed().empty());
    if (renewed) renew_now();
    // A factor of the whole cannot have tangents: those of some pairs are negative.
    if (!cover(renewed || !plain())) {
        renew_now();
        cover(true);
    }
    const bool definite = factorise_patches();
    preconditioner_.set_free(floating_.free());
    return definite;
}

std::vector<double> Reanalysis::right_side(std::span<const double> theta, std::span<const double> row_force) const {
    std::vector<double> b = load(theta);
    for (std::size_t r = 0; r < row_force.size(); ++r)
        if (system_.held()[r] == 0 && row_force[r] != 0.0) system_.rows().add(r, row_force[r], b);
    const std::vector<double> offset = system_.rows().offsets(theta);
    for (const Zone::Coupling& c : system_.couplings())
        if (offset[index(c.column)] != 0.0) system_.rows().add(index(c.row), -c.value * offset[index(c.column)], b);
    return b;
}

// Sum of the magnitudes of what springs and tangents do along x.
double Reanalysis::work_of_couplings(std::span<const double> x) const {
    double work = 0.0;
    for (const Zone::Coupling& c : system_.couplings())
        work += std::abs(system_.rows().value(index(c.row), x) * c.value * system_.rows().value(index(c.column), x));
    return work;
}

// sqrt of u^T K u and the work of the springs.
// Returns the root of twice the energy, or of what rounding makes of no energy: parts that move as a whole have none.
double Reanalysis::size_of(std::span<const double> theta, std::span<const double> x) const {
    std::vector<double> u = bodies_.lift(theta), force(u.size());
    bodies_.add_variables(x, u);
    multiply(bodies_.stiffness(), u, force);
    const std::span<const double> diagonal = system_.diagonal();
    double restrained = 0.0;  // twice the energy if every variable moved alone
    for (std::size_t i = 0; i < x.size(); ++i) restrained += diagonal[i] * x[i] * x[i];
    return std::sqrt(
        std::max(std::abs(dot(u, force)) + work_of_couplings(x), std::numeric_limits<double>::epsilon() * restrained));
}

// Estimates the jumps and forces of the missing correction A^-1 r. The preconditioner M is nearly A^-1, so that the
// estimate is M r over the root of the least eigenvalue of M A that the iteration has met: sqrt(r^T A^-1 r) <= sqrt(r^T
// M r / least). (The energy of M r would give bounds, |force| <= sqrt(stiffness of the row) |error| and |jump| <=
// sqrt(flexibility of the row) |error|, but those of a row at the tip of an arm are useless, by the flexibility of the
// whole arm.)
SolveError Reanalysis::error_of(std::span<const double> correction, double least) const {
    SolveError error;
    std::vector<double> left(correction.size()), force(system_.rows().size(), 0.0);
    system_.multiply_held(correction, left);
    system_.add_couplings(correction, left);
    system_.space().multipliers(left, force);
    for (std::size_t r = 0; r < force.size(); ++r)
        if (system_.held()[r] == 0) error.jump = std::max(error.jump, std::abs(system_.rows().value(r, correction)));
    const double factor = renewal_.doubt(least);
    return {factor * error.jump, factor * max_abs(force)};
}

std::vector<double> Reanalysis::held_forces(std::span<const double> theta, std::span<const double> x,
                                            std::span<double> force) const {
    std::vector<double> left = load(theta), image(left.size());
    system_.multiply_held(x, image);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= image[i];
    for (std::size_t r = 0; r < force.size(); ++r) {
        if (system_.held()[r] != 0)
            force[r] = 0.0;
        else
            system_.rows().add(r, -force[r], left);
    }
    return system_.space().multipliers(left, force);
}

// The recursion's residual against the true one, in units of what rounding does to each component.
bool Reanalysis::confirm(std::span<const double> right, std::span<const double> theta, std::span<const double> x,
                         std::span<const double> residual) const {
    if (preconditioner_.any_free() || !floating_.weak().empty()) return false;
    std::vector<double> at(x.begin(), x.end()), r(x.size()), sizes(x.size());
    system_.space().spread(at, theta);
    system_.apply(at, r, sizes);
    for (std::size_t i = 0; i < r.size(); ++i) {
        r[i] = right[i] - r[i];
        sizes[i] += std::abs(right[i]);
    }
    system_.space().gather(r);
    system_.space().gather_sizes(sizes);
    for (std::size_t i = 0; i < r.size(); ++i)
        if (!(std::abs(r[i] - residual[i]) <= bodies_.problem().options.limits.restart_rounding_units *
                                                  std::numeric_limits<double>::epsilon() * sizes[i]))
            return false;
    return true;
}

// Each component has an error of the size of its largest terms times the rounding unit, with a random sign.
double Reanalysis::rounding_at(std::span<const double> right, std::span<const double> x) {
    std::vector<double> delta(x.size()), z(x.size());
    system_.apply(x, z, delta);
    std::uint64_t seed = 1;
    for (std::size_t i = 0; i < delta.size(); ++i) {
        double& d = delta[i];
        d += std::abs(right[i]);
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        if ((seed >> 63U) == 0) d = -d;
    }
    system_.space().gather(delta);
    preconditioner_.project(delta);
    preconditioner_.apply(delta, z);
    return std::numeric_limits<double>::epsilon() * std::sqrt(std::abs(dot(delta, z)));
}

// The multiple of the start that has the least energy: a load that has only grown needs nothing else. No start is used
// if it is so much larger than the load that its energy is not finite. Returns A x there, with the rest of expressed
// variables.
std::vector<double> Reanalysis::start_from(std::span<const double> right, std::span<const double> theta,
                                           std::span<double> x) const {
    std::vector<double> y(x.begin(), x.end()), image(x.size());
    system_.space().spread(y);
    std::vector<double> rest(x.size(), 0.0), of_rest(x.size(), 0.0);
    system_.space().spread(rest, theta);
    double pull = dot(y, right);
    if (std::any_of(rest.begin(), rest.end(), [](double v) { return v != 0.0; })) {
        system_.apply(rest, of_rest);
        pull -= dot(y, of_rest);
    }
    system_.apply(y, image);
    const double curvature = dot(y, image);
    const bool usable = std::isfinite(curvature) && std::isfinite(pull);
    const double scale = !usable ? 0.0 : curvature > 0.0 ? pull / curvature : 1.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = scale * y[i];
        of_rest[i] += scale == 0.0 ? 0.0 : scale * image[i];
    }
    return of_rest;
}

// Directions of weakly held rigid motions, conjugate to each other. False: tangents along one are negative.
bool Reanalysis::weak_directions(std::vector<Direction>& given) const {
    bool definite = true;
    for (const std::vector<double>& motion : floating_.weak()) {
        Direction d{motion, std::vector<double>(motion.size(), 0.0), 0.0};
        system_.add_couplings(d.p, d.ap);  // the bodies do not resist
        const double size = work_of_couplings(d.p);
        system_.space().gather(d.ap);
        for (int pass = 0; pass < 2; ++pass)
            for (const Direction& other : given) {
                const double share = dot(other.ap, d.p) / other.pap;
                add_scaled(-share, other.p, d.p);
                add_scaled(-share, other.ap, d.ap);
            }
        d.pap = dot(d.p, d.ap);
        definite = definite && d.pap >= -cancelled * size;
        if (d.pap > 0.0) given.push_back(std::move(d));
    }
    return definite;
}

// With the factor at hand or, where that was an attempt that failed, with a new one.
CgOutcome Reanalysis::iterate(CgSystem& cg, double tolerance, std::span<double> x) {
    const std::int64_t limit = bodies_.problem().options.linear_limit;
    cg.rounded = rounded_;
    cg.limits = bodies_.problem().options.limits;
    cg.attempt = attempt_;
    // Residuals weigh less what the factor takes for stiffer than it is.
    const double careful = attempt_ ? renewal_.limits().renewal_cautious : 1.0;
    const double target = std::max(finest, careful * tolerance);
    double enough = 0.0;
    if (const Forcing forcing = cg.enough)
        cg.enough = [forcing, careful, &enough](double start) { return careful * (enough = forcing(start)); };
    CgOutcome outcome = conjugate_gradients(cg, x, target, attempt_ ? std::min(limit, affordable()) : limit);
    if (attempt_ && outcome.definite && !outcome.converged && outcome.iterations < limit) {
        const std::int64_t before = outcome.iterations;
        const double first = outcome.first;
        renew_now();
        cg.rounded = 0.0;
        cg.attempt = false;
        cg.enough = [enough](double) { return enough; };
        cover(true);
        if (factorise_patches())
            outcome = conjugate_gradients(cg, x, tolerance, limit);
        else
            outcome.definite = false;
        renewal_.solved(static_cast<double>(outcome.iterations), iteration_cost());
        outcome.iterations += before;
        outcome.first = first;
    } else {
        renewal_.solved(static_cast<double>(outcome.iterations), iteration_cost());
    }
    rounded_ = outcome.rounded;
    return outcome;
}

Reanalysis::Answer Reanalysis::solve(std::span<const double> theta, std::span<const double> row_force, double tolerance,
                                     std::vector<double>& x, const Forcing& forcing) {
    Answer answer;
    const std::vector<double> right = right_side(theta, row_force);
    answer.balanced = floating_.balances(theta, row_force);
    if (!answer.balanced) return answer;
    std::vector<double> image;  // A x at the start, where it is known
    if (x.size() != right.size())
        x.assign(right.size(), 0.0);
    else
        image = start_from(right, theta, x);

    CgSystem cg;
    cg.apply = [&](std::span<const double> p, std::span<double> ap) {
        std::vector<double> full(p.begin(), p.end());
        system_.space().spread(full);
        system_.apply(full, ap);
        system_.space().gather(ap);
    };
    // Free motions are null vectors; removing them keeps them from growing. Expressed variables have zeros.
    cg.precondition = [&](std::span<const double> r, std::span<double> z) {
        preconditioner_.apply(r, z);
        preconditioner_.project(z);
        system_.space().spread(z);
    };
    answer.definite = weak_directions(cg.given);
    if (!answer.definite) return answer;
    cg.restart = [&](std::span<double> at, std::span<double> r) {
        system_.space().spread(at, theta);
        std::vector<double> springs(at.size(), 0.0);
        for (const Direction& d : cg.given) {
            // Loads and springs alone act along a rigid motion.
            std::fill(springs.begin(), springs.end(), 0.0);
            system_.add_couplings(at, springs);
            const double along = (dot(d.p, right) - dot(d.p, springs)) / d.pap;
            add_scaled(along, d.p, at);
        }
        if (image.empty() || !cg.given.empty())
            system_.apply(at, r);
        else
            std::copy(image.begin(), image.end(), r.begin());
        image.clear();
        for (std::size_t i = 0; i < r.size(); ++i) r[i] = right[i] - r[i];
        system_.space().gather(r);
        preconditioner_.project(r);
        for (const Direction& d : cg.given) add_scaled(-dot(d.p, r) / d.pap, d.ap, r);
    };
    cg.size = [&](std::span<const double> at) {
        std::vector<double> full(at.begin(), at.end());
        system_.space().spread(full, theta);
        return size_of(theta, full);
    };
    cg.rounding = [&](std::span<const double> at) { return rounding_at(right, at); };
    cg.confirm = [&](std::span<const double> at, std::span<const double> residual) {
        return confirm(right, theta, at, residual);
    };
    cg.each_iteration = [&](std::int64_t iteration) { monitor_.progress("linear solve", iteration, 0); };
    cg.enough = forcing;
    const CgOutcome outcome = iterate(cg, std::max(tolerance, finest), x);
    system_.space().spread(x, theta);
    floating_.settle(x);
    answer.iterations = outcome.iterations;
    answer.residual = outcome.residual;
    answer.first = outcome.first;
    answer.norm = outcome.norm;
    answer.energy_error =
        0.5 * outcome.norm * outcome.norm / std::max(outcome.least, renewal_.limits().renewal_softest);
    if (!outcome.correction.empty()) answer.error = error_of(outcome.correction, outcome.least);
    answer.converged = outcome.converged;
    answer.definite = outcome.definite;
    return answer;
}

double Reanalysis::load_size(std::span<const double> theta) const { return max_abs(load(theta)); }

void Reanalysis::recover(std::span<const double> theta, std::span<const double> x, std::vector<double>& displacement,
                         std::vector<double>& stressed) {
    recover_state(bodies_, theta, x, displacement, stressed);
}

BodySolver::Work Reanalysis::work(std::span<const double> theta, std::span<const double> x) {
    return work_of_state(bodies_, theta, x);
}

double Reanalysis::energy_rounding(std::span<const double> theta, std::span<const double> x) {
    return energy_rounding_of_state(bodies_, theta, x);
}

// Springs of the whole factor [rows], the operations that a new one would have saved, the rounding of a residual, the
// iterations of its first solve, then the seeds of the patches.
std::vector<double> Reanalysis::memory() {
    factor_.remember();
    return history();
}

std::vector<double> Reanalysis::history() const {
    std::vector<double> m = factor_.springs();
    if (m.empty()) return m;
    m.push_back(renewal_.excess());
    m.push_back(rounded_);
    m.push_back(renewal_.first());
    for (const std::int64_t i : patches_.seeds()) m.push_back(static_cast<double>(i));
    return m;
}

void Reanalysis::require_memory(std::span<const double> memory) const {
    if (memory.empty()) return;
    const auto damaged = [](bool yes) {
        if (yes) fail(DELAM_ERROR_SNAPSHOT, "snapshot holds springs or patches that the iterated operator cannot have");
    };
    const std::size_t rows = system_.rows().size();
    damaged(memory.size() < rows + saved_numbers);
    for (std::size_t i = 0; i < rows; ++i) damaged(!(memory[i] >= 0.0 && std::isfinite(memory[i])));
    damaged(!(memory[rows + 1] >= 0.0 && memory[rows + 1] < 1.0));
    damaged(!renewal_.allows(memory[rows], memory[rows + 2]));
    for (std::size_t i = rows + saved_numbers; i < memory.size(); ++i)
        damaged(!(memory[i] >= 0.0 && memory[i] < static_cast<double>(system_.count())) ||
                memory[i] != std::floor(memory[i]) || (i > rows + saved_numbers && !(memory[i] > memory[i - 1])));
}

void Reanalysis::recall(std::span<const double> memory) {
    if (std::ranges::equal(memory, history())) return;
    if (memory.empty()) {
        factor_.leave();
        patches_.forget();
        renewal_.renewed();
        rounded_ = 0.0;
        return;
    }
    require_memory(memory);
    const std::size_t rows = system_.rows().size();
    std::vector<double> springs(memory.begin(), memory.begin() + static_cast<std::ptrdiff_t>(rows));
    for (double& s : springs) s += 0.0;  // negative zero would be saved with its sign
    std::vector<std::int64_t> seeds;
    for (std::size_t i = rows + saved_numbers; i < memory.size(); ++i)
        seeds.push_back(static_cast<std::int64_t>(memory[i]));
    if (springs != factor_.springs()) {
        if (factor_.come_back(springs))
            patches_.forget();
        else
            renew(std::move(springs));
    }
    factor_.remember();
    patches_.forget();
    patches_.cover(seeds, true, [this] { monitor_.progress("patch", 0, 0); });
    renewal_.restore(memory[rows], memory[rows + 2]);
    rounded_ = memory[rows + 1] + 0.0;
}

}  // namespace delam
