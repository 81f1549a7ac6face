// SPDX-License-Identifier: BSD-3-Clause
// state.bin, the input of --resume: one line of JSON, then the library's bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct State {
    std::string content_hash;  // of the scene
    std::string problem_hash;
    std::int64_t step = 0;
    std::vector<std::int64_t> not_converged;
    std::string started;
    std::int64_t resumed = 0;  // number of times
    std::string bytes;
};

std::string pack(const State& state);
// Throws Failure(exit_scene) if the file is damaged.
State unpack(const std::string& path, const std::string& file);

}  // namespace cli
