// SPDX-License-Identifier: BSD-3-Clause
// mixity_rule = variational: the stored energy holds f(B(u), zeta) at the mixity of the displacements themselves, the
// dissipated one Gc at the mixity before the step (law/variational.hpp). The displacement step is no quadratic program
// (curved_displacement.hpp), and the step minimises the split with f stored and Gc dzeta dissipated.
#pragma once

#include "evolution/increment/rule/step_rule.hpp"
#include "law/variational.hpp"

namespace delam {

class VariationalIncrement final : public StepRule {
public:
    VariationalIncrement(const PairLaws& pairs, const State& before, const PairMixities& mixity, StepLimits limits,
                         const StepRule* like = nullptr)
        : StepRule(pairs, before, mixity, limits, like) {}
    std::unique_ptr<StepRule> starting_at(const PairMixities& mixity) const override;

    double energy(std::span<const double> adhesion, std::span<const double> jump) const override;
    std::vector<double> damage_step(std::span<const double> adhesion, std::span<const double> jump) const override;
    bool displace(const DisplacementSolve& solve, State& state) const override;
    bool damages(std::size_t pair, double adhesion, std::span<const double> local_jump, double nearly) const override;
    PairMinimum minimum(std::size_t pair, std::span<const double> local_jump) const override;
    PairModel model(std::size_t pair, std::span<const double> local_jump, double adhesion,
                    double fraction) const override;
    double cost(const PairMixities& mixity, std::span<const double> adhesion) const override;
    double energy_before() const override { return before_.ledger.energy_linear(); }
    bool quadratic() const override { return false; }
    bool bounds_candidates() const override { return false; }
    PairMixities shown(std::span<const double> jump, PairMixities mixity) const override;
    std::vector<PairDirection> directions(const State& state) const override;
    std::vector<PairDirection> held_directions(const State& state) const override;

protected:
    const PairMixities& recorded() const override { return now_.own; }
    void record_rule(State& next, double energy_change_linear) const override;

private:
    std::vector<PairDirection> beside_springs(const State& state, bool held) const;
    VariationalPair pair(std::size_t p) const {
        return {*pairs_.law[p], now_.used[p].shear, now_.toughness[p].total, largest_};
    }
};

}  // namespace delam
