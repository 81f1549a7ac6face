// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/elimination.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

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
      builder_(bodies) {
    for (std::size_t n = 0; n < bodies.nodes().size(); ++n)
        for (const std::int64_t child : bodies.nodes()[n].children)
            parent_[index(child)] = static_cast<std::int64_t>(n);
}

void Elimination::update(std::span<const double> state, const Poll& poll) {
    if (interrupted_) builder_.reset();  // it was at a front
    interrupted_ = true;
    ++updates_;
    for (std::size_t p = 0; p < state_.size(); ++p) {
        const double now = state[p], before = state_[p];
        if (now == before) continue;
        changed_[p] = updates_;
        if (now < 0.0 || before < 0.0) changed_kind_[p] = updates_;
        state_[p] = now;
    }
    refresh_last(poll);
    interrupted_ = false;
}

void Elimination::take_loads(DenseMatrix load) {
    load_ = std::move(load);
    ++loads_;
}

void Elimination::refresh_last(const Poll& poll) {
    const std::int64_t before = std::exchange(last_node_, lowest_with_the_zone());
    if (before != last_node_) last_.made = -1;
    const Superelements::Node& node = bodies_.nodes()[index(last_node_)];
    for (const std::int64_t child : node.children) refresh_below(child, poll);
    refresh_outside(last_node_, poll);
    const bool top = parent_[index(last_node_)] < 0;
    const Inputs inputs{children(node), top ? nullptr : &outside_[index(last_node_)]};
    if (!older(last_, node.jumps, {last_node_}, inputs)) {
        reload(last_, node, inputs);
        return;
    }
    last_.made = -1;  // until it is made anew
    divide_node(last_, node, inputs.outside);
    builder_.open(last_, node.leaf, load_.columns);
    if (node.leaf >= 0) builder_.add_leaf(last_, node.leaf);
    add_all(last_, node, inputs);
    eliminate(last_, poll);
    mirror_lower(last_.energy.stiffness);
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
bool Elimination::older(const TreeFront& front, std::span<const std::int64_t> own,
                        std::initializer_list<std::int64_t> bordered, const Inputs& inputs) const {
    if (front.made < 0) return true;
    for (const std::int64_t p : own)
        if (changed_[index(p)] > front.made) return true;
    for (const std::int64_t node : bordered)
        for (const std::int64_t p : bodies_.nodes()[index(node)].border)
            if (changed_kind_[index(p)] > front.made) return true;
    const auto later = [&](const TreeFront* input) { return input != nullptr && input->made > front.made; };
    return later(inputs.outside) || std::ranges::any_of(inputs.inside, later);
}

// Renews the contribution of a subtree to the rest.
void Elimination::refresh_below(std::int64_t number, const Poll& poll) {
    const Superelements::Node& node = bodies_.nodes()[index(number)];
    for (const std::int64_t child : node.children) refresh_below(child, poll);
    TreeFront& front = below_[index(number)];
    const Inputs inputs{children(node), nullptr};
    if (!older(front, node.jumps, {number}, inputs)) {
        reload(front, node, inputs);
        return;
    }
    front.made = -1;  // until it is made anew
    divide_node(front, node, nullptr);
    builder_.open(front, node.leaf, load_.columns);
    if (node.leaf >= 0) builder_.add_leaf(front, node.leaf);
    add_all(front, node, inputs);
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
    TreeFront& front = outside_[index(number)];
    const Inputs inputs{{&below_[index(sibling)]}, top ? nullptr : &outside_[index(parent)]};
    if (!older(front, above.jumps, {number, sibling, parent}, inputs)) {
        reload(front, above, inputs);
        return;
    }
    front.made = -1;  // until it is made anew
    divide_outside(front, number);
    builder_.open(front, -1, load_.columns);
    add_all(front, above, inputs);
    eliminate(front, poll);
}

// Divides the variables of a node into those that it eliminates and those that it leaves: the border, kept
// displacements last, then the zone; all ascending. If `outside` is given, only kept displacements and the zone are
// left.
void Elimination::divide_node(TreeFront& front, const Superelements::Node& node, const TreeFront* outside) const {
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

void Elimination::divide_outside(TreeFront& front, std::int64_t number) const {
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

std::vector<const TreeFront*> Elimination::children(const Superelements::Node& node) const {
    std::vector<const TreeFront*> found;
    for (const std::int64_t child : node.children) found.push_back(&below_[index(child)]);
    return found;
}

void Elimination::add_all(TreeFront& front, const Superelements::Node& own, const Inputs& inputs) {
    for (const TreeFront* input : inputs.inside) builder_.add(front, *input);
    add_own(front, own);
    if (inputs.outside != nullptr) builder_.add(front, *inputs.outside);
}

// Entries of the cut, springs of the jumps that are minimised out, loads.
void Elimination::add_own(TreeFront& front, const Superelements::Node& node) {
    builder_.add_entries(front, node.entries);
    for (const auto* own : {&node.jumps, &node.kept})
        for (const std::int64_t p : *own)
            if (const std::int64_t i = builder_.at(p); i >= 0 && state_[index(p)] > 0.0)
                front.put(i, i, state_[index(p)]);
    add_own_loads(front, node);
}

void Elimination::add_own_loads(TreeFront& front, const Superelements::Node& node) {
    const auto e = static_cast<std::int64_t>(front.out.size());
    for (const auto* own : {&node.jumps, &node.kept})
        for (const std::int64_t p : *own)
            if (const std::int64_t i = builder_.at(p); i >= 0)
                for (std::int64_t q = 0; q < load_.columns; ++q)
                    (i < e ? front.load(i, q) : front.energy.load(i - e, q)) += load_(p, q);
}

void Elimination::eliminate(TreeFront& front, const Poll& poll) {
    builder_.close(front);
    front.made = -1;
    if (!front.eliminate(poll))
        fail(DELAM_ERROR_NUMERICAL, "the stiffness of ", front.out.size(),
             " condensed jumps and displacements is not positive definite");
    front.made = updates_;
    front.loaded = loads_;
}

// A front that is made anew for these loads would have the same digits.
void Elimination::reload(TreeFront& front, const Superelements::Node& own, const Inputs& inputs) {
    if (front.loaded == loads_) return;
    builder_.open_loads(front, load_.columns);
    for (const TreeFront* input : inputs.inside) builder_.add_loads(front, *input);
    add_own_loads(front, own);
    if (inputs.outside != nullptr) builder_.add_loads(front, *inputs.outside);
    builder_.close(front);
    front.eliminate_loads();
    front.loaded = loads_;
}

void Elimination::recover_below(std::int64_t node, std::span<const double> theta, std::span<double> skeleton) const {
    below_[index(node)].recover(theta, skeleton);
    for (const std::int64_t child : bodies_.nodes()[index(node)].children) recover_below(child, theta, skeleton);
}

// The subtree of the zone, and outwards from its border.
void Elimination::recover(std::span<const double> theta, std::span<const double> left,
                          std::span<double> skeleton) const {
    std::fill(skeleton.begin(), skeleton.end(), 0.0);
    for (std::size_t i = 0; i < left.size(); ++i) skeleton[index(last_.left[i])] = left[i];
    last_.recover(theta, skeleton);
    for (const std::int64_t child : bodies_.nodes()[index(last_node_)].children) recover_below(child, theta, skeleton);
    for (std::int64_t node = last_node_; parent_[index(node)] >= 0; node = parent_[index(node)]) {
        outside_[index(node)].recover(theta, skeleton);
        for (const std::int64_t child : bodies_.nodes()[index(parent_[index(node)])].children)
            if (child != node) recover_below(child, theta, skeleton);
    }
}

// L^-1 upwards, V and L^-T downwards.
void Elimination::solve_cuts(std::span<double> b) const {
    const std::size_t nodes = below_.size();
    const auto front_of = [&](std::size_t n) -> const TreeFront& { return n + 1 == nodes ? last_ : below_[n]; };
    std::vector<std::vector<double>> forward(nodes);
    std::vector<double> left, coupled;
    for (std::size_t n = 0; n < nodes; ++n) {
        const TreeFront& front = front_of(n);
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
        const TreeFront& front = front_of(n);
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
