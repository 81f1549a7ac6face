// SPDX-License-Identifier: BSD-3-Clause
// The host's ears inside long work: log, progress and cancel. Lives in the context; the core only calls it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "delam/delam.h"

namespace delam {

// Asked for between parts of long work that knows no monitor: leaves by an exception when the host wants to stop.
// Empty: nobody asks.
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
    void cancel() noexcept { requests_.fetch_add(1, std::memory_order_relaxed); }

private:
    friend class Listening;
    // Requests are counted, so that one that waited before a call can be told from one that comes while it runs. The
    // first check that sees some answers them all; one of several threads that see them.
    bool asked_to_stop() {
        const std::uint32_t now = requests_.load(std::memory_order_relaxed);
        std::uint32_t answered = answered_.load(std::memory_order_relaxed);
        return answered != now && answered_.compare_exchange_strong(answered, now, std::memory_order_relaxed);
    }
    std::atomic<std::uint32_t> requests_{0}, answered_{0};
    static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "cancel runs in signal handlers");
};

}  // namespace delam
