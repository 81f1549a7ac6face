// SPDX-License-Identifier: BSD-3-Clause
// A stiffness in the host's numbering, split into those of the bodies.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "body/host_stiffness.hpp"
#include "scene/problem.hpp"

namespace delam {

struct GivenMatrix {
    std::vector<std::int64_t> nodes;  // mesh nodes of one or several whole bodies
    std::vector<std::int64_t> dofs;   // [nodes][dimension] row of each displacement; empty: dimension*i + component
    std::vector<std::int64_t> row_starts;  // CSR, from 0
    std::vector<std::int64_t> columns;
    std::vector<double> values;
    ToldKernel kernel;  // by row
};

// Error(DELAM_ERROR_ARGUMENT) names the fault; the problem is then unchanged.
void take_stiffness(Problem& problem, const GivenMatrix& given, Monitor& monitor);

}  // namespace delam
