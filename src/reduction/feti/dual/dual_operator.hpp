// SPDX-License-Identifier: BSD-3-Clause
// The dual operator F + C at the springs of the moment, with all that conjugate gradients need of it: the projector
// onto balanced forces and the preconditioner. F = B K^+ B^T comes from the subdomains' boundary blocks, C is the
// compliance 1/s of the springs; a row with s = 0 carries no force and is left out.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/team.hpp"
#include "reduction/feti/dual/coarse.hpp"
#include "reduction/feti/dual/preconditioner.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "scene/options.hpp"

namespace delam {

class DualOperator {
public:
    // The subdomains are condensed, and outlive the operator.
    DualOperator(DualRows rows, const std::vector<Subdomain>& subdomains, const Options& options, const Poll& poll);
    // The preconditioner refers to the rows and the scaling here.
    DualOperator(const DualOperator&) = delete;
    DualOperator& operator=(const DualOperator&) = delete;

    // Sets the springs; the result does not depend on earlier calls. Rows whose jump is prescribed count as debonded.
    void set(const Springs& springs);

    const DualRows& rows() const { return rows_; }
    const SparseMatrix& b_transposed() const { return b_transposed_; }
    const Scaling& scaling() const { return scaling_; }
    const CoarseProblem& coarse() const { return *coarse_; }
    // Diagonal of F, [rows]; the mean of the others where the flexibility of a row is not known.
    std::span<const double> flexibility_diagonal() const { return flexibility_diagonal_; }
    // Compliance of the springs that are set, [rows].
    std::span<const double> compliance() const { return compliance_; }
    std::span<const double> weight() const { return weight_; }  // 1 / (F_ii + C_ii), 0 for rows without force
    bool active(std::size_t row) const { return active_[row] != 0; }

    // F lambda, over all rows
    void flexibility(Team& team, std::span<const double> lambda, std::span<double> jumps) const;
    // (F + C) lambda, zero for rows without force
    void apply(Team& team, std::span<const double> lambda, std::span<double> jumps) const;
    void precondition(Team& team, std::span<const double> jumps, std::span<double> lambda) const;
    void mask(std::span<double> x) const;
    // The same for several columns [rows][columns] at once, by products of matrices.
    void flexibility(Team& team, const DenseMatrix& lambda, DenseMatrix& jumps) const;
    void apply(Team& team, const DenseMatrix& lambda, DenseMatrix& jumps) const;
    void precondition(Team& team, const DenseMatrix& jumps, DenseMatrix& lambda) const;

private:
    void find_diagonal(const Poll& poll);
    // Returns a stiffness that gives the scale of the preconditioner, also where there is none.
    double unit() const;

    DualRows rows_;
    const std::vector<Subdomain>& subdomains_;
    bool preconditioned_;
    SparseMatrix b_transposed_;
    Scaling scaling_;
    std::unique_ptr<FetiPreconditioner> preconditioner_;
    std::unique_ptr<CoarseProblem> coarse_;
    std::vector<double> flexibility_diagonal_;
    std::vector<double> compliance_, weight_;
    std::vector<std::uint8_t> active_;
};

}  // namespace delam
