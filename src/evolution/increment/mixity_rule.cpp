// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/mixity_rule.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "evolution/increment/converged_increment.hpp"
#include "evolution/increment/frozen_increment.hpp"
#include "evolution/increment/variational_increment.hpp"

namespace delam {

namespace {

constexpr double tolerated_error = 0.1;  // of the toughness, relative

}  // namespace

MixityRule::MixityRule(const PairLaws& pairs, const std::string& word) {
    const bool mixed = std::any_of(pairs.law.begin(), pairs.law.end(),
                                   [](const Law* law) { return law != nullptr && law->depends_on_mixity(); });
    if (!mixed || word == "frozen") return;
    kind_ = word == "converged" ? Kind::converged : Kind::variational;
}

std::unique_ptr<Increment> MixityRule::increment(const PairLaws& pairs, const State& before,
                                                 std::span<const double> mixity, double tolerance) const {
    switch (kind_) {
        case Kind::converged:
            return std::make_unique<ConvergedIncrement>(pairs, before, mixity, tolerance);
        case Kind::variational:
            return std::make_unique<VariationalIncrement>(pairs, before, mixity, tolerance);
        case Kind::frozen:
            break;
    }
    return std::make_unique<FrozenIncrement>(pairs, before, mixity, tolerance);
}

void MixityRule::begin(const PairLaws& pairs, const State& before, State& start) const {
    start.mixity = mixities(pairs, before.response.jump, before.mixity);
    // A broken pair keeps the mixity with which it broke.
    for (std::size_t p = 0; p < start.mixity.size() && kind_ == Kind::converged; ++p)
        if (before.adhesion[p] <= 0.0) start.mixity[p] = before.mixity[p];
    start.mixity_before = kind_ == Kind::variational ? start.mixity : before.mixity;
}

void MixityRule::begin(const PairLaws& pairs, const State& before, const Response& elastic, State& start) const {
    start.mixity = mixities(pairs, elastic.jump, before.mixity);
    start.mixity_before = start.mixity;
}

bool MixityRule::warn_of_mixity_error(const Monitor& monitor, const State& next) const {
    if (kind_ != Kind::frozen || !(next.ledger.mixity_error > tolerated_error)) return false;
    monitor.log(
        1, text("step ", next.step, " at time ", next.time,
                ": the mode mixity changed within the step, so that the toughness at the frozen mixity is in error by ",
                100.0 * next.ledger.mixity_error,
                " %: use smaller steps or mixity_rule = converged (later steps are not reported; value mixity_error)"));
    return true;
}

}  // namespace delam
