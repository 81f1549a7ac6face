// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/zone_energies.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace delam {

namespace {

constexpr double noise = 1e-11;              // of the largest jump or force in the zone: rounding
constexpr std::int64_t contact_steps = 200;  // beyond them the energy is not told

double largest(std::span<const double> values) {
    double m = 0.0;
    for (const double v : values) m = std::max(m, std::abs(v));
    return m;
}

}  // namespace

bool ZoneEnergies::focus(const State& known, std::span<const std::uint8_t> wanted) {
    const auto dim = static_cast<std::size_t>(pairs_.dimension);
    known_ = &known;
    Springs springs{spring_stiffness(pairs_, known.adhesion), {}};
    springs.held.assign(springs.stiffness.size(), 0);
    std::vector<std::uint8_t> rows(springs.stiffness.size(), 0);
    for (std::size_t p = 0; p < wanted.size(); ++p)
        for (std::size_t c = 0; c < dim; ++c) {
            springs.held[p * dim + c] = contact_.bonded[p] != 0 || (c == 0 && known.closed[p] != 0) ? 1 : 0;
            rows[p * dim + c] = wanted[p];
        }
    zone_ = op_.zone(springs, rows, true);
    if (zone_ == nullptr) return false;
    const std::vector<std::int64_t>& members = zone_->jump_rows();
    place_.assign(wanted.size(), -1);
    held_.assign(members.size(), 0);
    normal_.assign(members.size(), 0);
    for (std::size_t z = 0; z < members.size(); ++z) {
        const auto row = static_cast<std::size_t>(members[z]);
        const bool given = op_.prescribed_rows()[row] != 0;  // by the device: neither held nor let go
        held_[z] = given ? 0 : springs.held[row];
        normal_[z] = row % dim == 0 && contact_.bonded[row / dim] == 0 && !given ? 1 : 0;
        if (row % dim == 0 && z + dim <= members.size() &&
            static_cast<std::size_t>(members[z + dim - 1]) == row + dim - 1)
            place_[row / dim] = static_cast<std::int64_t>(z);
    }
    const std::optional<double> energy = zone_energy(known.adhesion);
    if (!energy) return false;
    // The gradient term, which does not depend on displacements, is the search's own business.
    offset_ = known.ledger.energy() - gradient_energy(pairs_, known.adhesion) - *energy;
    return true;
}

std::optional<double> ZoneEnergies::energy(std::span<const double> adhesion) {
    const std::optional<double> energy = zone_energy(adhesion);
    return energy ? std::optional<double>(*energy + offset_) : std::nullopt;
}

std::optional<double> ZoneEnergies::zone_energy(std::span<const double> adhesion) {
    const auto dim = static_cast<std::size_t>(pairs_.dimension);
    const std::vector<std::int64_t>& members = zone_->jump_rows();
    std::vector<double> spring(members.size());
    std::vector<Zone::Coupling> couplings;
    for (std::size_t z = 0; z < members.size(); ++z) {
        const auto row = static_cast<std::size_t>(members[z]), p = row / dim;
        if (pairs_.law[p] == nullptr) continue;
        const Law& law = *pairs_.law[p];
        spring[z] = pairs_.weight[p] * adhesion[p] * (row % dim == 0 ? law.normal_stiffness : law.tangential_stiffness);
        if (spring[z] > 0.0)
            couplings.push_back({static_cast<std::int64_t>(z), static_cast<std::int64_t>(z), spring[z]});
    }
    // All pairs that violate their side at once; once a set comes back, the one of least index (contact.hpp).
    std::vector<double> unknowns;
    std::set<std::string> seen;  // held rows, as bytes
    bool settled = false, one_at_a_time = false;
    for (std::int64_t step = 0; step < contact_steps && !settled; ++step) {
        if (!zone_->factor(couplings, held_)) return std::nullopt;
        const Zone::Solution solution = zone_->solve(known_->theta, {});
        if (!solution.balanced) return std::nullopt;
        unknowns = solution.unknowns;
        jump_ = zone_->jumps(known_->theta, unknowns);
        std::vector<double> force(jump_.size());
        for (std::size_t z = 0; z < force.size(); ++z) force[z] = spring[z] * jump_[z];
        zone_->complete_forces(known_->theta, solution, force);
        const double jump_scale = noise * std::max(largest(jump_), contact_.jump_floor(known_->theta));
        const double force_scale = noise * std::max(largest(force), contact_.force_floor(known_->theta));
        one_at_a_time = one_at_a_time || !seen.emplace(held_.begin(), held_.end()).second;
        settled = true;
        for (std::size_t z = 0; z < held_.size() && !(one_at_a_time && !settled); ++z) {
            if (normal_[z] == 0 || (held_[z] != 0 ? force[z] <= force_scale : jump_[z] >= -jump_scale)) continue;
            held_[z] ^= 1;
            settled = false;
        }
    }
    if (!settled) return std::nullopt;
    double energy = zone_->energy_of(known_->theta, unknowns);
    for (std::size_t z = 0; z < spring.size(); ++z) energy += 0.5 * spring[z] * jump_[z] * jump_[z];
    return energy;
}

}  // namespace delam
