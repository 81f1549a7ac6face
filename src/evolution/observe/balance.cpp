// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.hpp"
#include "body/rigid_modes.hpp"
#include "scene/pieces.hpp"

namespace delam {

namespace {

constexpr double doubtful = 1e-7;  // of the energies: forces are summed if the estimated rounding exceeds this
constexpr double rigid = 1e-8;     // of the displacements: what remains of a motion without strain
constexpr double tiny = std::numeric_limits<double>::min();

// Largest displacement after subtracting each piece's own rigid motion.
double strained(const Problem& problem, std::span<const double> displacement) {
    const Mesh& mesh = *problem.mesh;
    const auto dim = index(mesh.dimension());
    double most = 0.0;
    for (const std::vector<std::int64_t>& nodes : rigid_pieces(problem).nodes) {
        std::vector<double> own;
        for (const std::int64_t node : nodes)
            for (std::size_t k = 0; k < dim; ++k) own.push_back(displacement[index(node) * dim + k]);
        const std::vector<double> modes = rigid_modes(mesh, nodes);
        for (std::size_t first = 0; first < modes.size(); first += own.size()) {
            double share = 0.0;
            for (std::size_t i = 0; i < own.size(); ++i) share += modes[first + i] * own[i];
            for (std::size_t i = 0; i < own.size(); ++i) own[i] -= share * modes[first + i];
        }
        most = std::max(most, max_abs(own));
    }
    return most;
}

}  // namespace

bool without_strain(const Problem& problem, std::span<const double> displacement) {
    return strained(problem, displacement) <= rigid * max_abs(displacement);
}

double largest_reaction(const JumpOperator& op, const State& state, double force_floor) {
    return std::max(force_floor, max_abs(op.reaction(state.theta, state.response)));
}

// Parts that have come off move without strain, energy or reaction, so that everything there is rounding. Otherwise the
// forces are compared with reactions, and their work with the energies, and the smaller ratio counts.
double out_of_balance(const Problem& problem, const JumpOperator& op, const State& state, double force_floor) {
    const Ledger& ledger = state.ledger;
    const double energies = std::max({ledger.scale(), std::abs(ledger.stored_bulk), ledger.dissipated});
    if (op.rounding_energy(state.theta, state.response) <= doubtful * energies) return 0.0;
    const std::vector<double> displacement = op.displacement(state.theta, state.response);
    const double motion = max_abs(displacement);
    if (without_strain(problem, displacement)) return 0.0;
    const double left = op.equilibrium_defect(state.theta, state.response);
    const double reaction = largest_reaction(op, state, force_floor);
    return std::min(left / std::max(reaction, tiny), left * motion / std::max(energies, tiny));
}

}  // namespace delam
