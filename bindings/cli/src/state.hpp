// SPDX-License-Identifier: BSD-3-Clause
// state.bin, the input of --resume: one line of JSON, then the library's bytes. Two runs of a scene write the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "origin.hpp"

namespace cli {

struct State {
    std::string content_hash;  // of the scene
    std::string problem_hash;
    std::int64_t step = 0;
    std::vector<std::int64_t> not_converged;
    std::string bytes;
};

struct StateFile {
    State state;
    std::optional<Origin> origin;  // format 2 kept it here
};

std::string pack(const State& state);
// Reads formats 2 and 3. Throws Failure(exit_scene) if the file is damaged; one that is no state is not read to its
// end.
StateFile read_state(const std::string& path);

}  // namespace cli
