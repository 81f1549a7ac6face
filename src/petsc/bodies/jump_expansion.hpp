// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "petsc/bodies/scene_variables.hpp"

namespace delam::petsc {

// The displacements w at the homes can be the variables in the place of the jumps: w = P v with the rows of T at the
// homes, and w = v elsewhere. This is P^-1, row by row.
class JumpExpansion {
public:
    using Row = std::vector<std::pair<std::int64_t, double>>;  // homes and coefficients

    explicit JumpExpansion(const SceneVariables& scene) : scene_(scene) {}
    // The variable at a home, in terms of w.
    const Row& row(std::int64_t home);

private:
    void expand_node(std::int64_t node);

    const SceneVariables& scene_;
    std::unordered_map<std::int64_t, Row> rows_;
};

}  // namespace delam::petsc
