// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/tree_factor.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"

namespace delam {

namespace {

bool same(std::span<const Triplet> a, std::span<const Triplet> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Triplet& s, const Triplet& t) {
        return s.row == t.row && s.column == t.column && s.value == t.value;
    });
}

}  // namespace

TreeFactor::TreeFactor(const Superelements& bodies)
    : bodies_(bodies),
      nodes_(bodies.nodes().size()),
      parent_(bodies.nodes().size(), -1),
      owner_(bodies.variable().size(), -1),
      held_(bodies.variable().size(), 0),
      spring_(bodies.variable().size(), 0.0),
      builder_(bodies) {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Superelements::Node& node = bodies.nodes()[n];
        for (const std::int64_t child : node.children) parent_[index(child)] = static_cast<std::int64_t>(n);
        for (const auto* own : {&node.cut, &node.jumps, &node.kept})
            for (const std::int64_t p : *own) owner_[index(p)] = static_cast<std::int64_t>(n);
    }
}

// Marks the fronts of changed springs and all above them as not made.
void TreeFactor::find_stale(std::span<const std::uint8_t> held, std::span<const double> spring,
                            std::span<const Triplet> cross) {
    std::vector<std::uint8_t> stale(nodes_.size(), 0);
    for (std::size_t p = 0; p < held_.size(); ++p)
        if (held[p] != held_[p] || (held[p] == 0 && spring[p] != spring_[p])) stale[index(owner_[p])] = 1;
    held_.assign(held.begin(), held.end());
    spring_.assign(spring.begin(), spring.end());
    std::vector<std::vector<Triplet>> of_node(nodes_.size());
    for (const Triplet& t : cross)
        if (held[index(t.row)] == 0 && held[index(t.column)] == 0) of_node[index(owner(t.column))].push_back(t);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        if (!same(of_node[n], nodes_[n].cross)) stale[n] = 1;
        nodes_[n].cross = std::move(of_node[n]);
        if (stale[n] != 0 || nodes_[n].front.made < 0)
            for (std::int64_t above = static_cast<std::int64_t>(n); above >= 0; above = parent_[index(above)])
                nodes_[index(above)].front.made = -1;
    }
}

// Leaves held jumps on the borders below, so that holding and releasing them renews no front there.
void TreeFactor::divide(Node& node, std::int64_t number) const {
    const Superelements::Node& own = bodies_.nodes()[index(number)];
    TreeFront& front = node.front;
    front.out.clear();
    for (const auto* list : {&own.cut, &own.jumps, &own.kept})
        for (const std::int64_t p : *list)
            if (held_[index(p)] == 0) front.out.push_back(p);
    std::sort(front.out.begin(), front.out.end());
    front.left.clear();
    if (parent_[index(number)] >= 0) front.left = own.border;
    std::sort(front.left.begin(), front.left.end());
}

bool TreeFactor::make(std::int64_t number, const Poll& poll) {
    const Superelements::Node& own = bodies_.nodes()[index(number)];
    Node& node = nodes_[index(number)];
    TreeFront& front = node.front;
    divide(node, number);
    builder_.open(front, own.leaf, 0);
    if (own.leaf >= 0) builder_.add_leaf(front, own.leaf);
    node.of_child.clear();
    for (const std::int64_t child : own.children) {
        const TreeFront& below = nodes_[index(child)].front;
        builder_.add(front, below);
        node.of_child.emplace_back();
        for (const std::int64_t p : below.left) node.of_child.back().push_back(builder_.at(p));
    }
    builder_.add_entries(front, own.entries);
    builder_.add_entries(front, node.cross);
    for (std::size_t i = 0; i < front.out.size(); ++i)
        if (const double s = spring_[index(front.out[i])]; s != 0.0)
            front.put(static_cast<std::int64_t>(i), static_cast<std::int64_t>(i), s);
    builder_.close(front);
    ++fronts_made_;
    if (!front.eliminate(poll)) return false;
    front.made = updates_;
    return true;
}

