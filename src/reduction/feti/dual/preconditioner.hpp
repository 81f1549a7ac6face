// SPDX-License-Identifier: BSD-3-Clause
// Preconditioners of the dual operator F + C.
//
//   none       I
//   lumped     B_D K_bb B_D^T
//   dirichlet  S~ = B_D S B_D^T, optimal for perfect bonds (C = 0), worse than none on a compliant interface
//   series     (S~^-1 + C)^-1 = S~ - S~ E T^-1 E^T S~,  T = E^T S~ E + C^-1,  E: the jump rows that are not held.
//              If c1 S~^-1 <= F <= c2 S~^-1 then the same constants (and 1) bound F + C, whatever C >= 0 is: flat in k
//              and zeta. C^-1 = s (weight k zeta) makes the debonded limit s = 0 harmless; held rows (C = 0) leave E.
// T is sparse: dense blocks where two jump rows meet the same subdomain. Only its diagonal changes as the damage grows.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/team.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "reduction/feti/dual/scaling.hpp"
#include "reduction/operator/jump_operator.hpp"

namespace delam {

class FetiPreconditioner {
public:
    FetiPreconditioner(const DualRows& rows, const std::vector<Subdomain>& subdomains, const Scaling& scaling,
                       const std::string& kind, const Poll& poll = {});
    void update(const Springs& springs);
    // z = M r; both over all rows; entries of rows without force are ignored in r and not meaningful in z.
    void apply(Team& team, std::span<const double> r, std::span<double> z) const;
    // The same for several columns at once.
    void apply(Team& team, const DenseMatrix& r, DenseMatrix& z) const;

private:
    enum class Kind { none, lumped, dirichlet, series };
    void apply_scaled(Team& team, std::span<const double> r, std::span<double> z) const;
    void apply_scaled(Team& team, const DenseMatrix& r, DenseMatrix& z) const;
    void add_dependencies(std::span<const double> r, std::span<double> z) const;
    void build_pattern(const Poll& poll);
    void factorise(const Springs& springs);

    const DualRows& rows_;
    const std::vector<Subdomain>& subdomains_;
    const Scaling& scaling_;
    SparseMatrix scaled_transposed_;    // B_D^T
    std::vector<SparseMatrix> lumped_;  // K_bb per subdomain
    Kind kind_;
    std::vector<double> dependency_weight_;
    SparseMatrix base_;  // E^T B_D S B_D^T E over all jump rows
    SparseMatrix t_;
    std::unique_ptr<SparseCholesky> t_factor_;
    std::vector<std::uint8_t> in_e_;
    Springs current_;
};

}  // namespace delam
