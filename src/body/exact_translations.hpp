// SPDX-License-Identifier: BSD-3-Clause
// Makes rigid translations an exact kernel of a stored element matrix, not one up to rounding.
#pragma once

#include <cstddef>
#include <vector>

namespace delam {

// Rounds a symmetric matrix [nodes*dimension]^2 (row-major) to multiples of 2^-51 of its largest entry (four nodes in the plane, of which
// four cells meet at a node) or 2^-50, so that sums over the cells around a node stay exact, and moves the last bits so that
// every row sums to zero over the nodes, component by component. Without it the resultant of K u over a large body is the
// rounding of its entries times the whole displacement, and global equilibrium of a slender ply is lost beyond 1e-10 of
// the reactions.
void make_translations_exact(std::vector<double>& matrix, std::size_t nodes, std::size_t dimension);

}  // namespace delam
