// SPDX-License-Identifier: BSD-3-Clause
// The one question that the evolution asks of the mechanics: which jump minimises the energy of bodies and springs at
// given loads?  E(theta, u) = 1/2 u^T K u - f(theta)^T u + 1/2 theta^T W theta + sum_i (1/2 s_i j_i^2 - h_i j_i)  over
// u with B_e u = j, j_i = 0 on held rows, B_d u = c(theta).
//
// Rows of the jump: interface after interface, pair after pair, normal first (Problem::jump_count of them). Nothing
// here knows about damage or contact.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "delam/delam.h"
#include "reduction/operator/zone.hpp"

namespace delam {

class Bulk;

// The present state of the interface rows.
struct Springs {
    std::vector<double> stiffness;  // [rows] s = weight k zeta >= 0, F/L; 0: debonded (no force)
    std::vector<std::uint8_t>
        held;  // [rows] 1: jump held at zero (perfect bond, closed contact); stiffness is then ignored
    std::vector<double>
        force{};  // [rows] h, F: the spring pulls with s j - h; only where s > 0 or the row is held. Empty: none
};

// The support whose equation B_d u = c a response misses most.
struct SupportError {
    std::int64_t constraint = -1;  // -1: none misses
    double error = 0.0;            // |B_d u - c|, L
    double size = 0.0;             // of the displacements of which this is a difference, L
    // Of the displacements: far above what a converged solve leaves (1e-12), far below what anybody would call held. A
    // host that asks for fewer digits of the iterative solve has asked for them at its supports, too.
    static double allowed(double linear_tolerance) { return std::max(1e-6, linear_tolerance); }
    bool violated(double linear_tolerance) const { return !(error <= allowed(linear_tolerance) * size); }
};

struct Response {
    std::vector<double> jump;         // [rows] L
    std::vector<double> force;        // [rows] force of a pair, F, pulling positive
    std::vector<double> conjugate;    // [patterns] q = dE/dtheta
    std::vector<double> multipliers;  // the operator's own unknowns: warm start in, solution out (empty: cold)
    std::vector<double> rigid;        // the operator's rigid-body coefficients of the solution
    double stored_bulk = 0.0;         // 1/2 int (eps - e*) : C : (eps - e*) >= 0 with the eigenstrains e*(theta)
    double load_potential = 0.0;      // -f^T u of the dead forces in f
    double residual = 0.0;            // relative residual of the linear solve (energy norm)
    std::int64_t iterations = 0;      // Krylov iterations of this solve
    SolveError error;                 // that the residual allows
    SupportError support;             // none where the realisation meets the supports by construction
    bool balanced = true;             // false: a floating part carries an unbalanced load; the rest is then not set
    bool converged = true;
};

// Of an iterative solve: enough for a first idea of contact, as the option linear_tolerance says, or all that this
// operator can reach.
enum class Accuracy { rough, usual, tight };

class JumpOperator {
public:
    virtual ~JumpOperator() = default;
    // theta: [patterns].
    virtual void solve(const Springs& springs, std::span<const double> theta, Response& response) = 0;
    // What solves from now on leave of their residual; without a call: usual. True: this operator can tell it from
    // usual.
    virtual bool aim(Accuracy /*accuracy*/) { return false; }
    // Contact may hold or release any of these rows in the solves up to the next call; empty: no more than usual. (A
    // hint: solve() takes all springs as they come.)
    virtual void expect_changes(std::span<const std::size_t> /*rows*/) {}
    // An a-fold load has the a-fold response, to rounding, whatever was solved before.
    virtual bool answers_in_proportion() const { return false; }
    // Reactions: forces of the constraints [constraints], F.
    virtual std::vector<double> reaction(std::span<const double> theta, const Response& response) const = 0;
    // Displacements [mesh DOFs] of a response of this operator.
    virtual std::vector<double> displacement(std::span<const double> theta, const Response& response) const = 0;
    // Has the engine of the host recover them, and keep them. False: there is no engine, and they are here.
    virtual bool recover_in_engine(std::span<const double> /*theta*/, const Response& /*response*/) const {
        return false;
    }
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
    virtual std::vector<double> memory() const { return {}; }
    virtual void recall(std::span<const double> /*memory*/) {}
    // Throws Error(DELAM_ERROR_SNAPSHOT) for numbers that memory() cannot have returned.
    virtual void require_memory(std::span<const double> memory) const {
        if (!memory.empty())
            fail(DELAM_ERROR_SNAPSHOT, "snapshot holds ", memory.size(),
                 " numbers of a zone, but this jump operator saves none");
    }
    // Another operator over the same condensed bodies, with a memory of its own; null: there is no cheap one.
    virtual std::unique_ptr<JumpOperator> twin() const { return nullptr; }
    // A local dense system about the wanted rows [rows], with everything else minimised out at these springs, for
    // minimisers that change springs and contact there. It is valid until the next call of zone(), solve() or recall().
    // Null: none this time, or never (offers_zone() is false). tight: do not use an existing zone that is much larger
    // than necessary, and choose no larger one.
    virtual bool offers_zone() const { return false; }
    // Every zone has all rows, and what it costs does not depend on those that are wanted.
    virtual bool zone_is_whole() const { return false; }
    // The largest change of an adhesion that may be the rounding of the zone, whose minimiser is then not quite that of
    // solve(). 0: they are one.
    virtual double zone_rounding() const { return 0.0; }
    virtual Zone* zone(const Springs& /*springs*/, std::span<const std::uint8_t> /*wanted*/, bool /*tight*/) {
        return nullptr;
    }
    // The response of all bodies to a solution of the last zone(). springs: those of the solution, and outside the zone
    // those of its choice. False: not set; zones are whole, or it would take another solve.
    virtual bool complete(const Springs& /*springs*/, std::span<const double> /*theta*/,
                          const Zone::Solution& /*solution*/, Response& /*response*/) const {
        return false;
    }
    // As zone(), with only the bodies about the wanted rows free, and all else where the response has it: what lowers
    // the energy there lowers that of the whole. Null: that is not much cheaper, or not offered.
    virtual Zone* part(std::span<const double> /*theta*/, const Response& /*response*/,
                       std::span<const std::uint8_t> /*wanted*/) {
        return nullptr;
    }
    // The bodies condensed onto the jumps; null: they are not.
    virtual const Bulk* bulk() const { return nullptr; }
    // Sparse factorisations of the bodies since the operator was made, and how often displacements were recovered.
    virtual std::int64_t factorisations() const { return 0; }
    virtual std::int64_t recoveries() const { return 0; }
    // Description for people: what was built, and its size.
    virtual std::string description() const = 0;
};

}  // namespace delam
