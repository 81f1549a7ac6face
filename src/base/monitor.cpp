// SPDX-License-Identifier: BSD-3-Clause
#include "base/monitor.hpp"

#include <thread>

#include "base/error.hpp"

namespace delam {

void Monitor::progress(const char* stage, std::int64_t done, std::int64_t total) {
    bool stop = progress_callback != nullptr && progress_callback(stage, done, total, progress_user) != 0;
    // After the callback, which may ask for it too.
    if (cancelled_.exchange(false, std::memory_order_relaxed)) stop = true;
    if (stop) fail(DELAM_CANCELLED, "cancelled by the host during stage '", stage, "'");
}

Look Monitor::look_from(const char* stage, std::int64_t done, std::int64_t total) {
    return [this, stage, done, total, host = std::this_thread::get_id()] {
        if (std::this_thread::get_id() == host) return progress(stage, done, total);
        if (cancelled_.exchange(false, std::memory_order_relaxed)) fail(DELAM_CANCELLED, "cancelled by the host during stage '", stage, "'");
    };
}

}  // namespace delam
