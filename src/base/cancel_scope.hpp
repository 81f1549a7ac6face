// SPDX-License-Identifier: BSD-3-Clause
// Cancellation of loops over cells, nodes and faces that lie too deep for a Poll to be passed down to each of them. The
// API call that runs on this thread opens a CancelScope; its loops call poll_cancel().
#pragma once

#include <cstdint>

#include "base/monitor.hpp"

namespace delam {

// The loops of this thread poll the monitor while this object exists.
class CancelScope {
public:
    // The requests that may stop the call.
    // solves: the answer of the progress callback, and any cancel request, including one made before the call.
    // builds: the answer of the callback, and a cancel request made during the call.
    // reads: only a cancel request made during the call. A host that has stopped the analysis keeps answering "stop"
    // from its callback, but still wants to read the results obtained so far.
    enum class Call { solves, builds, reads };
    CancelScope(Monitor& monitor, Call call);
    ~CancelScope();
    CancelScope(const CancelScope&) = delete;
    CancelScope& operator=(const CancelScope&) = delete;

    // Throws Error(DELAM_CANCELLED) when the host wants to stop.
    void poll(const char* stage);
    void pass(const char* stage, std::int64_t work) {
        if ((left_ -= work) <= 0) poll(stage);
    }
    void pass_numbers(const char* stage, std::int64_t count) {
        if ((numbers_left_ -= count) > 0) return;
        numbers_left_ = numbers_interval;
        poll(stage);
    }

private:
    static constexpr std::int64_t interval = 256, numbers_interval = 10'000'000;
    Monitor& monitor_;
    Call call_;
    std::int64_t left_ = interval, numbers_left_ = numbers_interval;
};

// The scope of this thread, if any. It lies in the static TLS block: reading it allocates no memory even when the
// library was loaded by dlopen, and so cannot fail.
extern constinit thread_local CancelScope* cancel_scope __attribute__((tls_model("initial-exec")));

// Opened around every API call: a call on another context, made from inside a callback, must not poll the monitor of
// the call that waits for it.
class NoCancelScope {
public:
    NoCancelScope() : outer_(cancel_scope) { cancel_scope = nullptr; }
    ~NoCancelScope() { cancel_scope = outer_; }
    NoCancelScope(const NoCancelScope&) = delete;
    NoCancelScope& operator=(const NoCancelScope&) = delete;

private:
    CancelScope* outer_;
};

// Polls; a loop calls this once for each cell, face or node. May throw Error(DELAM_CANCELLED). work: cost of the item,
// in cells of a light loop (a microsecond or less). Does nothing where no scope is open: in the library's other threads
// and in calls that cannot be cancelled.
inline void poll_cancel(const char* stage, std::int64_t work = 1) {
    if (cancel_scope != nullptr) cancel_scope->pass(stage, work);
}

// The same beside work that waits for memory: polls once ten million numbers have been read, every 10 to 20 ms.
inline void poll_cancel_reading(const char* stage, std::int64_t numbers) {
    if (cancel_scope != nullptr) cancel_scope->pass_numbers(stage, numbers);
}

// Polls at once: to be called between pieces of work each of which takes long.
inline void poll_cancel_now(const char* stage) {
    if (cancel_scope != nullptr) cancel_scope->poll(stage);
}

}  // namespace delam
