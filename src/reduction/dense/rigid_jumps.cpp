// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/dense/rigid_jumps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/numbers.hpp"
#include "scene/carriers.hpp"
#include "scene/pieces.hpp"

namespace delam {

namespace {

// Eigenvalues of a Gram matrix below this fraction of the largest one are zero: singular values below 1e-6. Lever arms
// of supports are longer. (Measured by verify/bench/constants.py on 250 random scenes: half, twice and a hundred times
// decide alike; a hundredth is rounding itself, and 223 of 750 analyses end elsewhere.)
constexpr double zero = 1e-12;
// The same of active rows: a part that hangs by a last line of pairs, straight but for what the balance of bodies that
// rotate leaves, turns about this line. (`film_comes_off_and_stays` of verify/cases/test_turned_loose.cpp passes with
// five processors' kernels from a tenth to ten times; with a thousandth, some stop. 100 random scenes of
// verify/cases/contact/random_scenes.py end alike from a thousandth to a hundred times.)
constexpr double straight = 1e-9;
// The largest part that the work of dead forces along a motion may reach of what it could be, and still be zero; and
// the part of the largest entry of a motion below which entries are rounding. (From a hundredth to a hundred times
// both decide alike on the same scenes.)
constexpr double unbalanced = 1e-8;
constexpr double still = 1e-8;

using Row = std::map<std::int64_t, double>;

// Eigenvectors of A^T A, small eigenvalues (up to `limit`) first. Squared rows determine null vectors to half the
// digits or fewer; the remaining effect on the rows themselves, image(v) = A^T (A v), determines the rest.
template <class Image>
DenseMatrix null_vectors(const Eigen& eigen, double limit, const Image& image) {
    const std::int64_t size = eigen.vector.rows;
    std::int64_t count = 0;
    while (count < size && eigen.value[index(count)] <= limit) ++count;
    DenseMatrix null(size, count);
    std::copy_n(eigen.vector.value.begin(), null.value.size(), null.value.begin());
    for (int pass = 0; pass < 2; ++pass)
        for (std::int64_t c = 0; c < count; ++c) {
            const auto v = std::span<double>(null.value).subspan(index(c * size), index(size));
            const std::vector<double> off = image(std::span<const double>(v));
            for (std::int64_t h = count; h < size; ++h) {
                const auto held = std::span<const double>(eigen.vector.value).subspan(index(h * size), index(size));
                add_scaled(-dot(held, off) / eigen.value[index(h)], held, v);
            }
        }
    return null;
}

// Motions that no row resists. Control nodes have units of their own (a strain, a length), scaled by their coefficients
// in the rows.
DenseMatrix unresisted(std::vector<Row> rows, std::int64_t count, std::int64_t first_control) {
    std::vector<double> unit(index(count), 0.0);
    for (const Row& row : rows)
        for (const auto& [i, a] : row) unit[index(i)] = std::max(unit[index(i)], std::abs(a));
    for (std::int64_t i = 0; i < count; ++i)
        if (double& u = unit[index(i)]; i < first_control || !(u > 0.0)) u = 1.0;
    DenseMatrix gram(count, count);
    for (Row& row : rows) {
        for (auto& [i, a] : row) a /= unit[index(i)];
        for (const auto& [i, a] : row)
            for (const auto& [j, b] : row) gram(i, j) += a * b;
    }
    const Eigen eigen = eigen_symmetric(std::move(gram));
    const auto image = [&](std::span<const double> v) {
        std::vector<double> off(v.size(), 0.0);
        for (const Row& row : rows) {
            double moved = 0.0;
            for (const auto& [i, a] : row) moved += a * v[index(i)];
            for (const auto& [i, a] : row) off[index(i)] += a * moved;
        }
        return off;
    };
    DenseMatrix null = null_vectors(eigen, eigen.value.empty() ? 0.0 : zero * eigen.value.back(), image);
    for (std::int64_t c = 0; c < null.columns; ++c)
        for (std::int64_t i = 0; i < count; ++i) null(i, c) /= unit[index(i)];
    return null;
}

}  // namespace

// A piece connected through whole faces moves rigidly: translations, and rotations about its centre with unit
// displacement at its edge. A control node moves by translations.
struct RigidMotions::Piece {
    std::array<double, 3> centre{};
    double size = 0.0;
};

class RigidMotions::Motions {
public:
    explicit Motions(const Problem& problem)
        : mesh_(*problem.mesh), carriers_(problem), dim_(mesh_.dimension()), modes_(dim_ == 2 ? 3 : 6) {
        const Pieces& parts = rigid_pieces(problem);
        pieces_.resize(parts.count());
        piece_of_ = parts.of_node;
        hinges_ = parts.hinges;
        resisted_ = parts.resisted;
        fixed_ = parts.fixed;
        std::vector<std::array<std::array<double, 3>, 2>> box(pieces_.size());
        for (std::size_t p = 0; p < pieces_.size(); ++p)
            for (const std::int64_t node : parts.nodes[p])
                for (std::size_t k = 0; k < index(dim_); ++k) {
                    const double x = mesh_.node(node)[k];
                    const bool first = node == parts.nodes[p].front();
                    box[p][0][k] = first ? x : std::min(box[p][0][k], x);
                    box[p][1][k] = first ? x : std::max(box[p][1][k], x);
                }
        for (std::size_t p = 0; p < pieces_.size(); ++p)
            for (std::size_t k = 0; k < index(dim_); ++k) {
                pieces_[p].centre[k] = 0.5 * (box[p][0][k] + box[p][1][k]);
                pieces_[p].size = std::max(pieces_[p].size, 0.5 * (box[p][1][k] - box[p][0][k]));
            }
        for (Piece& piece : pieces_)
            if (!(piece.size > 0.0)) piece.size = 1.0;
    }

