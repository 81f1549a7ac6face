// SPDX-License-Identifier: BSD-3-Clause
// A zone of which only the energy is wanted: contact may be left undecided where it hardly changes the energy.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolution/contact/zone_system.hpp"

namespace delam {

class EnergyZoneSystem : public ZoneSystem {
public:
    using ZoneSystem::ZoneSystem;

    // The energy with contact lies above that of the last solve by at most `above`, below it by at most `below`, F L.
    struct ContactDoubt {
        double above = 0.0, below = 0.0;
    };
    // Allows contact to be left undecided where it changes the energy by less, F L.
    void allow_doubt(double energy) { allowed_ = energy; }
    bool negligible(const std::vector<std::uint8_t>& closed, std::span<const std::size_t> wrong);
    const ContactDoubt& doubt() const { return doubt_; }

private:
    ContactDoubt doubt_contact(const std::vector<std::uint8_t>& closed, std::span<const std::size_t> wrong) const;

    double allowed_ = 0.0;
    ContactDoubt doubt_;
};

}  // namespace delam
