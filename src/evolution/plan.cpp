// SPDX-License-Identifier: BSD-3-Clause
// What the scene needs and what was left out, in words.
#include <set>

#include "base/error.hpp"
#include "evolution/solver.hpp"

namespace delam {

std::string Solver::plan() const {
    const Mesh& mesh = *problem_.mesh;
    const std::int64_t dim = mesh.dimension();
    std::string out;
    out += text("primal DOFs: ", mesh.node_count() * dim, " (", mesh.node_count(), " nodes, ", mesh.cell_count(), " cells, ",
                mesh.body_count(), " bodies, ", dim, "D)\n");
    out += text("dual DOFs: ", problem_.jump_count(), " (", problem_.pair_count(), " node pairs)\n");
    for (std::size_t i = 0; i < mesh.interfaces().size(); ++i) {
        const InterfaceGeometry& g = mesh.interfaces()[i];
        double notch = 0.0, bond = 0.0;
        for (std::size_t p = 0; p < g.weight.size(); ++p)
            (problem_.interfaces[i].adhesion[p] > 0.0 ? bond : notch) += g.weight[p];
        out += text("interface ", i, ": bodies ", mesh.body_label(g.body_a), " and ", mesh.body_label(g.body_b), ", ",
                    g.pair_count(), " pairs, ");
        out += problem_.interfaces[i].bonded ? std::string("bonded for ever: no damage, no contact\n")
                                             : text("adhering over ", bond, ", notch over ", notch,
                                                    dim == 2 ? " (length)" : " (area)", ": damage and contact\n");
    }
    out += text("constraints: ", problem_.constraints.size(), "; load patterns: ", problem_.patterns.size(), "\n");
    out += "displacements: " + operator_->description() + "\n";
    out += text("evolution: local solution, alternate minimisation with frozen mixity, delta = ",
                problem_.options.damage_tolerance, ", at most ", problem_.options.minimisation_limit, " alternations a step\n");
    out += "left out: displacements and stresses inside the bodies (recovered when asked for); gradient term (none in the "
           "laws); backtracking (the two-sided estimate is reported, not acted on)\n";
    return out;
}

}  // namespace delam
