// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/elimination.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// Resizes without values, in the memory that the matrix has.
void resize(DenseMatrix& a, std::int64_t rows, std::int64_t columns) {
    a.rows = rows;
    a.columns = columns;
    a.value.clear();
    make_room(a.value, index(rows * columns));
    a.value.resize(index(rows * columns));
}

void clear(DenseMatrix& a, std::int64_t rows, std::int64_t columns) {
    resize(a, rows, columns);
    std::fill(a.value.begin(), a.value.end(), 0.0);
}

void clear_lower(DenseMatrix& a) {
    for (std::int64_t j = 0; j < a.rows; ++j) std::fill_n(a.value.begin() + j * (a.rows + 1), index(a.rows - j), 0.0);
}

void sort_unique(std::vector<std::int64_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

Elimination::Elimination(const Superelements& bodies, DenseMatrix load, Last last)
    : changed_(bodies.variable().size(), 0),
      changed_kind_(bodies.variable().size(), 0),
      parent_(bodies.nodes().size(), -1),
      below_(bodies.nodes().size()),
      outside_(bodies.nodes().size()),
      ends_at_(last),
      bodies_(bodies),
      load_(std::move(load)),
      state_(bodies.variable().size(), 0.0),
      at_(bodies.variable().size(), -1) {
    for (std::size_t n = 0; n < bodies.nodes().size(); ++n)
        for (const std::int64_t child : bodies.nodes()[n].children)
            parent_[index(child)] = static_cast<std::int64_t>(n);
}

void Elimination::update(std::span<const double> state, const Poll& poll) {
    if (interrupted_) std::fill(at_.begin(), at_.end(), -1);  // places of the front at which it was
    interrupted_ = true;
    ++updates_;
    for (std::size_t p = 0; p < state_.size(); ++p) {
        const double now = state[p], before = state_[p];
        if (now == before) continue;
        changed_[p] = updates_;
        if (now < 0.0 || before < 0.0) changed_kind_[p] = updates_;
        state_[p] = now;
    }
    last_.made = -1;
    last_node_ = lowest_with_the_zone();
    const Superelements::Node& node = bodies_.nodes()[index(last_node_)];
    for (const std::int64_t child : node.children) refresh_below(child, poll);
    refresh_outside(last_node_, poll);
    const Front* outside = parent_[index(last_node_)] < 0 ? nullptr : &outside_[index(last_node_)];
    divide_node(last_, node, outside);
    open(last_, node.leaf);
    if (node.leaf >= 0) add_leaf(last_, node.leaf);
    for (const std::int64_t child : node.children) add(last_, below_[index(child)]);
    add_own(last_, node);
    if (outside != nullptr) add(last_, *outside);
    eliminate(last_, poll);
    mirror_lower(last_.energy.stiffness);
    interrupted_ = false;
}

// Down from the root as long as all of the zone lies below one child.
std::int64_t Elimination::lowest_with_the_zone() const {
    const std::vector<Superelements::Node>& nodes = bodies_.nodes();
    std::vector<std::int64_t> inside(nodes.size(), 0);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        for (const std::int64_t p : nodes[n].jumps) inside[n] += state_[index(p)] == in_zone ? 1 : 0;
        for (const std::int64_t child : nodes[n].children) inside[n] += inside[index(child)];
    }
    std::size_t lowest = nodes.size() - 1;
    for (bool down = ends_at_ == Last::zone && inside[lowest] > 0; down;) {
        down = false;
        for (const std::int64_t child : nodes[lowest].children)
            if (inside[index(child)] == inside[lowest]) {
                lowest = index(child);
                down = true;
                break;
            }
    }
    return static_cast<std::int64_t>(lowest);
}

// Was something made or changed after this front? bordered: nodes on whose borders it depends.
bool Elimination::older(const Front& front, std::span<const std::int64_t> own,
                        std::initializer_list<std::int64_t> bordered,
                        std::initializer_list<const Front*> inputs) const {
    if (front.made < 0) return true;
    for (const std::int64_t p : own)
        if (changed_[index(p)] > front.made) return true;
    for (const std::int64_t node : bordered)
        for (const std::int64_t p : bodies_.nodes()[index(node)].border)
            if (changed_kind_[index(p)] > front.made) return true;
    return std::any_of(inputs.begin(), inputs.end(), [&](const Front* input) { return input->made > front.made; });
}

