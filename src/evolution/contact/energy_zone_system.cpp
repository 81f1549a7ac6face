// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/contact/energy_zone_system.hpp"

#include <limits>

#include "base/numbers.hpp"

namespace delam {

// With A = S + C and the forces lambda <= 0 of the other closed rows kept, releasing the closed rows V that pull lowers
// the energy by 1/2 lambda_V^T (A^-1)_VV lambda_V, and A >= C_VV:   below = sum_V lambda^2 / (2 C).   By duality no
// state without penetration lies lower. Moving the open rows P that penetrate to zero, and nothing else, gives a state
// without penetration:   above = 1/2 j_P^T A_PP j_P.
EnergyZoneSystem::ContactDoubt EnergyZoneSystem::doubt_contact(const std::vector<std::uint8_t>& closed,
                                                               std::span<const std::size_t> wrong) const {
    const std::span<const double> acting = force(), jumps = jump();
    std::vector<double> spring(jumps.size(), 0.0), moved;
    for (const Zone::Coupling& c : couplings()) spring[index(c.row)] += c.row == c.column ? c.value : 0.0;
    std::vector<std::size_t> open;
    ContactDoubt doubt;
    for (const std::size_t i : wrong) {
        const std::size_t r = contact_rows().row[i];
        if (closed[i] != 0) {
            doubt.below +=
                spring[r] > 0.0 ? 0.5 * acting[r] * acting[r] / spring[r] : std::numeric_limits<double>::infinity();
        } else {
            open.push_back(r);
            moved.push_back(-jumps[r]);
            doubt.above += 0.5 * spring[r] * jumps[r] * jumps[r];
        }
    }
    if (!open.empty() && doubt.below + doubt.above <= allowed_) doubt.above += zone().energy_of_moving(open, moved);
    return doubt;
}

bool EnergyZoneSystem::negligible(const std::vector<std::uint8_t>& closed, std::span<const std::size_t> wrong) {
    doubt_ = {};
    if (wrong.empty() || !(allowed_ > 0.0)) return wrong.empty();
    const ContactDoubt doubt = doubt_contact(closed, wrong);
    if (!(doubt.above + doubt.below <= allowed_)) return false;
    doubt_ = doubt;
    return true;
}

}  // namespace delam
