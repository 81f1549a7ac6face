// SPDX-License-Identifier: BSD-3-Clause
#include "base/monitor.hpp"

#include <thread>

#include "base/error.hpp"
#include "base/glance.hpp"

namespace delam {

namespace {

[[noreturn]] void stop(const char* stage) { fail(DELAM_CANCELLED, "cancelled by the host during stage '", stage, "'"); }

}  // namespace

void Monitor::progress(const char* stage, std::int64_t done, std::int64_t total) {
    bool wanted = progress_callback != nullptr && progress_callback(stage, done, total, progress_user) != 0;
    // After the callback, which may ask for it too.
    if (asked_to_stop()) wanted = true;
    if (wanted) stop(stage);
}

Look Monitor::look_from(const char* stage, std::int64_t done, std::int64_t total) {
    return [this, stage, done, total, host = std::this_thread::get_id()] {
        if (std::this_thread::get_id() == host) return progress(stage, done, total);
        if (asked_to_stop()) stop(stage);
    };
}

constinit thread_local Listening* listening = nullptr;

Listening::Listening(Monitor& monitor, Call call)
    : monitor_(monitor), call_(call), before_(monitor.requests_.load(std::memory_order_relaxed)) {
    listening = this;
}

Listening::~Listening() { listening = nullptr; }

void Listening::look(const char* stage) {
    left_ = interval;
    if (call_ == Call::marches) return monitor_.progress(stage, 0, 0);
    const bool told =
        monitor_.progress_callback != nullptr && monitor_.progress_callback(stage, 0, 0, monitor_.progress_user) != 0;
    const bool asked = monitor_.requests_.load(std::memory_order_relaxed) != before_ && monitor_.asked_to_stop();
    if ((told && call_ == Call::builds) || asked) stop(stage);
}

}  // namespace delam