    // The motions of the pieces come first, then the translations of each control node.
    std::int64_t first_control() const { return static_cast<std::int64_t>(pieces_.size()) * modes_; }
    std::int64_t count() const {
        return first_control() + static_cast<std::int64_t>(carriers_.controls().size()) * dim_;
    }

    // row += factor * (component k of all motions at a node of a piece)
    void add(Row& row, std::int64_t node, std::int64_t piece, std::int64_t k, double factor) const {
        const Piece& p = pieces_[index(piece)];
        row[piece * modes_ + k] += factor;
        for (std::int64_t m = dim_; m < modes_; ++m) {
            const std::int64_t axis = dim_ == 2 ? 2 : m - dim_, u = (axis + 1) % 3, v = (axis + 2) % 3;
            if (k != u && k != v) continue;
            const auto other = index(k == u ? v : u);
            const double arm = (mesh_.node(node)[other] - p.centre[other]) / p.size;
            row[piece * modes_ + m] += factor * (k == u ? -arm : arm);
        }
    }
    void add(Row& row, std::int64_t node, std::int64_t k, double factor) const {
        for (const auto& [carrier, weight] : carriers_.of(node)) {
            const std::int64_t piece = piece_of_[index(carrier)];
            if (piece >= 0) {
                add(row, carrier, piece, k, factor * weight);
                continue;
            }
            const auto& controls = carriers_.controls();
            const auto place = std::lower_bound(controls.begin(), controls.end(), carrier) - controls.begin();
            row[first_control() + place * dim_ + k] += factor * weight;
        }
    }

