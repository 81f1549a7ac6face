// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"

namespace delam {

namespace {

constexpr double rounding = 1e-9;    // of the energy
constexpr double noticeable = 0.01;  // the same: what a ledger may leave open

}  // namespace

void StepWarnings::judge(const State& before, const State& after, const Options& options, const Monitor& monitor) {
    const Ledger& ledger = after.ledger;
    const double scale = ledger.scale(), eta = options.backtracking_tolerance;
    const double excess = std::max(ledger.lower - ledger.increment, ledger.increment - ledger.upper);
    const double band = ledger.upper - ledger.lower, work = ledger.work - before.ledger.work;
    const std::string where = text("step ", after.step, " at time ", after.time, ": ");
    const char* const once = " (later steps are not reported)";
    if (!told_of_estimate_ && excess > eta * scale) {
        monitor.log(1, text(where, "its energy lies outside its two-sided estimate by ", excess / scale,
                            " of the energy (tolerance ", eta,
                            "): the crack jumps, or the step is too long; shorter steps, backtracking = on and "
                            "solution = energetic tell which",
                            once));
        told_of_estimate_ = true;
    } else if (!told_of_estimate_ && band > std::max(std::abs(work), rounding * scale)) {
        monitor.log(1, text(where, "its two-sided estimate says nothing: its bounds lie ", band,
                            " apart, and the work of the step is ", work, "; take shorter steps", once));
        told_of_estimate_ = true;
    }
    // Each mixity rule closes the ledger in one of the two splits of the interfaces' energy.
    const double open = std::min(std::abs(ledger.defect()), std::abs(ledger.defect_linear()));
    if (!told_of_ledger_ && open > noticeable * scale) {
        monitor.log(1, text(where, "stored, dissipated and released energy differ from the work of the loads by ",
                            open / scale, " of the energy: take shorter steps", once));
        told_of_ledger_ = true;
    }
}

}  // namespace delam
