// SPDX-License-Identifier: BSD-3-Clause
// Solves the displacement step of the variational rule, whose energy f(B(u), zeta) is no quadratic form of u at frozen
// damage.
//
// Its linear part and a spring that bounds its curvature from above replace it around the last jumps (variational.hpp).
// This leaves an ordinary step with springs w k (zeta + mu) and additional forces. Each solution is a search direction:
// along the segment between two admissible displacements of the operator the bulk energy is exactly quadratic,
//
//   E(s) - E(0) = -s (j_1-j_0).lambda_0 + s^2/2 Q,     Q = (u_1-u_0)^T K (u_1-u_0) = -(j_1-j_0).(lambda_1-lambda_0),
//
// so the energy of every point on it is known without a solve, and no point that increases it is taken. The iteration
// ends when the traction of the law equals that of the bodies.
#pragma once

#include <span>

#include "evolution/increment/rule/step_rule.hpp"
#include "law/variational.hpp"

namespace delam {

class CurvedDisplacement {
public:
    // mixity: B of jumps that are rounding, [pairs].
    CurvedDisplacement(const PairLaws& pairs, std::span<const double> adhesion, const PairMixities& mixity)
        : pairs_(pairs), adhesion_(adhesion), mixity_(mixity) {}

    // True if the energy is a quadratic form after all, because no adhesion lies between 0 and 1.
    bool plain() const;
    // closed, response: the start on entry (ignored if the jump is empty or zero), the solution on return. False: a
    // limit was reached.
    bool run(const DisplacementSolve& solve, std::vector<std::uint8_t>& closed, Response& response) const;

private:
    struct Model {
        std::vector<double> stiffness, force;
    };
    Model model(std::span<const double> jump) const;
    // w f(B, zeta) + springs; without the bulk.
    double interface_energy(std::span<const double> jump) const;
    // Largest difference between the forces of the law and those of the solution, over the largest force.
    double mismatch(const std::vector<std::uint8_t>& closed, const Response& response) const;
    VariationalPair pair(std::size_t p, double largest) const {
        return {*pairs_.law[p], mixity_[p].shear, 0.0, largest};
    }

    const PairLaws& pairs_;
    std::span<const double> adhesion_;
    const PairMixities& mixity_;
};

}  // namespace delam
