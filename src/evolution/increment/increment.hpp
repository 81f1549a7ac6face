// SPDX-License-Identifier: BSD-3-Clause
// The minimisation of one load step: over adhesions 0 <= zeta <= zeta_before and admissible displacements u,
//
//   I(zeta, u) = E(t, u, zeta) + D(zeta_before, zeta)
//
// (Zeman, Kruzik, Gruber, PANM 15 (2010), "Incremental minimization"). The toughness depends on the mode mixity B of
// each pair, and the three rules of mixity_rule.hpp differ in whose B a step uses. An increment knows the state before
// the step, the laws of the pairs and the rule. It computes the part of the interfaces: their energy, the damage step,
// the response of one pair, the numbers that a search of candidates needs, and the entries of the step in the ledger.
// It also follows one minimisation: observe() takes the mixities of the iterates and tells whether the toughness in use
// has settled.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"

namespace delam {

// One displacement step with springs and forces of their own on the rows (Springs); whether it converged.
using DisplacementSolve = std::function<bool(std::span<const double> stiffness, std::span<const double> row_force,
                                             std::vector<std::uint8_t>& closed, Response& response)>;

// One pair with its damage minimised out.
struct PairMinimum {
    double adhesion;
    double energy;  // of the interface per unit area, F/L: stored and dissipated
};

// A quadratic model of one pair about a jump: force C j - h, both times the weight of the pair.
struct PairModel {
    std::array<double, 9> tangent{};  // C, row-major [dimension][dimension], F/L
    std::array<double, 3> force{};    // h, F
};

// A force v x that appears as the state moves, where own x = omega . dj (step_tangent.hpp).
struct PairDirection {
    std::size_t pair;
    std::vector<double> force;  // v, [dimension]
    std::vector<double> form;   // omega, [dimension]
    double own;
};

class Increment {
public:
    virtual ~Increment() = default;

    const PairLaws& pairs() const { return pairs_; }
    const State& before() const { return before_; }
    const std::vector<double>& adhesion_before() const { return before_.adhesion; }

    // ---- over all pairs ------------------------------------------------------------------------------------------
    // The interfaces' share of I, up to a constant of the step.
    virtual double energy(std::span<const double> adhesion, std::span<const double> jump) const = 0;
    // argmin of I over the adhesion at these displacements, [pairs]; adhesion: where coupled interfaces start.
    virtual std::vector<double> damage_step(std::span<const double> adhesion, std::span<const double> jump) const = 0;
    // The largest change of a pair (below) between two damages at these displacements.
    virtual double change(std::span<const double> from, std::span<const double> to,
                          std::span<const double> jump) const = 0;
    // argmin of I over the displacements at the adhesion of the state; its closed pairs and response are the start.
    virtual bool displace(const DisplacementSolve& solve, State& state) const = 0;

    // Is the energy at fixed adhesion quadratic in the displacements?
    virtual bool quadratic() const = 0;
    // ---- one pair ------------------------------------------------------------------------------------------------
    // True if the pair damages, or would damage if its driving energy were larger by 1/nearly.
    virtual bool damages(std::size_t pair, double adhesion, std::span<const double> local_jump,
                         double nearly) const = 0;
    virtual PairMinimum minimum(std::size_t pair, std::span<const double> local_jump) const = 0;
    // fraction: of the tangent that the damage adds; 1: Newton's method, 0: the adhesion held (secant).
    virtual PairModel model(std::size_t pair, std::span<const double> local_jump, double adhesion,
                            double fraction) const = 0;
    // The part of its toughness that the pair has not yet dissipated.
    virtual double left(std::size_t pair, double adhesion) const = 0;
    // Energy that the pair has dissipated since the state before, at the toughness in use, per unit area.
    virtual double dissipated(std::size_t pair, double adhesion) const = 0;
    // Change of the pair's traction at a jump as its adhesion goes from one value to another, relative to its peak
    // traction: |to - from| sqrt(Y/Go), or |to - from| below the onset. A softening pair of a stiff interface has
    // adhesions of the order of Go/Gc, which may be 1e-5 or less, and its traction tells them apart.
    virtual double change(std::size_t pair, double from, double to, double driving) const = 0;

    // The least adhesion that the pair may reach.
    virtual double least(std::size_t pair) const = 0;
    // Returns how the pairs that damage at the end of the step respond to their jumps.
    virtual std::vector<PairDirection> directions(const State& state) const = 0;
    // Returns how pairs respond at fixed adhesion, beside their springs.
    virtual std::vector<PairDirection> held_directions(const State& state) const = 0;

protected:
    Increment(const PairLaws& pairs, const State& before) : pairs_(pairs), before_(before) {}

    const PairLaws& pairs_;
    const State& before_;
};

}  // namespace delam
