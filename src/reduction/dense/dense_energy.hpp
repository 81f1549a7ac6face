// SPDX-License-Identifier: BSD-3-Clause
// A quadratic energy of dense unknowns, and the energy that remains when some of them are minimised out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"

namespace delam {

// A spring weaker than this part of the bodies' stiffness is no hold to factor with: its row stays in the zone, which
// can do without. (Measured by verify/bench/constants.py on 250 random scenes: half and twice decide alike.)
inline constexpr double weakest_hold = 1e-9;

// E(theta, x) = 1/2 x^T S x - theta^T L^T x  (+ a part that depends on theta alone and is not needed here)
struct DenseEnergy {
    DenseMatrix stiffness;  // S, full symmetric
    DenseMatrix load;       // L, [rows][patterns]
    std::int64_t rows() const { return stiffness.rows; }
};

// Some rows e of a parent energy are minimised together with their springs s_e, some rows k stay, the others are held
// at zero:
//   S_kk - S_ke (S_ee + s_e)^-1 S_ek = S_kk - V^T V,    V = L^-1 S_ek,  L L^T = S_ee + s_e
class Condensation {
public:
    // stiffness: [parent rows] springs. Throws Error(DELAM_ERROR_NUMERICAL) if
    // nothing holds the eliminated rows.
    Condensation(const DenseEnergy& parent, std::vector<std::int64_t> kept, std::vector<std::int64_t> eliminated,
                 std::span<const double> stiffness, const Poll& poll = {});
    const DenseEnergy& energy() const { return energy_; }
    const std::vector<std::int64_t>& kept() const { return kept_; }  // in the order of energy()
    // Parent's unknowns from the kept ones.
    void recover(std::span<const double> theta, std::span<const double> kept_values, std::span<double> parent) const;

private:
    std::vector<std::int64_t> kept_;  // in the order of energy_
    std::vector<std::int64_t> eliminated_;
    DenseMatrix factor_;    // L
    DenseMatrix coupling_;  // V
    DenseMatrix load_;      // L^-1 L_e
    DenseEnergy energy_;
};

}  // namespace delam
