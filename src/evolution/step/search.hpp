// SPDX-License-Identifier: BSD-3-Clause
// A search for states of lower energy than the one that the last step continues to.
//
// A candidate is the adhesion before the step with a set R of pairs debonded at once:
//   I(R) = E(t, z_R) + D(z_before, z_R).
// Sets grow by rings from every front and from places where a crack may begin (fronts.hpp), from all fronts together,
// and from each front again with the others where they were best; and an interface may come off altogether. E falls as
// R grows, and D grows with it. So nothing between two sets R1 < R2 of a sweep lies below  E(R2) + D(R1),  nor anything
// beyond R below  E_all + D(R),  where E_all is the energy with everything debonded. A sweep samples rings far apart,
// then around its minima, then wherever these bounds leave room for a state that is lower by more than
// search_tolerance (sweep.hpp).
//
// Contact without friction and springs are homogeneous, E(theta) = |theta|^2 E(theta/|theta|): under a proportional
// load one solve gives E_all for all steps.
//
// Where the operator offers a zone the energies come from a zone about each front (zone_energies.hpp), with the contact
// outside as it is in the step; else from whole displacement solves. They choose what is minimised from; the energy of
// a result never comes from here.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/increment/increment.hpp"
#include "evolution/step/fronts.hpp"
#include "evolution/step/zone_energies.hpp"
#include "scene/problem.hpp"

namespace delam {

// A candidate above the step's state by no more than this part of what it dissipates may relax below it.
inline constexpr double promising = 0.5;

struct Candidate {
    std::vector<double> adhesion;  // [pairs]
    std::vector<double> mixity;    // [pairs] with which it was booked
    double incremental = 0.0;      // I, F L
};

struct SearchResult {
    std::vector<Candidate> starts;  // to minimise from, lowest first
    std::int64_t candidates = 0;
    // Lowest I of all candidates, and what no candidate that was left out lies below; infinite: none.
    double lowest = std::numeric_limits<double>::infinity();
    double bound = std::numeric_limits<double>::infinity();
    double error = 0.0;  // by which the energy of a candidate may be too high, F L; the bound takes it into account
    std::string words;
    std::vector<double> energies;  // for the search of the next step (State::search_energies)
};

class Search {
public:
    // op: any operator of the scene whose memory may be disturbed; it must outlive the search.
    Search(const Problem& problem, const PairLaws& pairs, const ContactScene& contact, Monitor& monitor,
           JumpOperator& op);
    // from: the step as far as it is known, booked; mixity: that of its start. What a search finds depends on its step
    // and on the state before it, so that an analysis that was saved, rolled back or cancelled goes on with the same
    // bits: energies for later searches are part of the state. Besides these nothing is kept from other steps but E_all
    // of the same load.
    SearchResult run(const Increment& increment, const State& from, std::span<const double> mixity);

private:
    double debonded_energy(const State& from, std::span<const double> direction) const;

    const Problem& problem_;
    const PairLaws& pairs_;
    const ContactScene& contact_;
    Monitor& monitor_;
    JumpOperator& op_;
    PairGraph graph_;
    std::optional<ZoneEnergies> zone_;     // where the operator offers zones
    std::vector<double> floor_direction_;  // load for which unit_floor_ was computed
    double unit_floor_ = 0.0;              // E_all at this load
};

}  // namespace delam
