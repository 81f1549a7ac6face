// SPDX-License-Identifier: BSD-3-Clause
// Measurements that must not affect each other (numbers of threads, memory peaks) run in separate processes: this
// program, started again with another environment, writes its result as JSON to standard output.
#pragma once

#include <string>
#include <vector>

#include "stats.hpp"

namespace bench {

// `task` and its arguments are those of run_child_task(). threads: for BLAS and OpenMP; 0: the environment leaves them
// to the libraries. If the child fails, the result is {"error": ...}.
Json ask_child(const std::vector<std::string>& task, int threads);

// The same in two halves, for children that run at the same time.
struct Child {
    int process = -1, answer = -1;
};
Child start_child(const std::vector<std::string>& task, int threads);
Json answer_of(const Child& child);

// The child's side: what main() does when called with --child.
Json run_child_task(const std::vector<std::string>& task);

}  // namespace bench
