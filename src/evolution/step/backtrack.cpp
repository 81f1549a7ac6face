// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/backtrack.hpp"

#include <algorithm>
#include <optional>

#include "base/numbers.hpp"

namespace delam {

const State& Chain::at(std::int64_t step) const {
    if (const auto it = revised_.find(step); it != revised_.end()) return it->second;
    return step == last_.step ? last_ : past_[index(step - past_.front().step)];
}

Stepper::Result backtracked_step(Stepper& stepper, Chain& chain, std::int64_t last_step, double time,
                                 const Options& options) {
    const std::int64_t k = last_step + 1;
    Stepper::Result next;
    std::int64_t i = k, returns = 0, revised_from = k;
    bool returning = true, same_before = false;
    Effort effort;                          // of everything computed that is not kept as step k
    std::map<std::int64_t, bool> settled;   // true for a replaced step that converged
    std::optional<Stepper::Start> carried;  // the state whose lower bound has failed
    while (true) {
        std::vector<Stepper::Start> starts;
        if (carried) starts.push_back(*carried);
        if (i < k) starts.emplace_back(chain.at(i), same_before);
        Stepper::Result found = stepper.step(chain.at(i - 1), i < k ? chain.at(i).time : time, starts);
        if (i < k && same_before && !chain.at(i).ledger.undercut_by(found.state.ledger.increment)) {
            // Nothing lower: step i stays, and so do the later steps computed from it.
            returning = false;
            effort.add(found.state.effort);
            if (++i == k) break;
            ++i;
            same_before = false;
            continue;
        }
        const bool violated = stepper.lower_excess(found.state) > options.backtracking_tolerance;
        if (i < k) {
            found.state.history.revisions = chain.at(i).history.revisions + 1;
            revised_from = std::min(revised_from, i);
            effort.add(found.state.effort);
            settled[i] = found.converged;
            chain.revise(found.state);
        } else {
            if (next.state.step == k) effort.add(next.state.effort);  // of an attempt before the return
            next = found;
        }
        if (returning && violated && i - 1 > chain.first() && returns < options.backtracking_limit) {
            ++returns;
            carried = Stepper::Start(found.state, true);
            --i;
            same_before = true;
            continue;
        }
        if (i == k) break;
        ++i;
        same_before = false;
    }
    next.state.effort.add(effort);
    for (const auto& [step, converged] : settled) next.converged = next.converged && converged;
    next.state.history.backtracks = returns;
    next.state.history.revised_from = revised_from;
    return next;
}

bool keeps_past(const Options& options) {
    return options.backtracking == "on" ||
           (options.backtracking == "auto" && options.solution == "energetic" && options.kinematics == "linear");
}

}  // namespace delam
