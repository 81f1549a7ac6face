// SPDX-License-Identifier: BSD-3-Clause
// A search for states of lower energy than the one that the last step continues to.
//
// A candidate is the adhesion before the step with a set R of pairs debonded at once:
//   I(R) = E(t, z_R) + D(z_before, z_R).
// Sets grow by rings from every front and from places where a crack may begin (fronts.hpp), from all fronts together,
// and from each front again with the others where they were best; and an interface may come off altogether. E falls as
// R grows and D grows with it. So nothing between two sets R1 < R2 of a sweep lies below  E(R2) + D(R1),  nor anything
// beyond R below  E_all + D(R),  E_all: everything debonded. A sweep samples rings far apart, then around its minima,
// then wherever these bounds leave room for a state that is lower by more than search_tolerance.
//
// Contact without friction and springs are homogeneous, E(theta) = |theta|^2 E(theta/|theta|): under a proportional
// load E_all is solved for once.
//
// Where the operator is condensed the energies come from a zone about each front (zone_energies.hpp), with the contact
// outside as it is in the step; else from whole displacement solves. They choose what is minimised from; the energy of
// a result never comes from here.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/increment/contact.hpp"
#include "evolution/increment/mixity_rule.hpp"
#include "evolution/increment/state.hpp"
#include "evolution/step/fronts.hpp"
#include "evolution/step/zone_energies.hpp"
#include "scene/problem.hpp"

namespace delam {

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
    std::string words;
};

class Search {
public:
    // op: any operator of the scene whose memory may be disturbed; it must outlive the search.
    Search(const Problem& problem, const PairLaws& pairs, const ContactScene& contact, Monitor& monitor,
           JumpOperator& op);
    // from: the step as far as it is known, booked; mixity: that of its start.
    SearchResult run(const State& before, const State& from, std::span<const double> mixity);

private:
    struct Energy {
        double value;                     // at the unit load; infinite: nothing balances the load
        std::vector<std::int64_t> next;   // pairs that may break next
        std::vector<double> next_mixity;  // which they show
    };
    class Sweep;

    const Energy& energy(const std::vector<double>& adhesion, std::span<const std::int64_t> next,
                         std::span<const double> known);
    void aim(const State& from);
    double debonded_energy(const State& from) const;
    std::vector<std::uint8_t> adhering(const Candidate& base) const;
    // Lets energies of states come from a zone about these pairs.
    void focus(std::span<const std::uint8_t> wanted);
    double spent(const Candidate& c) const;
    double energy_before() const;
    // I of a candidate; counts it.
    double compare(Candidate& candidate, std::span<const std::int64_t> next, std::vector<double>* next_mixity);

    void break_everything(const Candidate& start, std::vector<Candidate>& found);
    void advance_together(const Candidate& start, std::span<const Front> fronts, std::vector<Candidate>& found);

    const Problem& problem_;
    const PairLaws& pairs_;
    const ContactScene& contact_;
    Monitor& monitor_;
    JumpOperator& op_;
    PairGraph graph_;
    MixityRule rule_;
    bool follow_mixity_;
    std::optional<ZoneEnergies> zone_;  // where the operator is condensed
    bool focused_ = false;

    std::vector<double> direction_;  // theta over its largest entry
    double size_ = 0.0;
    std::unordered_map<std::uint64_t, Energy> known_;
    double unit_floor_ = 0.0;  // E_all at the unit load of floor_direction_
    std::vector<double> floor_direction_;
    std::vector<std::uint8_t> closed_;
    Response response_;
    // of the step at hand
    const State* before_ = nullptr;
    const State* from_ = nullptr;
    double floor_ = 0.0;      // E_all less the energy before
    double best_ = 0.0;       // lowest I so far, of the step or a candidate
    double tolerance_ = 0.0;  // of energies
    std::int64_t left_ = 0;   // candidates until the limit
    SearchResult* result_ = nullptr;
};

}  // namespace delam
