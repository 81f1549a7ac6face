// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/feti_zone.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "linalg/sparse/block.hpp"
#include "reduction/dense/rigid_jumps.hpp"

namespace delam {

namespace {

// Columns are right to 1e-12 (jump_columns.cpp): what is left of a stiffness without its springs has three digits then.
// (Measured by verify/bench/constants.py on 250 random scenes: from a hundredth to a hundred times all decide alike.)
constexpr double least_difference = 1e-9;

}  // namespace

FetiZone::FetiZone(const Problem& problem, const std::vector<Subdomain>& subdomains, DualOperator& dual,
                   const DualLoads& loads, Monitor& monitor)
    : problem_(problem),
      dual_(dual),
      monitor_(monitor),
      columns_(problem, subdomains, dual, loads, monitor),
      equations_(dual, loads, problem.patterns.size()),
      motions_(problem),
      rigid_(motions_.jumps()) {}

// A.
std::vector<std::int64_t> FetiZone::changed(const Springs& springs, std::span<const std::uint8_t> wanted) const {
    const Springs& base = columns_.base();
    std::vector<std::uint8_t> group(columns_.groups(), 0);
    for (std::size_t r = 0; r < wanted.size(); ++r) {
        if (!columns_.has_spring(r)) continue;
        const bool same = springs.held[r] == 0 && springs.stiffness[r] == base.stiffness[r];
        if (wanted[r] != 0 || !same) group[columns_.group_of(r)] = 1;
    }
    std::vector<std::int64_t> rows;
    for (std::size_t r = 0; r < wanted.size(); ++r)
        if (columns_.has_spring(r) && group[columns_.group_of(r)] != 0) rows.push_back(static_cast<std::int64_t>(r));
    return rows;
}

bool FetiZone::allowed(std::span<const std::int64_t> rows) const {
    const Limits& limits = problem_.options.limits;
    if (rows.empty() || rows.size() > index(limits.feti_zone_rows)) return false;
    const std::size_t width = columns_.group_rows();
    return columns_.bytes((rows.size() + width - 1) / width) <= limits.feti_zone_bytes;
}

bool FetiZone::find_energy(std::vector<std::int64_t> wanted) {
    zone_.reset();
    rest_.reset();
    changed_.clear();
    dependent_ = equations_.among(wanted, [this](std::size_t r) { return columns_.has_spring(r); });
    rows_.clear();
    for (const std::int64_t r : wanted)
        if (std::none_of(dependent_.begin(), dependent_.end(), [r](const auto& d) { return d.row == r; }))
            rows_.push_back(r);
    if (rows_.empty() || !columns_.energy(rows_, energy_)) return false;
    for (JumpEquations::Dependent& d : dependent_)
        for (auto& [r, n] : d.jump.unknowns) r = std::lower_bound(rows_.begin(), rows_.end(), r) - rows_.begin();
    if (!take_out_springs()) return false;
    find_motions(wanted);
    changed_ = std::move(wanted);  // last: an energy that an exception has interrupted is not known
    return true;
}

// The energy has the dependent rows at the springs of the base, s/2 (n x + o theta)^2.
bool FetiZone::take_out_springs() {
    const DenseMatrix before = energy_.stiffness;
    for (const JumpEquations::Dependent& d : dependent_) {
        const double s = columns_.base().stiffness[index(d.row)];
        for (const auto& [i, n] : d.jump.unknowns) {
            for (const auto& [k, m] : d.jump.unknowns) energy_.stiffness(i, k) -= s * n * m;
            for (std::size_t q = 0; q < d.jump.offset.size(); ++q)
                energy_.load(i, static_cast<std::int64_t>(q)) += s * n * d.jump.offset[q];
        }
    }
    for (std::int64_t i = 0; i < before.rows; ++i)
        if (!(energy_.stiffness(i, i) > least_difference * before(i, i))) return false;
    return true;
}

// The motions that no row outside A holds do not strain anything: S Z = 0, exactly.
void FetiZone::find_motions(std::span<const std::int64_t> changed) {
    anchors_.clear();
    if (rigid_.columns == 0) return;
    std::vector<std::uint8_t> active(index(rigid_.rows), 1);
    for (const std::int64_t r : changed) active[index(r)] = 0;
    const DenseMatrix free = multiply(rigid_, split_motions(rigid_, active).free);
    if (free.columns == 0) return;
    const auto n = static_cast<std::int64_t>(rows_.size());
    DenseMatrix z(n, free.columns), across(free.columns, n);
    for (std::int64_t c = 0; c < free.columns; ++c)
        for (std::int64_t i = 0; i < n; ++i) z(i, c) = across(c, i) = free(rows_[index(i)], c);
    const PivotedColumns pivots = pivoted_columns(std::move(across), 1e-10);
    for (std::int64_t k = 0; k < pivots.rank; ++k) anchors_.push_back(pivots.order[index(k)]);
    z = orthonormalised(std::move(z));
    const DenseMatrix strained = multiply(energy_.stiffness, z), twice = multiply_transposed(z, strained);
    for (std::int64_t a = 0; a < n; ++a)
        for (std::int64_t i = 0; i < n; ++i)
            for (std::int64_t c = 0; c < z.columns; ++c) {
                energy_.stiffness(i, a) -= strained(i, c) * z(a, c) + z(i, c) * strained(a, c);
                for (std::int64_t d = 0; d < z.columns; ++d) energy_.stiffness(i, a) += z(i, c) * twice(c, d) * z(a, d);
            }
}

FetiZone::Split FetiZone::split(const Springs& springs, std::span<const std::uint8_t> wanted) const {
    const std::size_t dim = index(problem_.mesh->dimension());
    std::vector<std::uint8_t> group(columns_.groups(), 0), pair(wanted.size() / dim, 0);
    for (std::size_t r = 0; r < wanted.size(); ++r)
        if (wanted[r] != 0) group[columns_.group_of(r)] = 1;
    for (const std::int64_t a : anchors_) pair[index(rows_[index(a)]) / dim] = 1;
    for (const JumpEquations::Dependent& d : dependent_) {
        pair[index(d.row) / dim] = 1;
        for (const auto& [i, n] : d.jump.unknowns) pair[index(rows_[index(i)]) / dim] = 1;
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const std::size_t r = index(rows_[i]);
        const double s = springs.stiffness[r], body = energy_.stiffness.value[i * (rows_.size() + 1)];
        if (springs.held[r] == 0 && s > 0.0 && s < weakest_hold * body) pair[r / dim] = 1;
    }
    Split result{{}, std::vector<double>(rows_.size(), 0.0)};
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const std::size_t r = index(rows_[i]);
        if (group[columns_.group_of(r)] != 0 || pair[r / dim] != 0)
            result.kept.push_back(static_cast<std::int64_t>(i));
        else
            result.spring[i] = springs.held[r] != 0 ? -1.0 : springs.stiffness[r];
    }
    return result;
}

