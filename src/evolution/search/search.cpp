// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/search/search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/search/candidate_energies.hpp"
#include "evolution/search/sweep.hpp"

namespace delam {

namespace {

// (Measured by verify/bench/constants.py with verify/cases/search/energetic.py: half of `seeds` ends in the same states
// with 0.87 times the candidates, twice within 4e-5 of their energies with 1.21 times as many; both name a jump in the
// second step of "two fronts", where the value itself sees stable growth. Half and twice of the others change nothing.)
constexpr std::size_t seeds = 2;              // places per interface for a new crack besides the ends of lines
constexpr std::ptrdiff_t most_contacts = 64;  // of the bound E_all
constexpr double of_tolerance = 0.01;         // by which a candidate's energy may be too high

bool lower(const Candidate& a, const Candidate& b) { return a.incremental < b.incremental; }

// The candidates of one search, with the words that describe them.
class Trials {
public:
    Trials(SearchRun& search, const State& from, Candidate start)
        : search_(search), level_(from.ledger.increment), from_(from), start_(std::move(start)) {}

    void run();
    std::vector<Candidate> take_found() { return std::move(found_); }

private:
    std::vector<Front> fronts(const Candidate& base, std::size_t new_cracks) const;
    void sweep(const Front& front, const Candidate& base, const char* with);
    void advance_together(std::span<const Front> fronts);
    // Returns a candidate with these pairs as they were before the step.
    Candidate restored(const Candidate& base, std::span<const std::int64_t> pairs) const;
    // Sweeps each front and new crack with the others where they were best, from where they are and from where they
    // began, until none finds a lower state.
    void sweep_from_the_lowest(std::span<const Front> begun);
    void debond_interfaces();

