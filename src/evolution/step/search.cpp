// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "delam/delam.h"
#include "law/mixity.hpp"

namespace delam {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t seeds = 2;  // places per interface where a new crack is tried besides the ends of lines
constexpr std::ptrdiff_t most_contacts = 64;  // of the bound E_all
constexpr std::size_t fine = 16;              // rings that are all sampled; of longer sweeps about as many
constexpr std::size_t largest_zone = 1500;    // rows in which sweeps of a condensed scene live
constexpr std::size_t largest_crack = 32;     // rings of a new crack, and of the zone about it
constexpr int rounds = 3;                     // of sweeps with the other fronts where they were best

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

std::uint64_t key_of(std::span<const double> adhesion) {
    std::uint64_t h = 14695981039346656037ULL;
    for (const double z : adhesion) {
        h ^= std::bit_cast<std::uint64_t>(z);
        h *= 1099511628211ULL;
        h ^= h >> 29U;
    }
    return h;
}

}  // namespace

Search::Search(const Problem& problem, const PairLaws& pairs, const ContactScene& contact, Monitor& monitor,
               JumpOperator& op)
    : problem_(problem),
      pairs_(pairs),
      contact_(contact),
      monitor_(monitor),
      op_(op),
      graph_(problem.mesh->interfaces()),
      rule_(mixity_rule(pairs, problem.options.mixity_rule)),
      follow_mixity_(rule_ == MixityRule::converged) {
    if (op.offers_zone()) zone_.emplace(op, pairs, contact);
}

// What a search finds depends on its step alone: a march that was saved, rolled back or cancelled goes on with the same
// bits. So nothing is kept from other steps but E_all of the same load, computed from nothing else.
void Search::aim(const State& from) {
    size_ = 0.0;
    for (const double t : from.theta) size_ = std::max(size_, std::abs(t));
    direction_ = from.theta;
    for (double& d : direction_) d /= size_ > 0.0 ? size_ : 1.0;
    if (direction_ != floor_direction_) {
        floor_direction_.clear();
        unit_floor_ = 0.0;
        if (size_ > 0.0) unit_floor_ = debonded_energy(from);
        floor_direction_ = direction_;
    }
    known_.clear();
    closed_ = from.closed;
    response_ = from.response;
}

// E_all with contact tested at a few pairs only: less than with all of it, and a small problem.
double Search::debonded_energy(const State& from) const {
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
    Response response;
    try {
        const bool settled =
            solve_contact(op, coarse, spring_stiffness(pairs_, nothing), direction_, closed, response, false).converged;
        if (settled && response.balanced) return response.stored_bulk + response.load_potential;
    } catch (const Error& error) {
        if (error.status() != DELAM_LIMIT && error.status() != DELAM_ERROR_NUMERICAL) throw;
    }
    return dead ? -infinite : 0.0;
}

std::vector<std::uint8_t> Search::adhering(const Candidate& base) const {
    return adhering_pairs(pairs_, base.adhesion, toughnesses(pairs_, base.mixity));
}

void Search::focus(std::span<const std::uint8_t> wanted) {
    if (!zone_) return;
    std::vector<std::uint8_t> pairs(wanted.begin(), wanted.end());
    for (std::size_t p = 0; p < pairs.size(); ++p)
        if (from_->adhesion[p] != before_->adhesion[p]) pairs[p] = 1;
    focused_ = zone_->focus(*from_, pairs);
}