    const std::vector<Pieces::Hinge>& hinges() const { return hinges_; }
    const std::vector<Pieces::Row>& resisted() const { return resisted_; }
    // Rows that hold pieces that cannot move at all.
    void hold(std::vector<Row>& rows) const {
        for (std::size_t p = 0; p < fixed_.size(); ++p)
            for (std::int64_t m = 0; fixed_[p] != 0 && m < modes_; ++m)
                rows.push_back({{static_cast<std::int64_t>(p) * modes_ + m, 1.0}});
    }
    std::int64_t dimension() const { return dim_; }

private:
    const Mesh& mesh_;
    Carriers carriers_;
    std::int64_t dim_;
    std::int64_t modes_;
    std::vector<Piece> pieces_;
    std::vector<std::int64_t> piece_of_;
    std::vector<Pieces::Hinge> hinges_;
    std::vector<Pieces::Row> resisted_;
    std::vector<std::uint8_t> fixed_;
};

struct RigidMotions::Impl {
    explicit Impl(const Problem& problem) : motions(problem), carriers(problem), nodes(problem.mesh->node_count()) {}
    Motions motions;
    Carriers carriers;
    std::int64_t nodes;
    DenseMatrix null;  // [motions of pieces and control nodes][columns of the jumps]
};

RigidMotions::RigidMotions(const Problem& problem) : impl_(std::make_unique<Impl>(problem)) {
    const Motions& motions = impl_->motions;
    const std::int64_t dim = motions.dimension();
    std::vector<Row> rows;
    for (const Constraint& constraint : problem.constraints) {
        Row& row = rows.emplace_back();
        for (std::size_t i = 0; i < constraint.dof.size(); ++i)
            motions.add(row, constraint.dof[i] / dim, constraint.dof[i] % dim, constraint.coefficient[i]);
    }
    motions.hold(rows);
    for (const Pieces::Row& resisted : motions.resisted()) {
        Row& row = rows.emplace_back();
        for (const auto& [dof, coefficient] : resisted) motions.add(row, dof / dim, dof % dim, coefficient);
    }
    for (const auto& hinge : motions.hinges())
        for (std::int64_t k = 0; k < dim; ++k) {
            Row& row = rows.emplace_back();
            motions.add(row, hinge.node, hinge.piece_a, k, 1.0);
            motions.add(row, hinge.node, hinge.piece_b, k, -1.0);
        }
    const DenseMatrix null = unresisted(std::move(rows), motions.count(), motions.first_control());
    jumps_ = DenseMatrix(problem.jump_count(), null.columns);
    if (null.columns == 0) return;
    std::int64_t at = 0;
    for (const InterfaceGeometry& face : problem.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            for (std::int64_t r = 0; r < dim; ++r, ++at) {
                Row row;
                for (std::int64_t k = 0; k < dim; ++k) {
                    const double q = face.frame[(p * index(dim) + index(r)) * index(dim) + index(k)];
                    motions.add(row, face.node_b[p], k, q);
                    motions.add(row, face.node_a[p], k, -q);
                }
                for (std::int64_t c = 0; c < null.columns; ++c)
                    for (const auto& [i, value] : row) jumps_(at, c) += value * null(i, c);
            }
    // Orthonormal, without the motions that open nothing.
    const Eigen eigen = eigen_symmetric(multiply_transposed(jumps_, jumps_));
    const double largest = eigen.value.back();
    DenseMatrix basis(null.columns, 0);
    for (std::int64_t c = 0; c < null.columns; ++c) {
        const double value = eigen.value[index(c)];
        if (!(value > zero * largest)) continue;
        for (std::int64_t i = 0; i < null.columns; ++i) basis.value.push_back(eigen.vector(i, c) / std::sqrt(value));
        ++basis.columns;
    }
    jumps_ = multiply(jumps_, basis);
    impl_->null = multiply(null, basis);
    const auto patterns = static_cast<std::int64_t>(problem.patterns.size());
    dead_ = {DenseMatrix(patterns, basis.columns), DenseMatrix(patterns, basis.columns)};
    std::vector<double> farthest;  // displacement of each motion
    for (std::int64_t c = 0; c < basis.columns; ++c) farthest.push_back(max_abs(column(impl_->null, c)));
    for (const NodalForce& force : problem.forces) {
        Row row;
        motions.add(row, force.dof / dim, force.dof % dim, force.value);
        for (std::int64_t c = 0; c < basis.columns; ++c) {
            double work = 0.0;
            for (const auto& [i, value] : row) work += value * impl_->null(i, c);
            dead_.work(force.pattern, c) += work;
            dead_.magnitudes(force.pattern, c) += std::abs(force.value) * farthest[index(c)];
        }
    }
}

RigidMotions::~RigidMotions() = default;
RigidMotions::RigidMotions(RigidMotions&&) noexcept = default;
RigidMotions& RigidMotions::operator=(RigidMotions&&) noexcept = default;

bool DeadWork::balances(std::span<const double> theta, std::span<const double> combination, double added,
                        double magnitude) const {
    double total = added, size = magnitude;
    for (std::size_t p = 0; p < theta.size(); ++p)
        for (std::size_t c = 0; c < combination.size(); ++c) {
            const auto at = static_cast<std::int64_t>(p), motion = static_cast<std::int64_t>(c);
            total += theta[p] * work(at, motion) * combination[c];
            size += std::abs(theta[p] * magnitudes(at, motion) * combination[c]);
        }
    return std::abs(total) <= unbalanced * size;
}

std::vector<double> RigidMotions::of_piece(std::size_t piece, std::span<const double> combination) const {
    const std::size_t modes = impl_->motions.dimension() == 2 ? 3 : 6;
    std::vector<double> motion(modes, 0.0);
    for (std::size_t c = 0; c < combination.size(); ++c)
        for (std::size_t m = 0; m < modes; ++m)
            motion[m] += combination[c] *
                         impl_->null(static_cast<std::int64_t>(piece * modes + m), static_cast<std::int64_t>(c));
    return motion;
}

bool RigidMotions::holds(std::size_t piece) const {
    const std::int64_t modes = impl_->motions.dimension() == 2 ? 3 : 6;
    for (std::int64_t c = 0; c < impl_->null.columns; ++c) {
        const auto motion =
            std::span<const double>(impl_->null.value).subspan(index(c * impl_->null.rows), index(impl_->null.rows));
        if (max_abs(motion.subspan(piece * index(modes), index(modes))) > still * max_abs(motion)) return false;
    }
    return true;
}

std::vector<double> RigidMotions::displacement(std::span<const double> combination) const {
    const std::int64_t dim = impl_->motions.dimension();
    std::vector<double> of_piece(index(impl_->null.rows));
    multiply(impl_->null, combination, of_piece);
    std::vector<double> u(index(impl_->nodes * dim), 0.0);
    Row row;
    for (std::int64_t node = 0; node < impl_->nodes; ++node) {
        if (impl_->carriers.kind(node) == Carriers::Kind::nothing) continue;
        for (std::int64_t k = 0; k < dim; ++k) {
            row.clear();
            impl_->motions.add(row, node, k, 1.0);
            for (const auto& [i, value] : row) u[index(node * dim + k)] += value * of_piece[index(i)];
        }
    }
    return u;
}

Combinations split_motions(const DenseMatrix& z, std::span<const std::uint8_t> active) {
    DenseMatrix gram(z.columns, z.columns);
    for (std::int64_t r = 0; r < z.rows; ++r) {
        if (active[index(r)] == 0) continue;
        for (std::int64_t j = 0; j < z.columns; ++j)
            for (std::int64_t i = 0; i < z.columns; ++i) gram(i, j) += z(r, i) * z(r, j);
    }
    // A single active row may be the only one that resists a motion.
    const Eigen eigen = eigen_symmetric(gram);
    const auto image = [&](std::span<const double> v) {
        std::vector<double> off(v.size(), 0.0);
        for (std::int64_t r = 0; r < z.rows; ++r) {
            if (active[index(r)] == 0) continue;
            double moved = 0.0;
            for (std::int64_t i = 0; i < z.columns; ++i) moved += z(r, i) * v[index(i)];
            for (std::int64_t i = 0; i < z.columns; ++i) off[index(i)] += z(r, i) * moved;
        }
        return off;
    };
    Combinations result;
    result.free = null_vectors(eigen, straight / static_cast<double>(std::max<std::int64_t>(z.rows, 1)), image);
    result.held = DenseMatrix(z.columns, z.columns - result.free.columns);
    std::copy(eigen.vector.value.begin() + static_cast<std::ptrdiff_t>(result.free.value.size()),
              eigen.vector.value.end(), result.held.value.begin());
    return result;
}

}  // namespace delam
