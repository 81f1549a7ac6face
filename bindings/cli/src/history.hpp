// SPDX-License-Identifier: BSD-3-Clause
// The columns of history.csv and its rows.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "build.hpp"

namespace cli {

class History {
public:
    // Throws SceneFailure when [output] columns names a value that the solver does not have.
    History(const Model& model, const delam_solver* solver, const Scene& scene);

    [[nodiscard]] std::string header() const;
    // Of the committed state. Numbers keep 17 significant digits: reading them back gives the same bits.
    [[nodiscard]] std::string row(delam_solver* solver) const;
    // Value of the solver for people's lines: the factor of the first pattern.
    [[nodiscard]] double load(delam_solver* solver) const;
    [[nodiscard]] double value(delam_solver* solver, const std::string& key) const;

private:
    const delam_context* context_;
    std::vector<std::pair<std::string, std::string>> columns_;  // title, key ("": always 0)
    std::string first_load_;
};

}  // namespace cli
