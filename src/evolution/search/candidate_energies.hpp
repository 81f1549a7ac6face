// SPDX-License-Identifier: BSD-3-Clause
// Energies E(t, z) of the candidates of one search, per unit of the load, each computed once; those of the same
// adhesion and direction of the load that the searches of earlier steps have left are taken over.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/increment/increment.hpp"
#include "evolution/increment/step_account.hpp"
#include "evolution/search/fronts.hpp"
#include "evolution/search/zone_energies.hpp"

namespace delam {

struct CandidateEnergy {
    double value;                     // at the unit load; infinite: no equilibrium
    double error;                     // by which it may be too high
    std::vector<std::int64_t> next;   // pairs that may break next
    std::vector<Mixity> next_mixity;  // with which they would break; empty if the mixity does not follow the iterates
    bool exact = false;               // contact is decided everywhere, so that the error is that of the solve
};

class CandidateEnergies {
public:
    // The load of `from`: a direction whose largest entry has size 1, and its size. allowed: by how much an energy may
    // be too high, F L.
    CandidateEnergies(JumpOperator& op, const ContactScene& contact, Monitor& monitor, ZoneEnergies* zone,
                      const PairGraph& graph, const Increment& increment, bool follow_mixity, const State& from,
                      double allowed);
    // memory() of a search of an earlier step; ignored where it is of another load, or not of this kind.
    void recall(std::span<const double> memory);
    // The direction of the load, the layout, then key, value, error, age, exactness and mixities of each energy of the
    // last searches.
    std::vector<double> memory() const;

    double size() const { return size_; }
    const std::vector<double>& direction() const { return direction_; }
    // Rows of a zone in which energies are cheap, at most.
    std::size_t largest_zone() const;
    // Allows energies to come from a zone about these pairs, [pairs], and those that the step has damaged.
    void focus(std::span<const std::uint8_t> wanted);
    void lose_focus() {
        focused_ = false;
        wanted_.clear();
    }
    // Keeps the focus, but checks contact outside anew: the next candidates differ from the step's own state elsewhere.
    void recheck_contact() {
        if (focused_) zone_->recheck_contact();
    }
    // known: those of the pairs. candidates: number compared so far (progress). exact: contact is not left undecided,
    // nor unchecked outside a zone.
    const CandidateEnergy& at(const std::vector<double>& adhesion, std::span<const std::int64_t> next,
                              const PairMixities& known, std::int64_t candidates, bool exact = false);

private:
    // Returns the mixity of a pair that would break next, whose jump is then that of a broken neighbour. jump: of a
    // pair, empty where it is not known.
    Mixity breaking_mixity(std::size_t pair, std::span<const double> adhesion, const Mixity& known,
                           const std::function<std::span<const double>(std::size_t)>& jump) const;
    bool within_zone(std::span<const double> adhesion, std::span<const std::int64_t> next) const;
    void from_zone(std::span<const double> adhesion, const PairMixities& known, bool exact, CandidateEnergy& e);
    void recall_first_layout(std::span<const double> entries);
    void from_operator(std::span<const double> adhesion, const PairMixities& known, CandidateEnergy& e);

    JumpOperator& op_;
    const ContactScene& contact_;
    Monitor& monitor_;
    ZoneEnergies* zone_;
    const PairGraph& graph_;
    const Increment& increment_;
    const State& from_;
    bool follow_mixity_;
    bool focused_ = false;
    std::vector<std::uint8_t> wanted_;  // [pairs] of a zone that is chosen once an energy needs it; empty: none
    double allowed_;
    double size_ = 0.0;
    std::vector<double> direction_;
    std::vector<std::uint8_t> closed_;
    Response response_;
    struct Known {
        CandidateEnergy energy;
        std::int64_t age = 0;  // searches since it was last used
    };
    std::map<std::uint64_t, Known> known_;
};

}  // namespace delam
