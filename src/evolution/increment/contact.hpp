// SPDX-License-Identifier: BSD-3-Clause
// Frictionless unilateral contact, u_n >= 0, as an active set over a jump operator.
//
// A closed pair holds u_n = 0 and may only push (force <= 0); an open one follows its spring and may not penetrate (u_n
// >= 0). The primal-dual active set (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13, 2002) moves every pair that
// violates its side at once; warm it needs 3-4 solves. It can cycle: once a set comes back, only the violating pair of
// least index moves (Murty's principal pivoting, which ends for every positive definite problem).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/jump_operator.hpp"

namespace delam {

struct ContactResult {
    std::int64_t solves = 0;  // active-set steps
    std::int64_t linear_iterations = 0;
    double linear_residual = 0.0;  // worst of the solves
    bool converged = true;
    bool fallback = false;  // least-index exchanges were needed
};

struct ContactScene {
    int dimension = 2;
    std::vector<std::uint8_t> bonded;  // [pairs] held in every direction for ever
    std::vector<std::uint8_t> level;   // [pairs] of contact_levels.hpp
    std::uint8_t least_level =
        0;  // pairs below it are not tested and may pass through each other: less energy than any contact leaves
    std::int64_t limit = 200;
    bool always = false;  // in every step, also test pairs whose normal jump the device prescribes: they cannot close,
                          // only be pressed
    // [patterns] What the eigenstrains at factor 1 move (L) and press (F) where they are not free: where they are,
    // jumps and forces are the rounding of these, and no contact is to be read from it. Empty: no eigenstrains.
    std::vector<double> strain_jump{}, strain_force{};
    double jump_floor(std::span<const double> theta) const { return floor(strain_jump, theta); }
    double force_floor(std::span<const double> theta) const { return floor(strain_force, theta); }

private:
    static double floor(std::span<const double> size, std::span<const double> theta) {
        double sum = 0.0;
        for (std::size_t p = 0; p < size.size(); ++p) sum += size[p] * (theta[p] < 0.0 ? -theta[p] : theta[p]);
        return sum;
    }
};

// spring stiffness: [rows]. closed: [pairs], the warm start in, the contact set out. Throws Error(DELAM_LIMIT) when no
// contact set balances the loads, Error(DELAM_ERROR_PROBLEM) when prescribed displacements press faces into each other.
// cold: the set is searched from coarse to fine, with all pairs open at first. row_force: Springs::force.
ContactResult solve_contact(JumpOperator& op, const ContactScene& scene, std::span<const double> stiffness,
                            std::span<const double> theta, std::vector<std::uint8_t>& closed, Response& response,
                            bool cold, std::span<const double> row_force = {});

}  // namespace delam