// Renews the contribution of a subtree to the rest.
void Elimination::refresh_below(std::int64_t number, const Poll& poll) {
    const Superelements::Node& node = bodies_.nodes()[index(number)];
    for (const std::int64_t child : node.children) refresh_below(child, poll);
    Front& front = below_[index(number)];
    bool stale = older(front, node.jumps, {number}, {});
    for (const std::int64_t child : node.children) stale = stale || below_[index(child)].made > front.made;
    if (!stale) return;
    front.made = -1;  // until it is made anew
    divide_node(front, node, nullptr);
    open(front, node.leaf);
    if (node.leaf >= 0) add_leaf(front, node.leaf);
    for (const std::int64_t child : node.children) add(front, below_[index(child)]);
    add_own(front, node);
    eliminate(front, poll);
}

// Renews the contribution of all that is not below a node, on the border of that node: the parent's own, the sibling's
// subtree, and all outside of the parent's subtree. None of it is in the zone.
void Elimination::refresh_outside(std::int64_t number, const Poll& poll) {
    const std::int64_t parent = parent_[index(number)];
    if (parent < 0) return;
    refresh_outside(parent, poll);
    const Superelements::Node& above = bodies_.nodes()[index(parent)];
    const bool top = parent_[index(parent)] < 0;
    const std::int64_t sibling = above.children[above.children[0] == number ? 1 : 0];
    refresh_below(sibling, poll);
    Front& front = outside_[index(number)];
    const Front &beside = below_[index(sibling)], &beyond = outside_[index(parent)];
    if (!older(front, above.jumps, {number, sibling, parent}, {&beside, top ? &beside : &beyond})) return;
    front.made = -1;  // until it is made anew
    divide_outside(front, number);
    open(front, -1);
    add(front, beside);
    add_own(front, above);
    if (!top) add(front, beyond);
    eliminate(front, poll);
}

// Divides the variables of a node into those that it eliminates and those that it leaves: the border, kept
// displacements last, then the zone; all ascending. If `outside` is given, only kept displacements and the zone are
// left.
void Elimination::divide_node(Front& front, const Superelements::Node& node, const Front* outside) const {
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
    for (const std::int64_t p : node.border)
        take(p, outside != nullptr && bodies_.kind(p) != Superelements::Kind::kept ? front.out : front.left);
    if (outside != nullptr)
        for (const std::int64_t p : outside->left)
            if (bodies_.kind(p) == Superelements::Kind::kept) front.left.push_back(p);
    for (const std::int64_t child : node.children)
        for (const std::int64_t p : below_[index(child)].left)
            if (state_[index(p)] == in_zone) zone.push_back(p);
    sort_unique(front.out);
    sort_unique(front.left);
    sort_unique(zone);
    front.left.insert(front.left.end(), zone.begin(), zone.end());
}

void Elimination::divide_outside(Front& front, std::int64_t number) const {
    const std::int64_t parent = parent_[index(number)];
    const Superelements::Node &node = bodies_.nodes()[index(number)], &above = bodies_.nodes()[index(parent)];
    front.left.clear();
    front.out.clear();
    const auto is_left = [&](std::int64_t p) {
        return bodies_.kind(p) == Superelements::Kind::kept ||
               std::binary_search(node.border.begin(), node.border.end(), p);
    };
    const auto take = [&](std::int64_t p) {
        if (state_[index(p)] != held) (is_left(p) ? front.left : front.out).push_back(p);
    };
    for (const auto* own : {&above.cut, &above.jumps, &above.border, &above.kept})
        for (const std::int64_t p : *own) take(p);
    for (const std::int64_t sibling : above.children)
        if (sibling != number)
            for (const std::int64_t p : bodies_.nodes()[index(sibling)].border) take(p);
    if (parent_[index(parent)] >= 0)
        for (const std::int64_t p : outside_[index(parent)].left) take(p);
    sort_unique(front.out);
    sort_unique(front.left);
}

// Zero, with the places of its variables in at_. leaf: what is added next, -1: none; it may set all entries itself.
void Elimination::open(Front& front, std::int64_t leaf) {
    const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size());
    clear(front.load, e, load_.columns);
    clear(front.energy.load, r, load_.columns);
    resize(front.factor, e, e);
    resize(front.coupling, e, r);
    resize(front.energy.stiffness, r, r);
    for (std::int64_t i = 0; i < e; ++i) at_[index(front.out[index(i)])] = i;
    for (std::int64_t i = 0; i < r; ++i) at_[index(front.left[index(i)])] = e + i;
    std::int64_t set = 0;
    if (leaf >= 0)
        for (const std::int64_t p : bodies_.rows(leaf)) set += at_[index(p)] >= 0 ? 1 : 0;
    if (set == e + r) return;
    clear_lower(front.factor);
    clear_lower(front.energy.stiffness);
    std::fill(front.coupling.value.begin(), front.coupling.value.end(), 0.0);
}