const Search::Energy& Search::energy(const std::vector<double>& adhesion, std::span<const std::int64_t> next,
                                     std::span<const double> known) {
    const std::uint64_t key = key_of(adhesion);
    if (const auto it = known_.find(key);
        it != known_.end() && (!follow_mixity_ || next.empty() || std::ranges::equal(it->second.next, next)))
        return it->second;
    monitor_.progress("search", result_ != nullptr ? result_->candidates : 0, 0);
    Energy e{infinite, {next.begin(), next.end()}, {}};
    bool within = focused_;
    for (std::size_t p = 0; within && p < adhesion.size(); ++p)
        within = adhesion[p] == from_->adhesion[p] || zone_->inside(p);
    for (std::size_t i = 0; within && follow_mixity_ && i < next.size(); ++i) within = zone_->inside(index(next[i]));
    if (within) {
        if (const std::optional<double> value = zone_->energy(adhesion)) {
            e.value = *value / (size_ * size_);
            for (std::size_t i = 0; follow_mixity_ && i < next.size(); ++i) {
                const auto p = index(next[i]);
                const Driving y = driving_energy(*pairs_.law[p], zone_->jump(p));
                e.next_mixity.push_back(y.total() > 0.0 ? mode_mixity(y.normal, y.tangential) : known[p]);
            }
        }
        return known_[key] = std::move(e);
    }
    try {
        if (!solve_contact(op_, contact_, spring_stiffness(pairs_, adhesion), direction_, closed_, response_, false)
                 .converged)
            return known_[key] = std::move(e);
        e.value = response_.stored_bulk + response_.load_potential + stored_energy(pairs_, adhesion, response_.jump) -
                  gradient_energy(pairs_, adhesion);  // which does not grow with the load
        if (follow_mixity_) {
            const std::vector<double> own = mixities(pairs_, response_.jump, known);
            for (const std::int64_t p : next) e.next_mixity.push_back(own[index(p)]);
        }
    } catch (const Error& error) {
        if (error.status() != DELAM_LIMIT) throw;
    }
    return known_[key] = std::move(e);
}

// What is minimised besides bodies and springs: g, or in the slides' split f + Gc (zeta_before - zeta).
double Search::spent(const Candidate& c) const {
    if (rule_ != MixityRule::variational) return dissipation(pairs_, c.mixity, before_->adhesion, c.adhesion);
    return dissipation_slides(pairs_, c.mixity, before_->adhesion, c.adhesion) +
           stored_slides(pairs_, c.mixity, c.adhesion);
}

double Search::energy_before() const {
    return rule_ == MixityRule::variational ? before_->ledger.energy_slides() : before_->ledger.energy();
}

double Search::compare(Candidate& candidate, std::span<const std::int64_t> next, std::vector<double>* next_mixity) {
    --left_;
    ++result_->candidates;
    const Energy& e = energy(candidate.adhesion, next, candidate.mixity);
    if (next_mixity != nullptr) *next_mixity = e.next_mixity;
    candidate.incremental =
        size_ * size_ * e.value - energy_before() + gradient_energy(pairs_, candidate.adhesion) + spent(candidate);
    result_->lowest = std::min(result_->lowest, candidate.incremental);
    best_ = std::min(best_, candidate.incremental);
    return candidate.incremental;
}

// The growth of one front, or of a new crack, from a base.
class Search::Sweep {
public:
    Sweep(Search& search, const Front& front, const Candidate& base);

    void run();
    std::size_t rings_swept() const { return all_; }
    std::size_t sampled() const { return value_.size() - 1; }
    std::size_t best_at() const { return best_at_; }
    bool stopped() const { return stopped_; }
    // The lowest minimum beyond the base; none where I only grows.
    std::optional<Candidate> best() const {
        if (best_at_ == 0) return std::nullopt;
        return candidate(best_at_);
    }
    // No state between or beyond the samples lies below.
    double bound() const;

private:
    bool touches_debonded(std::span<const std::int64_t> ring) const;
    Candidate candidate(std::size_t n) const;
    void sample(std::size_t n);
    void refine_minimum();
    void close_gap();
    // Of what lies strictly between two samples.
    double between(std::size_t low, std::size_t high) const;

    Search& search_;
    const Candidate& base_;
    std::vector<std::uint8_t> adhering_;
    std::vector<std::vector<std::int64_t>> ring_;
    bool nucleation_;
    std::map<std::size_t, Candidate> value_;   // by rings; adhesion is left out: only I and D are needed
    std::map<std::size_t, double> spent_;      // D
    std::vector<std::vector<double>> mixity_;  // B of a ring, from the nearest sample before it
    std::size_t best_at_ = 0;
    std::size_t all_ = 0;  // rings of the front; those kept may matter and fit
    bool stopped_ = false;
};

// A new crack that meets an older one is an advance of that one, with the mixity that its front brings.
bool Search::Sweep::touches_debonded(std::span<const std::int64_t> ring) const {
    for (const std::int64_t p : ring)
        for (const std::int64_t q : search_.graph_.neighbours(index(p)))
            if (search_.pairs_.law[index(q)] != nullptr && adhering_[index(q)] == 0) return true;
    return false;
}

