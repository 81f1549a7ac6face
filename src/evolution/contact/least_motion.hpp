// SPDX-License-Identifier: BSD-3-Clause
// The least motion of free parts that keeps their faces from penetrating others:
//
//   minimise  1/2 a^T G a - p^T a     subject to  g_r + n_r^T a >= 0 for all rows r
//
// a: amplitudes of rigid motions that nothing resists; g: gaps before the motion. Solved by the dual method of Goldfarb
// and Idnani (Math. Program. 27, 1983): it begins at the minimiser without rows and takes in the row that is violated
// most; each step raises the minimum, so that no set of rows comes twice.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"

namespace delam {

struct LeastMotion {
    std::vector<double> motion;  // a; where rows block each other, the last one tried
    // Rows that no motion keeps apart together; empty: the motion keeps all rows apart.
    std::vector<std::size_t> blocked;
    // Rows that the motion touches and that hold it there.
    std::vector<std::size_t> touched;
};

// gram: G, positive definite. normals: [rows][motions]; gap: [rows]. slack: a row may be left violated by so much.
LeastMotion least_motion(const DenseMatrix& gram, std::span<const double> pull, const DenseMatrix& normals,
                         std::span<const double> gap, double slack);

}  // namespace delam
