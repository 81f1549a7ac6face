// SPDX-License-Identifier: BSD-3-Clause
// A quadratic energy of dense unknowns, and the energy that remains when some of them are minimised out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/dense.hpp"

namespace delam {

// E(theta, x) = 1/2 x^T S x - theta^T L^T x  (+ a part that depends on theta alone and is not needed here)
struct DenseEnergy {
    DenseMatrix stiffness;  // S, full symmetric
    DenseMatrix load;       // L, [rows][patterns]
    std::int64_t rows() const { return stiffness.rows; }
};

// Some rows e of a parent energy are minimised together with their springs s_e, some rows k stay, the others are held
// at zero:
//   S_kk - S_ke (S_ee + s_e)^-1 S_ek = S_kk - V^T V,    V = L^-1 S_ek,  L L^T = S_ee + s_e
// An unknown that was minimised out can be taken back without another factorisation: with x_R* = W x_k + w theta its
// minimiser and D = (S_ee + s_e)^-1 restricted to R,
//   E(x_k, x_R) = E(x_k) + 1/2 (x_R - x_R*)^T D^-1 (x_R - x_R*) - 1/2 s_R x_R^2,
// a low-rank update; one that was held is admitted by its column of V.
class Condensation {
public:
    Condensation() = default;
    // eliminated: in the order of elimination. stiffness: [parent rows] springs. Throws Error(DELAM_ERROR_NUMERICAL) if
    // nothing holds the eliminated rows.
    Condensation(const DenseEnergy& parent, std::vector<std::int64_t> kept, std::vector<std::int64_t> eliminated,
                 std::span<const double> stiffness, const Poll& poll = {});
    // Returns parent rows to the kept ones; `parent` and `stiffness` must be the original arguments.
    void release(const DenseEnergy& parent, std::span<const std::int64_t> rows, std::span<const double> stiffness,
                 const Poll& poll = {});
    // Multiplications needed to release these parent rows. Those eliminated last are the cheapest.
    double release_cost(std::span<const std::int64_t> rows) const;
    // Multiplications needed to minimise out so many and keep so many.
    static double cost(std::size_t eliminated, std::size_t kept);

    const DenseEnergy& energy() const { return energy_; }
    const std::vector<std::int64_t>& kept() const { return kept_; }  // in the order of energy()
    // Parent's unknowns from the kept ones.
    void recover(std::span<const double> theta, std::span<const double> kept_values, std::span<double> parent) const;

private:
    void admit(const DenseEnergy& parent, std::span<const std::int64_t> rows, const Poll& poll);
    void take_back(std::span<const std::int64_t> places, std::span<const double> stiffness, const Poll& poll);

    std::vector<std::int64_t> kept_;  // in the order of energy_
    std::vector<std::int64_t> eliminated_;
    std::vector<std::int64_t> original_;  // places in kept_ of those that were never minimised out: columns of V
    std::vector<std::int64_t> released_;  // places in kept_ of those that were: columns of Z
    DenseMatrix factor_;                  // L
    DenseMatrix coupling_;                // V
    DenseMatrix load_;                    // L^-1 L_e
    DenseEnergy energy_;
    DenseMatrix unit_;        // Z = L^-1 E_R, D = Z^T Z = C C^T
    DenseMatrix root_;        // C
    DenseMatrix inverse_;     // C^-1
    DenseMatrix image_;       // P = C^-1 W = - C^-1 Z^T V
    DenseMatrix image_load_;  // p = C^-1 Z^T L^-1 L_e
};

}  // namespace delam
