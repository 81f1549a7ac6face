// SPDX-License-Identifier: BSD-3-Clause
// The mode mixities of one minimisation: which toughness its pairs have, and when that changes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"

namespace delam {

class StepMixities {
public:
    virtual ~StepMixities() = default;

    // An iterate: displacements that were computed with this adhesion. True: a toughness in use has changed.
    virtual bool observe(std::span<const double> adhesion, std::span<const double> jump) = 0;
    // The same for one adhering pair.
    virtual bool observe(std::size_t pair, const Driving& y) = 0;
    // The damage of the iterate that was observed last rests at the mixity in use. Does it rest at its own, too? Then
    // that one is in use from now on.
    virtual bool settled(const State& state) = 0;
    // Pairs whose mixity is held because it does not settle.
    virtual std::int64_t held() const = 0;
    // From now on all mixities stay as they are, and none counts as held.
    virtual void lag() {}
    // True if no mixity that lags differs from that of the last iterate by more than may stay open.
    virtual bool follows() const { return true; }
    // Writes mixity, mixity_error and mixity_held of the minimisation into the state.
    virtual void record(State& state) const = 0;
    // Mixities to come back to; how much they have swung is not forgotten.
    struct Memory {
        PairMixities used, own;
        std::vector<Toughness> toughness;
    };
    virtual const Memory& memory() const = 0;
    virtual void restore(const Memory& memory) = 0;

    // Returns the change of the damage step that the error of the solve in the jumps explains. From now on a change of
    // this size does not count for mixities either.
    virtual double blur(const State& state, std::span<const double> damage) = 0;
    // Mixities of a start from another state: where that state is broken, those with which it broke.
    virtual void adopt(const PairMixities& mixity, State& start) const = 0;
    // Mixities to record for a state whose displacements are given, not minimised with the damage.
    virtual PairMixities shown(std::span<const double> jump, PairMixities mixity) const = 0;
};

}  // namespace delam
