// SPDX-License-Identifier: BSD-3-Clause
// Energies of many states that differ from one known state in a few pairs, where the operator offers a zone: the other
// pairs and their contact stay as they are in the known state, so that each energy is a small dense solve with contact
// inside the zone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evolution/increment/contact.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "reduction/jump_operator.hpp"
#include "reduction/zone/zone.hpp"

namespace delam {

class ZoneEnergies {
public:
    ZoneEnergies(JumpOperator& op, const PairLaws& pairs, const ContactScene& contact)
        : op_(op), pairs_(pairs), contact_(contact) {}
    // known: a state with displacements and booked energy. wanted: [pairs] that may differ; those of a floating zone
    // fail. False: the zone cannot tell its energy from its neighbours'.
    bool focus(const State& known, std::span<const std::uint8_t> wanted);
    // May this pair differ?
    bool inside(std::size_t pair) const { return place_[pair] >= 0; }
    // E at the known state's load and another adhesion; none: nothing balances the load.
    std::optional<double> energy(std::span<const double> adhesion);
    // Local jump of a pair inside, of the last energy().
    std::span<const double> jump(std::size_t pair) const {
        return std::span<const double>(jump_).subspan(static_cast<std::size_t>(place_[pair]),
                                                      static_cast<std::size_t>(pairs_.dimension));
    }

private:
    std::optional<double> zone_energy(std::span<const double> adhesion);

    JumpOperator& op_;
    const PairLaws& pairs_;
    const ContactScene& contact_;
    const State* known_ = nullptr;
    Zone* zone_ = nullptr;
    std::vector<std::int64_t> place_;  // [pairs] first row within the zone, -1: outside
    std::vector<std::uint8_t> held_, normal_;
    std::vector<double> jump_;
    double offset_ = 0.0;  // absolute energy less the zone's
};

}  // namespace delam
