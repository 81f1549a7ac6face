// SPDX-License-Identifier: BSD-3-Clause
// Constraints that bind several trailing variables (jump_variables.hpp) express some of them, the pivots, by the rest:
//
//     t = M r + d theta,      r = [kept displacements that no equation determines | unknown jumps],
//
// after which the energy is one of the unknown jumps alone. The jump rows are  j = N x + O theta  in the unknowns x.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"
#include "reduction/condensed/superelements.hpp"
#include "reduction/operator/jump_row.hpp"
#include "reduction/operator/jump_variables.hpp"

namespace delam {

class TrailingEquations {
public:
    // Has no variable at all.
    TrailingEquations() = default;
    // `skeleton` must outlive it.
    TrailingEquations(const JumpVariables& variables, std::int64_t patterns, const Superelements& skeleton);

    std::int64_t unknowns() const { return static_cast<std::int64_t>(rest_.size()) - kept_; }
    // Returns the number of displacements in r, which come first.
    std::int64_t kept() const { return kept_; }
    std::int64_t rest_count() const { return static_cast<std::int64_t>(rest_.size()); }
    bool any() const { return !pivot_.empty(); }
    // Returns the position of a variable in r, or -2 - its position among the pivots.
    std::int64_t role(std::int64_t variable) const { return role_[index(variable - leading_)]; }
    // Returns a row of M, in r.
    const SparseVector& row(std::int64_t pivot) const { return rows_[index(pivot)]; }
    // d, [pivots][patterns]
    const DenseMatrix& prescribed() const { return prescribed_; }

    const std::vector<JumpRow>& jump_rows() const { return jump_rows_; }
    // The first jump row that equals unknown i. Others may equal it too (on opposite faces of a periodic cell).
    const std::vector<std::int64_t>& row_of_unknown() const { return row_of_unknown_; }
    // [unknowns] 1: an equation binds it to other variables.
    const std::vector<std::uint8_t>& bound() const { return bound_; }

    // Returns the place of an unknown in the skeleton.
    std::int64_t place(std::int64_t unknown) const {
        return skeleton_->place(leading_ + rest_[index(kept_ + unknown)]);
    }
    // Returns states of the skeleton from those of the unknowns: jumps that equations determine always stay in the
    // zone.
    std::vector<double> states(std::span<const double> of_unknowns) const;
    std::vector<double> unknowns_at(std::span<const double> skeleton) const;
    // [places] 1: a force there acts on one of the wanted unknowns.
    std::vector<std::uint8_t> places_of(std::span<const std::uint8_t> wanted) const;
    // Turns forces on the skeleton into forces on the wanted unknowns, with those on the variables that they determine;
    // 0 for the others.
    std::vector<double> gather(std::span<const double> skeleton, std::span<const std::uint8_t> wanted) const;

    // Returns the force on a component of r: its own and those on the variables that it determines.
    double on_rest(std::span<const double> variables, std::int64_t rest) const;
    // Returns all variables, leading ones at zero, from the unknowns, with kept displacements at zero.
    std::vector<double> variables_at(std::span<const double> theta, std::span<const double> unknowns) const;
    // Returns the same from kept displacements in r, with unknowns and theta at zero.
    std::vector<double> variables_of_kept(std::span<const double> kept) const;

private:
    void express_jump_rows(const JumpVariables& variables, std::int64_t patterns);
    std::size_t pivot_place(std::int64_t pivot) const {
        return index(skeleton_->place(leading_ + pivot_[index(pivot)]));
    }

    const Superelements* skeleton_ = nullptr;
    std::int64_t leading_ = 0, kept_variables_ = 0, count_ = 0;  // of the variables
    std::int64_t kept_ = 0;
    std::vector<std::int64_t> rest_;     // trailing index of r
    std::vector<std::int64_t> pivot_;    // trailing index of variables determined by equations
    std::vector<std::int64_t> role_;     // [trailing]
    std::vector<SparseVector> rows_;     // of M
    std::vector<SparseVector> columns_;  // of M: the pivots that each of r determines
    DenseMatrix prescribed_;
    std::vector<JumpRow> jump_rows_;
    std::vector<std::int64_t> row_of_unknown_;
    std::vector<std::uint8_t> bound_;
};

}  // namespace delam
