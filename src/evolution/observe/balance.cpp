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

// True if these displacements are rigid motions of all pieces, but for rounding: their forces are rounding.
bool without_strain(const Problem& problem, std::span<const double> displacement) {
    return strained(problem, displacement) <= rigid * max_abs(displacement);
}

}  // namespace

double Balance::reaction() const {
    return std::max(contact_.force_floor(state_.theta), max_abs(op_.reaction(state_.theta, state_.response)));
}

double Balance::left(std::span<const double> displacement) const {
    if (without_strain(problem_, displacement)) return 0.0;
    const double left = op_.equilibrium_defect(state_.theta, state_.response);
    return left > contact_.rounding_of_forces(state_.theta, state_.response.jump) ? left : 0.0;
}

// Parts that have come off move without strain, energy or reaction, so that everything there is rounding. Otherwise the
// forces are compared with reactions, and their work with the energies, and the smaller ratio counts.
double Balance::off() const {
    const Ledger& ledger = state_.ledger;
    const double energies = std::max({ledger.scale(), std::abs(ledger.stored_bulk), ledger.dissipated});
    if (op_.rounding_energy(state_.theta, state_.response) <= doubtful * energies) return 0.0;
    const std::vector<double> displacement = op_.displacement(state_.theta, state_.response);
    const double left = this->left(displacement), motion = max_abs(displacement);
    if (left == 0.0) return 0.0;
    return std::min(left / std::max(reaction(), tiny), left * motion / std::max(energies, tiny));
}

}  // namespace delam
