// SPDX-License-Identifier: BSD-3-Clause
// Converts a scene file of the command line to a scene of the reference, with its meshes, materials, constraints and
// laws.
#pragma once

#include <string>
#include <vector>

#include "acceptance.hpp"
#include "comparison.hpp"

namespace reference {

struct SceneFile {
    Scene scene;
    std::vector<double> times;  // of the steps; the first is that of the initial state
};

// settings: KEY=VALUE, as for `delam run --set`. Throws Failure with the program's message.
SceneFile read_scene_file(const std::string& path, const std::vector<std::string>& settings);

// One displacement step of a realisation of the jump operator, compared with the direct solution.
struct Answer {
    std::string realisation;  // its name in tables: condensed, iterated, FETI
    Comparison difference;
    Acceptance kkt;
    bool stalled = false;  // the step did not meet its linear tolerance (DELAM_NOT_CONVERGED)
    double linear_iterations = 0.0;
};
// A state of a condensed analysis, solved by each realisation and by the direct solver.
struct Judged {
    double time = 0.0;
    double debonded = 0.0;  // fraction of the pairs
    int closed = 0;         // contacts, in the direct solution
    std::vector<Answer> answers;
};
// steps: which steps are compared; 0 is the initial state. subdomains: of FETI; 0: its own choice. Sets the options
// reduction and subdomains of `file`.
std::vector<Judged> judge(SceneFile& file, const std::vector<std::size_t>& steps, std::int64_t subdomains);

}  // namespace reference