// Keeps the rings whose dissipation alone does not yet exceed what could be gained.
Search::Sweep::Sweep(Search& search, const Front& front, const Candidate& base)
    : search_(search),
      base_(base),
      adhering_(search.adhering(base)),
      ring_(rings(search.graph_, adhering_, front)),
      nucleation_(front.nucleation),
      all_(ring_.size()) {
    double spent = search.spent(base);
    std::vector<std::uint8_t> wanted(base.adhesion.size(), 0);
    for (std::size_t p = 0; p < wanted.size(); ++p)
        if (base.adhesion[p] != search.before_->adhesion[p]) wanted[p] = 1;
    auto rows = static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), std::uint8_t{1}));
    std::size_t keep = 0;
    while (keep < ring_.size() && (keep < 2 || search.floor_ + spent < search.best_)) {
        rows += ring_[keep].size();
        if (keep > 0 && (search.zone_ && rows * static_cast<std::size_t>(search.pairs_.dimension) > largest_zone))
            break;
        if (nucleation_ && (keep == largest_crack || touches_debonded(ring_[keep]))) break;
        for (const std::int64_t p : ring_[keep]) {
            const Toughness t = search.pairs_.toughness(index(p), base.mixity[index(p)]);
            spent += search.pairs_.weight[index(p)] *
                     (t.total - search.pairs_.law[index(p)]->dissipated(t, base.adhesion[index(p)]));
            wanted[index(p)] = 1;
        }
        ++keep;
    }
    if (keep < ring_.size())
        for (const std::int64_t p : ring_[keep]) wanted[index(p)] = 1;  // whose mixity may be asked for
    ring_.resize(keep);
    mixity_.resize(ring_.size());
    search.focus(wanted);
}

Candidate Search::Sweep::candidate(std::size_t n) const {
    Candidate c = base_;
    const std::vector<double>* latest = nullptr;
    for (std::size_t k = 0; k < n; ++k) {
        if (!mixity_[k].empty()) latest = &mixity_[k];
        for (std::size_t i = 0; i < ring_[k].size(); ++i) {
            const auto p = index(ring_[k][i]);
            if (search_.follow_mixity_ && latest != nullptr) c.mixity[p] = (*latest)[std::min(i, latest->size() - 1)];
            c.adhesion[p] = 0.0;
        }
    }
    if (const auto it = value_.find(n); it != value_.end()) c.incremental = it->second.incremental;
    return c;
}

void Search::Sweep::sample(std::size_t n) {
    if (value_.contains(n)) return;
    Candidate c = candidate(n);
    const std::span<const std::int64_t> next =
        n < ring_.size() ? std::span<const std::int64_t>(ring_[n]) : std::span<const std::int64_t>();
    std::vector<double> next_mixity;
    search_.compare(c, next, &next_mixity);
    if (n < ring_.size()) mixity_[n] = std::move(next_mixity);
    spent_[n] = search_.spent(c);
    value_[n] = Candidate{{}, {}, c.incremental};
}

double Search::Sweep::between(std::size_t low, std::size_t high) const {
    const double first = search_.spent(candidate(low + 1));
    // The gradient energy is not monotone along the front: what is left of it in between is bounded by 0.
    const double gradient =
        search_.pairs_.gradient.empty() ? 0.0 : gradient_energy(search_.pairs_, candidate(high).adhesion);
    return value_.at(high).incremental - gradient - spent_.at(high) + first;
}

double Search::Sweep::bound() const {
    double least = infinite;
    for (auto low = value_.begin(), high = std::next(low); high != value_.end(); low = high++) {
        if (!std::isfinite(high->second.incremental))  // its energy is not known, or nothing balances its load
            least = std::min(least, search_.floor_ + spent_.at(low->first));
        else if (high->first > low->first + 1)
            least = std::min(least, between(low->first, high->first));
    }
    const std::size_t last = value_.rbegin()->first;
    return last < all_ ? std::min(least, search_.floor_ + spent_.at(last)) : least;
}