// Motions that nothing outside the zone holds, over the zone's unknowns.
ZoneMotions FetiZone::floating() const {
    std::vector<std::uint8_t> active(index(rigid_.rows), 1);
    std::vector<std::int64_t> row_of;
    for (std::size_t i = 0; i < rows_.size(); ++i) active[index(rows_[i])] = split_.spring[i] != 0.0 ? 1 : 0;
    for (const JumpEquations::Dependent& d : dependent_) active[index(d.row)] = 0;
    for (const std::int64_t kept : split_.kept) row_of.push_back(rows_[index(kept)]);
    return ZoneMotions::of(rigid_, motions_.dead_work(), active, row_of);
}

bool FetiZone::minimise_out(Split split) {
    const Poll poll = [this] { monitor_.progress("zone", 0, 0); };
    zone_.reset();
    rest_.reset();
    split_ = std::move(split);
    const std::size_t dim = index(problem_.mesh->dimension());
    std::vector<std::int64_t> eliminated, place(index(rigid_.rows), -1);
    std::vector<std::uint8_t> pair(index(rigid_.rows) / dim, 0);
    for (std::size_t k = 0; k < split_.kept.size(); ++k) {
        const std::size_t r = index(rows_[index(split_.kept[k])]);
        place[r] = static_cast<std::int64_t>(k);
        pair[r / dim] = 1;
    }
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (place[index(rows_[i])] < 0 && split_.spring[i] >= 0.0) eliminated.push_back(static_cast<std::int64_t>(i));
    try {
        rest_ = std::make_unique<Condensation>(energy_, split_.kept, std::move(eliminated), split_.spring, poll);
    } catch (const Error& error) {
        if (error.status() != DELAM_ERROR_NUMERICAL) throw;
        return false;
    }
    std::map<std::int64_t, JumpRow> rows;
    for (const JumpEquations::Dependent& d : dependent_) {
        JumpRow& row = rows[d.row] = d.jump;
        for (auto& [i, n] : row.unknowns) i = place[index(rows_[index(i)])];
        pair[index(d.row) / dim] = 1;
    }
    for (std::size_t r = 0; r < place.size(); ++r) {
        if (place[r] >= 0) rows[static_cast<std::int64_t>(r)] = {{{place[r], 1.0}}, {}};
        if (pair[r / dim] != 0 && dual_.scaling().prescribed[r] != 0)
            rows[static_cast<std::int64_t>(r)] = {{}, equations_.prescribed(r)};
    }
    std::vector<JumpRow> jumps;
    std::vector<std::int64_t> jump_rows;
    for (auto& [r, row] : rows) {
        jump_rows.push_back(r);
        jumps.push_back(std::move(row));
    }
    zone_ = std::make_unique<DenseZone>(rest_->energy(), std::move(jumps), std::move(jump_rows), floating(), poll);
    return true;
}

DenseZone* FetiZone::zone(const Springs& springs, std::span<const std::uint8_t> wanted) {
    std::vector<std::int64_t> rows = changed(springs, wanted);
    if (!allowed(rows)) return nullptr;
    if (rows != changed_ && !find_energy(std::move(rows))) return nullptr;
    Split now = split(springs, wanted);
    if (now.kept.empty()) return nullptr;
    if (zone_ != nullptr && now == split_)
        zone_->forget();  // no history: this operator has no memory
    else if (!minimise_out(std::move(now)))
        return nullptr;
    return zone_.get();
}

}  // namespace delam
