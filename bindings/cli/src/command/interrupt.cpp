// SPDX-License-Identifier: BSD-3-Clause
#include "command/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace cli {

namespace {
std::atomic<delam_context*> running{nullptr};
volatile std::sig_atomic_t flag = 0;

extern "C" void on_signal(int) {
    flag = 1;
    if (delam_context* context = running.load()) delam_context_cancel(context);
}

void handle(int signal_number, void (*handler)(int), int flags) {
    struct sigaction action = {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    action.sa_flags = flags;
    sigaction(signal_number, &action, nullptr);
}
}  // namespace

Interrupt::Interrupt(delam_context* context) {
    static_assert(std::atomic<delam_context*>::is_always_lock_free);
    running.store(context);
    handle(SIGINT, on_signal, static_cast<int>(SA_RESETHAND));
    handle(SIGTERM, on_signal, static_cast<int>(SA_RESETHAND));
    handle(SIGPIPE, SIG_IGN, 0);
    handle(SIGXFSZ, SIG_IGN, 0);
}

Interrupt::~Interrupt() { running.store(nullptr); }

bool Interrupt::requested() { return flag != 0; }

}  // namespace cli
