// SPDX-License-Identifier: BSD-3-Clause
// The stiffness of the bodies on the skeleton of a tree of superelements: all jumps, and the displacements on the cuts.
//
// Each leaf is condensed once onto its jumps and its border: with these eliminated last, the trailing block of its
// sparse factor is the Schur complement S = L_tt L_tt^T - tau, where a shift tau on the trailing diagonal keeps the
// factor definite whatever is left free. The stiffness of the skeleton is the sum of these and of the entries of
// T^T K T between variables of the cuts. Leaves that are alike share one condensed piece.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "linalg/sparse/sparse.hpp"
#include "reduction/condensed/superelement_tree.hpp"

namespace delam {

// Cost of minimising out all of the skeleton once.
struct CondensationSize {
    double operations = 0.0;
    double numbers = 0.0;  // that its dense matrices store
};

class Superelements {
public:
    // Cuts the bodies and analyses the leaves. stiffness: T^T K T.
    Superelements(const SparseMatrix& stiffness, const JumpVariables& variables, const Problem& problem,
                  const Poll& poll);
    // Takes other numbers of the analysed matrix, which had its leaves kept apart (Problem::renewed).
    void renew(const SparseMatrix& stiffness);
    // Computes the numbers. False: a leaf is not positive definite with its border at rest. poll: threads of the
    // library call it, too.
    bool condense(const Poll& poll);

    // The skeleton in the order of elimination, as variables; and the place of a variable in it, -1: inside a leaf.
    const std::vector<std::int64_t>& variable() const { return variable_; }
    std::int64_t place(std::int64_t variable) const { return place_[index(variable)]; }
    enum class Kind : std::uint8_t { cut, jump, kept };
    Kind kind(std::int64_t place) const { return kind_[index(place)]; }

    struct Node {
        std::vector<std::int64_t> children;
        // Lists of places of the skeleton, ascending.
        std::vector<std::int64_t> cut;  // displacements that this node owns
        std::vector<std::int64_t> jumps;
        std::vector<std::int64_t> border;
        std::vector<std::int64_t> kept;  // all kept displacements: at the root, which leaves them on its border
        // Entries of T^T K T in rows that an inner node owns or has kept: the lower triangle, column <= row.
        std::vector<Triplet> entries;
        std::int64_t leaf = -1;  // its number among the leaves
    };
    const std::vector<Node>& nodes() const { return nodes_; }

    // Stiffness of a leaf, full symmetric, and the places of its rows: jumps, then border.
    const DenseMatrix& stiffness(std::int64_t leaf) const { return piece_of(leaves_[index(leaf)]).stiffness; }
    const std::vector<std::int64_t>& rows(std::int64_t leaf) const { return leaves_[index(leaf)].rows; }
    // x_l = A_ll^-1 (b_l - A_lt x_t) for the displacements l inside the leaves; b, x: [variables].
    void solve_inside(std::span<const double> b, std::span<double> x) const;
    // b_t -= A_tl x_l, for the skeleton t.
    void carry(std::span<const double> x, std::span<double> b) const;
    // y -= S x over the skeleton, in the wanted rows only, [places].
    void subtract_image(std::span<const double> x, std::span<const std::uint8_t> wanted, std::span<double> y) const;
    // The stiffness of a jump with all else of the skeleton at rest, [places].
    const std::vector<double>& diagonal() const { return diagonal_; }
    // The same before anything is condensed: of T^T K T.
    const std::vector<double>& assembled_diagonal() const { return assembled_diagonal_; }

    std::size_t leaves() const { return leaves_.size(); }
    std::size_t pieces() const { return pieces_.size(); }
    FactorSize size() const;        // of the pieces' factors, by their analysis
    double factor_entries() const;  // numbers that these will store
    double dense_entries() const;   // of the pieces' dense matrices
    CondensationSize condensation() const;
    double longest() const;               // operations of the largest factorisation of a piece
    std::int64_t largest_inside() const;  // displacements inside a piece
    double entries_in_order() const;      // of a factor of T^T K T in the order of the tree

private:
    // Data that equal leaves share: [inside | jumps | border].
    struct Piece {
        std::int64_t inside = 0, jumps = 0, border = 0;
        std::int64_t trailing() const { return jumps + border; }
        SparseMatrix matrix;  // without entries within the border, whose diagonal is the shift, until it is condensed
        std::unique_ptr<SparseCholesky> factor;
        SparseMatrix coupling;  // A_tl, [jumps | border][inside]
        DenseMatrix stiffness;
    };
    struct Leaf {
        std::vector<std::int64_t> inside;  // variables
        std::vector<std::int64_t> rows;    // places: jumps, then border
        std::size_t piece = 0;
    };
    const Piece& piece_of(const Leaf& leaf) const { return pieces_[leaf.piece]; }
    void add_leaf(const SparseMatrix& stiffness, Superelement& node, const Poll& poll);
    SparseMatrix matrix_of(const SparseMatrix& stiffness, const Leaf& leaf, const Piece& piece);
    void take_entries(const SparseMatrix& stiffness);
    std::size_t find_alike(const Piece& piece) const;
    static bool condense(Piece& piece, const Poll& poll);

    std::vector<std::int64_t> variable_, place_;
    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_;
    std::vector<Piece> pieces_;
    std::vector<Kind> kind_;
    std::vector<double> diagonal_, assembled_diagonal_;
    std::vector<std::int64_t> local_;  // scratch of matrix_of(), [variables]
    bool apart_;                       // no two leaves share a piece
};

}  // namespace delam
