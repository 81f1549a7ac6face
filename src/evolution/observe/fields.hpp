// SPDX-License-Identifier: BSD-3-Clause
// The fields of a state by key, as [rows][columns].
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "evolution/observe/observer.hpp"

namespace delam {

struct FieldShape {
    std::int64_t rows;
    std::int64_t columns;
};
// part: an interface for pair fields, a node for displacements, -1 for everything. Throws Error(DELAM_ERROR_ARGUMENT)
// for an unknown key or part.
FieldShape field_shape(const Observer& observer, const std::string& key, std::int64_t part);
std::vector<double> field(Observer& observer, const std::string& key, std::int64_t part);

}  // namespace delam
