// SPDX-License-Identifier: BSD-3-Clause
// The library's own threads. A call starts them and joins them before it returns. The caller's thread works too, so a
// team of one starts no thread. The result must not depend on which thread does which piece.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace delam {

// As many as are of use: the processors that this process may use bound what a host asks for.
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
    // the caller's thread before each of its own pieces (progress, cancel).
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
