// SPDX-License-Identifier: BSD-3-Clause
// An analysis whose supports begin or end, or whose rotations become large: each of its stages (scene/stage.hpp) has a
// solver. The first step of a stage is pending in the solver of that stage, and the one before waits, unchanged, until
// the step is committed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "evolution/analysis/solver.hpp"

namespace delam {

class Stages {
public:
    // Computes the step to a time; `now` is then the solver in which it is pending.
    Outcome advance(std::shared_ptr<Solver>& now, double time);
    void commit(std::shared_ptr<Solver>& now);
    void rollback(std::shared_ptr<Solver>& now);
    // The solver whose committed state is that of the analysis.
    const Solver& committed(const Solver& now) const { return before_ != nullptr ? *before_ : now; }
    // Loads a state of any stage (snapshot.hpp); `now` is then the solver of this stage.
    void load(std::shared_ptr<Solver>& now, std::span<const std::uint8_t> bytes);
    void load_file(std::shared_ptr<Solver>& now, const std::string& path);

private:
    std::shared_ptr<Solver> before_;  // of the stage before, while the first step of a stage is pending; else null
};

}  // namespace delam
