// SPDX-License-Identifier: BSD-3-Clause
#include "base/monitor.hpp"

#include <thread>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"

namespace delam {

namespace {

[[noreturn]] void stop(const char* stage) { fail(DELAM_CANCELLED, "cancelled by the host during stage '", stage, "'"); }

}  // namespace

void Monitor::progress(const char* stage, std::int64_t done, std::int64_t total) {
    bool wanted = progress_callback != nullptr && progress_callback(stage, done, total, progress_user) != 0;
    // After the callback, which may itself have made a request.
    if (take_requests()) wanted = true;
    if (wanted) stop(stage);
}

Poll Monitor::poll_at(const char* stage, std::int64_t done, std::int64_t total) {
    return [this, stage, done, total, host = std::this_thread::get_id()] {
        if (std::this_thread::get_id() == host) return progress(stage, done, total);
        if (take_requests()) stop(stage);
    };
}

constinit thread_local CancelScope* cancel_scope = nullptr;

CancelScope::CancelScope(Monitor& monitor, Call call) : monitor_(monitor), call_(call) {
    if (call != Call::solves) monitor.let_wait();
    cancel_scope = this;
}

CancelScope::~CancelScope() {
    cancel_scope = nullptr;
    monitor_.let_none_wait();
}

void CancelScope::poll(const char* stage) {
    left_ = interval;
    if (call_ == Call::solves) return monitor_.progress(stage, 0, 0);
    const bool refused =
        monitor_.progress_callback != nullptr && monitor_.progress_callback(stage, 0, 0, monitor_.progress_user) != 0;
    const bool requested = monitor_.take_requests();
    if ((refused && call_ == Call::builds) || requested) stop(stage);
}

}  // namespace delam
