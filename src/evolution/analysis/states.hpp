// SPDX-License-Identifier: BSD-3-Clause
// The states of an analysis: the committed one, the steps that are kept before it and possibly a pending one, with the
// jumps on the way to them. Hosts read one of these states: the present one, unless they have selected an earlier one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evolution/increment/state.hpp"
#include "evolution/step/jump_event.hpp"

namespace delam {

struct PendingStep {
    State state;
    std::vector<State> revised;  // earlier steps that backtracking has replaced, ascending
    std::vector<JumpEvent> jumps;
    std::string searched;  // a text about its search; empty: there was none
    std::vector<StepPart> parts;
};

class States {
public:
    // depth: so many steps before the committed one are kept.
    explicit States(std::int64_t depth) : depth_(depth) {}
    States(const States&) = delete;  // selected_ points into it
    States& operator=(const States&) = delete;

    const State& committed() const { return committed_; }
    // Kept steps before the committed one, oldest first.
    const std::vector<State>& past() const { return past_; }
    // Null: no step is pending.
    const PendingStep* pending() const { return pending_ ? &*pending_ : nullptr; }
    // The present state: the pending one, otherwise the committed one.
    const State& present() const { return pending_ ? pending_->state : committed_; }
    // The state that hosts read: the selected one, otherwise the present one.
    const State& shown() const { return selected_ != nullptr ? *selected_ : present(); }
    bool selected() const { return selected_ != nullptr; }
    // The first step that can be read and returned to.
    std::int64_t first_kept() const { return past_.empty() ? committed_.step : past_.front().step; }
    // Jumps of the analysis up to the committed state.
    const std::vector<JumpEvent>& committed_jumps() const { return jumps_; }
    // Jumps of the analysis up to the present state.
    std::vector<JumpEvent> jumps() const;
    // A text about the search of the present step; empty: no search.
    const std::string& searched() const { return pending_ ? pending_->searched : searched_; }

    // Makes a state the committed one (of the same scene); discards a pending one.
    void restore(State committed, std::vector<State> past, std::vector<JumpEvent> jumps);
    // Sets the derivatives that are followed from the committed state on.
    void set_sensitivity(Sensitivity sensitivity) { committed_.sensitivity = std::move(sensitivity); }
    // Notes in the pending state that later steps are taken whole.
    void take_whole_steps() noexcept;
    void propose(PendingStep pending);
    // Makes the pending state the committed one; changes nothing if memory ends.
    void commit();
    void rollback();
    // Shows an earlier kept step, of the pending chain or the committed one; -1: the present one.
    void select(std::int64_t step);

private:
    std::int64_t depth_;
    State committed_;
    std::string searched_;  // of the step to committed_; empty where that was loaded, since it is not saved
    std::vector<State> past_;
    std::vector<JumpEvent> jumps_;
    std::optional<PendingStep> pending_;
    const State* selected_ = nullptr;
};

}  // namespace delam
