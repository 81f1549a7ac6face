// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/patches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "linalg/sparse/sparse_elimination.hpp"
#include "reduction/sparse/neighbourhood.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

namespace {

// Springs that are nowhere softer than these and pull nothing apart: negative ones are left out, and what couples two
// variables stiffens both.
std::vector<Triplet> stiffened(std::span<const Triplet> springs) {
    std::vector<Triplet> out;
    for (const Triplet& t : springs)
        if (t.row != t.column)
            out.push_back({t.row, t.row, std::abs(t.value)});
        else if (t.value > 0.0)
            out.push_back(t);
    return out;
}

}  // namespace

Patches::Patches(const JumpSystem& system)
    : system_(system),
      margin_(system.limits().patch_margin),
      share_(system.limits().patch_largest),
      barred_(index(system.count()), 0),
      inner_(barred_),
      member_(barred_) {
    const SparseMatrix& a = system.matrix();
    const double mean = static_cast<double>(a.entries()) / static_cast<double>(std::max<std::int64_t>(1, a.rows));
    for (const SparseVector& equation : system.rows().equations())
        for (const auto& [i, c] : equation)
            barred_[index(i)] =
                !(system.diagonal()[index(i)] > 0.0) ||
                static_cast<double>(a.start[index(i) + 1] - a.start[index(i)]) > system.limits().patch_crowded * mean;
}

// The widest margin, of 5, 2 and 1 rings, whose patches have no more than the share; 0: none.
std::int64_t Patches::margin_within_share(std::span<const std::int64_t> ring) const {
    std::vector<std::int64_t> within(index(margin_) + 2, 0);
    for (const std::int64_t r : ring) ++within[index(r)];
    for (std::size_t r = 1; r < within.size(); ++r) within[r] += within[r - 1];
    std::int64_t margin = margin_;
    while (margin > 0 && static_cast<double>(within[index(margin)]) > share_ * static_cast<double>(ring.size()))
        margin /= 2;
    return margin;
}

std::int64_t Patches::variables() const {
    std::int64_t sum = 0;
    for (const Patch& p : patches_) sum += static_cast<std::int64_t>(p.variables.size());
    return sum;
}

double Patches::flops() const {
    double sum = 0.0;
    for (const Patch& p : patches_) sum += p.factor->size().flops;
    return sum;
}

double Patches::entries() const {
    double sum = 0.0;
    for (const Patch& p : patches_) sum += p.factor->factor_entries();
    return sum;
}

void Patches::forget() {
    patches_.clear();
    seeds_.clear();
    narrow_ = false;
    std::fill(inner_.begin(), inner_.end(), std::uint8_t{0});
    std::fill(member_.begin(), member_.end(), std::uint8_t{0});
}

bool Patches::cover(std::span<const std::int64_t> seeds, bool any_size, const Poll& poll) {
    if (std::all_of(seeds.begin(), seeds.end(),
                    [&](std::int64_t i) { return inner_[index(i)] != 0 || barred_[index(i)] != 0; }))
        return true;
    std::vector<std::int64_t> ring = rings(system_.matrix(), seeds, barred_, margin_);
    const std::int64_t fitting = margin_within_share(ring), margin = std::max<std::int64_t>(1, fitting);
    if (fitting == 0 && !any_size) return false;
    std::vector<std::uint8_t> inner(ring.size()), member(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        inner[i] = 2 * ring[i] <= margin ? 1 : 0;
        member[i] = ring[i] <= margin ? 1 : 0;
    }
    // Connected parts; a visited variable is marked as beyond the margin.
    const SparseMatrix& a = system_.matrix();
    std::vector<Patch> chosen;
    std::vector<std::size_t> stay;
    std::vector<std::int64_t> stack;
    for (std::size_t first = 0; first < ring.size(); ++first) {
        if (ring[first] > margin) continue;
        std::vector<std::int64_t> part;
        stack.assign(1, static_cast<std::int64_t>(first));
        ring[first] = margin_ + 1;
        while (!stack.empty()) {
            const std::int64_t i = stack.back();
            stack.pop_back();
            part.push_back(i);
            for (std::int64_t e = a.start[index(i)]; e < a.start[index(i) + 1]; ++e) {
                const std::int64_t j = a.column[index(e)];
                if (ring[index(j)] > margin) continue;
                ring[index(j)] = margin_ + 1;
                stack.push_back(j);
            }
        }
        std::sort(part.begin(), part.end());
        const auto same =
            std::find_if(patches_.begin(), patches_.end(), [&](const Patch& p) { return p.variables == part; });
        if (same != patches_.end())
            stay.push_back(index(same - patches_.begin()));
        else
            chosen.push_back(make(std::move(part), poll));
    }
    chosen.reserve(chosen.size() + stay.size());
    std::vector<std::int64_t> chosen_for(seeds.begin(), seeds.end());
    // Nothing fails from here on: an interrupted choice leaves the one before.
    for (const std::size_t p : stay) chosen.push_back(std::move(patches_[p]));
    patches_ = std::move(chosen);
    seeds_ = std::move(chosen_for);
    inner_ = std::move(inner);
    member_ = std::move(member);
    narrow_ = margin < margin_;
    return true;
}