    SearchRun& search_;
    double level_;  // increment of the step
    const State& from_;
    Candidate start_;
    std::vector<Candidate> found_;
};

std::vector<Front> Trials::fronts(const Candidate& base, std::size_t new_cracks) const {
    return find_fronts(search_.graph, search_.pairs(), search_.adhering(base),
                       toughnesses(search_.pairs(), base.mixity), from_.response.jump, new_cracks);
}

void Trials::sweep(const Front& front, const Candidate& base, const char* with) {
    SearchResult& result = search_.result;
    const char* what = front.nucleation ? "new crack" : "front";
    if (search_.left <= 0) {
        if (!front.nucleation) result.left_out.push_back({search_.least_cost(base), {}, {}, {}, {{0, search_.floor}}});
        result.words +=
            text(what, " of interface ", front.interface, with, ": not searched, search_limit is reached\n");
        return;
    }
    Sweep sweep(search_, front, base);
    sweep.run();
    if (&base == &start_) {
        sweep.resolve_growth(from_.adhesion);
        if (sweep.rings_kept() > 0) result.profiles.push_back(sweep.profile());
    }
    const std::int64_t pair = front.pairs.front() - search_.graph.first_pair(front.interface);
    result.words +=
        text(what, " of interface ", front.interface, " at pair ", pair, with, ": ", sweep.sampled(), " of ",
             sweep.rings_swept(), " rings compared", sweep.stopped() ? ", search_limit is reached" : "");
    if (front.nucleation)
        result.words += " (1, 2, 4 ... and next to the lowest)";
    else
        result.words += text(", the energy of the others is at most ", std::max(0.0, search_.best - sweep.bound()),
                             " below the lowest");
    if (auto best = sweep.best()) {
        result.words +=
            text("; lowest at ring ", sweep.best_at(), ", energy ", best->incremental - level_, " above the step's");
        found_.push_back(std::move(*best));
    }
    result.words += "\n";
}

// All fronts of debonded regions together, by 1, 2, 4 ... rings.
void Trials::advance_together(std::span<const Front> fronts) {
    std::vector<std::vector<std::vector<std::int64_t>>> ring;
    std::size_t longest = 0;
    for (const Front& front : fronts)
        if (!front.nucleation) {
            ring.push_back(rings(search_.graph, search_.adhering(start_), front));
            longest = std::max(longest, ring.back().size());
        }
    if (ring.size() < 2) return;
    search_.energies.recheck_contact();
    std::optional<Candidate> lowest;
    Candidate joint = start_;
    std::size_t reached = 0;
    for (std::size_t n = 1; reached < longest && search_.left > 0; n *= 2) {
        for (const auto& r : ring)
            for (std::size_t k = reached; k < std::min(n, r.size()); ++k)
                for (const std::int64_t p : r[k]) {
                    if (!joint.least.empty()) joint.least[index(p)] = search_.least_left(start_, index(p));
                    joint.adhesion[index(p)] = 0.0;
                }
        reached = std::min(n, longest);
        search_.note_lowest(search_.compare(joint, {}, nullptr));
        if (std::isfinite(joint.incremental) && (!lowest || joint.incremental < lowest->incremental)) lowest = joint;
        if (search_.floor + search_.cost(joint) >= search_.best) break;
    }
    search_.result.words +=
        text("all ", ring.size(), " fronts together: advanced by 1, 2, 4 ... ", reached, " rings\n");
    if (lowest) found_.push_back(std::move(*lowest));
}

Candidate Trials::restored(const Candidate& base, std::span<const std::int64_t> pairs) const {
    Candidate out = base;
    for (const std::int64_t p : pairs) {
        out.adhesion[index(p)] = start_.adhesion[index(p)];
        out.mixity.set(index(p), start_.mixity[index(p)]);
    }
    for (std::size_t p = 0; p < out.least.size(); ++p)
        out.least[p] = out.adhesion[p] != start_.adhesion[p] ? search_.least_left(start_, p) : 0.0;
    return out;
}

void Trials::sweep_from_the_lowest(std::span<const Front> begun) {
    while (!found_.empty() && search_.left > 0) {
        const Candidate base = *std::min_element(found_.begin(), found_.end(), lower);
        if (base.incremental >= level_) break;
        for (const Front& front : fronts(base, 0))
            if (!front.nucleation) sweep(front, base, ", other fronts as in the lowest candidate so far");
        std::vector<std::uint8_t> grown(base.adhesion.size(), 0);
        for (std::size_t p = 0; p < grown.size(); ++p) grown[p] = base.adhesion[p] != start_.adhesion[p] ? 1 : 0;
        for (const std::vector<std::int64_t>& pairs : components(search_.graph, grown)) {
            const Candidate without = restored(base, pairs);
            for (const Front& front : begun)
                if (std::ranges::find_first_of(front.pairs, pairs) != front.pairs.end())
                    sweep(front, without, " from where it began, other fronts as in the lowest candidate so far");
        }
        Ledger known = from_.ledger;
        known.increment = base.incremental;
        if (!known.undercut_by(std::min_element(found_.begin(), found_.end(), lower)->incremental)) break;
    }
}

// One interface completely debonded, and all of them, whatever their length: this bounds the cracks that begin
// anywhere.
void Trials::debond_interfaces() {
    const PairLaws& pairs = search_.pairs();
    std::int64_t interfaces = 0;
    for (std::size_t p = 0; p < start_.adhesion.size(); ++p)
        if (pairs.law[p] != nullptr) interfaces = std::max(interfaces, search_.graph.interface_of(p) + 1);
    for (std::int64_t i = interfaces > 1 ? 0 : interfaces; i <= interfaces && search_.left > 0; ++i) {  // last: all
        Candidate all = start_;
        std::vector<std::uint8_t> wanted(all.adhesion.size(), 0);
        for (std::size_t p = 0; p < all.adhesion.size(); ++p) {
            if (pairs.law[p] == nullptr || all.adhesion[p] == 0.0 ||
                (i < interfaces && search_.graph.interface_of(p) != i))
                continue;
            all.adhesion[p] = 0.0;
            wanted[p] = 1;
        }
        const auto rows = index(std::count(wanted.begin(), wanted.end(), std::uint8_t{1}) * pairs.dimension);
        if (rows == 0 || search_.floor + search_.cost(all) >= search_.best) continue;
        search_.energies.lose_focus();
        if (rows <= search_.energies.largest_zone()) search_.energies.focus(wanted);
        if (!std::isfinite(search_.compare(all, {}, nullptr))) continue;
        search_.note_lowest(all.incremental);
        search_.result.words += text(i == interfaces ? "everything" : text("interface ", i), " debonded: energy ",
                                     all.incremental - level_, " above the step's\n");
        found_.push_back(std::move(all));
    }
}

void Trials::run() {
    const std::vector<Front> all = fronts(start_, seeds);
    search_.new_cracks = reach_of_new_cracks(search_, all, start_);
    // New cracks inside come before those at ends, which often reach over a part of them.
    for (const Front& front : all)
        if (!front.nucleation) sweep(front, start_, "");
    for (auto front = all.rbegin(); front != all.rend(); ++front)
        if (front->nucleation) sweep(*front, start_, "");
    if (all.size() > 1) {
        advance_together(all);
        sweep_from_the_lowest(all);
    }
    debond_interfaces();
    std::stable_sort(found_.begin(), found_.end(), lower);
}

}  // namespace

Search::Search(const Problem& problem, const PairLaws& pairs, const ContactScene& contact, Monitor& monitor,
               JumpOperator& op)
    : problem_(problem),
      pairs_(pairs),
      contact_(contact),
      monitor_(monitor),
      op_(op),
      graph_(problem.mesh->interfaces()) {
    if (Zones* zones = op.zones()) zone_.emplace(op, *zones, pairs, contact);
}

// E_all with contact tested at a few pairs only: less than with all of it, and a small problem.
double Search::debonded_energy(const State& from, std::span<const double> direction) const {
    const bool dead = from.ledger.load_potential != 0.0;
    std::vector<double> nothing(from.adhesion);
    for (std::size_t p = 0; p < nothing.size(); ++p)
        if (pairs_.law[p] != nullptr) nothing[p] = 0.0;
    ContactScene coarse = contact_;
    const auto members = [&](std::uint8_t level) {
        return std::ranges::count_if(coarse.level, [&](std::uint8_t l) { return l >= level; });
    };
    while (members(coarse.least_level) > most_contacts &&
           members(static_cast<std::uint8_t>(coarse.least_level + 1)) > 0)
        ++coarse.least_level;
    const std::unique_ptr<JumpOperator> twin = op_.twin();
    JumpOperator& op = twin ? *twin : op_;
    op.recall({});
    std::vector<std::uint8_t> closed(nothing.size(), 0);
    std::vector<std::uint8_t> tested;  // rows
    for (std::size_t p = 0; p < closed.size(); ++p)
        tested.insert(tested.end(), index(pairs_.dimension), coarse.level[p] >= coarse.least_level ? 1 : 0);
    Response response;
    try {
        // One zone for all contact sets.
        if (Zones* zones = twin ? op.zones() : nullptr)
            zones->zone({spring_stiffness(pairs_, nothing), held_rows(coarse, closed)}, tested, true);
        const bool settled =
            solve_contact(op, coarse, spring_stiffness(pairs_, nothing), direction, closed, response, false).converged;
        if (settled && response.balanced) return response.stored_bulk + response.load_potential;
    } catch (const Error& error) {
        if (error.status() != DELAM_LIMIT && error.status() != DELAM_ERROR_NUMERICAL) throw;
    }
    return dead ? -infinite : 0.0;
}

SearchResult Search::run(const Increment& increment, const StepAccount& account, const State& from,
                         const PairMixities& mixity) {
    SearchResult result;
    const double tolerance = problem_.options.search_tolerance * from.ledger.scale();
    CandidateEnergies energies(op_, contact_, monitor_, zone_ ? &*zone_ : nullptr, graph_, increment,
                               account.follows_iterates(), from, of_tolerance * tolerance);
    if (energies.direction() != floor_direction_) {
        floor_direction_.clear();
        unit_floor_ = energies.size() > 0.0 ? debonded_energy(from, energies.direction()) : 0.0;
        floor_direction_ = energies.direction();
    }
    if (energies.size() == 0.0) {
        result.words = "no load: nothing to search\n";
        return result;
    }
    if (zone_) zone_->forget();
    energies.recall(increment.before().search_energies);
    SearchRun run{increment,
                  account,
                  graph_,
                  energies,
                  result,
                  energies.size() * energies.size() * unit_floor_ - account.energy_before(),
                  from.ledger.increment,
                  from.ledger.increment,
                  tolerance,
                  problem_.options.search_limit};
    Candidate start{increment.adhesion_before(), mixity};
    if (account.follows_iterates()) start.least.assign(start.adhesion.size(), 0.0);
    Trials trials(run, from, std::move(start));
    trials.run();
    result.starts = trials.take_found();
    result.energies = energies.memory();
    if (result.error > 0.0) result.words += text("energies of candidates are too high by at most ", result.error, "\n");
    return result;
}

}  // namespace delam
