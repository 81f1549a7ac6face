// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/rule/converged_increment.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "law/adhesion_after.hpp"
#include "law/driving.hpp"

namespace delam {

namespace {

// A mixity that oscillates moves half as far after each oscillation that does not shrink to half, and further again
// where it then only converges slowly. It is held once the fraction has fallen to `least_share`, or after so many
// reversals, so that a step terminates.
constexpr double least_share = 1.0 / 64.0;
constexpr std::int64_t most_turns = 100;
// Tolerance, relative to the share that a part may take: the state that is kept may lie above the bound by what the
// stopping test allows.
constexpr double at_the_bound = 1e-3;

}  // namespace

ConvergedIncrement::ConvergedIncrement(const PairLaws& pairs, const State& before, const PairMixities& mixity,
                                       StepLimits limits, const StepRule* like)
    : FrozenIncrement(pairs, before, mixity, limits, like),
      swing_(mixity.size()),
      mixity_begun_(mixity),
      least_(mixity.size(), -1.0) {}

std::unique_ptr<StepRule> ConvergedIncrement::starting_at(const PairMixities& mixity) const {
    return std::make_unique<ConvergedIncrement>(pairs_, before_, mixity, limits_, this);
}

// The mixity kept by a broken pair is final.
void ConvergedIncrement::begin_observation() {
    for (Swing& s : swing_) s.open = 0.0;
}

bool ConvergedIncrement::observe(std::size_t pair, const Driving& y) {
    if (!pairs_.mixed(pair) || !tells_mixity(*pairs_.law[pair], y, largest_)) return false;
    const Mixity shown = y.mixity();
    now_.own.set(pair, shown);
    if (shown == now_.used[pair]) return false;
    const Toughness from = now_.toughness[pair], to = pairs_.law[pair]->toughness(shown);
    const double onset = from.onset > 0.0 ? to.onset / from.onset - 1.0 : 0.0, total = to.total / from.total - 1.0;
    const double change = std::abs(onset) > std::abs(total) ? onset : total;
    Swing& swing = swing_[pair];
    if (change * swing.last < 0.0 && std::abs(change) > tolerance()) {
        ++swing.turns;
        if (std::abs(change) > 0.5 * std::abs(swing.last)) {
            swing.share *= 0.5;
            if (std::exchange(swing.grown, false)) swing.most = swing.share;
        }
        if (swing.share < least_share || swing.turns > most_turns) swing.share = 0.0;
    } else if (change * swing.last > 0.0) {
        // A mixity that converges slowly moves as far as a secant says, but no more than twice as far as before.
        const double left = 1.0 - change / swing.last;
        const double share = std::min({swing.most, 2.0 * swing.share, left > 0.5 ? swing.share / left : 1.0});
        swing.grown = swing.grown || share > swing.share;
        swing.share = std::max(swing.share, share);
    }
    swing.last = change;
    swing.open = (1.0 - swing.share) * std::abs(change);
    if (swing.share <= 0.0) return false;
    if (swing.share >= 1.0) {
        now_.used.set(pair, shown);
        now_.toughness[pair] = to;
    } else {
        now_.used.set(pair, now_.used[pair] + swing.share * (shown - now_.used[pair]));
        now_.toughness[pair] = pairs_.law[pair]->toughness(now_.used[pair]);
    }
    return now_.toughness[pair].onset != from.onset || now_.toughness[pair].total != from.total;
}

bool ConvergedIncrement::settled(const State& state) {
    if (now_.used == now_.own) return true;
    const Memory before = now_;
    double open = 0.0;
    for (std::size_t p = 0; p < swing_.size(); ++p) {
        if (now_.used[p] == now_.own[p]) continue;
        now_.used.set(p, now_.own[p]);
        now_.toughness[p] = pairs_.law[p]->toughness(now_.own[p]);
        if (swing_[p].share > 0.0) open = std::max(open, swing_[p].open);
    }
    const std::vector<double> next = damage_step(state.adhesion, state.response.jump);
    if (change(state.adhesion, next, state.response.jump) <= tolerance()) {
        begin_observation();
        return true;
    }
    restore(before);
    // The others need not come nearer than those that are held, and no minimisation settles these.
    const bool holds = std::any_of(swing_.begin(), swing_.end(), [](const Swing& s) { return s.share <= 0.0; });
    return apart() > 0 || open <= (holds ? most_open() : tolerance());
}

void ConvergedIncrement::lag() {
    lags_ = true;
    for (Swing& s : swing_) s.share = s.most = 0.0;
}

std::int64_t ConvergedIncrement::apart() const {
    return std::count_if(swing_.begin(), swing_.end(),
                         [&](const Swing& s) { return s.share <= 0.0 && s.open > most_open(); });
}

double ConvergedIncrement::least(std::size_t pair) const {
    double& least = least_[pair];
    if (least < 0.0)
        least = limits_.stride < 1.0 && pairs_.mixed(pair)
                    ? adhesion_after(*pairs_.law[pair], pairs_.toughness(pair, mixity_begun_[pair]),
                                     before_.adhesion[pair], limits_.stride)
                    : 0.0;
    return least;
}

bool ConvergedIncrement::stopped(std::span<const double> adhesion) const {
    for (std::size_t p = 0; p < adhesion.size(); ++p)
        if (adhesion[p] > 0.0 && adhesion[p] < before_.adhesion[p] && least(p) > 0.0 &&
            left(p, adhesion[p]) - left(p, least(p)) <= at_the_bound * limits_.stride)
            return true;
    return false;
}

void ConvergedIncrement::adopt(const PairMixities& mixity, State& start) const {
    for (std::size_t p = 0; p < start.adhesion.size(); ++p)
        if (start.adhesion[p] <= 0.0) start.mixity.set(p, mixity[p]);
}

// The driving energy that a pair needs is D(B, S, zeta), so omega loses dD/dB dB/dj, where B = Y_t/Y gives
// dB/dj_n = -B k_n j_n / Y and dB/dj_t = (1 - B) k_t j_t / Y, and dD/dS dS/dj, where S = Y_2/Y_t gives
// dS/dj_1 = -S k_1 j_1 / Y_t and dS/dj_2 = (1 - S) k_2 j_2 / Y_t.
void ConvergedIncrement::add_mixity(PairDirection& direction, const State& state) const {
    const std::size_t p = direction.pair;
    const Law& law = *pairs_.law[p];
    if (!pairs_.mixed(p)) return;
    const std::span<const double> jump = local(state.response.jump, p);
    const Driving y = driving_energy(law, jump);
    if (!tells_mixity(law, y, largest_driving(pairs_, state.response.jump))) return;
    const auto [b, second] = y.mixity();
    const double zeta = state.adhesion[p];
    const double slope = driving_by_shear(law, {b, second}, zeta);
    for (std::size_t c = 0; c < jump.size(); ++c) {
        direction.form[c] -= slope * (c == 0 ? -b : 1.0 - b) * law.stiffness(c) * jump[c] / y.total();
    }
    const double turning = driving_by_second(law, {b, second}, zeta);
    for (std::size_t c = 1; c < jump.size() && turning != 0.0; ++c)
        direction.form[c] -= turning * (c == 1 ? -second : 1.0 - second) * law.stiffness(c) * jump[c] / y.tangential;
}

}  // namespace delam