Patches::Patch Patches::make(std::vector<std::int64_t> variables, const Poll& poll) {
    call_if_set(poll);
    Patch patch;
    patch.variables = std::move(variables);
    patch.matrix = submatrix(system_.matrix(), patch.variables);
    take_equations(patch);
    patch.factor = std::make_unique<SparseCholesky>(patch.matrix, 0, poll);
    cost_ += system_.limits().patch_analysis * static_cast<double>(patch.matrix.entries());
    return patch;
}

// The parts of constraints that lie in the patch, independent ones.
void Patches::take_equations(Patch& patch) const {
    SparseElimination known;
    for (const SparseVector& equation : system_.rows().equations()) {
        SparseVector own;
        for (const auto& [i, c] : equation) {
            const auto at = std::lower_bound(patch.variables.begin(), patch.variables.end(), i);
            if (at != patch.variables.end() && *at == i) own.emplace_back(at - patch.variables.begin(), c);
        }
        SparseElimination::Row row{{own.begin(), own.end()}, {}};
        known.reduce(row);
        if (row.terms.empty()) continue;
        const auto largest = std::max_element(row.terms.begin(), row.terms.end(), [](const auto& a, const auto& b) {
            return std::abs(a.second) < std::abs(b.second);
        });
        known.solve(row, largest->first);
        for (const auto& [k, c] : own) {
            const SparseMatrix& m = patch.matrix;
            const auto begin = m.column.begin() + m.start[index(k)], end = m.column.begin() + m.start[index(k) + 1];
            patch.matrix.value[index(std::lower_bound(begin, end, k) - m.column.begin())] +=
                constraint_shift * system_.diagonal()[index(patch.variables[index(k)])];
        }
        patch.equations.push_back(std::move(own));
    }
}

bool Patches::factorise(Patch& patch, std::span<const Triplet> springs) {
    SparseMatrix matrix = patch.matrix;
    add_entries(matrix, springs);
    return patch.factor->factorise(matrix);
}

bool Patches::factorise(std::span<const Triplet> springs, const Poll& poll) {
    std::vector<std::int64_t> patch_of(index(system_.count()), -1), place(patch_of.size());
    for (std::size_t p = 0; p < patches_.size(); ++p)
        for (std::size_t k = 0; k < patches_[p].variables.size(); ++k) {
            patch_of[index(patches_[p].variables[k])] = static_cast<std::int64_t>(p);
            place[index(patches_[p].variables[k])] = static_cast<std::int64_t>(k);
        }
    std::vector<std::vector<Triplet>> own(patches_.size());
    for (const Triplet& t : springs) {
        const std::int64_t p = patch_of[index(t.row)];
        if (p >= 0 && p == patch_of[index(t.column)])
            own[index(p)].push_back({place[index(t.row)], place[index(t.column)], t.value});
    }
    const auto same = [](const Triplet& a, const Triplet& b) {
        return a.row == b.row && a.column == b.column && a.value == b.value;
    };
    for (std::size_t p = 0; p < patches_.size(); ++p) {
        Patch& patch = patches_[p];
        if (patch.factored && std::ranges::equal(patch.springs, own[p], same)) continue;
        call_if_set(poll);
        patch.factored = false;
        patch.springs = std::move(own[p]);
        bool definite = factorise(patch, patch.springs);
        // Constraints may hold what tangents leave indefinite; the iteration finds out.
        if (!definite && !patch.equations.empty()) definite = factorise(patch, stiffened(patch.springs));
        if (!definite) return false;
        const auto solve = [&](std::span<const double> b, std::span<double> x) { patch.factor->solve(b, x); };
        patch.factored = patch.constraints.set(patch.equations, patch.matrix.rows, solve, poll);
        if (!patch.factored) return false;
    }
    return true;
}

void Patches::add(std::span<const double> r, std::span<double> z) const {
    std::vector<double> right, x;
    for (const Patch& patch : patches_) {
        right.resize(patch.variables.size());
        x.resize(right.size());
        for (std::size_t k = 0; k < right.size(); ++k) right[k] = r[index(patch.variables[k])];
        poll_cancel_reading("linear solve", static_cast<std::int64_t>(patch.factor->factor_entries()));
        patch.factor->solve(right, x);
        patch.constraints.apply(x);
        for (std::size_t k = 0; k < right.size(); ++k) z[index(patch.variables[k])] += x[k];
    }
}

}  // namespace delam
