// SPDX-License-Identifier: BSD-3-Clause
// Total FETI as a jump operator: all bodies are cut into floating subdomains; supports, gluing and interfaces act
// through multipliers.
//
//   [ F + C   -G^T ] [lambda]   [ B K^+ f - c ]        u = K^+ (f - B^T lambda) + R alpha
//   [ -G        0  ] [alpha ] = [ -R^T f      ]        F = B K^+ B^T,  G = R^T B^T
//
// C is the compliance 1/s of the springs on jump rows, zero elsewhere; a row with s = 0 carries no force and is left
// out, and its jump follows from u (Zeman, Kruzik, Gruber, PANM 15 (2010), "FETI formulation", "Dual problem", "Active
// set strategy").
#pragma once

#include <memory>

#include "base/monitor.hpp"
#include "base/team.hpp"
#include "reduction/feti/coarse.hpp"
#include "reduction/feti/preconditioner.hpp"
#include "reduction/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// How many subdomains the scene is cut into: what the options ask for, or chosen by size.
std::int64_t feti_subdomains(const Problem& problem);

class Feti final : public JumpOperator {
public:
    Feti(const Problem& problem, Monitor& monitor);
    void solve(const Springs& springs, std::span<const double> theta, Response& response) override;
    std::vector<double> reaction(std::span<const double> theta, const Response& response) const override;
    std::vector<double> displacement(std::span<const double> theta, const Response& response) const override;
    double equilibrium_defect(std::span<const double> theta, const Response& response) const override;
    std::span<const std::uint8_t> prescribed_rows() const override { return scaling_.prescribed; }
    std::int64_t factorisations() const override {
        return static_cast<std::int64_t>(subdomains_.size()) - (subdomains_.back().body < 0 ? 1 : 0);
    }
    std::int64_t recoveries() const override { return recoveries_; }
    std::string description() const override;

private:
    std::vector<std::vector<std::int64_t>> cut();
    void precompute_forces(std::span<const std::vector<std::int64_t>> cells, const Poll& poll);
    void apply_flexibility(Team& team, std::span<const double> lambda, std::span<double> jumps) const;
    std::vector<double> local_displacement(std::size_t subdomain, std::span<const double> theta,
                                           const Response& response) const;

    const Problem problem_;
    Monitor& monitor_;
    std::vector<Subdomain> subdomains_;
    std::vector<std::vector<NodeCopy>> copies_;
    DualRows rows_;
    SparseMatrix b_transposed_;
    Scaling scaling_;
    std::unique_ptr<FetiPreconditioner> preconditioner_;
    std::unique_ptr<CoarseProblem> coarse_;
    std::vector<double> flexibility_diagonal_;  // of F, per row

    mutable std::int64_t recoveries_ = 0;

    // Dead forces, per pattern, on the first copy of their nodes; those of eigenstrains, each on its own subdomain.
    std::vector<double> prescribed_;                       // [constraints][patterns]
    std::vector<std::vector<double>> force_jump_;          // B K^+ f, [rows]
    std::vector<std::vector<double>> force_resultant_;     // R^T f, [coarse]
    DenseMatrix force_work_;                               // f_p^T K^+ f_q
    DenseMatrix strain_energy_;                            // W of 1/2 theta^T W theta, of the eigenstrains alone
    std::vector<std::vector<std::vector<double>>> force_;  // [pattern][subdomain] local vector, empty where none
};

}  // namespace delam
