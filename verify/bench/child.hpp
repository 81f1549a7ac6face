// SPDX-License-Identifier: BSD-3-Clause
// Measurements that must not see each other (numbers of threads, peaks of memory) run in processes of their own: this
// program started again with another environment, answering in JSON on its standard output.
#pragma once

#include <string>
#include <vector>

#include "stats.hpp"

namespace bench {

// `task` and its arguments as understood by run_child_task(). threads: of BLAS and OpenMP. A child that fails gives
// {"error": ...}.
Json ask_child(const std::vector<std::string>& task, int threads);

// The other end: what main() does when it is called with --child.
Json run_child_task(const std::vector<std::string>& task);

}  // namespace bench
