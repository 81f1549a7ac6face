// SPDX-License-Identifier: BSD-3-Clause
// Unilateral contact of a whole scene: the active set of active_set.hpp over the jump operator.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "base/numbers.hpp"
#include "evolution/contact/free_parts.hpp"
#include "reduction/operator/jump_operator.hpp"

namespace delam {

struct ContactResult {
    std::int64_t solves = 0;  // active-set steps
    std::int64_t doubts = 0;  // sets of which a solve left open whether they are right
    std::int64_t linear_iterations = 0;
    double linear_residual = 0.0;  // worst of the solves
    bool converged = true;
    bool fallback = false;  // the feasible descent was needed
};

// The places of a state before a load step, which free parts keep.
class PlacesBefore {
public:
    // All must outlive this object; a response without jumps: nothing has moved. displacement: [mesh DOFs]; empty: that
    // of the response.
    PlacesBefore(const JumpOperator& op, std::span<const double> theta, const Response& response,
                 std::vector<double> displacement = {})
        : op_(op), theta_(theta), response_(response), displacement_(std::move(displacement)) {}
    // Displacements [mesh DOFs], recovered when they are first asked for; empty: nothing has moved.
    const std::vector<double>& displacement() {
        if (displacement_.empty() && !response_.jump.empty()) displacement_ = op_.displacement(theta_, response_);
        return displacement_;
    }

private:
    const JumpOperator& op_;
    std::span<const double> theta_;
    const Response& response_;
    std::vector<double> displacement_;
};

struct ContactScene {
    int dimension = 2;
    std::size_t bodies = 0;
    std::vector<std::uint8_t> bonded;  // [pairs] bonded permanently: held in every direction
    std::vector<std::uint8_t> level;   // [pairs] of contact_levels.hpp
    // Pairs below this level are not tested and may pass through each other: less energy than any contact leaves.
    std::uint8_t least_level = 0;
    std::int64_t limit = 200;
    // Also test, in every step, pairs whose normal jump is prescribed: they cannot close, only be pressed.
    bool always = false;
    // [patterns] Motion (L) and force (F) of the eigenstrains at factor 1 if they were restrained. Where the strains
    // are free, jumps and forces are only the rounding of these numbers and say nothing about contact. Empty: no
    // eigenstrains.
    std::vector<double> strain_jump{}, strain_force{};
    // Loose parts of bodies with large rotations lie flat on others but for the rounding of their places, whose size
    // this is, L; 0: there are none.
    double place_size = 0.0;
    // [patterns] The largest displacement or gap that is prescribed at factor 1, L.
    std::vector<double> prescribed_most{};
    // Parts that may float; null: none. It outlives the scene.
    const FreeParts* parts = nullptr;
    // The nodes' stiffness against each row [rows], and the largest of the dead forces and of the forces K u of
    // displacements that the patterns cause at factor 1 [patterns]: forces below force_rounding times these sizes are
    // rounding. Empty: not known.
    std::vector<double> row_stiffness{}, carried_force{};
    // True if the pair is neither bonded nor prescribed in its normal row. prescribed: [rows].
    bool may_close(std::size_t pair, std::span<const std::uint8_t> prescribed) const {
        return bonded[pair] == 0 && prescribed[pair * index(dimension)] == 0;
    }
    double jump_floor(std::span<const double> theta) const { return std::max(place_size, floor(strain_jump, theta)); }
    double prescribed_size(std::span<const double> theta) const { return floor(prescribed_most, theta); }
    double force_floor(std::span<const double> theta) const { return floor(strain_force, theta); }
    // Returns what rounding leaves of forces at these jumps, F. row_of: the row of each jump; empty: all rows.
    double rounding_of_forces(std::span<const double> theta, std::span<const double> jump,
                              std::span<const std::int64_t> row_of = {}) const;

private:
    static double floor(std::span<const double> size, std::span<const double> theta) {
        double sum = 0.0;
        for (std::size_t p = 0; p < size.size(); ++p) sum += size[p] * (theta[p] < 0.0 ? -theta[p] : theta[p]);
        return sum;
    }
};

// Springs::held of a contact set: every row of a bonded pair and the normal row of a closed one. closed: [pairs].
std::vector<std::uint8_t> held_rows(const ContactScene& scene, std::span<const std::uint8_t> closed);
// Returns the pairs, of those that may close, whose faces touch at these jumps [rows], [pairs].
std::vector<std::uint8_t> touching_pairs(const ContactScene& scene, const JumpOperator& op, double scene_size,
                                         std::span<const double> jump);
// True if some part is held by contact alone, or by nothing. stiffness: of the springs, [rows].
bool held_by_contact_alone(const ContactScene& scene, std::span<const double> stiffness);

// stiffness: [rows] of the springs. closed: [pairs], on entry the warm start, on return the contact set. row_force:
// Springs::force. cold: searches the set from coarse levels to fine ones, with all pairs open at first. Throws
// Error(DELAM_LIMIT) if no contact set balances the loads, Error(DELAM_ERROR_PROBLEM) if prescribed displacements press
// faces into each other. before: null: free parts may be anywhere (only energies are asked for).
ContactResult solve_contact(JumpOperator& op, const ContactScene& scene, std::span<const double> stiffness,
                            std::span<const double> theta, std::vector<std::uint8_t>& closed, Response& response,
                            bool cold, std::span<const double> row_force = {}, PlacesBefore* before = nullptr);

// Rigid motions that nothing resists in a response with these springs and this contact set (FreeParts::free); no
// columns: there are none.
DenseMatrix free_motions(const JumpOperator& op, const ContactScene& scene, std::span<const double> stiffness,
                         std::span<const double> theta, std::span<const std::uint8_t> closed, const Response& response);

// Pairs that this response shows on the wrong side of contact, ascending; empty: the contact set is its own, as far as
// rounding lets it be known.
std::vector<std::size_t> pairs_on_the_wrong_side(const JumpOperator& op, const ContactScene& scene,
                                                 std::span<const double> theta, std::span<const std::uint8_t> closed,
                                                 const Response& response);

}  // namespace delam
