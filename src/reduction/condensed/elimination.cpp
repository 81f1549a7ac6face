// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/elimination.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// Zeros, in the memory of what was there.
void clear(DenseMatrix& a, std::int64_t rows, std::int64_t columns) {
    a.rows = rows;
    a.columns = columns;
    a.value.assign(index(rows * columns), 0.0);
}

}  // namespace

Elimination::Elimination(const Superelements& bodies, DenseMatrix load)
    : bodies_(bodies),
      load_(std::move(load)),
      state_(bodies.variable().size(), held),
      front_(bodies.nodes().size()),
      at_(bodies.variable().size(), -1) {}

void Elimination::update(std::span<const double> state, const Poll& poll) {
    const std::vector<Superelements::Node>& nodes = bodies_.nodes();
    const bool all = !valid_;
    valid_ = false;
    std::vector<std::uint8_t> stale(nodes.size(), 0);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const auto changed = [&](std::int64_t p) { return state[index(p)] != state_[index(p)]; };
        // Of a jump on the border, a subtree must know only whether it is held, and whether it is in the zone.
        const auto changed_kind = [&](std::int64_t p) {
            const double now = state[index(p)], before = state_[index(p)];
            return now != before && (now < 0.0 || before < 0.0);
        };
        bool again = all || std::any_of(nodes[n].jumps.begin(), nodes[n].jumps.end(), changed) ||
                     std::any_of(nodes[n].border.begin(), nodes[n].border.end(), changed_kind);
        for (const std::int64_t child : nodes[n].children) again = again || stale[index(child)] != 0;
        stale[n] = again ? 1 : 0;
    }
    state_.assign(state.begin(), state.end());
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (stale[n] != 0) eliminate(n, poll);
    mirror_lower(front_.back().energy.stiffness);
    valid_ = true;
}

// The lower triangle of an energy into that of a front; `at` ascends.
void Elimination::add(Front& front, std::span<const std::int64_t> at, const DenseEnergy& energy) {
    const auto e = static_cast<std::int64_t>(front.out.size());
    const DenseMatrix& s = energy.stiffness;
    for (std::int64_t j = 0; j < s.columns; ++j) {
        const std::int64_t c = at[index(j)];
        if (c < 0) continue;
        const double* column = s.value.data() + j * s.rows;
        double* target;
        std::int64_t i = j;
        if (c < e) {
            target = front.factor.value.data() + c * e;
            for (; i < s.rows && at[index(i)] < e; ++i)
                if (at[index(i)] >= 0) target[at[index(i)]] += column[i];
            for (; i < s.rows; ++i)
                if (at[index(i)] >= 0) front.coupling.value[index(c + (at[index(i)] - e) * e)] += column[i];
        } else {
            target = front.energy.stiffness.value.data() + (c - e) * front.energy.stiffness.rows - e;
            for (; i < s.rows; ++i)
                if (at[index(i)] >= 0) target[at[index(i)]] += column[i];
        }
    }
    for (std::int64_t p = 0; p < energy.load.columns; ++p)
        for (std::int64_t i = 0; i < energy.load.rows; ++i) {
            const std::int64_t r = at[index(i)];
            if (r >= 0) (r < e ? front.load(r, p) : front.energy.load(r - e, p)) += energy.load(i, p);
        }
}

// What a node eliminates, and what it leaves: the border, then the zone; all ascending.
void Elimination::divide(Front& front, const Superelements::Node& node) {
    std::vector<std::int64_t> zone;
    front.left.clear();
    front.out = node.cut;
    const auto take = [&](std::int64_t p, std::vector<std::int64_t>& otherwise) {
        if (state_[index(p)] == in_zone)
            zone.push_back(p);
        else if (state_[index(p)] != held)
            otherwise.push_back(p);
    };
    for (const std::int64_t p : node.jumps) take(p, front.out);
    for (const std::int64_t p : node.border) take(p, front.left);
    for (const std::int64_t child : node.children)
        for (const std::int64_t p : front_[index(child)].left)
            if (state_[index(p)] == in_zone) zone.push_back(p);
    std::sort(front.out.begin(), front.out.end());
    std::sort(zone.begin(), zone.end());
    zone.erase(std::unique(zone.begin(), zone.end()), zone.end());
    front.left.insert(front.left.end(), zone.begin(), zone.end());
    const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size());
    clear(front.factor, e, e);
    clear(front.coupling, e, r);
    clear(front.energy.stiffness, r, r);
    clear(front.load, e, load_.columns);
    clear(front.energy.load, r, load_.columns);
}

void Elimination::add_leaf(Front& front, std::int64_t leaf) {
    const DenseMatrix& s = bodies_.stiffness(leaf);
    const std::vector<std::int64_t>& rows = bodies_.rows(leaf);
    const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size());
    std::vector<std::int64_t> from(index(e + r));
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (at_[index(rows[i])] >= 0) from[index(at_[index(rows[i])])] = static_cast<std::int64_t>(i);
    for (std::int64_t j = 0; j < e; ++j) {
        const double* column = s.value.data() + from[index(j)] * s.rows;
        double* target = front.factor.value.data() + j * e;
        for (std::int64_t i = j; i < e; ++i) target[i] = column[from[index(i)]];
    }
    for (std::int64_t j = 0; j < r; ++j) {
        const double* column = s.value.data() + from[index(e + j)] * s.rows;
        double* target = front.coupling.value.data() + j * e;
        for (std::int64_t i = 0; i < e; ++i) target[i] = column[from[index(i)]];
        target = front.energy.stiffness.value.data() + j * r;
        for (std::int64_t i = j; i < r; ++i) target[i] = column[from[index(e + i)]];
    }
}