bool TreeFactor::factor(std::span<const std::uint8_t> held, std::span<const double> spring,
                        std::span<const Triplet> cross, const Poll& poll) {
    if (interrupted_) builder_.reset();
    interrupted_ = true;
    ++updates_;
    find_stale(held, spring, cross);
    bool definite = true;
    for (std::size_t n = 0; n < nodes_.size() && definite; ++n)
        if (nodes_[n].front.made < 0) definite = make(static_cast<std::int64_t>(n), poll);
    interrupted_ = false;
    return definite;
}

// y = L^-1 (b - what the children carry), and V^T y with what they carry further up.
void TreeFactor::substitute(std::int64_t number, std::span<const double> b) {
    const Superelements::Node& own = bodies_.nodes()[index(number)];
    Node& node = nodes_[index(number)];
    const TreeFront& front = node.front;
    bool renew = node.made != front.made;
    for (const std::int64_t child : own.children) renew = renew || nodes_[index(child)].solved == solves_;
    if (!renew)
        for (std::size_t i = 0; i < front.out.size() && !renew; ++i) renew = node.load[i] != b[index(front.out[i])];
    if (!renew) return;
    node.solved = solves_;
    node.made = front.made;
    const std::size_t e = front.out.size(), r = front.left.size();
    node.load.resize(e);
    for (std::size_t i = 0; i < e; ++i) node.load[i] = b[index(front.out[i])];
    node.forward = node.load;
    std::vector<double> passed(r, 0.0);
    node.work = 0.0;
    for (std::size_t c = 0; c < own.children.size(); ++c) {
        const Node& child = nodes_[index(own.children[c])];
        node.work += child.work;
        for (std::size_t i = 0; i < child.up.size(); ++i) {
            const std::int64_t at = node.of_child[c][i];
            if (at < 0) continue;
            if (index(at) < e)
                node.forward[index(at)] -= child.up[i];
            else
                passed[index(at) - e] += child.up[i];
        }
    }
    node.up.assign(r, 0.0);
    if (e > 0) {
        solve_lower(front.factor, node.forward);
        multiply_transposed(front.coupling, node.forward, node.up);
        node.work += dot(node.forward, node.forward);
    }
    for (std::size_t i = 0; i < r; ++i) node.up[i] += passed[i];
}

double TreeFactor::solve(std::span<const double> b, std::span<const std::uint8_t> wanted, std::span<double> x) {
    ++solves_;
    for (std::size_t n = 0; n < nodes_.size(); ++n) substitute(static_cast<std::int64_t>(n), b);
    std::fill(x.begin(), x.end(), 0.0);
    std::vector<double> known, coupled, own;
    for (std::size_t n = nodes_.size(); n-- > 0;) {
        const TreeFront& front = nodes_[n].front;
        if (wanted[n] == 0 || front.out.empty()) continue;
        known.resize(front.left.size());
        for (std::size_t i = 0; i < known.size(); ++i) known[i] = x[index(front.left[i])];
        coupled.resize(front.out.size());
        multiply(front.coupling, known, coupled);
        own = nodes_[n].forward;
        for (std::size_t i = 0; i < own.size(); ++i) own[i] -= coupled[i];
        solve_lower_transposed(front.factor, own);
        for (std::size_t i = 0; i < own.size(); ++i) x[index(front.out[i])] = own[i];
    }
    return nodes_.back().work;
}

