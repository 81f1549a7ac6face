// SPDX-License-Identifier: BSD-3-Clause
// mixity_rule = frozen: the whole step uses the mixities of the state before it. The step minimises the recorded split:
// stored zeta Y, dissipated g(B, zeta) - g(B, zeta_before). At frozen B the displacement step is a quadratic program.
#pragma once

#include "evolution/increment/rule/step_rule.hpp"

namespace delam {

class FrozenIncrement : public StepRule {
public:
    FrozenIncrement(const PairLaws& pairs, const State& before, const PairMixities& mixity, StepLimits limits,
                    const StepRule* like = nullptr)
        : StepRule(pairs, before, mixity, limits, like) {}
    std::unique_ptr<StepRule> starting_at(const PairMixities& mixity) const override;

    double energy(std::span<const double> adhesion, std::span<const double> jump) const override;
    std::vector<double> damage_step(std::span<const double> adhesion, std::span<const double> jump) const override;
    bool displace(const DisplacementSolve& solve, State& state) const override;
    double cost(const PairMixities& mixity, std::span<const double> adhesion) const override;
    double energy_before() const override { return before_.ledger.energy(); }
    std::vector<PairDirection> directions(const State& state) const override;

protected:
    void record_rule(State& next, double energy_change_linear) const override;
    // Adds the change of the mixity of the pair to the form omega of its direction; nothing while B is frozen.
    virtual void add_mixity(PairDirection& /*direction*/, const State& /*state*/) const {}

private:
    // True if the pair damages at the end of the step: its adhesion is the minimiser at its load, strictly inside.
    bool damaging(const State& state, std::size_t pair, bool coupled) const;
};

}  // namespace delam
