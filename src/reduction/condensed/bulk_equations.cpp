// SPDX-License-Identifier: BSD-3-Clause
// Constraints that bind several trailing variables: they express some of them by the rest, after which the energy is
// one of the unknown jumps alone.
#include <cmath>
#include <map>
#include <numeric>

#include "base/numbers.hpp"
#include "reduction/condensed/bulk.hpp"

namespace delam {

// Equations express some trailing variables by the rest.
void Bulk::resolve_equations() {
    const std::int64_t trailing = variables().trailing(), kept = variables().kept;
    const std::vector<SolvedEquation> solved = solve_equations(variables());
    for (const SolvedEquation& equation : solved) pivot_.push_back(equation.pivot);
    role_.assign(index(trailing), -1);
    for (std::size_t i = 0; i < pivot_.size(); ++i) role_[index(pivot_[i])] = -2 - static_cast<std::int64_t>(i);
    for (std::int64_t t = 0; t < trailing; ++t) {
        if (role_[index(t)] < -1) continue;
        role_[index(t)] = static_cast<std::int64_t>(rest_.size());
        rest_.push_back(t);
        if (t < kept) ++kept_rest_;
    }
    prescribed_ =
        DenseMatrix(static_cast<std::int64_t>(pivot_.size()), static_cast<std::int64_t>(problem_.patterns.size()));
    bound_.resize(pivot_.size());
    binds_.resize(rest_.size());
    bound_unknown_.assign(rest_.size() - index(kept_rest_), 0);
    for (std::size_t i = 0; i < pivot_.size(); ++i) {
        const auto pivot = static_cast<std::int64_t>(i);
        for (const auto& [t, c] : solved[i].entries) {
            const std::int64_t r = role_[index(t)];
            bound_[i].emplace_back(r, c);
            binds_[index(r)].emplace_back(pivot, c);
            if (r >= kept_rest_) bound_unknown_[index(r - kept_rest_)] = 1;
        }
        for (std::int64_t p = 0; p < prescribed_.columns; ++p) prescribed_(pivot, p) = solved[i].prescribed[index(p)];
    }
    express_rows();
}

// The rows of the jumps as functions of the unknowns.
void Bulk::express_rows() {
    for (std::size_t r = 0; r < variables().row.size(); ++r) {
        const SparseVector& in_jumps = variables().row[r];
        JumpRow row;
        row.offset = variables().row_offset[r];
        std::map<std::int64_t, double> entries;
        for (const auto& [jump, c] : in_jumps) {
            const std::int64_t at = role_[index(variables().kept + jump)];
            if (at >= 0) {
                entries[at - kept_rest_] += c;
                continue;
            }
            const std::int64_t pivot = -2 - at;
            for (const auto& [j, m] : bound_[index(pivot)])
                if (j >= kept_rest_ && std::abs(m) > dependent_equation) entries[j - kept_rest_] += c * m;
            if (row.offset.empty()) row.offset.assign(problem_.patterns.size(), 0.0);
            for (std::int64_t p = 0; p < prescribed_.columns; ++p) row.offset[index(p)] += c * prescribed_(pivot, p);
        }
        for (const auto& [i, c] : entries)
            if (std::abs(c) > dependent_equation) row.unknowns.emplace_back(i, c);
        rows_.push_back(std::move(row));
    }
    row_of_unknown_.assign(rest_.size() - index(kept_rest_), -1);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (rows_[r].unknowns.size() != 1 || rows_[r].unknowns.front().second != 1.0 || !rows_[r].offset.empty())
            continue;
        std::int64_t& first = row_of_unknown_[index(rows_[r].unknowns.front().first)];
        if (first < 0) first = static_cast<std::int64_t>(r);
    }
}

// States of the skeleton: jumps that equations determine always stay.
std::vector<double> Bulk::states(std::span<const double> of_unknowns) const {
    std::vector<double> state(superelements_->variable().size(), 0.0);
    for (std::int64_t i = 0; i < unknowns(); ++i)
        state[index(place(i))] = bound_unknown_[index(i)] != 0 ? Elimination::in_zone : of_unknowns[index(i)];
    for (const std::int64_t t : pivot_)
        if (t >= variables().kept) state[index(superelements_->place(variables().leading + t))] = Elimination::in_zone;
    return state;
}

// The forces T^T f on one of r: its own and those on the variables that it determines.
double Bulk::on_rest(std::span<const double> carried, std::int64_t rest) const {
    const std::int64_t leading = variables().leading;
    double force = carried[index(leading + rest_[index(rest)])];
    for (const auto& [pivot, m] : binds_[index(rest)]) force += m * carried[index(leading + pivot_[index(pivot)])];
    return force;
}

