// SPDX-License-Identifier: BSD-3-Clause
// The contact rows that do not hold a part: open ones, and closed ones without a force.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolution/contact/active_set.hpp"
#include "evolution/contact/least_motion.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

// Returns the rows that hold, [rows of the system]: what is held, and what has a spring.
std::vector<std::uint8_t> with_springs(std::vector<std::uint8_t> held, std::span<const double> spring);

class LooseRows {
public:
    // force: of all rows of the system; no force beyond least_force presses.
    LooseRows(const ContactRows& contact, std::span<const std::uint8_t> closed, std::span<const double> force,
              std::uint8_t level, double least_force);

    // Positions in the contact rows.
    std::vector<std::size_t> rows;
    // The part of least_jump by which keep_apart() may leave rows violated: from least_jump on they count as violated,
    // and half of it is left for the rounding of the motion. (Measured by verify/cases/contact/random_scenes.py --hard
    // and --scenes 120: half and twice decide alike.)
    static constexpr double left = 0.5;

    // Rows that hold, [rows of the system]: what is held, but for these rows, and what has a spring.
    std::vector<std::uint8_t> active(std::span<const std::uint8_t> held, std::span<const double> spring) const;
    // The least motion (least_motion.hpp) that keeps these rows apart. jumps: of the motions, [rows of the
    // system][motions]; jump: before it.
    LeastMotion keep_apart(const DenseMatrix& gram, std::span<const double> pull, const DenseMatrix& jumps,
                           std::span<const double> jump, double least_jump) const;
    // The open rows that stop a motion along `pull`, however far it goes, as positions in the contact rows. jump:
    // before.
    std::vector<std::size_t> stopping(const DenseMatrix& gram, std::span<const double> pull, const DenseMatrix& jumps,
                                      std::span<const double> jump) const;
    // Opens the closed rows that this motion has opened; their force becomes zero. Returns the rows that block
    // each other, as positions in the contact rows.
    std::vector<std::size_t> settled(const LeastMotion& motion, std::vector<std::uint8_t>& closed,
                                     std::span<const double> jump, std::span<double> force, double least_jump) const;

private:
    const ContactRows& contact_;
};

}  // namespace delam
