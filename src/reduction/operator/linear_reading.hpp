// SPDX-License-Identifier: BSD-3-Clause
// A sum of weighted displacements as it follows from the jumps and the loads of a response,
//
//     l . u = sum_r a_r j_r + sum_p b_p theta_p,
//
// without the displacements themselves: means over bodies, or the displacement of one node, in every step.
#pragma once

#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"
#include "reduction/operator/response.hpp"

namespace delam {

struct LinearReading {
    std::vector<double> of_row;      // a, [rows]; empty: all zero
    std::vector<double> of_pattern;  // b, [patterns]
    double at(std::span<const double> theta, const Response& response) const {
        return dot(of_row, response.jump) + dot(of_pattern, theta);
    }
};

}  // namespace delam
