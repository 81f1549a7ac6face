// SPDX-License-Identifier: BSD-3-Clause
// state.bin, the input of --resume: one line of JSON, the library's bytes, and one line with the seal, the hash of all
// before it. The line of JSON also holds the hashes of the other files from which a run goes on, its history and the
// fields of its steps, so that the seal covers these, too. Two runs of a scene write the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "file/hash.hpp"
#include "file/origin.hpp"

namespace cli {

// Steps that an analysis has chosen so far to write their fields, and what it chooses the next ones by
// (result/fields/instants.hpp).
struct ChosenInstants {
    std::vector<std::int64_t> steps;            // ascending
    std::vector<std::int64_t> kinds, patterns;  // [steps]
    std::vector<double> changes;                // [steps]
    std::vector<double> largest, lowest;        // [patterns]
};

// The files beside the state.
struct Companions {
    Content history;                         // header and rows up to the step of the state
    std::vector<std::string> fields;         // hash of the file of each chosen step up to that of the state
    std::optional<ChosenInstants> instants;  // nothing: the scene alone chooses
};

struct State {
    std::string content_hash;  // of the scene
    std::string problem_hash;
    std::int64_t step = 0;
    std::vector<std::int64_t> not_converged;  // ascending
    Companions companions;
    std::string bytes;
};

struct StateFile {
    State state;
    std::int64_t format = 0;
    std::optional<Origin> origin;  // format 2 kept it here
};

// Formats before this one had no seal over the line of JSON, the history and the fields.
constexpr std::int64_t first_sealed_format = 4;

std::string pack(const State& state);
// Reads formats 2 to 4. Throws Failure(exit_scene) if the file is damaged; one that is no state is not read to its end.
StateFile read_state(const std::string& path);
// True if a regular file begins as a state does, of whatever format.
bool is_state(const std::string& path);

}  // namespace cli
