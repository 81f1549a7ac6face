// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace delam {

namespace {

constexpr double noticeable = 0.01;    // of the energy: what a ledger may leave open
constexpr double of_debonding = 0.02;  // of the energy that debonds all interfaces: from here on an energy counts

}  // namespace

StepWarnings::StepWarnings(const Problem& problem) {
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const InterfaceProperties& properties = problem.interfaces[i];
        if (properties.bonded || !properties.law) continue;
        const std::vector<double>& weight = problem.mesh->interfaces()[i].weight;
        double area = 0.0;
        for (std::size_t p = 0; p < weight.size(); ++p) area += weight[p] * properties.adhesion[p];
        least_ += of_debonding * area * properties.law->toughness(0.0).total;
    }
}

void StepWarnings::judge(const State& after, const Options& options, const Monitor& monitor) {
    const Ledger& ledger = after.ledger;
    const double scale = ledger.scale(), eta = options.backtracking_tolerance;
    const double excess = std::max(ledger.lower - ledger.increment, ledger.increment - ledger.upper);
    const std::string where = text("step ", after.step, " at time ", after.time, ": ");
    const char* const once = " (later steps are not reported)";
    if (!told_of_estimate_ && excess > std::max(eta * scale, least_)) {
        monitor.log(1, text(where, "its energy lies outside its two-sided estimate by ", excess / scale,
                            " of the energy (tolerance ", eta,
                            "): the crack jumps, or the step is too long; shorter steps, backtracking = on and "
                            "solution = energetic tell which",
                            once));
        told_of_estimate_ = true;
    }
    // Each mixity rule closes the ledger in one of the two splits of the interfaces' energy.
    const double open = std::min(std::abs(ledger.defect()), std::abs(ledger.defect_linear()));
    if (!told_of_ledger_ && open > std::max(noticeable * scale, least_)) {
        monitor.log(
            1, text(where, "stored, dissipated and released energy differ from the work of the loads by ", open / scale,
                    " of the energy: take shorter steps, or locate the jump (jump_tolerance)", once));
        told_of_ledger_ = true;
    }
}

}  // namespace delam
