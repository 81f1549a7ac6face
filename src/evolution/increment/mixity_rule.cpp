// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/mixity_rule.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.hpp"
#include "law/mixity.hpp"

namespace delam {

namespace {

// A mixity that swings to and fro goes half as far with each swing that does not shrink to half, and rests once it is
// down to `least` of the way, or after so many turns: a step ends.
constexpr double least = 1.0 / 64.0;
constexpr std::int64_t most_turns = 100;

constexpr double snapped = 0.1;  // part of the toughness

}  // namespace

MixityRule mixity_rule(const PairLaws& pairs, const std::string& word) {
    if (word == "frozen") return MixityRule::frozen;
    const Law* last = nullptr;
    for (const Law* law : pairs.law) {
        if (law == nullptr || law == last) continue;
        if (law->depends_on_mixity()) return word == "converged" ? MixityRule::converged : MixityRule::variational;
        last = law;
    }
    return MixityRule::frozen;
}

std::vector<double> starting_mixity(const PairLaws& pairs, MixityRule rule, const State& committed) {
    std::vector<double> b = mixities(pairs, committed.response.jump, committed.mixity);
    for (std::size_t p = 0; p < b.size() && rule == MixityRule::converged; ++p)
        if (committed.adhesion[p] <= 0.0) b[p] = committed.mixity[p];
    return b;
}

void warn_of_snap(const Monitor& monitor, MixityRule rule, const State& next) {
    if (rule != MixityRule::frozen || !(next.ledger.mixity_error > snapped)) return;
    monitor.log(1,
                text("step ", next.step, " at time ", next.time,
                     ": the mode mixity changed so much within the step that the frozen one misses the toughness by ",
                     100.0 * next.ledger.mixity_error, " %; smaller steps or mixity_rule = converged cure it"));
}

StepMixity::StepMixity(const PairLaws& pairs, MixityRule rule, double tolerance, std::span<const double> start)
    : pairs_(pairs), rule_(rule), tolerance_(tolerance) {
    now_.used.assign(start.begin(), start.end());
    now_.own = now_.used;
    now_.toughness = toughnesses(pairs, start);
    if (rule == MixityRule::converged) swing_.resize(start.size());
}

bool StepMixity::look(std::span<const double> adhesion, std::span<const double> jump) {
    largest_ = largest_driving(pairs_, jump);
    bool changed = false;
    for (Swing& s : swing_) s.open = 0.0;  // what a broken pair has kept is settled
    for (std::size_t p = 0; p < adhesion.size(); ++p)
        if (pairs_.mixed(p) && adhesion[p] > 0.0 && look(p, driving_energy(pairs_, p, jump))) changed = true;
    return changed;
}

bool StepMixity::look(std::size_t pair, const Driving& y) {
    if (!pairs_.mixed(pair) || !tells_mixity(*pairs_.law[pair], y, largest_)) return false;
    const double shown = mode_mixity(y.normal, y.tangential);
    now_.own[pair] = shown;
    if (rule_ != MixityRule::converged || shown == now_.used[pair]) return false;
    const Toughness from = now_.toughness[pair], to = pairs_.law[pair]->toughness(shown);
    const double onset = from.onset > 0.0 ? to.onset / from.onset - 1.0 : 0.0, total = to.total / from.total - 1.0;
    const double asked = std::abs(onset) > std::abs(total) ? onset : total;
    Swing& swing = swing_[pair];
    if (asked * swing.last < 0.0 && std::abs(asked) > tolerance_) {
        ++swing.turns;
        if (std::abs(asked) > 0.5 * std::abs(swing.last)) swing.share *= 0.5;
        if (swing.share < least || swing.turns > most_turns) swing.share = 0.0;
    }
    swing.last = asked;
    swing.open = (1.0 - swing.share) * std::abs(asked);
    if (swing.share <= 0.0) return false;
    if (swing.share >= 1.0) {
        now_.used[pair] = shown;
        now_.toughness[pair] = to;
    } else {
        now_.used[pair] += swing.share * (shown - now_.used[pair]);
        now_.toughness[pair] = pairs_.law[pair]->toughness(now_.used[pair]);
    }
    return now_.toughness[pair].onset != from.onset || now_.toughness[pair].total != from.total;
}

bool StepMixity::settled(const State& state, std::span<const double> adhesion_old) {
    if (rule_ != MixityRule::converged || now_.used == now_.own) return true;
    const Memory before = now_;
    double open = 0.0;
    for (std::size_t p = 0; p < swing_.size(); ++p) {
        if (now_.used[p] == now_.own[p]) continue;
        now_.used[p] = now_.own[p];
        now_.toughness[p] = pairs_.law[p]->toughness(now_.own[p]);
        if (swing_[p].share > 0.0) open = std::max(open, swing_[p].open);
    }
    const std::vector<double> next = damage_step(adhesion_old, state.adhesion, state.response.jump);
    bool rests = true;
    for (std::size_t p = 0; p < next.size(); ++p) rests = rests && std::abs(next[p] - state.adhesion[p]) <= tolerance_;
    if (rests) {
        for (Swing& s : swing_) s.open = 0.0;
        return true;
    }
    restore(before);
    return open <= tolerance_;
}

std::int64_t StepMixity::held() const {
    return std::count_if(swing_.begin(), swing_.end(),
                         [&](const Swing& s) { return s.share <= 0.0 && s.open > tolerance_; });
}

std::vector<double> StepMixity::damage_step(std::span<const double> adhesion_old, std::span<const double> adhesion,
                                            std::span<const double> jump) const {
    if (rule_ != MixityRule::variational)
        return delam::damage_step(pairs_, now_.toughness, adhesion_old, adhesion, jump);
    const auto dim = static_cast<std::size_t>(pairs_.dimension);
    std::vector<Toughness> toughness = now_.toughness;
    std::vector<double> driving(adhesion.size(), 0.0);
    for (std::size_t p = 0; p < driving.size(); ++p) {
        if (pairs_.mixed(p))
            std::tie(toughness[p], driving[p]) = variational(p).damaging(jump.subspan(p * dim, dim));
        else if (pairs_.law[p] != nullptr)
            driving[p] = driving_energy(pairs_, p, jump).total();
    }
    return damage_at(pairs_, toughness, driving, adhesion_old, adhesion);
}

double StepMixity::energy(std::span<const double> adhesion_old, std::span<const double> adhesion,
                          std::span<const double> jump) const {
    if (rule_ != MixityRule::variational)
        return stored_energy(pairs_, adhesion, jump) + dissipation(pairs_, now_.used, adhesion_old, adhesion);
    const std::vector<double> shown = mixities(pairs_, jump, now_.used);
    return stored_energy(pairs_, adhesion, jump) + stored_slides(pairs_, shown, adhesion) +
           dissipation_slides(pairs_, now_.used, adhesion_old, adhesion);
}

double StepMixity::error(std::span<const double> adhesion_old, std::span<const double> adhesion) const {
    double missed = 0.0, spent = 0.0;
    for (std::size_t p = 0; p < adhesion.size(); ++p) {
        if (pairs_.law[p] == nullptr || adhesion[p] == adhesion_old[p]) continue;
        const double part = pairs_.weight[p] * std::abs(adhesion_old[p] - adhesion[p]), total = now_.toughness[p].total;
        spent += part * total;
        if (pairs_.mixed(p)) missed += part * std::abs(pairs_.law[p]->toughness(now_.own[p]).total - total);
    }
    return spent > 0.0 ? missed / spent : 0.0;
}

void StepMixity::restore(const Memory& memory) {
    std::copy(memory.used.begin(), memory.used.end(), now_.used.begin());
    std::copy(memory.own.begin(), memory.own.end(), now_.own.begin());
    std::copy(memory.toughness.begin(), memory.toughness.end(), now_.toughness.begin());
}

}  // namespace delam
