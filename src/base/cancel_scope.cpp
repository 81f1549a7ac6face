// SPDX-License-Identifier: BSD-3-Clause
#include "base/cancel_scope.hpp"

namespace delam {

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
