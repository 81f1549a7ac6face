// SPDX-License-Identifier: BSD-3-Clause
#include "base/monitor.hpp"

#include "base/error.hpp"

namespace delam {

void Monitor::progress(const char* stage, std::int64_t done, std::int64_t total) {
    bool stop = progress_callback != nullptr && progress_callback(stage, done, total, progress_user) != 0;
    // After the callback, which may ask for it too.
    if (cancelled_.exchange(false, std::memory_order_relaxed)) stop = true;
    if (stop) fail(DELAM_CANCELLED, "cancelled by the host during stage '", stage, "'");
}

}  // namespace delam
