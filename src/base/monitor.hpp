// SPDX-License-Identifier: BSD-3-Clause
// The host's log and progress callbacks and its cancel requests. Belongs to the context; the core only calls it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "delam/delam.h"

namespace delam {

// Called between parts of long work that does not know the monitor; throws when the host wants to stop. May be empty.
using Poll = std::function<void()>;
inline void call_if_set(const Poll& poll) {
    if (poll) poll();
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
    // Calls the progress callback; to be called at least once per linear solve. Throws Error(DELAM_CANCELLED) when the
    // host wants to stop.
    void progress(const char* stage, std::int64_t done, std::int64_t total);
    // The same for code that other threads of the library run too: only the host's thread calls the callback.
    Poll poll_at(const char* stage, std::int64_t done, std::int64_t total);
    void cancel() noexcept { requests_.fetch_add(1, std::memory_order_relaxed); }

private:
    friend class CancelScope;
    // Counting the requests distinguishes one made before a call from one made during it. The first check that finds
    // open requests answers them all, in exactly one of the threads that find them. Where the running call lets earlier
    // ones wait (CancelScope), they are answered together with the first that comes during it.
    bool take_requests() {
        const std::uint32_t now = requests_.load(std::memory_order_relaxed);
        if (lets_wait_.load(std::memory_order_relaxed) && now == waiting_.load(std::memory_order_relaxed)) return false;
        std::uint32_t answered = answered_.load(std::memory_order_relaxed);
        return answered != now && answered_.compare_exchange_strong(answered, now, std::memory_order_relaxed);
    }
    void let_wait() {
        waiting_.store(requests_.load(std::memory_order_relaxed), std::memory_order_relaxed);
        lets_wait_.store(true, std::memory_order_relaxed);
    }
    void let_none_wait() { lets_wait_.store(false, std::memory_order_relaxed); }
    std::atomic<std::uint32_t> requests_{0}, answered_{0}, waiting_{0};
    std::atomic<bool> lets_wait_{false};
    static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "cancel runs in signal handlers");
};

// Throws Error(DELAM_CANCELLED) with the stage in its message.
[[noreturn]] void stop(const char* stage);

}  // namespace delam