// Halves the intervals on both sides of the lowest sample until its neighbours are sampled.
void Search::Sweep::refine_minimum() {
    while (search_.left_ > 0) {
        // The lowest sample to which I falls: beyond the first pairs' resistance it may lie above the start and still
        // be worth relaxing.
        auto lowest = value_.end();
        for (auto it = std::next(value_.begin()); it != value_.end(); ++it)
            if (it->second.incremental < std::prev(it)->second.incremental &&
                (lowest == value_.end() || it->second.incremental < lowest->second.incremental))
                lowest = it;
        best_at_ = lowest != value_.end() ? lowest->first : 0;
        if (best_at_ == 0) return;
        const std::size_t at = lowest->first, left = std::prev(lowest)->first;
        const std::size_t right = std::next(lowest) == value_.end() ? at : std::next(lowest)->first;
        if (at - left <= 1 && right - at <= 1) return;
        if (at - left > 1) sample(left + (at - left) / 2);
        if (right - at > 1 && search_.left_ > 0) sample(at + (right - at) / 2);
    }
    stopped_ = true;
}

void Search::Sweep::close_gap() {
    while (true) {
        std::size_t low = 0, high = 0;
        double least = search_.best_ - search_.tolerance_;
        for (auto a = value_.begin(), b = std::next(a); b != value_.end(); a = b++) {
            if (b->first <= a->first + 1 || !std::isfinite(b->second.incremental)) continue;
            if (const double left = between(a->first, b->first); left < least) {
                least = left;
                low = a->first;
                high = b->first;
            }
        }
        if (high == 0) return;
        if (search_.left_ <= 0) {
            stopped_ = true;
            return;
        }
        sample(low + (high - low) / 2);
    }
}

void Search::Sweep::run() {
    sample(0);
    std::size_t stride = 1;
    while (ring_.size() / stride > fine) stride *= 2;
    std::size_t geometric = 1;
    for (std::size_t n = 1; n <= ring_.size(); ++n) {
        // Places that do not move with the front.
        const std::size_t place = ring_[n - 1].size() == 1 ? index(ring_[n - 1].front()) : n;
        const bool wanted = nucleation_ ? n == geometric : n <= 2 || place % stride == 0;
        if (!wanted && n < ring_.size()) continue;
        if (search_.left_ <= 0) {
            stopped_ = true;
            break;
        }
        if (nucleation_) geometric *= 2;
        sample(n);
        if (search_.floor_ + spent_.at(n) >= search_.best_) break;
    }
    if (value_.size() > 1) {
        refine_minimum();
        if (!nucleation_) close_gap();
    }
    search_.result_->bound = std::min(search_.result_->bound, nucleation_ ? infinite : bound());
}

SearchResult Search::run(const State& before, const State& from, std::span<const double> mixity) {
    SearchResult result;
    before_ = &before;
    from_ = &from;
    result_ = nullptr;
    aim(from);
    if (size_ == 0.0) {
        result.words = "no load: nothing to search\n";
        return result;
    }
    result_ = &result;
    left_ = problem_.options.search_limit;
    const double level = from.ledger.increment;
    best_ = level;
    tolerance_ =
        problem_.options.search_tolerance * std::max(std::abs(from.ledger.energy()), std::abs(from.ledger.work));
    floor_ = size_ * size_ * unit_floor_ - energy_before();

    const Candidate start{before.adhesion, {mixity.begin(), mixity.end()}, 0.0};
    const std::vector<Front> fronts =
        find_fronts(graph_, pairs_, adhering(start), toughnesses(pairs_, start.mixity), from.response.jump, seeds);
    std::vector<Candidate> found;
    const auto lower = [](const Candidate& a, const Candidate& b) { return a.incremental < b.incremental; };
    const auto look = [&](const Front& front, const Candidate& base, const char* with) {
        if (left_ <= 0) {
            if (!front.nucleation) result.bound = std::min(result.bound, floor_ + spent(base));
            result.words += text(front.nucleation ? "new crack" : "front", " of interface ", front.interface, with,
                                 ": left out by search_limit\n");
            return;
        }
        Sweep sweep(*this, front, base);
        sweep.run();
        const std::int64_t pair = front.pairs.front() - graph_.first_pair(front.interface);
        result.words += text(front.nucleation ? "new crack" : "front", " of interface ", front.interface, " at pair ",
                             pair, with, ": ", sweep.sampled(), " of ", sweep.rings_swept(), " rings compared",
                             sweep.stopped() ? ", stopped by search_limit" : "");
        if (front.nucleation)
            result.words += ", sizes 1, 2, 4 ... and around the lowest";
        else
            result.words += text(", the others lie at most ", std::max(0.0, best_ - sweep.bound()), " below the best");
        if (auto best = sweep.best()) {
            result.words +=
                text("; lowest at ", sweep.best_at(), ", by ", best->incremental - level, " above the step");
            found.push_back(std::move(*best));
        }
        result.words += "\n";
    };
    for (const Front& front : fronts) look(front, start, "");
    if (fronts.size() > 1) {
        advance_together(start, fronts, found);
        // Each front again with the others where they were best.
        for (int round = 0; round < rounds && !found.empty() && left_ > 0; ++round) {
            const Candidate base = *std::min_element(found.begin(), found.end(), lower);
            if (base.incremental >= level) break;
            for (const Front& front :
                 find_fronts(graph_, pairs_, adhering(base), toughnesses(pairs_, base.mixity), from.response.jump, 0))
                if (!front.nucleation) look(front, base, " from the lowest so far");
            if (std::min_element(found.begin(), found.end(), lower)->incremental >= base.incremental) break;
        }
    }
    break_everything(start, found);
    std::stable_sort(found.begin(), found.end(), lower);
    result.starts = std::move(found);
    return result;
}