// The sum of Y^T Y over the nodes, with Y = L^-1 of what arrives of the forces at or below each.
DenseMatrix TreeFactor::flexibility(std::span<const std::vector<std::pair<std::int64_t, double>>> forces) const {
    struct Carried {
        std::vector<std::size_t> column;
        DenseMatrix up;  // [left][column]
    };
    const auto sets = static_cast<std::int64_t>(forces.size());
    DenseMatrix work(sets, sets);
    std::vector<Carried> carried(nodes_.size());
    std::vector<std::vector<std::size_t>> own(nodes_.size());
    for (std::size_t c = 0; c < forces.size(); ++c)
        for (const auto& [p, value] : forces[c]) own[index(owner(p))].push_back(c);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Superelements::Node& node = bodies_.nodes()[n];
        const TreeFront& front = nodes_[n].front;
        Carried& now = carried[n];
        now.column = own[n];
        for (const std::int64_t child : node.children)
            now.column.insert(now.column.end(), carried[index(child)].column.begin(),
                              carried[index(child)].column.end());
        std::sort(now.column.begin(), now.column.end());
        now.column.erase(std::unique(now.column.begin(), now.column.end()), now.column.end());
        if (now.column.empty()) continue;
        const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size()),
                   k = static_cast<std::int64_t>(now.column.size());
        DenseMatrix y(e, k), passed(r, k);
        const auto at = [&now](std::size_t c) {
            return std::lower_bound(now.column.begin(), now.column.end(), c) - now.column.begin();
        };
        for (const std::size_t c : now.column)
            for (const auto& [p, value] : forces[c])
                if (owner(p) == static_cast<std::int64_t>(n))
                    y(std::lower_bound(front.out.begin(), front.out.end(), p) - front.out.begin(), at(c)) += value;
        for (std::size_t child = 0; child < node.children.size(); ++child) {
            Carried& from = carried[index(node.children[child])];
            for (std::size_t j = 0; j < from.column.size(); ++j)
                for (std::int64_t i = 0; i < from.up.rows; ++i) {
                    const std::int64_t to = nodes_[n].of_child[child][index(i)], c = at(from.column[j]);
                    if (to >= 0 && to < e) y(to, c) -= from.up(i, static_cast<std::int64_t>(j));
                    if (to >= e) passed(to - e, c) += from.up(i, static_cast<std::int64_t>(j));
                }
            from = {};
        }
        now.up = std::move(passed);
        if (e == 0) continue;
        solve_lower(front.factor, y);
        const DenseMatrix up = multiply_transposed(front.coupling, y), gram = multiply_transposed(y, y);
        for (std::size_t i = 0; i < up.value.size(); ++i) now.up.value[i] += up.value[i];
        for (std::int64_t j = 0; j < k; ++j)
            for (std::int64_t i = 0; i < k; ++i)
                work(static_cast<std::int64_t>(now.column[index(i)]),
                     static_cast<std::int64_t>(now.column[index(j)])) += gram(i, j);
    }
    return work;
}

void TreeFactor::image(std::span<const double> x, std::span<const std::int64_t> places, std::span<double> y) const {
    std::fill(y.begin(), y.end(), 0.0);
    std::vector<std::uint8_t> wanted(owner_.size(), 0);
    for (const std::int64_t p : places) wanted[index(p)] = 1;
    bodies_.subtract_image(x, wanted, y);
    for (const std::int64_t p : places) y[index(p)] = -y[index(p)];
}

std::vector<std::uint8_t> TreeFactor::nodes(std::span<const std::int64_t> places) const {
    std::vector<std::uint8_t> there(nodes_.size(), 0), of(owner_.size(), 0);
    for (const std::int64_t p : places) of[index(p)] = 1;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Superelements::Node& node = bodies_.nodes()[n];
        const auto is_one = [&of](std::int64_t p) { return of[index(p)] != 0; };
        const bool own = std::any_of(node.jumps.begin(), node.jumps.end(), is_one) ||
                         (node.leaf >= 0 && std::any_of(node.border.begin(), node.border.end(), is_one));
        if (!own) continue;
        for (std::int64_t above = static_cast<std::int64_t>(n); above >= 0; above = parent_[index(above)])
            there[index(above)] = 1;
    }
    return there;
}

double TreeFactor::operations(std::span<const std::int64_t> places) const {
    std::vector<std::uint8_t> renewed(nodes_.size(), 0);
    for (const std::int64_t p : places)
        for (std::int64_t n = owner(p); n >= 0 && renewed[index(n)] == 0; n = parent_[index(n)]) renewed[index(n)] = 1;
    double sum = 0.0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        if (renewed[n] == 0) continue;
        const Superelements::Node& node = bodies_.nodes()[n];
        const auto e = static_cast<double>(node.cut.size() + node.jumps.size() + node.kept.size()),
                   r = parent_[n] < 0 ? 0.0 : static_cast<double>(node.border.size());
        sum += e * (e * e / 3.0 + e * r + r * r);
    }
    return sum;
}

}  // namespace delam