// The equations t_pivot = M r + d theta reduce the energy in all trailing variables to
// S_rr + S_rp M + M^T S_pr + M^T S_pp M   and   L_r + M^T L_p - (S_rp + M^T S_pp) d.
Bulk::Reduced Bulk::reduce(const Elimination& elimination) const {
    Reduced r;
    const DenseEnergy& energy = elimination.energy();
    std::vector<std::int64_t> at(rest_.size(), -1);
    for (std::int64_t i = 0; i < energy.rows(); ++i) {
        const std::int64_t variable = superelements_->variable()[index(elimination.places()[index(i)])];
        const std::int64_t role = role_[index(variable - variables().leading)];
        if (role >= 0) {
            at[index(role)] = static_cast<std::int64_t>(r.rest.size());
            r.rest.push_back(i);
            r.rest_number.push_back(role);
        } else {
            r.pivot.push_back(i);
            r.pivot_number.push_back(-2 - role);
        }
    }
    if (r.pivot.empty()) return r;
    const auto pick = [](const DenseMatrix& a, std::span<const std::int64_t> rows, std::span<const std::int64_t> c) {
        DenseMatrix b(static_cast<std::int64_t>(rows.size()), static_cast<std::int64_t>(c.size()));
        for (std::int64_t j = 0; j < b.columns; ++j)
            for (std::int64_t i = 0; i < b.rows; ++i) b(i, j) = a(rows[index(i)], c[index(j)]);
        return b;
    };
    std::vector<std::int64_t> all(index(energy.load.columns));
    std::iota(all.begin(), all.end(), 0);
    r.binding = DenseMatrix(static_cast<std::int64_t>(r.pivot.size()), static_cast<std::int64_t>(r.rest.size()));
    for (std::int64_t i = 0; i < r.binding.rows; ++i)
        for (const auto& [j, m] : bound_[index(r.pivot_number[index(i)])]) r.binding(i, at[index(j)]) = m;
    const DenseMatrix s_pp = pick(energy.stiffness, r.pivot, r.pivot), s_pr = pick(energy.stiffness, r.pivot, r.rest);
    r.energy = {pick(energy.stiffness, r.rest, r.rest), pick(energy.load, r.rest, all)};
    DenseMatrix half = multiply(s_pp, r.binding);
    for (std::size_t i = 0; i < half.value.size(); ++i) half.value[i] = 0.5 * half.value[i] + s_pr.value[i];
    const DenseMatrix product = multiply_transposed(r.binding, half);
    const std::int64_t rest = r.energy.rows();
    for (std::int64_t j = 0; j < rest; ++j)
        for (std::int64_t i = 0; i < rest; ++i) r.energy.stiffness(i, j) += product(i, j) + product(j, i);
    if (all.empty()) return r;
    const DenseMatrix l_p = pick(energy.load, r.pivot, all), d = pick(prescribed_, r.pivot_number, all);
    DenseMatrix right = multiply(s_pp, d);
    for (std::size_t i = 0; i < right.value.size(); ++i) right.value[i] = l_p.value[i] - right.value[i];
    const DenseMatrix through = multiply_transposed(r.binding, right), direct = multiply_transposed(s_pr, d);
    for (std::size_t i = 0; i < r.energy.load.value.size(); ++i)
        r.energy.load.value[i] += through.value[i] - direct.value[i];
    return r;
}

Bulk::ZoneEnergy::ZoneEnergy(const Bulk& bulk, const Elimination& elimination, const Poll& poll)
    : bulk_(&bulk), elimination_(&elimination), reduced_(bulk.reduce(elimination)) {
    std::vector<std::int64_t> kept, zone;
    for (std::size_t i = 0; i < reduced_.rest_number.size(); ++i) {
        const std::int64_t unknown = reduced_.rest_number[i] - bulk.kept_rest_;
        (unknown < 0 ? kept : zone).push_back(static_cast<std::int64_t>(i));
        if (unknown >= 0) unknowns_.push_back(unknown);
    }
    if (kept.empty()) return;
    base_ = std::make_unique<Condensation>(energy(), std::move(zone), std::move(kept),
                                           std::vector<double>(reduced_.rest.size(), 0.0), poll);
    reduced_.energy = DenseEnergy();
}

std::vector<double> Bulk::ZoneEnergy::recover(std::span<const double> theta, std::span<const double> zone) const {
    std::vector<double> rest(reduced_.rest.size()), all(reduced_.rest.size() + reduced_.pivot.size());
    if (base_)
        base_->recover(theta, zone, rest);
    else
        std::copy(zone.begin(), zone.end(), rest.begin());
    for (std::size_t i = 0; i < rest.size(); ++i) all[index(reduced_.rest[i])] = rest[i];
    if (reduced_.pivot.empty()) return all;
    std::vector<double> bound(reduced_.pivot.size());
    multiply(reduced_.binding, rest, bound);
    for (std::size_t i = 0; i < bound.size(); ++i) {
        for (std::size_t p = 0; p < theta.size(); ++p)
            bound[i] += bulk_->prescribed_(reduced_.pivot_number[i], static_cast<std::int64_t>(p)) * theta[p];
        all[index(reduced_.pivot[i])] = bound[i];
    }
    return all;
}

}  // namespace delam