// All fronts of debonded regions together, by 1, 2, 4 ... rings.
void Search::advance_together(const Candidate& start, std::span<const Front> fronts, std::vector<Candidate>& found) {
    std::vector<std::vector<std::vector<std::int64_t>>> ring;
    std::size_t longest = 0;
    for (const Front& front : fronts)
        if (!front.nucleation) {
            ring.push_back(rings(graph_, adhering(start), front));
            longest = std::max(longest, ring.back().size());
        }
    if (ring.size() < 2) return;
    std::optional<Candidate> lowest;
    Candidate joint = start;
    std::size_t reached = 0;
    for (std::size_t n = 1; reached < longest && left_ > 0; n *= 2) {
        for (const auto& r : ring)
            for (std::size_t k = reached; k < std::min(n, r.size()); ++k)
                for (const std::int64_t p : r[k]) joint.adhesion[index(p)] = 0.0;
        reached = std::min(n, longest);
        compare(joint, {}, nullptr);
        if (std::isfinite(joint.incremental) && (!lowest || joint.incremental < lowest->incremental)) lowest = joint;
        if (floor_ + spent(joint) >= best_) break;
    }
    result_->words += text("all ", ring.size(), " fronts together: advanced by 1, 2, 4 ... ", reached, " rings\n");
    if (lowest) found.push_back(std::move(*lowest));
}

// One interface debonded altogether, and all of them: whatever their length, which bounds the cracks that begin
// somewhere.
void Search::break_everything(const Candidate& start, std::vector<Candidate>& found) {
    std::int64_t interfaces = 0;
    for (std::size_t p = 0; p < start.adhesion.size(); ++p)
        if (pairs_.law[p] != nullptr) interfaces = std::max(interfaces, graph_.interface_of(p) + 1);
    for (std::int64_t i = interfaces > 1 ? 0 : interfaces; i <= interfaces && left_ > 0;
         ++i) {  // the last: all of them
        Candidate all = start;
        std::vector<std::uint8_t> wanted(all.adhesion.size(), 0);
        for (std::size_t p = 0; p < all.adhesion.size(); ++p) {
            if (pairs_.law[p] == nullptr || all.adhesion[p] == 0.0 || (i < interfaces && graph_.interface_of(p) != i))
                continue;
            all.adhesion[p] = 0.0;
            wanted[p] = 1;
        }
        const auto rows =
            static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), std::uint8_t{1}) * pairs_.dimension);
        if (rows == 0 || floor_ + spent(all) >= best_) continue;
        focused_ = false;
        if (rows <= largest_zone) focus(wanted);
        if (!std::isfinite(compare(all, {}, nullptr))) continue;
        result_->words += text(i == interfaces ? "everything" : text("interface ", i),
                               " debonded: ", all.incremental - from_->ledger.increment, " above the step\n");
        found.push_back(std::move(all));
    }
}

}  // namespace delam
