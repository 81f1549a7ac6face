// SPDX-License-Identifier: BSD-3-Clause
// Displacements expressed in variables that include the jumps: u = T v + U theta.
//
// The two nodes of a pair become one displacement and one jump, u_b = u_a + Q^T j (Q: the pair's frame). Nodes
// connected by several pairs (a triple junction) depend on one root along a spanning tree; the jump of a pair that
// closes a ring depends on the ring's others. Tied nodes are replaced by the nodes to which they are tied. A constraint
// on few variables expresses one of them by the others, exactly and sparsely: a displacement if there is one (u_p = sum
// of c u + U theta), else a jump. Thousands of periodic pairs therefore need no unknown. Variables of longer
// constraints (means over a patch) are kept for the dense stage, and so are control nodes, on which many others depend.
//
// Faces that are apart at the start have the jump u_b - u_a + gap along the normal: their distance. A gap is then a
// load like a prescribed displacement, u_b = u_a + Q^T (j - g theta).
//
// With all jumps and kept displacements zero this is the structure bonded everywhere, whose stiffness is definite, so
// they can be eliminated last.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "linalg/sparse/sparse.hpp"
#include "reduction/operator/jump_row.hpp"
#include "scene/problem.hpp"

namespace delam {

struct JumpVariables {
    // v = [leading displacements | displacements kept for the dense stage | independent jumps]
    std::int64_t leading = 0;
    std::int64_t kept = 0;
    std::int64_t jumps = 0;
    std::int64_t count() const { return leading + kept + jumps; }
    std::int64_t trailing() const { return kept + jumps; }

    SparseMatrix transform;                 // T, [mesh DOFs][count]
    std::vector<std::vector<double>> lift;  // U, [patterns][mesh DOFs]
    std::vector<SparseVector> row;          // [jump rows] each in independent jumps, 0-based among the jumps
    // [jump rows][patterns] what prescribed displacements contribute to them; empty: nothing
    std::vector<std::vector<double>> row_offset;
    std::vector<std::int64_t> bound;  // jump rows that constraints, not rings, express by others

    // Constraints left for the dense stage: sum over trailing variables (kept ones first, then jumps) = sum_p
    // prescribed[p] theta_p.
    struct Equation {
        SparseVector entries;
        std::vector<double> prescribed;  // [patterns]
    };
    std::vector<Equation> equations;
};

// Smaller coefficients of equations are rounding. (Measured by verify/bench/constants.py on 250 random scenes: half and
// twice decide alike.)
inline constexpr double dependent_equation = 1e-10;

JumpVariables make_jump_variables(const Problem& problem, const Poll& poll = {});

// Gives the jumps parts that no displacement has, [rows] per unit of the last pattern, which drives nothing else.
void offset_jumps(JumpVariables& variables, std::span<const double> offset);

// An equation solved for one trailing variable, displacements before jumps: t_pivot = sum of entries t + prescribed .
// theta, where no entry is another one's pivot.
struct SolvedEquation {
    std::int64_t pivot;
    SparseVector entries;
    std::vector<double> prescribed;  // [patterns]
};
// Drops dependent equations.
std::vector<SolvedEquation> solve_equations(const JumpVariables& variables);
// All jump rows in variables v, with the jumps that these equations determine replaced, so that a row which the
// constraints prescribe has none.
std::vector<JumpRow> express_rows(const JumpVariables& variables, std::span<const SolvedEquation> solved);
// Jumps that no equation determines.
std::int64_t free_jumps(const JumpVariables& variables);
// [jump rows] 1: the constraints alone determine the jump.
std::vector<std::uint8_t> prescribed_rows(const JumpVariables& variables);

}  // namespace delam
