// SPDX-License-Identifier: BSD-3-Clause
// A scene file of the command line, as the reference takes scenes: whatever it has of meshes, materials, constraints
// and laws.
#pragma once

#include <string>
#include <vector>

#include "acceptance.hpp"
#include "comparison.hpp"

namespace reference {

struct SceneFile {
    Scene scene;
    std::vector<double> times;  // of the march, the first is that of the initial state
};

// settings: KEY=VALUE, as `delam run --set` takes them. Failure with the program's message.
SceneFile read_scene_file(const std::string& path, const std::vector<std::string>& settings);

// States of a condensed march of `file`, solved by both realisations of the library and directly.
struct Judged {
    double time = 0.0;
    double debonded = 0.0;  // share of the pairs
    int closed = 0;         // contacts, of the direct solution
    Comparison condensed, feti;
    Acceptance kkt_condensed, kkt_feti;
    bool stalled = false;            // FETI did not meet its linear tolerance (DELAM_NOT_CONVERGED)
    double linear_iterations = 0.0;  // of FETI's one displacement step
};
// steps: which of the march are judged; 0 is the initial state. subdomains: of FETI, 0 for its own choice. The options
// reduction and subdomains of `file` are changed by it.
std::vector<Judged> judge(SceneFile& file, const std::vector<std::size_t>& steps, std::int64_t subdomains);

}  // namespace reference
