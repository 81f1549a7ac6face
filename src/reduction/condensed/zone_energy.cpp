// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/zone_energy.hpp"

#include <utility>

namespace delam {

ZoneEnergy::ZoneEnergy(const TrailingEquations& equations, const Superelements& skeleton,
                       const Elimination& elimination, const Poll& poll)
    : reduced_(equations, skeleton, elimination) {
    std::vector<std::int64_t> kept, zone;
    const std::vector<std::int64_t>& rest = reduced_.rest_number();
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const std::int64_t unknown = rest[i] - equations.kept();
        (unknown < 0 ? kept : zone).push_back(static_cast<std::int64_t>(i));
        if (unknown >= 0) unknowns_.push_back(unknown);
    }
    if (kept.empty()) return;
    base_ = std::make_unique<Condensation>(reduced_.energy(), std::move(zone), std::move(kept),
                                           std::vector<double>(rest.size(), 0.0), poll);
    reduced_.forget();
}

std::vector<double> ZoneEnergy::recover(std::span<const double> theta, std::span<const double> zone) const {
    if (!base_) return reduced_.recover(theta, zone);
    std::vector<double> rest(reduced_.rest_number().size());
    base_->recover(theta, zone, rest);
    return reduced_.recover(theta, rest);
}

}  // namespace delam
