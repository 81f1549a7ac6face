// SPDX-License-Identifier: BSD-3-Clause
// What one load step minimises: over adhesions 0 <= zeta <= zeta_before and admissible displacements u,
//
//   I(zeta, u) = E(t, u, zeta) + D(zeta_before, zeta)
//
// (Zeman, Kruzik, Gruber, PANM 15 (2010), "Incremental minimization"). The toughness depends on the mode mixity B of
// each pair, and the three rules of mixity_rule.hpp differ in whose B a step uses. An increment knows the state before
// the step, the laws of the pairs and the rule. It answers for the interfaces: their energy, the damage step, the
// response of one pair, what a search of candidates needs, and what the step books in the ledger. It also follows one
// minimisation: the iterates show it their mixities (observe), and it says whether the toughness in use has settled.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
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

// What bounds a minimisation.
struct StepLimits {
    StepLimits(double tolerance_, double stride_ = 1.0) : tolerance(tolerance_), stride(stride_) {}
    double tolerance;  // of the tractions (Increment::change), and relative of a toughness
    double stride;     // share of its toughness that a pair may dissipate, where the rule bounds it
};

// What a step dissipates, F L.
struct Dissipation {
    double booked = 0.0;
    double linear = 0.0;  // in the split of PANM 15 (2010)
    double error = 0.0;   // estimate for what is booked
};

class Increment {
public:
    virtual ~Increment() = default;
    // The same step with a minimisation that starts at other mixities, [pairs].
    virtual std::unique_ptr<Increment> starting_at(std::span<const double> mixity) const = 0;

    const PairLaws& pairs() const { return pairs_; }
    const State& before() const { return before_; }
    const std::vector<double>& adhesion_before() const { return before_.adhesion; }

    // ---- over all pairs ------------------------------------------------------------------------------------------
    // The interfaces' share of I, up to a constant of the step.
    virtual double energy(std::span<const double> adhesion, std::span<const double> jump) const = 0;
    // argmin of I over the adhesion at these displacements, [pairs]; adhesion: where coupled interfaces start.
    virtual std::vector<double> damage_step(std::span<const double> adhesion, std::span<const double> jump) const = 0;
    // The largest change of a pair (below) between two damages at these displacements.
    double change(std::span<const double> from, std::span<const double> to, std::span<const double> jump) const;
    // The change of the damage step that what the solve has left open of the jumps explains. From now on a change of
    // this size says nothing about mixities either.
    double blur(const State& state, std::span<const double> damage);
    // argmin of I over the displacements at the adhesion of the state; its closed pairs and response are the start.
    virtual bool displace(const DisplacementSolve& solve, State& state) const = 0;

    // ---- one pair ------------------------------------------------------------------------------------------------
    // Does the pair damage, or would it if its driving energy were larger by 1/nearly?
    virtual bool damages(std::size_t pair, double adhesion, std::span<const double> local_jump, double nearly) const;
    virtual PairMinimum minimum(std::size_t pair, std::span<const double> local_jump) const;
    // fraction: of the tangent that the damage adds; 1: Newton's method, 0: the adhesion held (secant).
    virtual PairModel model(std::size_t pair, std::span<const double> local_jump, double adhesion,
                            double fraction) const;
    // The part of its toughness that the pair has not yet dissipated.
    double left(std::size_t pair, double adhesion) const;
    // What the pair has dissipated since the state before, at the toughness in use, per unit area.
    double dissipated(std::size_t pair, double adhesion) const;
    // Change of the pair's traction at a jump as its adhesion goes from one value to another, relative to its peak
    // traction: |to - from| sqrt(Y/Go), or |to - from| below the onset. A softening pair of a stiff interface has
    // adhesions of the order of Go/Gc, which may be 1e-5 or less, and its traction tells them apart.
    double change(std::size_t pair, double from, double to, double driving) const;

