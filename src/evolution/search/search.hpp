// SPDX-License-Identifier: BSD-3-Clause
// A search for states of lower energy than the one that the last step continues to.
//
// A candidate is the adhesion before the step with a set R of pairs debonded at once:
//   I(R) = E(t, z_R) + D(z_before, z_R).
// Sets grow by rings from every front and from places where a crack may begin (fronts.hpp), from all fronts together,
// and from each front again with the others where they were best. One set debonds a whole interface. E falls as R
// grows, and D grows with it. Therefore every set between R1 < R2 of a sweep has at least the energy E(R2) + D(R1), and
// every set beyond R at least E_all + D(R), where E_all is the energy with everything debonded. A sweep samples rings
// far apart, then around its minima, then wherever these bounds leave room for a state that is lower by more than
// search_tolerance (sweep.hpp).
//
// In mixed mode a ring breaks with the mixities that it shows with the rings before it debonded. Where no sample has
// shown them, its D is bounded below by zeta times the least toughness of all mixities (law/criterion.hpp); samples are
// added where this lowers the bound most. A sharp front shows other mixities than one with a process zone (mixed-mode
// bending at G_II/G = 0.8: 333 instead of 500 J/m2 of toughness). Where the step has followed growth to a candidate
// (stepper.cpp), each pair that broke on the way counts with what it dissipated there (search_result.hpp). The bound
// holds for the positions of one front, with the others in their places.
//
// Contact without friction and springs are homogeneous, E(theta) = |theta|^2 E(theta/|theta|): under a proportional
// load one solve gives E_all for all steps.
//
// If the operator offers a zone, the energies come from a zone about each front (zone_energies.hpp), with the contact
// outside as it is in the step; otherwise they come from whole displacement solves. They only select the starts of
// minimisations, which compute the energy of the result.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/increment/increment.hpp"
#include "evolution/increment/step_account.hpp"
#include "evolution/search/fronts.hpp"
#include "evolution/search/search_result.hpp"
#include "evolution/search/zone_energies.hpp"
#include "scene/problem.hpp"

namespace delam {

class Search {
public:
    // op: any operator of the scene whose memory may be disturbed; it must outlive the search.
    Search(const Problem& problem, const PairLaws& pairs, const ContactScene& contact, Monitor& monitor,
           JumpOperator& op);
    // from: the step as far as it is known, recorded; mixity: that of its start. The result depends on the step and on
    // the state before it alone, so that an analysis that was saved, rolled back or cancelled continues with the same
    // bits. Energies for later searches are therefore part of the state, and other steps leave only E_all of the same
    // load.
    SearchResult run(const Increment& increment, const StepAccount& account, const State& from,
                     const PairMixities& mixity);

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
