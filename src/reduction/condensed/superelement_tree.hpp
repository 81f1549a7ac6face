// SPDX-License-Identifier: BSD-3-Clause
// Cuts the bodies into pieces across the interfaces, as a binary tree of nested dissection (A. George, SIAM J. Numer.
// Anal. 10, 1973).
//
// A leaf is a piece of the bodies with the jumps on it, a superelement (J. S. Przemieniecki, AIAA J. 1, 1963). An inner
// node owns the variables on the cut between its two children, which alone couple one child to the other. What a
// subtree shares with the rest is its border, variables that nodes above it own.
//
// Every variable belongs to the jump that is the fewest cells away, and of several to the nearest. Cuts thus run
// straight from the interface through the bodies. METIS divides the graph of these columns, which has a vertex for each
// pair.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/sparse/sparse.hpp"
#include "reduction/operator/jump_variables.hpp"
#include "scene/problem.hpp"

namespace delam {

struct Superelement {
    std::vector<std::int64_t> children;  // none or two
    std::vector<std::int64_t> inside;    // displacements; those of an inner node lie on the cut
    std::vector<std::int64_t> jumps;
    std::vector<std::int64_t> border;  // variables of nodes above and kept displacements, in the order of elimination
    bool leaf() const { return children.empty(); }
};

struct SuperelementTree {
    std::vector<Superelement> node;      // children before their parents, the root last
    std::vector<std::int64_t> position;  // [variables] in the order of elimination, kept displacements last
};

// Positions of the variables, L.
struct VariablePoints {
    std::int64_t dimension = 0;
    std::vector<double> at;  // [variables][dimension]
};
VariablePoints variable_points(const Problem& problem, const JumpVariables& variables);

// stiffness: T^T K T.
SuperelementTree cut_into_superelements(const SparseMatrix& stiffness, const JumpVariables& variables,
                                        const VariablePoints& points, const Poll& poll = {});

}  // namespace delam
