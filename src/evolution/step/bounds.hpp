// SPDX-License-Identifier: BSD-3-Clause
// The two-sided energy estimate of a step (Zeman, Kruzik, Gruber, PANM 15 (2010), equation (3)), with a lift that does
// not depend on the mesh.
//
// Taking q = (jump, zeta) and letting u be the energy-minimal extension, E is quadratic in the load parameters theta at
// fixed q:
//   E(theta, q) = 1/2 theta^T A theta + theta^T H j + ...,   A: stiffness of the load patterns with every jump held at
//   zero,
// and its derivative is the conjugate force r = dE/dtheta, which every displacement solve returns. So with d = theta_k
// - theta_{k-1}
//   lower = E(theta_k, q_k) - E(theta_{k-1}, q_k)         = d.r_k     - 1/2 d^T A d
//   upper = E(theta_k, q_{k-1}) - E(theta_{k-1}, q_{k-1}) = d.r_{k-1} + 1/2 d^T A d
// exactly, for any load path. Jumps that constraints prescribe, or bind to others, are not held; their springs
// s_i add s_i J_i J_i^T to A.
//
// Bodies, springs and frictionless contact answer an a-fold load with a-fold displacements (gaps are loads, too). So
// q_{k-1} may also be compared with its jumps scaled by s >= 0, whose energy under theta_k is, with E = theta.r / 2,
//   E(theta_k, s) = s^2 E_{k-1} + s (theta_k - s theta_{k-1}).r_{k-1}
//                   + 1/2 (theta_k - s theta_{k-1})^T A (theta_k - s theta_{k-1})
// and the same holds with k and k-1 exchanged. The least of it narrows both bounds by g^2 / (4 c), with g = d.(r - A
// theta) and c = (theta^T A theta - theta.r) / 2 of the state that is scaled. Where no load pattern changes its share
// of the whole, theta_k - s theta_{k-1} vanishes at the least: then the energies alone give it (reduced_bounds).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/operator/bound_rows.hpp"

namespace delam {

// lower <= increment <= upper of a step.
struct EnergyBounds {
    double lower, upper;
};

// The bounds for q = zeta alone, with E(theta, zeta) minimised over all displacements, so that nothing is held. With
// theta_{k-1} = a theta_k, a > 0,
//   lower = (1 - a^2) E(theta_k, zeta_k),   upper = (1/a^2 - 1) E(theta_{k-1}, zeta_{k-1})
// where E leaves out the gradient energy, which stays. A step that damages nothing has lower = upper = its increment
// under any loads. None: the loads change their shares.
std::optional<EnergyBounds> reduced_bounds(const PairLaws& pairs, const State& before, const State& next);

class Lift {
public:
    Lift() = default;
    // Takes the bonded response to one pattern at factor 1.
    using Take = std::function<void(std::span<const double> theta, const Response& response)>;
    // One bonded solve for each pattern. bonded: [rows] never come apart; bound: equations among jumps. Throws
    // Error(DELAM_ERROR_PROBLEM) where a dead force acts on what nothing holds.
    Lift(JumpOperator& op, std::span<const std::uint8_t> bonded, std::span<const BoundRow> bound, std::size_t patterns,
         const Take& take = {});
    // 1/2 d^T A d with the springs of `stiffness` [rows] on prescribed jumps.
    double half_quadratic(std::span<const double> d, std::span<const double> stiffness) const;
    // E(theta, q) - E of a state, q: its jumps and adhesion. scaled: the jumps times the s >= 0 that makes it least.
    double rise(std::span<const double> theta, const State& state, std::span<const double> stiffness,
                bool scaled) const;

private:
    // a^T A b
    double form(std::span<const double> a, std::span<const double> b, std::span<const double> stiffness) const;

    DenseMatrix a_;
    std::vector<std::size_t> prescribed_;
    std::vector<std::vector<double>> jump_;  // [prescribed][patterns]
};

// Returns the narrowest of these bounds. quadratic: the energy is a quadratic form of loads and displacements, so that
// displacements may be scaled.
EnergyBounds step_bounds(const Lift& lift, const PairLaws& pairs, const State& before, const State& next,
                         bool quadratic);

}  // namespace delam
