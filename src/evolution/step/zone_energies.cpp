// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/zone_energies.hpp"

#include <algorithm>
#include <limits>

#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr std::int64_t energy_contact_steps = 200;  // beyond them the energy is not known

}  // namespace

bool ZoneEnergies::focus(const State& known, std::span<const std::uint8_t> wanted, double allowed) {
    const auto dim = static_cast<std::size_t>(pairs_.dimension);
    Springs springs{spring_stiffness(pairs_, known.adhesion), held_rows(contact_, known.closed)};
    std::vector<std::uint8_t> rows;
    for (const std::uint8_t pair : wanted) rows.insert(rows.end(), dim, pair);
    Zone* zone = op_.zone(springs, rows, true);
    if (zone == nullptr) return false;
    system_.emplace(*zone, contact_, op_.prescribed_rows(), springs.held, known.theta);
    solved_.clear();
    place_.assign(wanted.size(), -1);
    for (const ZoneSystem::Pair& p : system_->pairs()) place_[p.pair] = static_cast<std::int64_t>(p.first);
    zone->unknowns_at(known.response);
    zone->ask_for_energies(0.0);
    const std::optional<double> energy = zone_energy(known.adhesion);
    if (!energy) return false;
    zone->ask_for_energies(allowed);
    // The search itself handles the gradient term, which does not depend on displacements.
    offset_ = known.ledger.energy() - gradient_energy(pairs_, known.adhesion) - *energy;
    return true;
}

std::optional<double> ZoneEnergies::energy(std::span<const double> adhesion) {
    const std::optional<double> energy = zone_energy(adhesion);
    return energy ? std::optional<double>(*energy + offset_) : std::nullopt;
}

std::optional<double> ZoneEnergies::zone_energy(std::span<const double> adhesion) {
    const auto dim = static_cast<std::size_t>(pairs_.dimension);
    const std::vector<std::int64_t>& rows = system_->zone().jump_rows();
    std::vector<double> spring(rows.size());
    std::vector<Zone::Coupling> couplings;
    for (std::size_t z = 0; z < rows.size(); ++z) {
        const std::size_t row = index(rows[z]), p = row / dim;
        if (pairs_.law[p] == nullptr) continue;
        const Law& law = *pairs_.law[p];
        spring[z] = pairs_.weight[p] * adhesion[p] * law.stiffness(row % dim);
        if (spring[z] > 0.0)
            couplings.push_back({static_cast<std::int64_t>(z), static_cast<std::int64_t>(z), spring[z]});
    }
    system_->load(std::move(couplings), {});
    std::vector<std::uint8_t> closed = system_->entered_closed();
    std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
    for (const Solved& s : solved_) {
        std::int64_t differ = 0;
        for (std::size_t z = 0; z < spring.size(); ++z) differ += s.spring[z] != spring[z] ? 1 : 0;
        if (differ >= nearest) continue;
        nearest = differ;
        closed = s.closed;
    }
    if (!find_active_set(*system_, system_->contact_rows(), closed, energy_contact_steps, false).settled)
        return std::nullopt;
    solved_.push_back({spring, std::move(closed)});
    double energy = system_->zone().energy_of(system_->theta(), system_->unknowns());
    const std::span<const double> jump = system_->jump();
    for (std::size_t z = 0; z < spring.size(); ++z) energy += 0.5 * spring[z] * jump[z] * jump[z];
    return energy;
}

}  // namespace delam
