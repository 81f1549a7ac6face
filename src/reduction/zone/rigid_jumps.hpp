// SPDX-License-Identifier: BSD-3-Clause
// Jumps without strain: the effect on the interfaces of the rigid motions that the supports leave free.
#pragma once

#include "linalg/dense.hpp"
#include "scene/problem.hpp"

namespace delam {

// Orthonormal columns, [jump rows][motions]; no column if the supports hold every part by themselves. These are the
// motions in which a part floats once its interfaces have separated.
DenseMatrix rigid_jumps(const Problem& problem);

// Combinations of the columns of z (of unit length over rows that include these) that vanish on all active rows, and
// their orthogonal complement: [columns of z][combinations].
struct Combinations {
    DenseMatrix free;
    DenseMatrix held;
};
Combinations split_motions(const DenseMatrix& z, std::span<const std::uint8_t> active);

}  // namespace delam
