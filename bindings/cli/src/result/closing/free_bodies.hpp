// SPDX-License-Identifier: BSD-3-Clause
// Bodies that nothing holds at the end of an analysis, with the step since which, and the motions that are free.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/library/model.hpp"

namespace cli {

struct FreeBody {
    std::string name;
    std::int64_t since = 0;         // step
    std::vector<std::string> axes;  // in which it may move
    bool turns = false;
};

std::vector<FreeBody> free_bodies_of(const Model& model, delam_solver* solver, const Scene& scene);
// One line for all bodies that are free since the same step in the same way.
std::vector<std::string> free_body_lines(const std::vector<FreeBody>& bodies, const Scene& scene);

}  // namespace cli
