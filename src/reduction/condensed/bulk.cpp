// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/bulk.hpp"

#include <algorithm>
#include <cmath>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/dense/rigid_jumps.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

Bulk::Bulk(const Problem& problem, Monitor& monitor) : Bulk(assemble_bodies(problem, monitor), monitor) {}

Bulk::Bulk(std::shared_ptr<const Problem> problem, Monitor& monitor)
    : Bulk(assemble_bodies(std::move(problem), monitor), monitor) {}

Bulk::Bulk(AssembledBodies bodies, Monitor& monitor)
    : system_(std::move(bodies.system)), problem_(system_->problem()), transformed_(std::move(bodies.transformed)) {
    const Poll analysing = [&monitor] { monitor.progress("analyse", 0, 0); };
    call_if_set(analysing);
    superelements_ = std::make_unique<Superelements>(transformed_, variables(), problem_, analysing);
    if (!problem_.renewed) return;
    analysed_.start = transformed_.start;
    analysed_.column = transformed_.column;
}

bool Bulk::renew(Renewed what, Monitor& monitor) {
    const Poll condensing = monitor.poll_at("condense", 0, 0);
    system_->renew(what, condensing);
    if (what == Renewed::all) {
        transformed_ = system_->transformed(condensing);
        if (transformed_.start != analysed_.start || transformed_.column != analysed_.column) return false;
        superelements_->renew(transformed_);
    }
    equations_ = TrailingEquations(variables(), static_cast<std::int64_t>(problem_.patterns.size()), *superelements_);
    if (what == Renewed::all) factorise(condensing);
    // Only the last pattern has other forces, unless those of eigenstrains turn with the bodies.
    const bool all = what == Renewed::all || !problem_.eigenstrains.empty();
    take_loads(all ? 0 : problem_.patterns.size() - 1, condensing);
    return true;
}

AssembledBodies Bulk::release() && { return {std::move(system_), std::move(transformed_)}; }

void Bulk::condense(Monitor& monitor) {
    const Poll condensing = monitor.poll_at("condense", 0, 0);
    monitor.progress("factor", 0, 0);
    equations_ = TrailingEquations(variables(), static_cast<std::int64_t>(problem_.patterns.size()), *superelements_);
    factorise(condensing);
    take_loads(0, condensing);
    if (!problem_.renewed) stressed_.clear();
}

void Bulk::take_loads(std::size_t first, const Poll& condensing) {
    const StrainLoads strained = system_->find_loads();
    condense_loads(first, condensing);
    call_if_set(condensing);
    find_pattern_stiffness(first, strained, condensing);
    const RigidMotions known(problem_);
    const DenseMatrix& motions = known.jumps();
    dead_work_ = known.dead_work();
    rigid_ = DenseMatrix(unknowns(), motions.columns);
    for (std::int64_t c = 0; c < motions.columns; ++c)
        for (std::int64_t i = 0; i < rigid_.rows; ++i) rigid_(i, c) = motions(row_of_unknown()[index(i)], c);
    if (equations_.kept() == 0) balance_strains();
    rest(condensing);
}

void Bulk::rest(const Poll& condensing) {
    if (variables().kept == 0 && !equations_.any()) return;
    resting_ = std::make_unique<Elimination>(*superelements_, trailing_load_);
    resting_->update(equations_.states(std::vector<double>(index(unknowns()), Elimination::held)), condensing);
    resting_energy_ = std::make_unique<ZoneEnergy>(zone_energy(*resting_, condensing));
}

void Bulk::factorise(const Poll& poll) {
    ++factorisations_;
    transformed_ = SparseMatrix();
    bool definite = superelements_->condense(poll);
    const auto patterns = static_cast<std::int64_t>(problem_.patterns.size());
    const auto places = static_cast<std::int64_t>(superelements_->variable().size());
    trailing_load_ = DenseMatrix(places, patterns);
    bonded_ = std::make_unique<Elimination>(*superelements_, DenseMatrix(places, 0), Elimination::Last::root);
    try {
        if (definite)
            bonded_->update(equations_.states(std::vector<double>(index(unknowns()), Elimination::held)), poll);
    } catch (const Error& error) {
        if (error.status() != DELAM_ERROR_NUMERICAL) throw;
        definite = false;
    }
    if (!definite)
        fail(DELAM_ERROR_NUMERICAL,
             "the stiffness of the bonded structure is not positive definite: check supports, materials and the shapes "
             "of cells");
    const std::int64_t kept = equations_.kept();
    if (kept == 0) return;
    const ReducedEnergy reduced(equations_, *superelements_, *bonded_);
    kept_factor_ = DenseMatrix(kept, kept);
    for (std::int64_t j = 0; j < kept; ++j)
        for (std::int64_t i = 0; i < kept; ++i) kept_factor_(i, j) = reduced.energy().stiffness(i, j);
    if (!factor_definite(kept_factor_, poll))
        fail(DELAM_ERROR_NUMERICAL, "the condensed stiffness of ", kept,
             " displacements in long constraints is not positive definite");
}

