// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/superelements.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "base/team.hpp"

namespace delam {

namespace {

// Allowed difference of equal entries, relative to the root of the two diagonal entries. Rounded coordinates change a
// stiffness by about as much, so that pieces of a mesh that are copies of each other agree to 1e-13 or better.
constexpr double alike = 1e-11;

bool same_pattern(const SparseMatrix& a, const SparseMatrix& b) {
    return a.rows == b.rows && a.start == b.start && a.column == b.column;
}

}  // namespace

Superelements::Superelements(const SparseMatrix& stiffness, const JumpVariables& variables, const Problem& problem,
                             const Poll& poll)
    : apart_(problem.renewed) {
    SuperelementTree tree = cut_into_superelements(stiffness, variables, variable_points(problem, variables), poll);
    std::vector<std::int64_t> order(index(variables.count()));
    for (std::size_t v = 0; v < order.size(); ++v) order[index(tree.position[v])] = static_cast<std::int64_t>(v);
    std::vector<std::uint8_t> inside_leaf(order.size(), 0);
    for (const Superelement& node : tree.node)
        if (node.leaf())
            for (const std::int64_t v : node.inside) inside_leaf[index(v)] = 1;
    place_.assign(order.size(), -1);
    std::vector<std::int64_t> kept;
    for (const std::int64_t v : order) {
        if (inside_leaf[index(v)] != 0) continue;
        place_[index(v)] = static_cast<std::int64_t>(variable_.size());
        kind_.push_back(v < variables.leading                    ? Kind::cut
                        : v < variables.leading + variables.kept ? Kind::kept
                                                                 : Kind::jump);
        if (kind_.back() == Kind::kept) kept.push_back(place_[index(v)]);
        variable_.push_back(v);
    }
    const auto places = [this](std::span<const std::int64_t> of) {
        std::vector<std::int64_t> p;
        for (const std::int64_t v : of) p.push_back(place(v));
        return p;
    };
    for (Superelement& node : tree.node) {
        Node own;
        own.children = std::move(node.children);
        own.jumps = places(node.jumps);
        own.border = places(node.border);
        if (own.children.empty()) {
            own.leaf = static_cast<std::int64_t>(leaves_.size());
            add_leaf(stiffness, node, poll);
        } else {
            own.cut = places(node.inside);
        }
        nodes_.push_back(std::move(own));
        call_if_set(poll);
    }
    Node& root = nodes_.back();
    root.border = kept;
    root.kept = std::move(kept);
    take_entries(stiffness);
}

// Entries of the cuts, each at the node that eliminates the first of its two variables.
void Superelements::take_entries(const SparseMatrix& stiffness) {
    assembled_diagonal_.assign(variable_.size(), 0.0);
    for (std::size_t p = 0; p < variable_.size(); ++p) {
        const std::int64_t v = variable_[p];
        for (std::int64_t e = stiffness.start[index(v)]; e < stiffness.start[index(v) + 1]; ++e)
            if (stiffness.column[index(e)] == v) assembled_diagonal_[p] = stiffness.value[index(e)];
    }
    diagonal_ = assembled_diagonal_;
    for (Node& node : nodes_) {
        node.entries.clear();
        const auto take = [&](std::span<const std::int64_t> own) {
            for (const std::int64_t p : own) {
                const std::int64_t v = variable_[index(p)];
                for (std::int64_t e = stiffness.start[index(v)]; e < stiffness.start[index(v) + 1]; ++e) {
                    const std::int64_t q = place(stiffness.column[index(e)]);
                    if (q >= p) node.entries.push_back({q, p, stiffness.value[index(e)]});
                }
            }
        };
        if (!node.children.empty()) {
            take(node.cut);
            take(node.jumps);
        }
        take(node.kept);
    }
}

void Superelements::renew(const SparseMatrix& stiffness) {
    for (const Leaf& leaf : leaves_) {
        Piece& piece = pieces_[leaf.piece];
        piece.matrix = matrix_of(stiffness, leaf, piece);
        piece.coupling = SparseMatrix();
    }
    take_entries(stiffness);
}

void Superelements::add_leaf(const SparseMatrix& stiffness, Superelement& node, const Poll& poll) {
    Leaf leaf;
    std::sort(node.border.begin(), node.border.end());  // where copies of a piece have the same order
    for (const auto* own : {&node.jumps, &node.border})
        for (const std::int64_t v : *own) leaf.rows.push_back(place(v));
    leaf.inside = std::move(node.inside);
    Piece piece;
    piece.inside = static_cast<std::int64_t>(leaf.inside.size());
    piece.jumps = static_cast<std::int64_t>(node.jumps.size());
    piece.border = static_cast<std::int64_t>(node.border.size());
    piece.matrix = matrix_of(stiffness, leaf, piece);
    leaf.piece = apart_ ? pieces_.size() : find_alike(piece);
    if (leaf.piece == pieces_.size()) {
        piece.factor = std::make_unique<SparseCholesky>(piece.matrix, piece.trailing(), poll);
        pieces_.push_back(std::move(piece));
    }
    leaves_.push_back(std::move(leaf));
}

// The rows and columns of a leaf, without entries within the border, which belong to the cuts. In their place the
// border has a diagonal that is not less than they are, so that the whole is definite: the sums of their sizes.
SparseMatrix Superelements::matrix_of(const SparseMatrix& stiffness, const Leaf& leaf, const Piece& piece) {
    std::vector<std::int64_t> all(leaf.inside);
    for (const std::int64_t p : leaf.rows) all.push_back(variable_[index(p)]);
    local_.resize(place_.size(), -1);
    for (std::size_t i = 0; i < all.size(); ++i) local_[index(all[i])] = static_cast<std::int64_t>(i);
    SparseMatrix m;
    m.rows = m.columns = static_cast<std::int64_t>(all.size());
    m.start.reserve(all.size() + 1);
    std::int64_t entries = piece.border;
    for (const std::int64_t v : all) entries += stiffness.start[index(v) + 1] - stiffness.start[index(v)];
    make_room(m.column, index(entries));
    make_room(m.value, index(entries));
    const std::int64_t border = piece.inside + piece.jumps;
    std::vector<std::pair<std::int64_t, double>> row;
    for (std::int64_t r = 0; r < m.rows; ++r) {
        row.clear();
        bool sorted = true;
        double shift = 0.0;
        const std::size_t v = index(all[index(r)]);
        for (std::int64_t e = stiffness.start[v]; e < stiffness.start[v + 1]; ++e) {
            const std::int64_t c = local_[index(stiffness.column[index(e)])];
            if (c < 0) continue;
            if (r >= border && c >= border) {
                shift += std::abs(stiffness.value[index(e)]);
                continue;
            }
            sorted = sorted && (row.empty() || row.back().first < c);
            row.emplace_back(c, stiffness.value[index(e)]);
        }
        if (!sorted) std::sort(row.begin(), row.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
        if (r >= border) row.emplace_back(r, shift);
        for (const auto& [c, value] : row) {
            m.column.push_back(c);
            m.value.push_back(value);
        }
        m.start.push_back(m.entries());
    }
    for (const std::int64_t v : all) local_[index(v)] = -1;
    return m;
}

std::size_t Superelements::find_alike(const Piece& piece) const {
    const SparseMatrix& m = piece.matrix;
    const std::int64_t border = piece.inside + piece.jumps;
    std::vector<double> size;
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
        const Piece& other = pieces_[p];
        if (other.inside != piece.inside || other.jumps != piece.jumps || !same_pattern(other.matrix, m)) continue;
        if (size.empty()) {
            size.resize(index(m.rows));
            for (std::int64_t r = 0; r < m.rows; ++r)
                for (std::int64_t e = m.start[index(r)]; e < m.start[index(r) + 1]; ++e)
                    if (m.column[index(e)] == r) size[index(r)] = std::sqrt(std::abs(m.value[index(e)]));
        }
        bool same = true;
        for (std::int64_t r = 0; r < m.rows && same; ++r)
            for (std::int64_t e = m.start[index(r)]; e < m.start[index(r) + 1] && same; ++e) {
                const std::int64_t c = m.column[index(e)];
                if (r >= border && c == r) continue;  // the shift is no entry of the leaf
                const double scale = size[index(r)] * size[index(c)];
                same = std::abs(m.value[index(e)] - other.matrix.value[index(e)]) <= alike * scale;
            }
        if (same) return p;
    }
    return pieces_.size();
}

bool Superelements::condense(const Poll& poll) {
    std::vector<std::uint8_t> definite(pieces_.size(), 0);
    const auto work = [&](std::int64_t p) { definite[index(p)] = condense(pieces_[index(p)], poll) ? 1 : 0; };
    share(static_cast<std::int64_t>(pieces_.size()), work);
    if (std::find(definite.begin(), definite.end(), 0) != definite.end()) return false;
    for (const Leaf& leaf : leaves_)
        for (std::int64_t t = 0; t < piece_of(leaf).jumps; ++t)
            diagonal_[index(leaf.rows[index(t)])] = piece_of(leaf).stiffness(t, t);
    return true;
}

bool Superelements::condense(Piece& piece, const Poll& poll) {
    SparseMatrix m = std::move(piece.matrix);
    piece.matrix = SparseMatrix();
    const std::int64_t inside = piece.inside, trailing = piece.trailing();
    std::vector<double> shift(index(trailing), 0.0);
    std::vector<std::int64_t> diagonal(index(trailing), -1);
    piece.coupling.rows = trailing;
    piece.coupling.columns = inside;
    for (std::int64_t t = 0; t < trailing; ++t) {
        for (std::int64_t e = m.start[index(inside + t)]; e < m.start[index(inside + t) + 1]; ++e) {
            const std::int64_t c = m.column[index(e)];
            if (c < inside) {
                piece.coupling.column.push_back(c);
                piece.coupling.value.push_back(m.value[index(e)]);
            }
            if (c == inside + t) diagonal[index(t)] = e;
        }
        piece.coupling.start.push_back(piece.coupling.entries());
        shift[index(t)] = m.value[index(diagonal[index(t)])];
    }
    const double largest = trailing > 0 ? *std::max_element(shift.begin(), shift.end()) : 0.0;
    for (std::int64_t t = 0; t < trailing; ++t) {
        double& entry = m.value[index(diagonal[index(t)])];
        if (!(shift[index(t)] > 0.0)) shift[index(t)] = largest > 0.0 ? largest : 1.0;
        entry = t < piece.jumps ? entry + shift[index(t)] : shift[index(t)];
    }
    if (!piece.factor->factorise(m)) return false;
    m = SparseMatrix();
    call_if_set(poll);
    piece.stiffness = lower_times_transpose(piece.factor->trailing_factor(), poll);
    for (std::int64_t t = 0; t < trailing; ++t) piece.stiffness(t, t) -= shift[index(t)];
    call_if_set(poll);
    return true;
}

void Superelements::solve_inside(std::span<const double> b, std::span<double> x) const {
    for (const Leaf& leaf : leaves_) {
        const Piece& piece = piece_of(leaf);
        std::vector<double> outside(leaf.rows.size()), right(leaf.inside.size()), inside(right.size());
        for (std::size_t t = 0; t < outside.size(); ++t) outside[t] = -x[index(variable_[index(leaf.rows[t])])];
        multiply_transposed(piece.coupling, outside, right);
        for (std::size_t i = 0; i < right.size(); ++i) right[i] += b[index(leaf.inside[i])];
        poll_cancel("solve", piece.inside / 64);
        if (std::any_of(right.begin(), right.end(), [](double v) { return v != 0.0; }))
            piece.factor->solve_leading(right, inside);
        for (std::size_t i = 0; i < inside.size(); ++i) x[index(leaf.inside[i])] = inside[i];
    }
}

void Superelements::carry(std::span<const double> x, std::span<double> b) const {
    for (const Leaf& leaf : leaves_) {
        std::vector<double> inside(leaf.inside.size()), image(leaf.rows.size());
        for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = x[index(leaf.inside[i])];
        multiply(piece_of(leaf).coupling, inside, image);
        for (std::size_t t = 0; t < image.size(); ++t) b[index(variable_[index(leaf.rows[t])])] -= image[t];
    }
}

void Superelements::subtract_image(std::span<const double> x, std::span<const std::uint8_t> wanted,
                                   std::span<double> y) const {
    for (const Leaf& leaf : leaves_) {
        const std::size_t n = leaf.rows.size();
        std::vector<double> local(n);
        for (std::size_t t = 0; t < n; ++t) local[t] = x[index(leaf.rows[t])];
        for (std::size_t t = 0; t < n; ++t) {
            const std::size_t p = index(leaf.rows[t]);
            if (wanted[p] == 0) continue;
            y[p] -= dot(std::span(piece_of(leaf).stiffness.value).subspan(t * n, n), local);
        }
    }
    const auto subtract = [&](std::span<const Triplet> entries) {
        for (const Triplet& e : entries) {
            if (wanted[index(e.row)] != 0) y[index(e.row)] -= e.value * x[index(e.column)];
            if (e.row != e.column && wanted[index(e.column)] != 0) y[index(e.column)] -= e.value * x[index(e.row)];
        }
    };
    for (const Node& node : nodes_) subtract(node.entries);
}

FactorSize Superelements::size() const {
    FactorSize sum;
    for (const Piece& piece : pieces_) {
        sum.entries += piece.factor->size().entries;
        sum.flops += piece.factor->size().flops;
    }
    return sum;
}

double Superelements::dense_entries() const {
    double sum = 0.0;
    for (const Piece& piece : pieces_) {
        const auto n = static_cast<double>(piece.trailing());
        sum += n * n;
    }
    return sum;
}

CondensationSize Superelements::condensation() const {
    CondensationSize sum;
    const auto add = [&sum](double eliminated, double left) {
        sum.operations += eliminated * (eliminated * eliminated / 3.0 + eliminated * left + left * left);
        sum.numbers += eliminated * eliminated + eliminated * left + left * left;
    };
    for (const Node& node : nodes_)
        add(static_cast<double>(node.cut.size() + node.jumps.size()), static_cast<double>(node.border.size()));
    return sum;
}

double Superelements::longest() const {
    double most = 0.0;
    for (const Piece& piece : pieces_) most = std::max(most, piece.factor->size().flops);
    return most;
}

std::int64_t Superelements::largest_inside() const {
    std::int64_t most = 0;
    for (const Piece& piece : pieces_) most = std::max(most, piece.inside);
    return most;
}

// Jumps among the displacements inside a leaf have columns as long as theirs.
double Superelements::entries_in_order() const {
    double sum = 0.0;
    for (const Leaf& leaf : leaves_) {
        const Piece& piece = piece_of(leaf);
        const auto n = static_cast<double>(piece.trailing()), inside = static_cast<double>(piece.inside);
        sum += (piece.factor->size().entries - 0.5 * n * (n + 1.0)) *
               (1.0 + static_cast<double>(piece.jumps) / std::max(inside, 1.0));
    }
    for (const Node& node : nodes_) {
        const auto e = static_cast<double>(node.cut.size()), r = static_cast<double>(node.border.size());
        sum += 0.5 * e * (e + 1.0) + e * r;
    }
    return sum;
}

double Superelements::factor_entries() const {
    double sum = 0.0;
    for (const Piece& piece : pieces_) sum += piece.factor->factor_entries();
    return sum;
}

}  // namespace delam
