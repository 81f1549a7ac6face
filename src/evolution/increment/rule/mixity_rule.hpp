// SPDX-License-Identifier: BSD-3-Clause
// Each rule says which mode mixity decides the toughness of a step (option mixity_rule). Each rule is an implementation
// of Increment:
//
//   frozen       B of the state before, throughout the step                         (frozen_increment.hpp)
//   converged    B that each pair meets on the way, in parts of the step            (converged_increment.hpp)
//   variational  f(B(u), zeta) in the stored energy, Gc of the state before in the dissipated one
//                                                                                   (variational_increment.hpp)
//
// Under every rule the mixities that the iterates show are kept beside those in use; under frozen and variational their
// difference is mixity_error.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "base/monitor.hpp"
#include "evolution/increment/rule/step_rule.hpp"

namespace delam {

class MixityRule {
public:
    // word: of the option; Error(DELAM_ERROR_INTERNAL) where no rule has it. Without a law that depends on the mixity
    // all rules are the same, and the rule is frozen.
    MixityRule(const PairLaws& pairs, const std::string& word);

    // A step from the state `before`, which must outlive it, minimised from these mixities, [pairs].
    std::unique_ptr<StepRule> increment(const PairLaws& pairs, const State& before, const PairMixities& mixity,
                                        StepLimits limits) const;
    // True if what a step dissipates depends on its path.
    bool follows_path() const;
    // Sets mixity and mixity_before of a state with which a step from `before` starts: from the committed
    // displacements, or, where nothing was loaded before, from the elastic ones of the step itself.
    void begin(const PairLaws& pairs, const State& before, State& start) const;
    void begin(const PairLaws& pairs, const State& before, const Response& elastic, State& start) const;

    // Warns the host of a step whose frozen mixities miss the toughness of the mode in which the damage came about;
    // true if it did.
    bool warn_of_mixity_error(const Monitor& monitor, const State& next) const;

private:
    struct Row;
    static const Row rows[];
    const Row* row_;
};

}  // namespace delam