// T^T (f theta - K u)
std::vector<double> Bulk::carried(std::span<const double> theta, std::span<const double> displacement) const {
    std::vector<double> nodal(displacement.size()), on_variables(index(variables().count()));
    multiply(stiffness(), displacement, nodal);
    for (double& f : nodal) f = -f;
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (theta[p] != 0.0 && !system_->force()[p].empty()) add_scaled(theta[p], system_->force()[p], nodal);
    multiply_transposed(variables().transform, nodal, on_variables);
    return on_variables;
}

// With all trailing variables at zero each pattern has the displacements u_p, which are returned; the remaining forces
// K u_p - f_p act on the trailing variables.
void Bulk::condense_loads(std::size_t first, const Poll& poll) {
    const std::int64_t leading = variables().leading;
    const std::size_t patterns = problem_.patterns.size();
    left_over_.resize(patterns);
    closed_.resize(patterns);
    for (std::size_t p = first; p < patterns; ++p) {
        std::vector<double> unit(patterns, 0.0);
        unit[p] = 1.0;
        std::vector<double> u = variables().lift[p];
        const std::vector<double> v = solve_bonded(carried(unit, u));
        system_->add_variables(v, u);
        const std::vector<double> left = carried(unit, u);
        double squares = 0.0;
        for (std::size_t i = 0; i < index(leading); ++i) squares += left[i] * left[i] * v[i] * v[i];
        left_over_[p] = std::sqrt(squares);
        for (std::int64_t t = leading; t < variables().count(); ++t)
            trailing_load_(superelements_->place(t), static_cast<std::int64_t>(p)) = left[index(t)];
        closed_[p] = std::move(u);
        call_if_set(poll);
    }
}

// A_pq = u_p^T K u_q - f_p^T u_q - f_q^T u_p + W_pq, W of the eigenstrains: no difference of large numbers, whatever
// the lift is. And L: the forces K u_p - f_p on the unknown jumps.
void Bulk::find_pattern_stiffness(std::size_t first, const StrainLoads& strained, const Poll& poll) {
    const std::size_t patterns = problem_.patterns.size();
    const std::vector<std::vector<double>>& force = system_->force();
    std::vector<double> nodal(index(system_->dofs()));
    const std::vector<double> closed(index(unknowns()), 0.0);
    if (first == 0) load_ = DenseMatrix(unknowns(), static_cast<std::int64_t>(patterns));
    stressed_.resize(patterns);
    for (std::size_t p = first; p < patterns; ++p) {
        std::vector<double> unit(patterns, 0.0);
        unit[p] = 1.0;
        if (variables().kept > 0 || equations_.any()) closed_[p] = displacement_from_lift(unit, closed);
        multiply(stiffness(), closed_[p], nodal);
        stressed_[p] = nodal;
        const std::vector<double> left = carried(unit, closed_[p]);
        for (std::int64_t i = 0; i < unknowns(); ++i)
            load_(i, static_cast<std::int64_t>(p)) = equations_.on_rest(left, equations_.kept() + i);
        call_if_set(poll);
    }
    pattern_stiffness_ = DenseMatrix(static_cast<std::int64_t>(patterns), static_cast<std::int64_t>(patterns));
    for (std::size_t p = 0; p < patterns; ++p)
        for (std::size_t q = 0; q < patterns; ++q) {
            double a = dot(closed_[p], stressed_[q]) + strained.energy[p * patterns + q];
            if (!force[p].empty()) a -= dot(force[p], closed_[q]);
            if (!force[q].empty()) a -= dot(force[q], closed_[p]);
            pattern_stiffness_(static_cast<std::int64_t>(p), static_cast<std::int64_t>(q)) = a;
        }
}

double Bulk::rounding_energy(std::span<const double> theta) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < theta.size(); ++p) sum += theta[p] * theta[p] * left_over_[p];
    return sum;
}

