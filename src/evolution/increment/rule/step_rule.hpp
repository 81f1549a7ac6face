// SPDX-License-Identifier: BSD-3-Clause
// One step under one rule for the mode mixity: what all rules have in common.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/numbers.hpp"
#include "evolution/increment/increment.hpp"
#include "evolution/increment/step_account.hpp"
#include "evolution/increment/step_mixities.hpp"

namespace delam {

// Bounds of a minimisation.
struct StepLimits {
    StepLimits(double tolerance_, double stride_ = 1.0, double held_ = 0.0)
        : tolerance(tolerance_), stride(stride_), held(held_) {}
    double tolerance;  // of the tractions (Increment::change), and relative of a toughness
    double stride;     // share of its toughness that a pair may dissipate, where the rule bounds it
    double held;       // relative error of the toughness of a pair up to which its mixity may be held
};

class StepRule : public Increment, public StepMixities, public StepAccount {
public:
    // The same step with a minimisation that starts at other mixities, [pairs].
    virtual std::unique_ptr<StepRule> starting_at(const PairMixities& mixity) const = 0;
    // Is the step followed in parts, each an increment of its own (step/inner_path.hpp)?
    virtual bool in_parts() const { return false; }
    // Has the bound of the part stopped the damage of a pair?
    virtual bool stopped(std::span<const double> /*adhesion*/) const { return false; }

    using Increment::change;
    double change(std::span<const double> from, std::span<const double> to,
                  std::span<const double> jump) const override;
    double change(std::size_t pair, double from, double to, double driving) const override;
    bool damages(std::size_t pair, double adhesion, std::span<const double> local_jump, double nearly) const override;
    PairMinimum minimum(std::size_t pair, std::span<const double> local_jump) const override;
    PairModel model(std::size_t pair, std::span<const double> local_jump, double adhesion,
                    double fraction) const override;
    double left(std::size_t pair, double adhesion) const override;
    double dissipated(std::size_t pair, double adhesion) const override;
    double least(std::size_t /*pair*/) const override { return 0.0; }
    bool quadratic() const override { return true; }
    std::vector<PairDirection> held_directions(const State& /*state*/) const override { return {}; }

    bool observe(std::span<const double> adhesion, std::span<const double> jump) override;
    bool observe(std::size_t pair, const Driving& y) override;
    double blur(const State& state, std::span<const double> damage) override;
    bool settled(const State& /*state*/) override { return true; }
    std::int64_t held() const override { return 0; }
    void record(State& state) const override;
    const Memory& memory() const override { return now_; }
    void restore(const Memory& memory) override;
    void adopt(const PairMixities& /*mixity*/, State& /*start*/) const override {}
    PairMixities shown(std::span<const double> /*jump*/, PairMixities mixity) const override { return mixity; }

    bool follows_iterates() const override { return false; }
    bool bounds_candidates() const override { return true; }
    void record_ledger(State& next, const Dissipation* along = nullptr) const override;

protected:
    // mixity: [pairs]. like: a step of the same laws, from which toughnesses at equal mixities are taken.
    StepRule(const PairLaws& pairs, const State& before, const PairMixities& mixity, StepLimits limits,
             const StepRule* like = nullptr);
    virtual const PairMixities& recorded() const { return now_.used; }
    virtual void begin_observation() {}
    // Records the split of PANM 15 (2010), at the mixities of the state.
    virtual void record_rule(State& next, double energy_change_linear) const = 0;
    std::size_t dimension() const { return index(pairs_.dimension); }
    // The part of the jumps that belongs to a pair.
    std::span<const double> local(std::span<const double> jump, std::size_t pair) const {
        return jump.subspan(pair * dimension(), dimension());
    }

    double bounded(std::size_t pair, double adhesion) const {
        return adhesion < before_.adhesion[pair] ? std::max(adhesion, least(pair)) : adhesion;
    }

    double tolerance() const { return std::max(limits_.tolerance, blur_); }

    StepLimits limits_;
    double blur_ = 0.0;
    double largest_ = 0.0;  // driving energy of the last iterate
    Memory now_;
};

}  // namespace delam
