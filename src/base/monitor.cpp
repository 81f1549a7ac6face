// SPDX-License-Identifier: BSD-3-Clause
#include "base/monitor.hpp"

#include <thread>

#include "base/error.hpp"

namespace delam {

void stop(const char* stage) { fail(DELAM_CANCELLED, "cancelled by the host during stage '", stage, "'"); }

void Monitor::progress(const char* stage, std::int64_t done, std::int64_t total) {
    bool wanted = progress_callback != nullptr && progress_callback(stage, done, total, progress_user) != 0;
    // The requests are taken after the callback, which may itself have made one.
    if (take_requests()) wanted = true;
    if (wanted) stop(stage);
}

Poll Monitor::poll_at(const char* stage, std::int64_t done, std::int64_t total) {
    return [this, stage, done, total, host = std::this_thread::get_id()] {
        if (std::this_thread::get_id() == host) return progress(stage, done, total);
        if (take_requests()) stop(stage);
    };
}

}  // namespace delam
