// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/states.hpp"

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

std::vector<JumpEvent> States::jumps() const {
    std::vector<JumpEvent> all = jumps_;
    if (!pending_) return all;
    if (pending_->state.step == committed_.step) return all;  // set, not computed by steps
    const std::int64_t from = pending_->revised.empty() ? pending_->state.step : pending_->revised.front().step;
    std::erase_if(all, [&](const JumpEvent& jump) { return jump.step >= from; });
    all.insert(all.end(), pending_->jumps.begin(), pending_->jumps.end());
    return all;
}

void States::restore(State committed, std::vector<State> past, std::vector<JumpEvent> jumps) {
    committed_ = std::move(committed);
    searched_.clear();
    past_ = std::move(past);
    jumps_ = std::move(jumps);
    rollback();
}

void States::take_whole_steps() noexcept {
    if (pending_) pending_->state.growth.way = 2;
}

void States::propose(PendingStep pending) {
    selected_ = nullptr;
    pending_ = std::move(pending);
}

void States::commit() {
    const bool keeps = depth_ > 0 && pending_->state.step > committed_.step;
    std::vector<JumpEvent> all = jumps();
    if (keeps) past_.reserve(past_.size() + 1);
    // From here on nothing can fail.
    selected_ = nullptr;
    jumps_ = std::move(all);
    for (State& state : pending_->revised) {
        if (state.step == committed_.step)
            committed_ = std::move(state);
        else
            past_[index(state.step - past_.front().step)] = std::move(state);
    }
    if (pending_->state.step == committed_.step) past_.clear();  // a state that was set: no earlier step leads to it
    if (keeps) {
        past_.push_back(std::move(committed_));
        if (past_.size() > index(depth_)) past_.erase(past_.begin());
    }
    committed_ = std::move(pending_->state);
    searched_ = std::move(pending_->searched);
    pending_.reset();
}

void States::rollback() {
    selected_ = nullptr;
    pending_.reset();
}

void States::select(std::int64_t step) {
    const State* found = nullptr;
    if (step != -1) {
        if (step < first_kept() || step > present().step)
            fail(DELAM_ERROR_ARGUMENT, "step ", step, " is not kept; kept are ", first_kept(), " to ", present().step,
                 depth_ > 0 ? "" : " (earlier ones with option backtracking = on)");
        if (pending_) {
            if (step == pending_->state.step) found = &pending_->state;
            for (const State& state : pending_->revised)
                if (state.step == step) found = &state;
        }
        if (found == nullptr) found = step == committed_.step ? &committed_ : &past_[index(step - past_.front().step)];
    }
    selected_ = found;
}

}  // namespace delam