void Elimination::add_entries(Front& front, std::span<const Triplet> entries) {
    const auto e = static_cast<std::int64_t>(front.out.size());
    for (const Triplet& entry : entries) {
        const std::int64_t i = at_[index(entry.row)], j = at_[index(entry.column)];
        if (i < 0 || j < 0) continue;
        const std::int64_t low = std::max(i, j), high = std::min(i, j);
        if (low < e)
            front.factor(low, high) += entry.value;
        else if (high < e)
            front.coupling(high, low - e) += entry.value;
        else
            front.energy.stiffness(low - e, high - e) += entry.value;
    }
}

void Elimination::eliminate(std::size_t number, const Poll& poll) {
    const Superelements::Node& node = bodies_.nodes()[number];
    Front& front = front_[number];
    divide(front, node);
    const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size());
    for (std::int64_t i = 0; i < e; ++i) at_[index(front.out[index(i)])] = i;
    for (std::int64_t i = 0; i < r; ++i) at_[index(front.left[index(i)])] = e + i;
    if (node.leaf >= 0) add_leaf(front, node.leaf);
    std::vector<std::int64_t> at;
    for (const std::int64_t child : node.children) {
        const Front& below = front_[index(child)];
        at.clear();
        for (const std::int64_t p : below.left) at.push_back(at_[index(p)]);
        add(front, at, below.energy);
    }
    add_entries(front, node.entries);
    for (const std::int64_t p : node.jumps)
        if (const std::int64_t i = at_[index(p)]; i >= 0 && i < e) front.factor(i, i) += state_[index(p)];
    for (const auto* own : {&node.jumps, &node.kept})
        for (const std::int64_t p : *own) {
            const std::int64_t i = at_[index(p)];
            if (i < 0) continue;
            for (std::int64_t q = 0; q < load_.columns; ++q)
                (i < e ? front.load(i, q) : front.energy.load(i - e, q)) += load_(p, q);
        }
    for (const auto* list : {&front.out, &front.left})
        for (const std::int64_t p : *list) at_[index(p)] = -1;

    if (!factor_definite(front.factor, poll))
        fail(DELAM_ERROR_NUMERICAL, "the stiffness of ", e,
             " condensed jumps and displacements is not positive definite");
    solve_lower(front.factor, front.coupling, 0, poll);
    solve_lower(front.factor, front.load);
    subtract_gram(front.energy.stiffness, front.coupling, poll);
    subtract_product(front.energy.load, front.coupling, front.load);
}

// x_e = L^-T (L^-1 f_e theta - V x_r), from the root down.
void Elimination::recover(std::span<const double> theta, std::span<const double> left,
                          std::span<double> skeleton) const {
    std::fill(skeleton.begin(), skeleton.end(), 0.0);
    for (std::size_t i = 0; i < left.size(); ++i) skeleton[index(places()[i])] = left[i];
    std::vector<double> x, known, coupled;
    for (std::size_t n = front_.size(); n-- > 0;) {
        const Front& front = front_[n];
        x.assign(front.out.size(), 0.0);
        if (x.empty()) continue;
        known.resize(front.left.size());
        coupled.assign(x.size(), 0.0);
        for (std::size_t i = 0; i < known.size(); ++i) known[i] = skeleton[index(front.left[i])];
        multiply(front.load, theta, x);
        multiply(front.coupling, known, coupled);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] -= coupled[i];
        solve_lower_transposed(front.factor, x);
        for (std::size_t i = 0; i < x.size(); ++i) skeleton[index(front.out[i])] = x[i];
    }
}

void Elimination::solve_cuts(std::span<double> b) const {
    std::vector<double> x, left;
    std::vector<std::vector<double>> forward(front_.size());
    for (std::size_t n = 0; n < front_.size(); ++n) {
        const Front& front = front_[n];
        x.resize(front.out.size());
        if (x.empty()) continue;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = b[index(front.out[i])];
        solve_lower(front.factor, x);
        left.resize(front.left.size());
        multiply_transposed(front.coupling, x, left);
        for (std::size_t i = 0; i < left.size(); ++i) b[index(front.left[i])] -= left[i];
        forward[n] = x;
    }
    for (std::size_t p = 0; p < b.size(); ++p)
        if (bodies_.kind(static_cast<std::int64_t>(p)) != Superelements::Kind::cut) b[p] = 0.0;
    for (std::size_t n = front_.size(); n-- > 0;) {
        const Front& front = front_[n];
        x = std::move(forward[n]);
        if (x.empty()) continue;
        left.resize(front.left.size());
        for (std::size_t i = 0; i < left.size(); ++i) left[i] = b[index(front.left[i])];
        std::vector<double> coupled(x.size());
        multiply(front.coupling, left, coupled);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] -= coupled[i];
        solve_lower_transposed(front.factor, x);
        for (std::size_t i = 0; i < x.size(); ++i) b[index(front.out[i])] = x[i];
    }
}

}  // namespace delam