// Eigenstrains do no work in rigid motions. If nothing resists these, the load along them is only rounding, and this
// removes it.
void Bulk::balance_strains() {
    const auto rows = index(rigid_.rows);
    for (std::size_t p = 0; p < problem_.patterns.size(); ++p) {
        if (problem_.patterns[p].drives != Pattern::Drives::strain) continue;
        const auto load = std::span<double>(load_.value).subspan(p * rows, rows);
        const std::vector<double> before(load.begin(), load.end());
        for (int pass = 0; pass < 2; ++pass)
            for (std::int64_t c = 0; c < rigid_.columns; ++c) {
                const auto motion = std::span<const double>(rigid_.value).subspan(index(c) * rows, rows);
                add_scaled(-dot(motion, load), motion, load);
            }
        for (std::int64_t i = 0; i < unknowns(); ++i)
            trailing_load_(equations_.place(i), static_cast<std::int64_t>(p)) += load[index(i)] - before[index(i)];
    }
}

// The displacements under forces with all trailing variables at rest: leaves, cuts, leaves.
std::vector<double> Bulk::solve_bonded(std::span<const double> forces) const {
    std::vector<double> v(forces.size(), 0.0);
    const auto leading = static_cast<std::ptrdiff_t>(variables().leading);
    if (std::all_of(forces.begin(), forces.begin() + leading, [](double f) { return f == 0.0; })) return v;
    superelements_->solve_inside(forces, v);
    if (superelements_->nodes().size() == 1) return v;
    std::vector<double> b(forces.begin(), forces.end()), skeleton;
    superelements_->carry(v, b);
    for (const std::int64_t variable : superelements_->variable()) skeleton.push_back(b[index(variable)]);
    bonded_->solve_cuts(skeleton);
    for (std::size_t p = 0; p < skeleton.size(); ++p) v[index(superelements_->variable()[p])] = skeleton[p];
    superelements_->solve_inside(forces, v);
    return v;
}

// u = sum_p theta_p u_p + T v, where v has the jumps and what they move: with the leaves condensed to S, the cuts at
// S_cc v_c = -S_ct v_t, then the leaves at A_ll v_l = -A_ls v_s. Each leaf is solved once.
std::vector<double> Bulk::displacement(std::span<const double> theta, std::span<const double> unknowns) const {
    if (equations_.kept() > 0) return displacement_from_lift(theta, unknowns);
    std::vector<double> u(index(system_->dofs()), 0.0);
    for (std::size_t p = 0; p < theta.size(); ++p) add_scaled(theta[p], closed_[p], u);
    poll_cancel("recover", system_->dofs() / 64);
    system_->add_variables(moved_by_jumps(unknowns), u);
    poll_cancel("recover", system_->dofs() / 64);
    return u;
}

std::vector<double> Bulk::moved_by_jumps(std::span<const double> unknowns) const {
    const std::vector<double> unloaded(problem_.patterns.size(), 0.0);
    std::vector<double> v = equations_.variables_at(unloaded, unknowns);
    const std::vector<std::int64_t>& skeleton = superelements_->variable();
    std::vector<double> moved(skeleton.size()), cuts(skeleton.size(), 0.0);
    std::vector<std::uint8_t> is_cut(skeleton.size());
    for (std::size_t p = 0; p < skeleton.size(); ++p) {
        moved[p] = v[index(skeleton[p])];
        is_cut[p] = superelements_->kind(static_cast<std::int64_t>(p)) == Superelements::Kind::cut ? 1 : 0;
    }
    superelements_->subtract_image(moved, is_cut, cuts);
    bonded_->solve_cuts(cuts);
    for (std::size_t p = 0; p < skeleton.size(); ++p)
        if (is_cut[p] != 0) v[index(skeleton[p])] = cuts[p];
    superelements_->solve_inside(std::vector<double>(v.size(), 0.0), v);
    return v;
}

// u = u_0 + G (f theta - K u_0) from the lift and the jumps, u_0, with G of reading(), below.
std::vector<double> Bulk::displacement_from_lift(std::span<const double> theta,
                                                 std::span<const double> unknowns) const {
    std::vector<double> u = system_->lift(theta);
    system_->add_variables(equations_.variables_at(theta, unknowns), u);
    poll_cancel("recover", system_->dofs() / 64);
    system_->add_variables(solve_bonded(carried(theta, u)), u);
    poll_cancel("recover", system_->dofs() / 64);
    if (equations_.kept() > 0) {
        const std::vector<double> left = carried(theta, u);
        std::vector<double> kept(index(equations_.kept()));
        for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = equations_.on_rest(left, static_cast<std::int64_t>(k));
        solve_lower(kept_factor_, kept);
        solve_lower_transposed(kept_factor_, kept);
        system_->add_variables(equations_.variables_of_kept(kept), u);
        system_->add_variables(solve_bonded(carried(theta, u)), u);
    }
    return u;
}

