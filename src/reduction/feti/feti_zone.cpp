// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/feti_zone.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "linalg/sparse/block.hpp"
#include "reduction/dense/rigid_jumps.hpp"

namespace delam {

FetiZone::FetiZone(const Problem& problem, const std::vector<Subdomain>& subdomains, DualOperator& dual,
                   const DualLoads& loads, Monitor& monitor)
    : problem_(problem),
      dual_(dual),
      loads_(loads),
      monitor_(monitor),
      columns_(problem, subdomains, dual, loads, monitor),
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

// Rows that depend on each other have no flexibility in some direction: all of them together cannot be unknowns. A
// dependency without springs, of supports on both faces of a pair, leaves no unknown.
bool FetiZone::allowed(std::span<const std::int64_t> rows) const {
    const Limits& limits = problem_.options.limits;
    if (rows.empty() || rows.size() > index(limits.feti_zone_rows)) return false;
    const std::size_t width = columns_.group_rows();
    if (columns_.bytes((rows.size() + width - 1) / width) > limits.feti_zone_bytes) return false;
    for (const Scaling::Dependency& dependency : dual_.scaling().dependencies) {
        std::int64_t outside = 0, unknown = 0;
        for (const std::int64_t r : dependency.row) {
            if (r >= dual_.rows().jump_count || !columns_.has_spring(index(r))) continue;
            (std::binary_search(rows.begin(), rows.end(), r) ? unknown : outside) += 1;
        }
        if (unknown > 0 && outside == 0) return false;
    }
    return true;
}

bool FetiZone::find_energy(std::vector<std::int64_t> rows) {
    zone_.reset();
    rest_.reset();
    rows_.clear();
    if (!columns_.energy(rows, energy_)) return false;
    find_motions(rows);
    rows_ = std::move(rows);  // last: an energy whose motions an exception has interrupted is not known
    return true;
}

// The motions that no row outside A holds do not strain anything: S Z = 0, exactly.
void FetiZone::find_motions(std::span<const std::int64_t> rows) {
    anchors_.clear();
    if (rigid_.columns == 0) return;
    std::vector<std::uint8_t> active(index(rigid_.rows), 1);
    for (const std::int64_t r : rows) active[index(r)] = 0;
    const DenseMatrix free = multiply(rigid_, split_motions(rigid_, active).free);
    if (free.columns == 0) return;
    const auto n = static_cast<std::int64_t>(rows.size());
    DenseMatrix z(n, free.columns), across(free.columns, n);
    for (std::int64_t c = 0; c < free.columns; ++c)
        for (std::int64_t i = 0; i < n; ++i) z(i, c) = across(c, i) = free(rows[index(i)], c);
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

// Returns the jump that constraints and gaps prescribe on a row, [patterns].
std::vector<double> FetiZone::driven(std::size_t row) const {
    const std::size_t patterns = problem_.patterns.size(),
                      first = index(dual_.rows().count() - dual_.rows().constraint_count);
    std::vector<double> offset(patterns, 0.0);
    for (const Scaling::Prescribed& p : dual_.scaling().prescribed_jumps)
        for (std::size_t k = 0; k < p.row.size() && index(p.jump_row) == row; ++k)
            for (std::size_t q = 0; q < patterns && index(p.row[k]) >= first; ++q)
                offset[q] += p.y[k] * loads_.prescribed[(index(p.row[k]) - first) * patterns + q];
    for (const GapRow& gap : loads_.gaps)
        if (index(gap.row) == row) offset[index(gap.pattern)] += gap.value;
    return offset;
}

// Motions that nothing outside the zone holds, over the zone's unknowns.
ZoneMotions FetiZone::floating() const {
    std::vector<std::uint8_t> active(index(rigid_.rows), 1);
    std::vector<std::int64_t> row_of;
    for (std::size_t i = 0; i < rows_.size(); ++i) active[index(rows_[i])] = split_.spring[i] != 0.0 ? 1 : 0;
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
    std::vector<JumpRow> rows;
    std::vector<std::int64_t> jump_rows;
    for (std::size_t r = 0; r < place.size(); ++r) {
        const bool given = dual_.scaling().prescribed[r] != 0;
        if (pair[r / dim] == 0 || (place[r] < 0 && !given)) continue;
        rows.push_back(given ? JumpRow{{}, driven(r)} : JumpRow{{{place[r], 1.0}}, {}});
        jump_rows.push_back(static_cast<std::int64_t>(r));
    }
    zone_ = std::make_unique<DenseZone>(rest_->energy(), std::move(rows), std::move(jump_rows), floating(), poll);
    return true;
}

DenseZone* FetiZone::zone(const Springs& springs, std::span<const std::uint8_t> wanted) {
    std::vector<std::int64_t> rows = changed(springs, wanted);
    if (!allowed(rows)) return nullptr;
    if (rows != rows_ && !find_energy(std::move(rows))) return nullptr;
    Split now = split(springs, wanted);
    if (now.kept.empty()) return nullptr;
    if (zone_ != nullptr && now == split_)
        zone_->forget();  // no history: this operator has no memory
    else if (!minimise_out(std::move(now)))
        return nullptr;
    return zone_.get();
}

}  // namespace delam