void Elimination::add_leaf(Front& front, std::int64_t leaf) {
    const DenseMatrix& s = bodies_.stiffness(leaf);
    const std::vector<std::int64_t>& rows = bodies_.rows(leaf);
    const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size());
    std::vector<std::int64_t> from(index(e + r), -1);
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (at_[index(rows[i])] >= 0) from[index(at_[index(rows[i])])] = static_cast<std::int64_t>(i);
    const auto copy = [&](std::int64_t column, std::int64_t first, std::int64_t last, double* target) {
        const double* values = s.value.data() + column * s.rows;
        for (std::int64_t i = first; i < last; ++i, ++target)
            if (from[index(i)] >= 0) *target = values[from[index(i)]];
    };
    for (std::int64_t j = 0; j < e; ++j)
        if (from[index(j)] >= 0) copy(from[index(j)], j, e, front.factor.value.data() + j * e + j);
    for (std::int64_t j = 0; j < r; ++j) {
        if (from[index(e + j)] < 0) continue;
        copy(from[index(e + j)], 0, e, front.coupling.value.data() + j * e);
        copy(from[index(e + j)], e + j, e + r, front.energy.stiffness.value.data() + j * r + j);
    }
}

// Entries of the cut, springs of the jumps that are minimised out, loads.
void Elimination::add_own(Front& front, const Superelements::Node& node) {
    const auto e = static_cast<std::int64_t>(front.out.size());
    const auto put = [&](std::int64_t i, std::int64_t j, double value) {
        if (i < e)
            front.factor(i, j) += value;
        else if (j < e)
            front.coupling(j, i - e) += value;
        else
            front.energy.stiffness(i - e, j - e) += value;
    };
    for (const Triplet& entry : node.entries) {
        const std::int64_t i = at_[index(entry.row)], j = at_[index(entry.column)];
        if (i >= 0 && j >= 0) put(std::max(i, j), std::min(i, j), entry.value);
    }
    for (const auto* own : {&node.jumps, &node.kept})
        for (const std::int64_t p : *own) {
            const std::int64_t i = at_[index(p)];
            if (i < 0) continue;
            if (state_[index(p)] > 0.0) put(i, i, state_[index(p)]);
            for (std::int64_t q = 0; q < load_.columns; ++q)
                (i < e ? front.load(i, q) : front.energy.load(i - e, q)) += load_(p, q);
        }
}

// The energy that another front has left. Its variables stand here in runs of neighbours, those that are eliminated
// and those that are left each in the same order as there.
void Elimination::add(Front& front, const Front& other) {
    struct Run {
        std::int64_t from, to, length;
    };
    const auto e = static_cast<std::int64_t>(front.out.size());
    std::vector<Run> out, left;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(other.left.size()); ++i) {
        const std::int64_t at = at_[index(other.left[index(i)])];
        if (at < 0) continue;
        auto& runs = at < e ? out : left;
        const std::int64_t to = at < e ? at : at - e;
        if (!runs.empty() && runs.back().from + runs.back().length == i && runs.back().to + runs.back().length == to)
            ++runs.back().length;
        else
            runs.push_back({i, to, 1});
    }
    const DenseMatrix& s = other.energy.stiffness;
    // The part of a column from its diagonal on.
    const auto add_columns = [&s](const std::vector<Run>& runs, DenseMatrix& target) {
        for (std::size_t a = 0; a < runs.size(); ++a)
            for (std::int64_t k = 0; k < runs[a].length; ++k) {
                const double* values = s.value.data() + (runs[a].from + k) * s.rows;
                double* sums = target.value.data() + (runs[a].to + k) * target.rows;
                for (std::int64_t i = k; i < runs[a].length; ++i) sums[runs[a].to + i] += values[runs[a].from + i];
                for (std::size_t b = a + 1; b < runs.size(); ++b)
                    for (std::int64_t i = 0; i < runs[b].length; ++i) sums[runs[b].to + i] += values[runs[b].from + i];
            }
    };
    add_columns(out, front.factor);
    add_columns(left, front.energy.stiffness);
    for (const Run& column : left)
        for (std::int64_t k = 0; k < column.length; ++k) {
            double* sums = front.coupling.value.data() + (column.to + k) * e;
            for (const Run& row : out) {
                // The matrix stores the lower triangle: of two equal entries the one there is read.
                const bool below = column.from > row.from;
                const double* values = s.value.data() + (below ? row.from * s.rows + column.from + k
                                                               : (column.from + k) * s.rows + row.from);
                const std::int64_t step = below ? s.rows : 1;
                for (std::int64_t i = 0; i < row.length; ++i) sums[row.to + i] += values[i * step];
            }
        }
    for (std::int64_t q = 0; q < other.energy.load.columns; ++q) {
        for (const Run& run : out)
            for (std::int64_t i = 0; i < run.length; ++i)
                front.load(run.to + i, q) += other.energy.load(run.from + i, q);
        for (const Run& run : left)
            for (std::int64_t i = 0; i < run.length; ++i)
                front.energy.load(run.to + i, q) += other.energy.load(run.from + i, q);
    }
}

