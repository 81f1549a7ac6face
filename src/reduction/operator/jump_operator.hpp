// SPDX-License-Identifier: BSD-3-Clause
// The one question that the evolution asks of the mechanics: which jump minimises the energy of bodies and springs at
// given loads?  E(theta, u) = 1/2 u^T K u - f(theta)^T u + 1/2 theta^T W theta + sum_i (1/2 s_i j_i^2 - h_i j_i)  over
// u with B_e u = j, j_i = 0 on held rows, B_d u = c(theta).
//
// Rows of the jump: interface after interface, pair after pair, normal first (Problem::jump_count of them). Nothing
// here knows about damage or contact.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "delam/delam.h"
#include "reduction/operator/linear_reading.hpp"
#include "reduction/operator/renewed.hpp"
#include "reduction/operator/response.hpp"
#include "reduction/operator/zones.hpp"

namespace delam {

class BodySystem;
class TurnedBodies;

struct OperatorTraits {
    // True if an a-fold load has the a-fold response, to rounding, whatever was solved before.
    bool proportional = false;
    // True if it can renew its loads alone.
    bool renewable = false;
};

class JumpOperator {
public:
    virtual ~JumpOperator() = default;
    // theta: [patterns].
    virtual void solve(const Springs& springs, std::span<const double> theta, Response& response) = 0;
    // Sets the accuracy of the following solves; without a call: usual. True: this operator can tell it from usual.
    virtual bool aim(Accuracy /*accuracy*/) { return false; }
    // Contact may hold or release any of these rows in the solves up to the next call; empty: no more than usual. (A
    // hint: solve() takes all springs as they come.)
    virtual void expect_changes(std::span<const std::size_t> /*rows*/) {}
    virtual OperatorTraits traits() const { return {}; }
    // Reactions: forces of the constraints [constraints], F.
    virtual std::vector<double> reaction(std::span<const double> theta, const Response& response) const = 0;
    // Displacements [mesh DOFs] of a response of this operator.
    virtual std::vector<double> displacement(std::span<const double> theta, const Response& response) const = 0;
    // Returns how the sum of displacements with these weights, [mesh DOFs], follows from any response; nothing: they
    // must be recovered.
    virtual std::optional<LinearReading> reading(std::span<const double> /*weights*/) const { return std::nullopt; }
    // Adds rigid motions that nothing active resists to a response. displacement: theirs, [mesh DOFs]; combination: of
    // the columns of RigidMotions(problem).jumps(); jump: theirs, [rows].
    virtual void move(std::span<const double> /*displacement*/, std::span<const double> /*combination*/,
                      std::span<const double> jump, Response& response) const {
        for (std::size_t r = 0; r < jump.size(); ++r) response.jump[r] += jump[r];
    }
    // The stiffness of the softer body's nodes against each row, F/L, with all other displacements at rest, within the
    // bodies too; 0: not known. Forces are differences of jumps and displacements times as much, and have the rounding
    // of these, also where bodies that are free to move resist a jump by less or not at all.
    virtual std::vector<double> row_stiffness() const = 0;
    // The bodies at a response, where their cells turn by any angle; null: rotations are small.
    virtual const TurnedBodies* turned(const Response& /*response*/) const { return nullptr; }
    // The bodies as one sparse system, which lives as long as the operator; null: it has none.
    virtual const BodySystem* system() const { return nullptr; }
    // Largest out-of-balance force, F, at a node for the displacements above, with the response's interface forces and
    // reactions.
    virtual double equilibrium_defect(std::span<const double> theta, const Response& response) const = 0;
    // Estimate of the energy error, F L, due to rounding where the stiffness of the response is a small difference of
    // large ones. 0: none, or one that the solver's own residual shows.
    virtual double rounding_energy(std::span<const double> /*theta*/, const Response& /*response*/) const {
        return 0.0;
    }
    // Rows whose jump is determined by the prescribed displacements alone, [rows].
    virtual std::span<const std::uint8_t> prescribed_rows() const = 0;
    // The part of the history that affects the last digits of the next solve (empty: none); recalling it reproduces
    // these digits.
    virtual std::vector<double> memory() { return {}; }
    virtual void recall(std::span<const double> /*memory*/) {}
    // Throws Error(DELAM_ERROR_SNAPSHOT) for numbers that memory() cannot have returned.
    virtual void require_memory(std::span<const double> memory) const {
        if (!memory.empty())
            fail(DELAM_ERROR_SNAPSHOT, "snapshot holds ", memory.size(),
                 " numbers of a zone, but this jump operator saves none");
    }
    // Another operator over the same condensed bodies, with a memory of its own; null: there is no cheap one.
    virtual std::unique_ptr<JumpOperator> twin() const { return nullptr; }
    // Returns the zones that this operator offers; null: none. They live as long as the operator.
    virtual Zones* zones() { return nullptr; }
    // Takes what has changed in its problem (Problem::renewed), and forgets what earlier solves have left. False: it
    // cannot, and must be made anew.
    virtual bool renew(Renewed /*what*/) { return false; }
    // Returns how many sparse factorisations of the bodies there were since the operator was made.
    virtual std::int64_t factorisations() const { return 0; }
    // Description for people: what was built, and its size.
    virtual std::string description() const = 0;
};

}  // namespace delam
