// SPDX-License-Identifier: BSD-3-Clause
// Load steps with small strains and large rotations. The bodies and the frames of the interfaces are linearised about
// displacements x_k, and a step of the linear scene that results, with its search for contact, damage and mixity, leads
// to x_k+1 and an adhesion, until the true forces balance:
//
//     E(x) ~ E_k + f_k . (x - x_k) + 1/2 (x - x_k) . K_k (x - x_k),   jumps  j = Q_k (u_b - u_a).
//
// Every such step begins at the adhesion before the load step, so that nothing of an iterate is irreversible; only
// where the iterates do not come to rest (pairs of an unresolved process zone, which break in one and hold in the
// next), later ones begin at the damage of the lowest. Where the true energy rises, half of the way is taken.
//
// What a step of mixed mode dissipates depends on its path: once its forces balance, it is followed along its load in
// the scene linearised there (path_within.hpp), until they balance again.
//
// A balance whose stiffness under its stresses is not positive definite is no minimum: the bodies buckle. The step then
// goes on along the mode that the stresses soften most, to where the true energy has fallen, and comes to its balance
// from there. (M. Crisfield, Non-linear Finite Element Analysis 2, 1997, section 21.10, on branches.)
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/minimise/energy_fall.hpp"
#include "evolution/step/stepper.hpp"
#include "evolution/step/turned/linearised_scene.hpp"
#include "evolution/step/turned/loose_parts.hpp"
#include "evolution/step/turned/lower_states.hpp"
#include "evolution/step/turned/path_within.hpp"
#include "evolution/step/turned/turned_tangents.hpp"
#include "reduction/turned/buckling_mode.hpp"
#include "reduction/turned/turned_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

class TurnedSteps final : public Stepper::OtherSteps {
public:
    // The arguments must outlive it.
    TurnedSteps(const Problem& problem, Monitor& monitor, const TurnedOperator& op, const PairLaws& pairs,
                const ContactScene& contact);

    Stepper::Result initial(double time) const override;
    Stepper::Result step(const State& before, double time, double stride) const override;
    Stepper::Result equilibrate(const State& before, double time, std::span<const double> adhesion) const override;
    std::vector<double> tangent(const State& state) const override;
    std::vector<double> step_tangent(const State& before, const State& state) const override;

private:
    using Stresses = TurnedCell::Stresses;
    // A step in a linear scene from a state of such a scene.
    using Solve = std::function<Stepper::Result(Stepper& stepper, const State& from)>;
    using Known = TurnedTangents::Known;
    // Says where linear steps begin: displacements and forces of rows, the energy that they shall not exceed, with what
    // is dissipated, and the unbalanced force over the load.
    struct Begin {
        std::vector<double> displacement, row_force;
        TurnedMemory memory;
        bool own;  // the stiffness is of this step
        double level, off;
        bool falls = false;  // from a state that is not stable, with faces apart
    };
    Begin begin(const State& before) const;
    Begin begin_at(const EnergyFall& fall, const State& state) const;
    Begin at_rest(const State& balance) const;
    // Returns by how much a linear step from `at` has moved the bodies (Balanced).
    double moved(std::span<const double> at, const State& state) const;
    // definite: out, whether the stiffness of the last linear step has all stresses.
    Stepper::Result iterate(const State& before, Begin from, const Solve& solve, bool& definite) const;
    // Leads a result that is in balance, but not stable, to a stable one. known: in, out; of the result. Returns the
    // work of the reactions on the way, F L.
    double leave_unstable(const State& before, const Solve& solve, Stepper::Result& result, Known& known) const;
    // Follows a step along its load where its result has damaged pairs of different toughness.
    PathWithin follow_load(const State& before, double time, Stepper::Result& result) const;
    // Returns the lowest state of a step that a search finds, from its balance.
    Stepper::Result lowest_state(const State& before, double time, double stride, Stepper::Result best) const;
    BucklingMode mode_of(const State& state, std::span<const std::uint8_t> held) const;
    // The share of a step, from a stable state to one that buckles along this mode, at which the bodies begin to.
    double critical_share(const State& before, const BucklingMode& mode, const State& state) const;
    // about: out, where the scene that has given the result was linearised.
    Stepper::Result solve_about(TurnedPoint& about, const std::vector<double>& at, std::vector<double> row_force,
                                const State& from, const Solve& solve) const;
    [[noreturn]] static void refuse_buckling(double time);
    // Replaces what the linear scene says of a state by what is true at its displacements.
    void make_true(State& state) const;

    const Problem& problem_;
    Monitor& monitor_;
    const TurnedOperator& op_;
    const PairLaws& pairs_;
    PairGraph graph_;
    LooseParts loose_;
    mutable LinearisedScene linear_;
    TurnedTangents tangents_;
    mutable std::optional<Known> known_;  // the last state that a step has led to
};

// Lets a stepper of this problem take its steps so. All must outlive it.
void delegate_to_turned_steps(Stepper& stepper, const Problem& problem, Monitor& monitor);

}  // namespace delam
