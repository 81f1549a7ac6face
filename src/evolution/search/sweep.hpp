// SPDX-License-Identifier: BSD-3-Clause
// The growth of one front, or of a new crack, ring by ring from a base; and what all sweeps of one search share.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "evolution/search/candidate_energies.hpp"
#include "evolution/search/fronts.hpp"
#include "evolution/search/search_result.hpp"

namespace delam {

// One search as far as it has come.
struct SearchRun {
    const Increment& increment;
    const StepAccount& account;
    const PairGraph& graph;
    CandidateEnergies& energies;
    SearchResult& result;
    double floor;       // E_all less the energy before
    double level;       // I of the step
    double best;        // lowest I so far, of the step or a candidate
    double tolerance;   // of energies
    std::int64_t left;  // candidates until the limit
    // Pairs of cracks, ascending, and a lower bound of the energy with them debonded, which also holds for every crack
    // with fewer of these pairs.
    struct SmallerCracks {
        std::vector<std::int64_t> pairs;
        double energy;  // E less the energy before, F L
    };
    std::vector<SmallerCracks> smaller_cracks{};
    // [pairs] that the new cracks of this search may reach, if one zone serves them all; empty: a zone for each.
    std::vector<std::uint8_t> new_cracks{};

    const PairLaws& pairs() const { return increment.pairs(); }
    double cost(const Candidate& c) const { return account.cost(c.mixity, c.adhesion); }
    // D of a candidate is no less.
    double least_cost(const Candidate& c) const;
    const std::vector<std::uint8_t>& adhering(const Candidate& base);
    // These pairs and those that new cracks may reach, where a small zone serves both, or always.
    std::vector<std::uint8_t> with_new_cracks(std::vector<std::uint8_t> wanted, bool always) const;
    // Returns what a pair of the base dissipates at least when it breaks, at any mixity if that follows the iterates, F
    // L.
    double least_left(const Candidate& base, std::size_t pair) const;
    // I of a candidate; counts it. next_mixity: those that the pairs `next` show, where the mixity follows the
    // iterates. exact: see CandidateEnergies::at. Samples of a sweep are noted once they are final.
    double compare(Candidate& candidate, std::span<const std::int64_t> next, std::vector<Mixity>* next_mixity,
                   bool exact = false);

    void note_lowest(double incremental) { result.lowest = std::min(result.lowest, incremental); }

    // The last answer of adhering().
    Candidate last_base{};
    std::vector<std::uint8_t> last_adhering{};
};

// SearchRun::new_cracks of these fronts.
std::vector<std::uint8_t> reach_of_new_cracks(SearchRun& search, std::span<const Front> fronts, const Candidate& base);

class Sweep {
public:
    Sweep(SearchRun& search, const Front& front, const Candidate& base);

    void run();
    std::size_t rings_swept() const { return all_; }
    std::size_t rings_kept() const { return ring_.size(); }
    std::size_t sampled() const { return value_.size() - 1; }
    std::size_t best_at() const { return best_at_; }
    bool stopped() const { return stopped_; }
    // The lowest minimum beyond the base; none where I only grows.
    std::optional<Candidate> best() const;
    // Adds samples to those on whose hull the front grows, up to the best one or to where another adhesion has it.
    void resolve_growth(std::span<const double> adhesion);
    GrowthProfile profile() const;
    // No state between or beyond the samples lies below, at the mixities that they show.
    double bound() const;
    LeftOut left_out() const;

private:
    // Keeps the rings whose dissipation alone does not yet exceed what could be gained.
    void keep_rings();
    bool touches_debonded(std::span<const std::int64_t> ring) const;
    Candidate candidate(std::size_t n) const;
    void sample(std::size_t n, bool exact = false);
    // Brings D of all samples up to date with what ring n has shown.
    void update_costs(std::size_t n);
    // Samples these rings anew, with exact energies; false: the limit is reached.
    bool sample_exactly(std::initializer_list<std::size_t> places);
    // A place of ring n that does not move with the front, where rings are single pairs.
    std::size_t place(std::size_t n) const;
    // Returns a place between two samples, about in the middle.
    std::size_t middle(std::size_t low, std::size_t high) const;
    void sample_coarsely();
    void sample_new_crack();
    std::vector<std::int64_t> pairs_within(std::size_t n) const;
    // True if a crack with this energy, and each smaller one, lies too high.
    bool not_promising(double energy) const;
    // True if a larger crack, of this sweep or another one, shows that one of n rings is not promising.
    bool settled_by_a_larger_one(std::size_t n) const;
    // Keeps what the sample says about smaller cracks.
    void bound_smaller_cracks(std::size_t n);
    // Returns the ring whose sample tells whether the growth over an edge is stable; 0: the samples do.
    std::size_t to_resolve(const GrowthProfile& known, const GrowthProfile::Edge& edge) const;
    void refine_minimum();
    void close_gap();
    // Rings without a sample between two that have one, or beyond the last: low, and the next sample.
    struct Gap {
        std::size_t low, high;
        double least;  // no state of these rings, nor that of `high` if its mixities are not all known, lies below
    };
    // Ascending; none: all rings are sampled.
    std::vector<Gap> gaps() const;
    // Returns the gap with the lowest states.
    std::optional<Gap> lowest_gap() const;
    // Lower bound of what lies between two samples.
    double between(std::size_t low, std::size_t high) const;
    // Returns the ring whose sample raises the bound of a gap most: one within it, or one before it whose mixities are
    // not known. 0: no sample can.
    std::size_t best_to_sample(const Gap& gap) const;
    // True if samples have shown the mixities with which the rings up to n break.
    bool shown(std::size_t n) const;
    // D of the rings up to n is no less.
    double least_cost(std::size_t n) const;
    // Adds up least_cost() from what the samples have shown.
    void bound_costs();
    // D of the rings up to n, of which a sample need not exist.
    double cost_of(std::size_t n) const;

    SearchRun& search_;
    const Candidate& base_;
    std::vector<std::uint8_t> adhering_;
    std::vector<std::vector<std::int64_t>> ring_;
    bool nucleation_;
    std::map<std::size_t, Candidate> value_;            // by rings; adhesion is left out: only I and D are needed
    std::map<std::size_t, double> cost_;                // D
    mutable std::map<std::size_t, double> other_cost_;  // where it does not depend on the samples
    std::vector<std::vector<Mixity>> mixity_;           // those of a ring as its sample shows it; empty: not sampled
    std::vector<double> least_cost_;                    // [rings and 1], where the mixity follows the iterates
    std::vector<std::vector<double>> ring_least_;       // of each pair
    std::vector<std::size_t> unknown_;                  // [rings and 1] rings before, whose mixity no sample has shown
    std::set<std::size_t> exact_;                       // rings of exact samples
    double best_before_;                                // lowest I before this sweep
    std::size_t best_at_ = 0;
    std::size_t all_ = 0;  // rings of the front; those kept may matter and fit
    bool stopped_ = false;
};

}  // namespace delam
