// SPDX-License-Identifier: BSD-3-Clause
#include "watch.hpp"

#include <algorithm>

namespace bench {

Watch::Watch(delam_context* context) : context_(context) { delam_context_set_progress(context_, hear, this); }

Watch::~Watch() { delam_context_set_progress(context_, nullptr, nullptr); }

void Watch::resume() {
    before_ = clock_.seconds();
    stage_ = "begin";
}

std::int32_t Watch::hear(const char* stage, std::int64_t done, std::int64_t, void* self) noexcept {
    auto& watch = *static_cast<Watch*>(self);
    const double now = watch.clock_.seconds();
    double& longest = watch.silence_[watch.stage_];
    longest = std::max(longest, now - watch.before_);
    watch.before_ = now;
    watch.stage_ = stage;
    // The count of a solve's iterations; checks within an iteration have none.
    if (watch.stage_ == "linear solve" && done > 0) {
        if (done == 1) watch.solves_ += 1.0;
        watch.iterations_ += 1.0;
        watch.most_ = std::max(watch.most_, static_cast<double>(done));
    }
    return 0;
}

}  // namespace bench
