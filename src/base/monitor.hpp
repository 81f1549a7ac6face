// SPDX-License-Identifier: BSD-3-Clause
// The host's ears inside long work: log, progress and cancel. Lives in the context; the core only calls it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "delam/delam.h"

namespace delam {

// Asked for between parts of long work that knows no monitor: leaves by an exception when the host wants to stop. Empty: nobody asks.
using Look = std::function<void()>;
inline void ask(const Look& look) {
    if (look) look();
}

class Monitor {
public:
    delam_log_callback log_callback = nullptr;
    void* log_user = nullptr;
    delam_progress_callback progress_callback = nullptr;
    void* progress_user = nullptr;

    void log(std::int32_t level, const std::string& line) const {
        if (log_callback != nullptr) log_callback(level, line.c_str(), log_user);
    }
    // To be called at least once per linear solve. Throws Error(DELAM_CANCELLED) when the host wants to stop.
    void progress(const char* stage, std::int64_t done, std::int64_t total);
    // The same where other threads of the library may come by: the callback is for the host's thread alone.
    Look look_from(const char* stage, std::int64_t done, std::int64_t total);
    void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }

private:
    std::atomic<bool> cancelled_{false};
};

}  // namespace delam
