// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/rigid_jumps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scene/carriers.hpp"
#include "scene/pieces.hpp"

namespace delam {

namespace {

// Eigenvalues of a Gram matrix below this part of the largest one are zero: singular values below 1e-6. Lever arms of supports are longer.
constexpr double zero = 1e-12;

// Null vectors of a positive semi-definite matrix, in columns.
DenseMatrix null_vectors(const DenseMatrix& gram) {
    const Eigen eigen = eigen_symmetric(gram);
    const double largest = eigen.value.empty() ? 0.0 : eigen.value.back();
    std::int64_t count = 0;
    while (count < gram.rows && eigen.value[static_cast<std::size_t>(count)] <= zero * largest) ++count;
    DenseMatrix null(gram.rows, count);
    std::copy_n(eigen.vector.value.begin(), null.value.size(), null.value.begin());
    return null;
}

// A piece that hangs together through whole faces moves rigidly: translations, and rotations about its centre with unit displacement at
// its edge. A control node moves by translations.
struct Piece {
    std::array<double, 3> centre{};
    double size = 0.0;
};

class Motions {
public:
    explicit Motions(const Problem& problem)
        : mesh_(*problem.mesh), carriers_(problem), dim_(mesh_.dimension()), modes_(dim_ == 2 ? 3 : 6) {
        const Pieces parts = rigid_pieces(problem);
        pieces_.resize(parts.count());
        piece_of_ = parts.of_node;
        hinges_ = parts.hinges;
        resisted_ = parts.resisted;
        fixed_ = parts.fixed;
        std::vector<std::array<std::array<double, 3>, 2>> box(pieces_.size());
        for (std::size_t p = 0; p < pieces_.size(); ++p)
            for (const std::int64_t node : parts.nodes[p])
                for (std::size_t k = 0; k < static_cast<std::size_t>(dim_); ++k) {
                    const double x = mesh_.node(node)[k];
                    const bool first = node == parts.nodes[p].front();
                    box[p][0][k] = first ? x : std::min(box[p][0][k], x);
                    box[p][1][k] = first ? x : std::max(box[p][1][k], x);
                }
        for (std::size_t p = 0; p < pieces_.size(); ++p)
            for (std::size_t k = 0; k < static_cast<std::size_t>(dim_); ++k) {
                pieces_[p].centre[k] = 0.5 * (box[p][0][k] + box[p][1][k]);
                pieces_[p].size = std::max(pieces_[p].size, 0.5 * (box[p][1][k] - box[p][0][k]));
            }
        for (Piece& piece : pieces_)
            if (!(piece.size > 0.0)) piece.size = 1.0;
    }

    // Of the pieces, then the translations of each control node.
    std::int64_t count() const { return static_cast<std::int64_t>(pieces_.size()) * modes_ + static_cast<std::int64_t>(carriers_.controls().size()) * dim_; }

    // row += factor * (component k of all motions at a node of a piece)
    void add(std::map<std::int64_t, double>& row, std::int64_t node, std::int64_t piece, std::int64_t k, double factor) const {
        const Piece& p = pieces_[static_cast<std::size_t>(piece)];
        row[piece * modes_ + k] += factor;
        for (std::int64_t m = dim_; m < modes_; ++m) {
            const std::int64_t axis = dim_ == 2 ? 2 : m - dim_, u = (axis + 1) % 3, v = (axis + 2) % 3;
            if (k != u && k != v) continue;
            const auto other = static_cast<std::size_t>(k == u ? v : u);
            const double arm = (mesh_.node(node)[other] - p.centre[other]) / p.size;
            row[piece * modes_ + m] += factor * (k == u ? -arm : arm);
        }
    }
    void add(std::map<std::int64_t, double>& row, std::int64_t node, std::int64_t k, double factor) const {
        for (const auto& [carrier, weight] : carriers_.of(node)) {
            const std::int64_t piece = piece_of_[static_cast<std::size_t>(carrier)];
            if (piece >= 0) {
                add(row, carrier, piece, k, factor * weight);
                continue;
            }
            const auto& controls = carriers_.controls();
            const auto place = std::lower_bound(controls.begin(), controls.end(), carrier) - controls.begin();
            row[static_cast<std::int64_t>(pieces_.size()) * modes_ + place * dim_ + k] += factor * weight;
        }
    }

