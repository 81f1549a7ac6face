// SPDX-License-Identifier: BSD-3-Clause
// mixity_rule = converged: the step is followed in parts (step/inner_path.hpp), which bound the share of its toughness
// that a pair may dissipate. Within a part the mixities follow the iterates to a fixed point, the solution of the
// part. A pair that breaks keeps the mixity of the last iterate whose displacements it still took part in. B adds no
// traction of its own; energies are compared at equal B.
#pragma once

#include <algorithm>

#include "evolution/increment/rule/frozen_increment.hpp"

namespace delam {

class ConvergedIncrement final : public FrozenIncrement {
public:
    ConvergedIncrement(const PairLaws& pairs, const State& before, const PairMixities& mixity, StepLimits limits,
                       const StepRule* like = nullptr);
    std::unique_ptr<StepRule> starting_at(const PairMixities& mixity) const override;

    using StepRule::observe;
    bool observe(std::size_t pair, const Driving& y) override;
    bool settled(const State& state) override;
    std::int64_t held() const override { return lags_ ? 0 : apart(); }
    void lag() override;
    bool follows() const override { return apart() == 0; }
    // At the toughness with which the part began, so that the bound stays while the mixities move.
    double least(std::size_t pair) const override;
    bool in_parts() const override { return true; }
    bool stopped(std::span<const double> adhesion) const override;
    bool follows_iterates() const override { return true; }
    void adopt(const PairMixities& mixity, State& start) const override;

protected:
    void begin_observation() override;
    void add_mixity(PairDirection& direction, const State& state) const override;

private:
    // The changes of the mixity of a pair from iterate to iterate.
    struct Swing {
        double last = 0.0;   // relative change of Gc or Go that the last iterate called for
        double share = 1.0;  // part of such a change that is made
        double most = 1.0;   // that this part may become again
        bool grown = false;  // since it was halved last
        double open = 0.0;   // rest of the last change, which was not made
        std::int64_t turns = 0;
    };
    std::int64_t apart() const;
    double most_open() const { return std::max(tolerance(), limits_.held); }

    std::vector<Swing> swing_;
    bool lags_ = false;
    PairMixities mixity_begun_;
    mutable std::vector<double> least_;  // computed when asked for; before that: -1
};

}  // namespace delam
