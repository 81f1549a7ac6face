// SPDX-License-Identifier: BSD-3-Clause
// The library's own threads. A call starts them and joins them before it returns. The caller's thread works too, so a
// team of one starts no thread. The result must not depend on which thread does which piece. Threads without a piece
// sleep; they do not spin, which would take time from other programs.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace delam {

// Returns the number of threads that are of use: that which the host asks for, at most the processors of this process.
std::int64_t useful_threads(std::int64_t asked);
std::int64_t processors();

class Team {
public:
    // Starts up to `threads` - 1 threads, or as many as the system and the memory of the BLAS allow.
    explicit Team(std::int64_t threads);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    // Runs work(i) for i = 0 .. count-1, each once, in any order, and returns when all are done. If pieces throw, the
    // exception of the smallest i is rethrown here, and pieces that have not begun may be skipped. before: called on
    // the caller's thread before each of its own pieces (progress, cancel). A piece has one thread of the BLAS.
    void run(std::int64_t count, const std::function<void(std::int64_t)>& work,
             const std::function<void(std::int64_t done)>& before = {});

private:
    void serve();
    bool step(bool caller);

    std::vector<std::thread> members_;
    std::mutex mutex_;
    std::condition_variable begun_, done_;
    const std::function<void(std::int64_t)>* work_ = nullptr;
    std::int64_t next_ = 0, count_ = 0, busy_ = 0, finished_ = 0;
    std::int64_t failed_ = -1;
    std::exception_ptr failure_;
    bool leaving_ = false;
};

// True if this thread works on a piece for a team, also a team of one thread: the others are busy with such pieces,
// too.
bool in_a_piece();

// share() of this thread has so many threads while this object exists. They start with the first work that is shared.
class TeamScope {
public:
    explicit TeamScope(std::int64_t threads);
    ~TeamScope();
    TeamScope(const TeamScope&) = delete;
    TeamScope& operator=(const TeamScope&) = delete;

private:
    friend void share(std::int64_t, const std::function<void(std::int64_t)>&, const std::function<void(std::int64_t)>&);
    std::int64_t threads_;
    std::optional<Team> team_;
    TeamScope* outer_;
};

// Does the work as Team::run() does, with the team of the scope that this thread has opened. Without a scope, and
// within a piece, the items follow one another. A single item does not count as a piece: it may share its own work.
void share(std::int64_t count, const std::function<void(std::int64_t)>& work,
           const std::function<void(std::int64_t done)>& before = {});

}  // namespace delam