    const std::vector<Pieces::Hinge>& hinges() const { return hinges_; }
    const std::vector<Pieces::Row>& resisted() const { return resisted_; }
    // What holds pieces that cannot move at all.
    void hold(DenseMatrix& gram) const {
        for (std::size_t p = 0; p < fixed_.size(); ++p)
            for (std::int64_t m = 0; fixed_[p] != 0 && m < modes_; ++m) {
                const std::int64_t i = static_cast<std::int64_t>(p) * modes_ + m;
                gram(i, i) += 1.0;
            }
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

void accumulate(DenseMatrix& gram, const std::map<std::int64_t, double>& row) {
    for (const auto& [i, a] : row)
        for (const auto& [j, b] : row) gram(i, j) += a * b;
}

}  // namespace

DenseMatrix rigid_jumps(const Problem& problem) {
    const Motions motions(problem);
    const std::int64_t dim = motions.dimension();
    DenseMatrix gram(motions.count(), motions.count());
    for (const Constraint& constraint : problem.constraints) {
        std::map<std::int64_t, double> row;
        for (std::size_t i = 0; i < constraint.dof.size(); ++i)
            motions.add(row, constraint.dof[i] / dim, constraint.dof[i] % dim, constraint.coefficient[i]);
        accumulate(gram, row);
    }
    motions.hold(gram);
    for (const Pieces::Row& resisted : motions.resisted()) {
        std::map<std::int64_t, double> row;
        for (const auto& [dof, coefficient] : resisted) motions.add(row, dof / dim, dof % dim, coefficient);
        accumulate(gram, row);
    }
    for (const auto& hinge : motions.hinges())
        for (std::int64_t k = 0; k < dim; ++k) {
            std::map<std::int64_t, double> row;
            motions.add(row, hinge.node, hinge.piece_a, k, 1.0);
            motions.add(row, hinge.node, hinge.piece_b, k, -1.0);
            accumulate(gram, row);
        }
    const DenseMatrix null = null_vectors(gram);
    DenseMatrix jumps(problem.jump_count(), null.columns);
    if (null.columns == 0) return jumps;
    std::int64_t at = 0;
    for (const InterfaceGeometry& face : problem.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            for (std::int64_t r = 0; r < dim; ++r, ++at) {
                std::map<std::int64_t, double> row;
                for (std::int64_t k = 0; k < dim; ++k) {
                    const double q = face.frame[(p * static_cast<std::size_t>(dim) + static_cast<std::size_t>(r)) *
                                                    static_cast<std::size_t>(dim) + static_cast<std::size_t>(k)];
                    motions.add(row, face.node_b[p], k, q);
                    motions.add(row, face.node_a[p], k, -q);
                }
                for (std::int64_t c = 0; c < null.columns; ++c)
                    for (const auto& [i, value] : row) jumps(at, c) += value * null(i, c);
            }
    // Orthonormal, without the motions that open nothing.
    const Eigen eigen = eigen_symmetric(multiply_transposed(jumps, jumps));
    const double largest = eigen.value.back();
    DenseMatrix basis(null.columns, 0);
    for (std::int64_t c = 0; c < null.columns; ++c) {
        const double value = eigen.value[static_cast<std::size_t>(c)];
        if (!(value > zero * largest)) continue;
        for (std::int64_t i = 0; i < null.columns; ++i) basis.value.push_back(eigen.vector(i, c) / std::sqrt(value));
        ++basis.columns;
    }
    return multiply(jumps, basis);
}

Combinations split_motions(const DenseMatrix& z, std::span<const std::uint8_t> active) {
    DenseMatrix gram(z.columns, z.columns);
    for (std::int64_t r = 0; r < z.rows; ++r) {
        if (active[static_cast<std::size_t>(r)] == 0) continue;
        for (std::int64_t j = 0; j < z.columns; ++j)
            for (std::int64_t i = 0; i < z.columns; ++i) gram(i, j) += z(r, i) * z(r, j);
    }
    // A single active row may be all that holds a motion.
    const Eigen eigen = eigen_symmetric(gram);
    std::int64_t count = 0;
    const double scale = 1.0 / static_cast<double>(std::max<std::int64_t>(z.rows, 1));
    while (count < z.columns && eigen.value[static_cast<std::size_t>(count)] <= zero * scale) ++count;
    Combinations result{DenseMatrix(z.columns, count), DenseMatrix(z.columns, z.columns - count)};
    const auto cut = eigen.vector.value.begin() + static_cast<std::ptrdiff_t>(result.free.value.size());
    std::copy(eigen.vector.value.begin(), cut, result.free.value.begin());
    std::copy(cut, eigen.vector.value.end(), result.held.value.begin());
    return result;
}

}  // namespace delam
