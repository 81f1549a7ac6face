// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/operator/open_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "linalg/sparse/sparse_elimination.hpp"

namespace delam {

namespace {

// Part of the largest prescribed displacement by which equations may miss each other: as in contact (contact.cpp) and
// between constraints (validate.cpp), far above rounding, far below what a host means. (Measured by
// verify/bench/constants.py on 250 random scenes: from a hundredth to a hundred times all decide alike.)
constexpr double contradiction = 1e-9;

bool moves(const std::vector<double>& offset) { return max_abs(offset) > 0.0; }

}  // namespace

void refuse_open_bonds(const Problem& problem, const JumpVariables& variables) {
    const bool bonds = std::any_of(problem.interfaces.begin(), problem.interfaces.end(),
                                   [](const InterfaceProperties& own) { return own.bonded; });
    const bool driven = std::any_of(variables.row_offset.begin(), variables.row_offset.end(), moves) ||
                        std::any_of(variables.equations.begin(), variables.equations.end(),
                                    [](const JumpVariables::Equation& e) { return moves(e.prescribed); });
    if (!bonds || !driven) return;
    const double rounding = contradiction * max_abs(problem.prescribed_matrix());
    const std::vector<JumpRow> rows = express_rows(variables, solve_equations(variables));
    const auto dim = index(problem.mesh->dimension());
    SparseElimination known;
    std::size_t pair = 0;
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const InterfaceProperties& own = problem.interfaces[i];
        for (std::size_t p = 0; p < own.adhesion.size(); ++p, ++pair)
            for (std::size_t c = 0; own.bonded && c < dim; ++c) {
                const JumpRow& jump = rows[pair * dim + c];  // n x + O theta = 0
                SparseElimination::Row row{{jump.unknowns.begin(), jump.unknowns.end()}, jump.offset};
                row.right.resize(problem.patterns.size(), 0.0);
                for (double& o : row.right) o = -o;
                known.reduce(row);
                if (!row.terms.empty()) {
                    const auto largest = std::max_element(
                        row.terms.begin(), row.terms.end(),
                        [](const auto& a, const auto& b) { return std::abs(a.second) < std::abs(b.second); });
                    known.solve(row, largest->first);
                } else if (max_abs(row.right) > rounding) {
                    fail(DELAM_ERROR_PROBLEM, "prescribed displacements open interface ", i, " at its pair ", p,
                         ", directly or through bodies that are bonded to both sides, but it is bonded permanently");
                }
            }
    }
}

}  // namespace delam
