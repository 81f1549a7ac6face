// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.hpp"
#include "evolution/increment/damage_step.hpp"
#include "scene/pieces.hpp"

namespace delam {

namespace {

constexpr double doubtful = 1e-7;  // of the energies: forces are summed if the estimated rounding exceeds this
// Jumps are gaps and what bodies move, as one number: displacements below this part of the jumps have not as many
// digits as the balance asks for.
constexpr double lost = std::numeric_limits<double>::epsilon() / no_balance;
constexpr double tiny = std::numeric_limits<double>::min();

}  // namespace

double Balance::reaction() const {
    return std::max(contact_.force_floor(state_.theta), max_abs(op_.reaction(state_.theta, state_.response)));
}

double Balance::left(std::span<const double> displacement) const {
    if (without_strain(problem_, displacement)) return 0.0;
    const double left = op_.equilibrium_defect(state_.theta, state_.response);
    if (max_abs(displacement) <= lost * max_abs(state_.response.jump)) return 0.0;
    const bool loose = held_by_contact_alone(contact_, spring_stiffness(pairs_, state_.adhesion));
    return !loose || left > contact_.rounding_of_forces(state_.theta, state_.response.jump) ? left : 0.0;
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
