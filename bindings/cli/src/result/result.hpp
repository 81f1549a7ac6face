// SPDX-License-Identifier: BSD-3-Clause
// result.json: the origin of a result and its progress.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "file/hash.hpp"
#include "model/library/model.hpp"
#include "result/closing/closing.hpp"

namespace cli {

struct Outcome {
    bool complete = false;
    std::string reason;  // why it is incomplete
    std::int64_t steps_done = 0;
    std::vector<std::int64_t> not_converged;
    Closing closing;
    std::vector<std::string> warnings;  // of the scene, before the first step
    std::vector<std::string> closing_lines;
    bool has_jumps = false;  // there is a jumps.csv
    std::int64_t resumed = 0;
    std::string started;
    std::string command;
    std::string problem_hash;
    std::vector<NamedContent> files;  // of the result, besides result.json
};

// UTC, e.g. 2026-01-31T12:00:00Z.
std::string now_text();
std::string hash_of(const Model& model);
std::string result_text(const Model& model, delam_solver* solver, const Scene& scene, const Outcome& outcome);

}  // namespace cli
