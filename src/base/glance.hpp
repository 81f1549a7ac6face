// SPDX-License-Identifier: BSD-3-Clause
// Looking up from loops over cells, nodes and faces that lie too deep for a Look to be handed down to each: the call
// that runs on this thread says that it can be stopped, its loops glance at it.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"

namespace delam {

// As long as it lives, loops of this thread look up to the monitor.
class Listening {
public:
    // What may stop the call. marches: the callback's answer and every request; one that was there before, too. builds:
    // that answer and a request that comes meanwhile. reads: only such a request: who has stopped a march goes on
    // saying so, and wants to read what there is.
    enum class Call { marches, builds, reads };
    Listening(Monitor& monitor, Call call);
    ~Listening();
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

    // Error(DELAM_CANCELLED) when the host wants to stop.
    void look(const char* stage);
    void pass(const char* stage, std::int64_t work) {
        if ((left_ -= work) <= 0) look(stage);
    }

private:
    static constexpr std::int64_t interval = 256;
    Monitor& monitor_;
    Call call_;
    std::uint32_t before_;
    std::int64_t left_ = interval;
};

// Of the static block of each thread: reading it takes no memory when the library comes by dlopen, and so cannot fail.
extern constinit thread_local Listening* listening __attribute__((tls_model("initial-exec")));

// Around every call: another island's that is called from a callback must not look up to the one that waits for it.
class Silence {
public:
    Silence() : outer_(listening) { listening = nullptr; }
    ~Silence() { listening = outer_; }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    Listening* outer_;
};

// Once for each cell, face or node of a loop, which may be left there by an exception. work: what it costs, in cells'
// worth of a light loop (a microsecond or less). Where nobody listens (other threads of the library, calls that cannot
// be stopped) nothing happens.
inline void glance(const char* stage, std::int64_t work = 1) {
    if (listening != nullptr) listening->pass(stage, work);
}

// Between parts of work that are long by themselves.
inline void look_up(const char* stage) {
    if (listening != nullptr) listening->look(stage);
}

}  // namespace delam
