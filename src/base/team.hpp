// SPDX-License-Identifier: BSD-3-Clause
// The library's own threads: made where a call needs them, gone when it returns. The caller's thread works too, so that
// a team of one has none of its own. What is done must not depend on who does it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace delam {

class Team {
public:
    // As many as can be had, up to `threads`.
    explicit Team(std::int64_t threads);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    // work(i) for i = 0 .. count-1, each once, in any order; returns when all are done. What the one with the smallest
    // i throws is thrown here, and those not yet begun may be left out then. before: called on the caller's thread
    // before each of its own pieces (progress, cancel).
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

}  // namespace delam
