// SPDX-License-Identifier: BSD-3-Clause
// Whose mixity the toughness of a step has (option mixity_rule).
//
//   frozen       B of the state before, throughout the step: what the slides minimise
//   converged    B of the iterate that is looked at, in the end of the step's own solution. A pair that breaks keeps
//   the B of the iterate in which it
//                broke: the last one whose displacements it still took part in. B has no traction of its own; energies
//                are compared at equal B.
//   variational  f(B(u), zeta) in the stored energy, Gc of the state before in the dissipated one
//   (interface/variational.hpp)
//
// Under every rule the mixities that the iterates show are kept beside those in use; their difference is the step's
// `error`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "law/variational.hpp"

namespace delam {

enum class MixityRule : std::uint8_t { frozen, converged, variational };

// By its word; frozen where no law depends on the mixity, since all are the same then.
MixityRule mixity_rule(const PairLaws& pairs, const std::string& word);
// What a step starts with: B of the committed displacements, [pairs]. converged: pairs that are broken keep theirs.
std::vector<double> starting_mixity(const PairLaws& pairs, MixityRule rule, const State& committed);

// Warns the host when a step with frozen mixities snapped: its toughness misses that of the mode in which the damage
// came about.
void warn_of_snap(const Monitor& monitor, MixityRule rule, const State& next);

class StepMixity {
public:
    // start: [pairs]. tolerance: relative, of a toughness.
    StepMixity(const PairLaws& pairs, MixityRule rule, double tolerance, std::span<const double> start);

    MixityRule rule() const { return rule_; }
    // At the B in use, [pairs]; the storage stays.
    std::span<const Toughness> toughness() const { return now_.toughness; }
    // In use, [pairs].
    const std::vector<double>& used() const { return now_.used; }
    // What the last iterate showed in which a pair adhered, [pairs].
    const std::vector<double>& own() const { return now_.own; }

    // An iterate: displacements that were computed with `adhesion`. True: a toughness in use has changed.
    bool look(std::span<const double> adhesion, std::span<const double> jump);
    // The same for one adhering pair of it.
    bool look(std::size_t pair, const Driving& y);
    // Is the iterate that was looked at last, whose damage rests at the B in use, at rest at the B that it shows too?
    // That B is then the one in use.
    bool settled(const State& state, std::span<const double> adhesion_old);
    // Pairs whose mixity is held because it would not settle.
    std::int64_t held() const;

    // The pair under the variational rule.
    VariationalPair variational(std::size_t pair) const {
        return {*pairs_.law[pair], now_.used[pair], now_.toughness[pair].total, largest_};
    }
    // argmin over 0 <= zeta <= adhesion_old at these displacements, [pairs]; adhesion: where it is now.
    std::vector<double> damage_step(std::span<const double> adhesion_old, std::span<const double> adhesion,
                                    std::span<const double> jump) const;
    // What is minimised of the interfaces, stored and dissipated, at the B in use.
    double energy(std::span<const double> adhesion_old, std::span<const double> adhesion,
                  std::span<const double> jump) const;
    // sum w |dzeta| |Gc(own) - Gc(used)| / sum w |dzeta| Gc(used); 0 when nothing was damaged.
    double error(std::span<const double> adhesion_old, std::span<const double> adhesion) const;
    // B for the records: in use; variational: of the last iterate.
    const std::vector<double>& recorded() const { return rule_ == MixityRule::variational ? now_.own : now_.used; }

    // Mixities to come back to; how much they have swung is not forgotten.
    struct Memory {
        std::vector<double> used, own;
        std::vector<Toughness> toughness;
    };
    const Memory& memory() const { return now_; }
    void restore(const Memory& memory);

private:
    struct Swing {
        double last = 0.0;   // relative change of Gc or Go that was asked for last
        double share = 1.0;  // of the way that is gone
        double open = 0.0;   // what of it is left to go
        std::int64_t turns = 0;
    };

    const PairLaws& pairs_;
    MixityRule rule_;
    double tolerance_;
    double largest_ = 0.0;
    Memory now_;
    std::vector<Swing> swing_;
};

}  // namespace delam
