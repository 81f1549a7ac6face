// SPDX-License-Identifier: BSD-3-Clause
#include "base/team.hpp"

#include <sched.h>

#include <algorithm>
#include <csignal>
#include <system_error>
#include <utility>

#include "base/machine/blas_memory.hpp"
#include "base/machine/blas_threads.hpp"

namespace delam {

namespace {

// Both are in the static TLS block, as cancel_scope is: reading them cannot fail.
constinit thread_local TeamScope* team_scope __attribute__((tls_model("initial-exec"))) = nullptr;
constinit thread_local bool at_a_piece __attribute__((tls_model("initial-exec"))) = false;

class Piece {
public:
    Piece() : outer_(std::exchange(at_a_piece, true)) {}
    ~Piece() { at_a_piece = outer_; }
    Piece(const Piece&) = delete;
    Piece& operator=(const Piece&) = delete;

private:
    const BlasThreads blas_;
    bool outer_;
};

}  // namespace

std::int64_t processors() {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
    return std::max<std::int64_t>(1, std::thread::hardware_concurrency());  // more than the set has room for
}

std::int64_t useful_threads(std::int64_t asked) { return asked > 1 ? std::min(asked, processors()) : asked; }

Team::Team(std::int64_t threads) {
    threads = blas_callers(threads);
    // Only the host's threads handle signals.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
        for (std::int64_t i = 1; i < threads; ++i) members_.emplace_back([this] { serve(); });
    } catch (const std::system_error&) {  // A team with fewer threads gives the same result.
    } catch (...) {
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
        {
            const std::lock_guard lock(mutex_);
            leaving_ = true;
        }
        begun_.notify_all();
        for (std::thread& member : members_) member.join();
        throw;
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Team::~Team() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    begun_.notify_all();
    for (std::thread& member : members_) member.join();
}

// Does one piece of the work. False: none was left.
bool Team::step(bool caller) {
    std::int64_t mine = 0;
    {
        const std::lock_guard lock(mutex_);
        if (work_ == nullptr || next_ >= count_) return false;
        mine = next_++;
        ++busy_;
    }
    std::exception_ptr thrown;
    try {
        const Piece piece;
        (*work_)(mine);
    } catch (...) {
        thrown = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    --busy_;
    ++finished_;
    if (thrown && (failed_ < 0 || mine < failed_)) {
        failed_ = mine;
        failure_ = thrown;
        next_ = count_;
    }
    if (busy_ == 0 && next_ >= count_ && !caller) done_.notify_one();
    return true;
}

void Team::serve() {
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            begun_.wait(lock, [this] { return leaving_ || (work_ != nullptr && next_ < count_); });
            if (leaving_) return;
        }
        while (step(false)) {
        }
    }
}

void Team::run(std::int64_t count, const std::function<void(std::int64_t)>& work,
               const std::function<void(std::int64_t)>& before) {
    if (members_.empty()) {
        for (std::int64_t i = 0; i < count; ++i) {
            if (before) before(i);
            const Piece piece;
            work(i);
        }
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        work_ = &work;
        next_ = 0;
        count_ = count;
        finished_ = 0;
        failed_ = -1;
        failure_ = nullptr;
    }
    begun_.notify_all();
    std::exception_ptr stopped;
    try {
        do {
            std::int64_t finished = 0;
            {
                const std::lock_guard lock(mutex_);
                finished = finished_;
            }
            if (before) before(finished);
        } while (step(true));
    } catch (...) {
        stopped = std::current_exception();
        const std::lock_guard lock(mutex_);
        next_ = count_;
    }
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
    work_ = nullptr;
    if (stopped) std::rethrow_exception(stopped);
    if (failure_) {
        const std::exception_ptr failure = failure_;
        failure_ = nullptr;
        std::rethrow_exception(failure);
    }
}

bool in_a_piece() { return at_a_piece; }

TeamScope::TeamScope(std::int64_t threads) : threads_(threads), outer_(team_scope) { team_scope = this; }

TeamScope::~TeamScope() { team_scope = outer_; }

// The scope is closed meanwhile: a callback of the host, in `before`, may call the library for another context.
void share(std::int64_t count, const std::function<void(std::int64_t)>& work,
           const std::function<void(std::int64_t done)>& before) {
    if (count == 1) {
        if (before) before(0);
        return work(0);
    }
    TeamScope* const scope = in_a_piece() ? nullptr : team_scope;
    if (scope == nullptr || scope->threads_ <= 1) return Team(1).run(count, work, before);
    if (!scope->team_) scope->team_.emplace(scope->threads_);
    struct Closed {
        TeamScope* scope = std::exchange(team_scope, nullptr);
        ~Closed() { team_scope = scope; }
    } const closed;
    scope->team_->run(count, work, before);
}

}  // namespace delam
