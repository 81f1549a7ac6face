// SPDX-License-Identifier: BSD-3-Clause
// The scene that stays linear about given places of bodies with large rotations, and the stepper of its load steps.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/step/stepper.hpp"
#include "reduction/turned/turned_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// Returns a state as one of a linearised scene, whose additional pattern has had no factor so far: its loads are never
// in proportion to those before.
State extended(const State& state, std::size_t patterns);

class LinearisedScene {
public:
    // The arguments must outlive it.
    LinearisedScene(const Problem& problem, Monitor& monitor, const TurnedOperator& op)
        : problem_(problem), monitor_(monitor), op_(op) {}

    // Returns the stepper of the scene with the stiffness and frames of a point, and with the forces and jumps of
    // displacements `at` [mesh DOFs] and forces of the rows [rows].
    Stepper& about(const TurnedPoint& point, std::span<const double> at, std::span<const double> row_force);
    // From now on free parts keep these places of the nodes, [mesh DOFs].
    void keep_places(std::vector<double> displacement) { places_ = std::move(displacement); }
    // Returns the stepper of the same stiffness and frames with these forces alone, [mesh DOFs].
    Stepper& under(std::span<const double> force);
    // Lets the steps that `take` takes search for states of lower energy.
    template <class Take>
    auto searching(const Take& take) {
        return with(&Options::solution, std::string("energetic"), take);
    }
    // Lets pairs damage in what `take` derives. Their adhesion is that of the last linear step, whose jumps differ from
    // those of the balance by what this leaves: a change that they would make up to this tolerance is none. (From a
    // hundredth to ten times of of_balance, `verify/cases/features/table.py plane "large rotations" "step tangent"`
    // agrees with differences; with the tolerance of the damage itself, 1e-11 there, it is off by 110 %.)
    template <class Take>
    auto derived(const Take& take) {
        constexpr double of_balance = 100.0;
        const Options& options = problem_.options;
        return with(&Options::damage_tolerance,
                    std::max(options.damage_tolerance, of_balance * options.limits.turned_balance), take);
    }
    // Returns a state from which the next linear step begins. Its memory is that of the operator after an earlier one,
    // for linear steps change the same pairs, and the zone that has them need not be found again; without it where the
    // operator cannot have it.
    State resumed(State from) const;
    // Returns the forces of the stiffness of the scene at displacements, [mesh DOFs].
    std::vector<double> forces(std::span<const double> displacement) const {
        return op_.forces(linear_->scene, displacement);
    }
    // Returns the stepper of the scene as it is; there must be one.
    Stepper& stepper() const { return *linear_->stepper; }
    // True if other loads cost less than another stiffness.
    bool keeps_stiffness() const { return linear_->stepper->op().traits().renewable; }

private:
    struct Linear {
        LinearScene scene;
        bool loose;  // it has parts that nothing holds
        std::unique_ptr<Stepper> stepper;
        TurnedPoint about;                  // its stiffness and frames
        std::vector<double> at, row_force;  // its loads; empty: not set
    };
    // A host may have changed them since the scene was made.
    void take_histories();
    // Calls `take` with another value of an option of the scene.
    template <class Value, class Take>
    auto with(Value Options::*option, Value value, const Take& take) {
        struct Back {
            Value& own;
            Value before;
            ~Back() { own = before; }
        };
        Value& own = linear_->scene.problem.options.*option;
        const Back back{own, std::exchange(own, std::move(value))};
        return take();
    }
    void begin(const TurnedPoint& point, std::span<const double> at, std::size_t rows);
    Stepper& renewed(Renewed what);

    const Problem& problem_;
    Monitor& monitor_;
    const TurnedOperator& op_;
    std::unique_ptr<Linear> linear_;
    std::vector<double> places_;
};

}  // namespace delam