    // ---- the mixities of a minimisation --------------------------------------------------------------------------
    // An iterate: displacements that were computed with this adhesion. True: a toughness in use has changed.
    bool observe(std::span<const double> adhesion, std::span<const double> jump);
    // The same for one adhering pair.
    virtual bool observe(std::size_t pair, const Driving& y);
    // The damage of the iterate that was observed last rests at the mixity in use. Does it rest at its own, too? Then
    // that one is in use from now on.
    virtual bool settled(const State& /*state*/) { return true; }
    // Pairs whose mixity is held because it does not settle.
    virtual std::int64_t held() const { return 0; }
    // Writes mixity, mixity_error and mixity_held of the minimisation into the state.
    void record(State& state) const;
    // Mixities to come back to; how much they have swung is not forgotten.
    struct Memory {
        std::vector<double> used, own;
        std::vector<Toughness> toughness;
    };
    const Memory& memory() const { return now_; }
    void restore(const Memory& memory);

    // The least adhesion that the pair may reach.
    virtual double least(std::size_t /*pair*/) const { return 0.0; }
    // Is the energy at fixed adhesion quadratic in the displacements?
    virtual bool quadratic() const { return true; }
    // Is the step followed in parts, each an increment of its own (step/inner_path.hpp)?
    virtual bool in_parts() const { return false; }
    // Has the bound of the part stopped the damage of a pair?
    virtual bool stopped(std::span<const double> /*adhesion*/) const { return false; }

    // ---- candidates of a search (search.hpp) ---------------------------------------------------------------------
    // D, with what else the rule minimises besides bodies and springs, from the state before to this adhesion.
    virtual double cost(std::span<const double> mixity, std::span<const double> adhesion) const = 0;
    // E of the state before, of the split that cost() completes.
    virtual double energy_before() const = 0;
    // Do pairs that break next take the mixity that the candidate's displacements show?
    virtual bool follows_iterates() const { return false; }
    // Are the energies of candidates bounds for the states left out?
    virtual bool bounds_candidates() const { return true; }
    // Mixities of a start from another state: where that state is broken, those with which it broke.
    virtual void adopt(std::span<const double> /*mixity*/, State& /*start*/) const {}
    // Mixities to record for a state whose displacements are given, not minimised with the damage.
    virtual std::vector<double> shown(std::span<const double> /*jump*/, std::vector<double> mixity) const {
        return mixity;
    }

    // ---- the ledger and the tangent ------------------------------------------------------------------------------
    // Energies, dissipated energies and increments of the step into next.ledger. along: what was dissipated on the way;
    // none: at the mixities of the state.
    void book(State& next, const Dissipation* along = nullptr) const;
    // How the pairs that damage at the end of the step respond to their jumps.
    virtual std::vector<PairDirection> directions(const State& state) const = 0;

protected:
    // mixity: [pairs]. like: an increment of the same laws, from which toughnesses at equal mixities are taken.
    Increment(const PairLaws& pairs, const State& before, std::span<const double> mixity, StepLimits limits,
              const Increment* like = nullptr);
    virtual const std::vector<double>& recorded() const { return now_.used; }
    virtual void begin_observation() {}
    // In the split of PANM 15 (2010), at the mixities of the state.
    virtual void book_rule(State& next, double energy_change_linear) const = 0;
    std::size_t dimension() const { return static_cast<std::size_t>(pairs_.dimension); }
    // The part of the jumps that belongs to a pair.
    std::span<const double> local(std::span<const double> jump, std::size_t pair) const {
        return jump.subspan(pair * dimension(), dimension());
    }

    const PairLaws& pairs_;
    const State& before_;
    double bounded(std::size_t pair, double adhesion) const {
        return adhesion < before_.adhesion[pair] ? std::max(adhesion, least(pair)) : adhesion;
    }

    double tolerance() const { return std::max(limits_.tolerance, blur_); }

    StepLimits limits_;
    double blur_ = 0.0;
    double largest_ = 0.0;  // driving energy of the last iterate
    Memory now_;
};

// Energies of a state at its own mixity; the columns that accumulate are not touched.
void book_energies(const PairLaws& pairs, State& state);

}  // namespace delam
