// SPDX-License-Identifier: BSD-3-Clause
// Computes the energies of many states that differ from one known state in a few pairs, if the operator offers a zone.
// The other pairs and their contact stay as they are in the known state. Each energy is then a small dense solve with
// contact inside the zone. Contact outside is checked where a state differs from the known one in twice as many pairs
// as any state before it; pairs that are then on the wrong side join the zone. (FETI would need another solve for this
// check, and keeps the contact outside as it is.)
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/numbers.hpp"
#include "evolution/contact/energy_zone_system.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"

namespace delam {

// A zone is used although it has twice the rows that are wanted, and so many more: another one would have to be chosen.
// (Half and twice change nothing, as of the numbers in zone_energies.cpp.)
inline constexpr std::size_t spare_rows = 128;

class ZoneEnergies {
public:
    // zones: those of the operator.
    ZoneEnergies(const JumpOperator& op, Zones& zones, const PairLaws& pairs, const ContactScene& contact)
        : op_(op), zones_(zones), whole_(zones.zone_traits().whole), pairs_(pairs), contact_(contact) {}

    // True if every zone has all rows.
    bool whole() const { return whole_; }
    // known: a state with displacements and recorded energy, which must outlive the following calls. wanted: [pairs]
    // that may differ. allowed: by how much an energy may be too high, F L. with_jumps: its jumps are wanted, too,
    // which contact must not be left undecided for. False: there is no zone for them, or no equilibrium under the known
    // load in it.
    bool focus(const State& known, std::span<const std::uint8_t> wanted, double allowed, bool with_jumps);
    // Discards what earlier energies have shown of contact; a search begins without it.
    void forget() {
        solved_.clear();
        joined_.clear();
    }
    // True if this pair may differ.
    bool inside(std::size_t pair) const { return place_[pair] >= 0; }
    // True if the zone in use has all of these pairs, [pairs], and is not much larger than a zone of these pairs alone.
    bool serves(std::span<const std::uint8_t> wanted) const;
    // Checks contact outside anew: the next states differ from the known one elsewhere.
    void recheck_contact() { checked_ = 0; }
    // E at the known state's load and another adhesion; none: no equilibrium. exact: contact is not left undecided, and
    // that outside is checked.
    std::optional<double> energy(std::span<const double> adhesion, bool exact = false);
    // True if contact outside the zone had settled in the last energy(), as far as it was checked.
    bool settled() const { return settled_; }
    // Returns the largest amount by which the last energy() may be too high, F L.
    double error() const { return system_->solution().energy_error + system_->doubt().above + system_->doubt().below; }
    // Local jump of a pair inside the zone, in the last energy().
    std::span<const double> jump(std::size_t pair) const {
        return system_->jump().subspan(index(place_[pair]), index(pairs_.dimension));
    }

private:
    std::vector<std::uint8_t> start_of_contact(std::span<const double> adhesion) const;
    void remember(std::span<const double> adhesion, const std::vector<std::uint8_t>& closed);
    std::optional<double> zone_energy(std::span<const double> adhesion);
    // Sets which errors the next energies may have.
    void allow_errors(bool exact);
    bool wants(std::size_t pair) const { return wanted_[pair] != 0 || (!joined_.empty() && joined_[pair] != 0); }
    // Chooses the zone of `wanted_` and `joined_`.
    bool choose();
    // Pairs outside the zone that are on the wrong side of contact in the last state that was solved.
    std::vector<std::size_t> wrong_outside() const;

    const JumpOperator& op_;
    Zones& zones_;
    bool whole_;
    const PairLaws& pairs_;
    const ContactScene& contact_;
    std::optional<EnergyZoneSystem> system_;
    // The states solved since forget(): the next contact set is searched from the nearest one.
    struct Solved {
        std::vector<double> adhesion;      // [pairs]
        std::vector<std::uint8_t> closed;  // [pairs]
    };
    std::vector<Solved> solved_;
    std::vector<std::int64_t> place_;  // [pairs] first row within the zone, -1: outside
    double offset_ = 0.0;              // absolute energy less the zone's
    // Arguments of the last focus().
    const State* known_ = nullptr;
    std::vector<std::uint8_t> wanted_;  // [pairs]
    double allowed_ = 0.0;
    bool with_jumps_ = false;
    std::size_t checked_ = 0;           // most pairs by which a state with settled contact outside differs
    std::vector<std::uint8_t> joined_;  // [pairs] wanted since forget() for their contact; empty: none
    bool settled_ = true;
};

}  // namespace delam