std::vector<double> Bulk::moved_bonded(std::span<const double> nodal) const {
    std::vector<double> on_variables(index(variables().count())), moved(nodal.size(), 0.0);
    multiply_transposed(variables().transform, nodal, on_variables);
    system_->add_variables(solve_bonded(on_variables), moved);
    return moved;
}

// displacement_from_lift(), transposed. With G = T S T^T its stages are
//
//     u_0 = U theta + T E x,   u_1 = u_0 + G (f theta - K u_0),
//     y = A^-1 D^T T^T (f theta - K u_1),   u_2 = u_1 + T D y,   u = u_2 + G (f theta - K u_2),
//
// D: the variables of the kept displacements. From the last to the first, each turns  l . u  into  l' . u_before  plus
// the work of  f theta  in what it adds.
LinearReading Bulk::reading(std::span<const double> weights) const {
    std::vector<double> l(weights.begin(), weights.end()), works(l.size(), 0.0);  // works: f theta acts in it
    const auto pass = [&](std::span<const double> added) {
        const std::vector<double> resisted = system_->stressed(added);
        for (std::size_t i = 0; i < l.size(); ++i) {
            l[i] -= resisted[i];
            works[i] += added[i];
        }
    };
    const auto on_variables = [&](std::span<const double> nodal) {
        std::vector<double> out(index(variables().count()));
        multiply_transposed(variables().transform, nodal, out);
        return out;
    };
    pass(moved_bonded(l));
    if (equations_.kept() > 0) {
        const std::vector<double> left = on_variables(l);
        std::vector<double> kept(index(equations_.kept())), added(l.size(), 0.0);
        for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = equations_.on_rest(left, static_cast<std::int64_t>(k));
        solve_lower(kept_factor_, kept);
        solve_lower_transposed(kept_factor_, kept);
        system_->add_variables(equations_.variables_of_kept(kept), added);
        pass(added);
        pass(moved_bonded(l));
    }
    const std::vector<double> left = on_variables(l);
    LinearReading reading;
    for (std::int64_t i = 0; i < unknowns(); ++i)
        reading.of_row.push_back(equations_.on_rest(left, equations_.kept() + i));
    const std::vector<double> none(index(unknowns()), 0.0);
    for (std::size_t p = 0; p < problem_.patterns.size(); ++p) {
        std::vector<double> unit(problem_.patterns.size(), 0.0);
        unit[p] = 1.0;
        std::vector<double> u = system_->lift(unit);
        system_->add_variables(equations_.variables_at(unit, none), u);
        const std::vector<double>& force = system_->force()[p];
        reading.of_pattern.push_back(dot(l, u) + (force.empty() ? 0.0 : dot(works, force)));
    }
    return reading;
}

std::vector<double> Bulk::skeleton_at_rest(std::span<const double> theta) const {
    std::vector<double> skeleton(superelements_->variable().size(), 0.0);
    if (resting_ == nullptr) return skeleton;
    const std::vector<double> closed(resting_energy_->unknowns().size(), 0.0);
    resting_->recover(theta, resting_energy_->recover(theta, closed), skeleton);
    return skeleton;
}

std::vector<double> Bulk::residual(std::span<const double> theta, std::span<const double> skeleton,
                                   std::span<const std::uint8_t> wanted) const {
    std::vector<double> left(skeleton.size());
    multiply(trailing_load_, theta, left);
    superelements_->subtract_image(skeleton, equations_.places_of(wanted), left);
    return equations_.gather(left, wanted);
}

DenseEnergy Bulk::dense(const Poll& poll) const {
    Elimination whole = elimination();
    whole.update(equations_.states(std::vector<double>(index(unknowns()), Elimination::in_zone)), poll);
    const ZoneEnergy zone = zone_energy(whole, poll);
    DenseEnergy energy{DenseMatrix(unknowns(), unknowns()), load_};
    const std::vector<std::int64_t>& at = zone.unknowns();
    for (std::size_t j = 0; j < at.size(); ++j)
        for (std::size_t i = 0; i < at.size(); ++i)
            energy.stiffness(at[i], at[j]) =
                zone.energy().stiffness(static_cast<std::int64_t>(i), static_cast<std::int64_t>(j));
    return energy;
}

}  // namespace delam