void Elimination::eliminate(Front& front, const Poll& poll) {
    for (const auto* list : {&front.out, &front.left})
        for (const std::int64_t p : *list) at_[index(p)] = -1;
    front.made = -1;
    if (!factor_definite(front.factor, poll))
        fail(DELAM_ERROR_NUMERICAL, "the stiffness of ", front.out.size(),
             " condensed jumps and displacements is not positive definite");
    solve_lower(front.factor, front.coupling, 0, poll);
    solve_lower(front.factor, front.load);
    subtract_gram(front.energy.stiffness, front.coupling, poll);
    subtract_product(front.energy.load, front.coupling, front.load);
    front.made = updates_;
}

// x_e = L^-T (L^-1 f_e theta - V x_r)
void Elimination::recover(const Front& front, std::span<const double> theta, std::span<double> skeleton) {
    std::vector<double> x(front.out.size(), 0.0), known(front.left.size()), coupled(x.size());
    if (x.empty()) return;
    for (std::size_t i = 0; i < known.size(); ++i) known[i] = skeleton[index(front.left[i])];
    multiply(front.load, theta, x);
    multiply(front.coupling, known, coupled);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= coupled[i];
    solve_lower_transposed(front.factor, x);
    for (std::size_t i = 0; i < x.size(); ++i) skeleton[index(front.out[i])] = x[i];
}

void Elimination::recover_below(std::int64_t node, std::span<const double> theta, std::span<double> skeleton) const {
    recover(below_[index(node)], theta, skeleton);
    for (const std::int64_t child : bodies_.nodes()[index(node)].children) recover_below(child, theta, skeleton);
}

// The subtree of the zone, and outwards from its border.
void Elimination::recover(std::span<const double> theta, std::span<const double> left,
                          std::span<double> skeleton) const {
    std::fill(skeleton.begin(), skeleton.end(), 0.0);
    for (std::size_t i = 0; i < left.size(); ++i) skeleton[index(last_.left[i])] = left[i];
    recover(last_, theta, skeleton);
    for (const std::int64_t child : bodies_.nodes()[index(last_node_)].children) recover_below(child, theta, skeleton);
    for (std::int64_t node = last_node_; parent_[index(node)] >= 0; node = parent_[index(node)]) {
        recover(outside_[index(node)], theta, skeleton);
        for (const std::int64_t child : bodies_.nodes()[index(parent_[index(node)])].children)
            if (child != node) recover_below(child, theta, skeleton);
    }
}

// L^-1 upwards, V and L^-T downwards.
void Elimination::solve_cuts(std::span<double> b) const {
    const std::size_t nodes = below_.size();
    const auto front_of = [&](std::size_t n) -> const Front& { return n + 1 == nodes ? last_ : below_[n]; };
    std::vector<std::vector<double>> forward(nodes);
    std::vector<double> left, coupled;
    for (std::size_t n = 0; n < nodes; ++n) {
        const Front& front = front_of(n);
        std::vector<double>& x = forward[n];
        for (const std::int64_t p : front.out) x.push_back(b[index(p)]);
        if (x.empty()) continue;
        solve_lower(front.factor, x);
        left.resize(front.left.size());
        multiply_transposed(front.coupling, x, left);
        for (std::size_t i = 0; i < left.size(); ++i) b[index(front.left[i])] -= left[i];
    }
    for (std::size_t p = 0; p < b.size(); ++p)
        if (bodies_.kind(static_cast<std::int64_t>(p)) != Superelements::Kind::cut) b[p] = 0.0;
    for (std::size_t n = nodes; n-- > 0;) {
        const Front& front = front_of(n);
        std::vector<double>& x = forward[n];
        if (x.empty()) continue;
        left.resize(front.left.size());
        for (std::size_t i = 0; i < left.size(); ++i) left[i] = b[index(front.left[i])];
        coupled.resize(x.size());
        multiply(front.coupling, left, coupled);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] -= coupled[i];
        solve_lower_transposed(front.factor, x);
        for (std::size_t i = 0; i < x.size(); ++i) b[index(front.out[i])] = x[i];
    }
}

}  // namespace delam
