// SPDX-License-Identifier: BSD-3-Clause
// The factor of a dense matrix A = S + C in which, between two solves, few springs C change and few unknowns are held
// or released: the reference L L^T = A0 is kept, and what has changed since is a small system beside it.
//
// With the unknowns K of the reference whose springs have changed (U) or that are held now (R), the new ones B, the
// flexibility G = E_K^T A0^-1 E_K and H = E_K^T A0^-1 S_0B, everything else is at its minimum for
//
//   1/2 (x_K - x_K* + H x_B)^T G^-1 (x_K - x_K* + H x_B) + 1/2 x_B^T (S_BB - S_B0 A0^-1 S_0B) x_B - h^T x_B,
//
// where x_K* and h belong to the load (static condensation: Belytschko, Liu, Moran, 2000). To this the changes of the
// springs on U and B are added, and x_R = 0. By Haynsworth's theorem (Linear Algebra Appl. 1, 1968) A is positive
// definite where A0 and this small matrix are. Columns L^-1 e_i and L^-1 S_0b are computed when they are first needed
// and kept as long as the reference; a new one is made when the updates have cost as much.
//
// Held rows that express some unknowns by others, x_b = M x_f, add all unknowns of these rows to U, with springs that
// have not changed, and are then eliminated in the small matrix: A restricted to them is positive definite where the
// small matrix is on the null space of the rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/dense/dense.hpp"
#include "linalg/sparse/sparse.hpp"

namespace delam {

// Unknowns of a system: those that are solved for, ascending, and those that they determine, bound = M free.
struct BoundUnknowns {
    std::span<const std::int64_t> free, bound;
    const DenseMatrix& binding;  // M

    // True if this free unknown, by its number among them, determines a bound one.
    bool binds(std::size_t i) const;
    // All unknowns of the rows that bind.
    std::size_t touched() const;
};

class UpdatedFactor {
public:
    // Can an update of so many unknowns, so many of them in U, be cheaper than a new factor?
    static bool pays(std::size_t unknowns, std::size_t touched);
    // The matrix with these springs [symmetric] and unknowns, from the reference. False: there is none, a new one is
    // cheaper, or digits would be lost; then renew. stiffness: S, the same as for the reference.
    bool update(const DenseMatrix& stiffness, const std::vector<Triplet>& springs, const BoundUnknowns& unknowns,
                const Poll& poll);
    // Makes the reference of A, [free] with its lower triangle set, where none is bound, in its memory; a: that of an
    // earlier one. False: A is not positive definite, and the reference is the one before.
    bool renew(DenseMatrix& a, const std::vector<Triplet>& springs, std::span<const std::int64_t> free,
               std::int64_t all, const Poll& poll);
    void forget() { valid_ = false; }
    // True if the last successful update or renewal found the matrix positive definite.
    bool definite() const { return definite_; }
    // True if the matrix differs from the reference.
    bool changed() const { return !k_.empty() || !b_.empty(); }
    // A^-1 x in place, [free]. again: this load may come back after the next update.
    void solve(std::span<double> x, bool again);
    // Full factorisations since the construction.
    std::int64_t renewals() const { return renewals_; }

private:
    // Differences from the reference.
    struct Change {
        std::vector<std::int64_t> touched, held, added;  // U, R, B
        std::vector<Triplet> spring;                     // among U and B
    };
    Change compare(const std::vector<Triplet>& springs, const BoundUnknowns& unknowns);
    // A stiff spring hides the digits of the bodies that would remain without it.
    bool hides(const DenseMatrix& stiffness, const Change& change) const;
    double cost(const Change& change) const;
    void add_columns(const DenseMatrix& stiffness, const Change& change, const Poll& poll);
    bool condense(const DenseMatrix& stiffness, const Change& change, const BoundUnknowns& unknowns);
    void bind(const BoundUnknowns& unknowns, std::span<const std::int64_t> row);
    void solve_small(std::vector<double>& small) const;

    // The reference.
    bool valid_ = false;
    DenseMatrix factor_;                   // L
    std::vector<std::int64_t> unknowns_;   // of it, ascending
    std::vector<std::int64_t> place_;      // [all unknowns] in the reference, -1: not in it
    std::vector<Triplet> springs_;         // C among them, sorted, without duplicates
    DenseMatrix columns_;                  // L^-1 e_i and L^-1 S_0b
    DenseMatrix gram_;                     // their products
    std::vector<std::int64_t> column_of_;  // [all unknowns] -1: not yet computed
    double spent_ = 0.0;                   // multiplications in updates

    // The present matrix.
    bool definite_ = false;
    std::vector<std::int64_t> free_;
    std::vector<std::int64_t> k_, b_;  // unknowns: U then R; B
    std::int64_t touched_ = 0;         // size of U
    DenseMatrix inverse_;              // G^-1
    DenseMatrix through_;              // H
    DenseMatrix small_;                // factor of the small matrix, in its unknowns that are not bound
    std::vector<std::int64_t> small_free_, small_bound_;  // rows of the small matrix
    DenseMatrix small_binding_;                           // M among them
    std::vector<double> load_, loaded_;                   // on the reference, and L^-1 of it: contact changes neither
    std::int64_t renewals_ = 0;
};

}  // namespace delam
