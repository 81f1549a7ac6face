// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/rule/mixity_rule.hpp"

#include <algorithm>
#include <iterator>

#include "base/error.hpp"
#include "delam/delam.h"
#include "evolution/increment/rule/converged_increment.hpp"
#include "evolution/increment/rule/frozen_increment.hpp"
#include "evolution/increment/rule/variational_increment.hpp"

namespace delam {

namespace {

constexpr double tolerated_error = 0.1;  // of the dissipated energy, relative

template <class Rule>
std::unique_ptr<StepRule> make(const PairLaws& pairs, const State& before, const PairMixities& mixity,
                               StepLimits limits) {
    return std::make_unique<Rule>(pairs, before, mixity, limits);
}

}  // namespace

struct MixityRule::Row {
    const char* word;
    std::unique_ptr<StepRule> (*make)(const PairLaws&, const State&, const PairMixities&, StepLimits);
    bool keeps_broken;     // a broken pair keeps the mixity with which it broke
    bool before_is_start;  // mixity_before is that of the displacements before the step, else of the step before
    const char* cure;      // of an error of its mixities, besides smaller steps; null: no warning
};

// The first stands for all where no law depends on the mixity.
const MixityRule::Row MixityRule::rows[] = {
    {"frozen", make<FrozenIncrement>, false, false, "mixity_rule = converged"},
    {"converged", make<ConvergedIncrement>, true, false, "a smaller path_step"},
    {"variational", make<VariationalIncrement>, false, true, nullptr},
};

MixityRule::MixityRule(const PairLaws& pairs, const std::string& word)
    : row_(std::find_if(std::begin(rows), std::end(rows), [&](const Row& row) { return word == row.word; })) {
    if (row_ == std::end(rows)) fail(DELAM_ERROR_INTERNAL, "mixity_rule = ", word, ": no increment has this rule");
    if (std::none_of(pairs.law.begin(), pairs.law.end(),
                     [](const Law* law) { return law != nullptr && law->depends_on_mixity(); }))
        row_ = rows;
}

bool MixityRule::follows_path() const { return row_->keeps_broken; }

std::unique_ptr<StepRule> MixityRule::increment(const PairLaws& pairs, const State& before, const PairMixities& mixity,
                                                StepLimits limits) const {
    return row_->make(pairs, before, mixity, limits);
}

void MixityRule::begin(const PairLaws& pairs, const State& before, State& start) const {
    start.mixity = mixities(pairs, before.response.jump, before.mixity);
    for (std::size_t p = 0; p < start.mixity.size() && row_->keeps_broken; ++p)
        if (before.adhesion[p] <= 0.0) start.mixity.set(p, before.mixity[p]);
    start.mixity_before = row_->before_is_start ? start.mixity : before.mixity;
}

void MixityRule::begin(const PairLaws& pairs, const State& before, const Response& elastic, State& start) const {
    start.mixity = mixities(pairs, elastic.jump, before.mixity);
    start.mixity_before = start.mixity;
}

bool MixityRule::warn_of_mixity_error(const Monitor& monitor, const State& next) const {
    if (row_->cure == nullptr || !(next.ledger.mixity_error > tolerated_error)) return false;
    monitor.log(1, text("step ", next.step, " at time ", next.time,
                        ": the energy that it dissipates is in error by about ", 100.0 * next.ledger.mixity_error,
                        " %, because the mode mixity changes on the way: use smaller steps or ", row_->cure,
                        " (later steps are not reported; value mixity_error)"));
    return true;
}

}  // namespace delam
