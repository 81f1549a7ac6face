// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/search/sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/numbers.hpp"

namespace delam {

namespace {

// Half and twice of these numbers were measured by verify/bench/constants.py with verify/cases/search/energetic.py.
// Those of `fine` and `small_zone` find the same states, with 0.88 to 1.23 and 1.00 times the candidates; half of
// `fine_mixity` moves an energy by 6e-5 with 0.92 times as many, twice by 5e-6 with 1.17.
constexpr std::size_t fine = 8;          // rings that are all sampled; of longer sweeps about as many
constexpr std::size_t fine_mixity = 16;  // where the mixity of a ring is that of the sample before it
// Edges of up to so many rings are sampled throughout: the pairs of a cell differ in mixity, which makes two edges of a
// stable front one of three rings if a sample is missing. (Without it, single-leg bending in 15 steps with solution =
// energetic named a jump that is none, while mixities of earlier loads were still used. Half and twice change nothing
// in verify/bench/analyses.py.)
constexpr std::size_t turns = 4;
constexpr std::size_t small_zone = 512;  // rows of a zone that serves all new cracks

}  // namespace

const std::vector<std::uint8_t>& SearchRun::adhering(const Candidate& base) {
    if (last_adhering.empty() || base.adhesion != last_base.adhesion || base.mixity != last_base.mixity) {
        last_adhering = adhering_pairs(pairs(), base.adhesion, toughnesses(pairs(), base.mixity));
        last_base = base;
    }
    return last_adhering;
}

double SearchRun::compare(Candidate& candidate, std::span<const std::int64_t> next, std::vector<Mixity>* next_mixity,
                          bool exact) {
    --left;
    ++result.candidates;
    const CandidateEnergy& e = energies.at(candidate.adhesion, next, candidate.mixity, result.candidates, exact);
    if (next_mixity != nullptr) *next_mixity = e.next_mixity;
    const double size = energies.size();
    result.error = std::max(result.error, size * size * e.error);
    candidate.incremental = size * size * e.value - account.energy_before() +
                            gradient_energy(pairs(), candidate.adhesion) + cost(candidate);
    best = std::min(best, candidate.incremental);
    return candidate.incremental;
}

std::vector<std::uint8_t> reach_of_new_cracks(SearchRun& search, std::span<const Front> fronts, const Candidate& base) {
    const std::vector<std::uint8_t> adhering = search.adhering(base);
    std::vector<std::uint8_t> reached(adhering.size(), 0);
    std::size_t rows = 0;
    for (const Front& front : fronts) {
        if (!front.nucleation) continue;
        double cost = search.least_cost(base);
        for (const std::vector<std::int64_t>& ring : rings(search.graph, adhering, front)) {
            for (const std::int64_t p : ring) {
                if (reached[index(p)] == 0) rows += index(search.pairs().dimension);
                reached[index(p)] = 1;
                cost += search.least_left(base, index(p));
            }
            if (rows > small_zone) return {};
            if (search.floor + cost >= search.best) break;
        }
    }
    return reached;
}

std::vector<std::uint8_t> SearchRun::with_new_cracks(std::vector<std::uint8_t> wanted, bool always) const {
    std::vector<std::uint8_t> all = wanted;
    for (std::size_t p = 0; p < new_cracks.size(); ++p)
        if (new_cracks[p] != 0) all[p] = 1;
    const auto rows = [&](const std::vector<std::uint8_t>& set) {
        return index(std::count(set.begin(), set.end(), std::uint8_t{1})) * index(pairs().dimension);
    };
    return always || rows(all) <= 2 * rows(wanted) + spare_rows ? all : wanted;
}

// A new crack that meets an older one is an advance of the older one, with the mixity of its front.
bool Sweep::touches_debonded(std::span<const std::int64_t> ring) const {
    for (const std::int64_t p : ring)
        for (const std::int64_t q : search_.graph.neighbours(index(p)))
            if (search_.pairs().law[index(q)] != nullptr && adhering_[index(q)] == 0) return true;
    return false;
}

Sweep::Sweep(SearchRun& search, const Front& front, const Candidate& base)
    : search_(search),
      base_(base),
      adhering_(search.adhering(base)),
      ring_(rings(search.graph, adhering_, front)),
      nucleation_(front.nucleation),
      best_before_(search.best),
      all_(ring_.size()) {
    keep_rings();
}

double SearchRun::least_cost(const Candidate& c) const {
    if (!account.follows_iterates()) return cost(c);
    return std::accumulate(c.least.begin(), c.least.end(), 0.0);
}

// With g convex, g(1) = 0 and g(0) = Gc, what is left of the toughness, Gc - g(zeta), is at least zeta Gc.
double SearchRun::least_left(const Candidate& base, std::size_t pair) const {
    const Law& law = *pairs().law[pair];
    if (account.follows_iterates() && pairs().mixed(pair))
        return pairs().weight[pair] * base.adhesion[pair] * law.least_total();
    const Toughness t = pairs().toughness(pair, base.mixity[pair]);
    return pairs().weight[pair] * (t.total - law.dissipated(t, base.adhesion[pair]));
}

void Sweep::bound_costs() {
    const PairLaws& pairs = search_.pairs();
    least_cost_.assign(1, search_.least_cost(base_));
    ring_least_.assign(ring_.size(), {});
    unknown_.assign(1, 0);
    for (std::size_t n = 0; n < ring_.size(); ++n) {
        const std::vector<Mixity>& known = mixity_[n];
        for (std::size_t i = 0; i < ring_[n].size(); ++i) {
            const std::size_t p = index(ring_[n][i]);
            if (known.empty() || !pairs.mixed(p)) {
                ring_least_[n].push_back(search_.least_left(base_, p));
                continue;
            }
            const Toughness t = pairs.toughness(p, known[std::min(i, known.size() - 1)]);
            ring_least_[n].push_back(pairs.weight[p] * (t.total - pairs.law[p]->dissipated(t, base_.adhesion[p])));
        }
        least_cost_.push_back(std::accumulate(ring_least_[n].begin(), ring_least_[n].end(), least_cost_.back()));
        unknown_.push_back(unknown_.back() + (known.empty() ? 1 : 0));
    }
}

bool Sweep::shown(std::size_t n) const { return unknown_.empty() || unknown_[n] == 0; }

double Sweep::least_cost(std::size_t n) const { return least_cost_.empty() ? cost_of(n) : least_cost_[n]; }

void Sweep::keep_rings() {
    const PairLaws& pairs = search_.pairs();
    double cost = search_.least_cost(base_);
    std::vector<std::uint8_t> wanted(base_.adhesion.size(), 0);
    for (std::size_t p = 0; p < wanted.size(); ++p)
        if (base_.adhesion[p] != search_.increment.adhesion_before()[p]) wanted[p] = 1;
    auto rows = index(std::count(wanted.begin(), wanted.end(), std::uint8_t{1}));
    std::size_t keep = 0;
    while (keep < ring_.size() && (keep < 2 || search_.floor + cost < search_.best)) {
        rows += ring_[keep].size();
        if (keep > 0 && rows * index(pairs.dimension) > search_.energies.largest_zone()) break;
        if (nucleation_ && touches_debonded(ring_[keep])) break;
        for (const std::int64_t i : ring_[keep]) {
            const std::size_t p = index(i);
            cost += search_.least_left(base_, p);
            wanted[p] = 1;
        }
        ++keep;
    }
    if (keep < ring_.size())
        for (const std::int64_t p : ring_[keep]) wanted[index(p)] = 1;  // pairs whose mixity may be needed
    ring_.resize(keep);
    mixity_.resize(ring_.size());
    if (search_.account.follows_iterates()) bound_costs();
    search_.energies.focus(search_.with_new_cracks(std::move(wanted), nucleation_));
}

Candidate Sweep::candidate(std::size_t n) const {
    Candidate c = base_;
    std::size_t latest = ring_.size(), next = 0;  // rings with known mixities
    for (std::size_t k = 0; k < n; ++k) {
        if (!mixity_[k].empty()) latest = k;
        if (next <= k)
            for (next = k + 1; next < ring_.size() && mixity_[next].empty();) ++next;
        const double way = next < ring_.size() && latest < ring_.size()
                               ? static_cast<double>(k - latest) / static_cast<double>(next - latest)
                               : 0.0;
        for (std::size_t i = 0; i < ring_[k].size(); ++i) {
            const auto p = index(ring_[k][i]);
            c.adhesion[p] = 0.0;
            if (!search_.account.follows_iterates() || latest == ring_.size()) continue;
            const auto at = [&](std::size_t ring) { return mixity_[ring][std::min(i, mixity_[ring].size() - 1)]; };
            c.mixity.set(p, way > 0.0 ? (1.0 - way) * at(latest) + way * at(next) : at(latest));
        }
    }
    if (const auto it = value_.find(n); it != value_.end()) c.incremental = it->second.incremental;
    for (std::size_t k = 0; k < n && !ring_least_.empty(); ++k)
        for (std::size_t i = 0; i < ring_[k].size(); ++i) c.least[index(ring_[k][i])] = ring_least_[k][i];
    return c;
}

std::optional<Candidate> Sweep::best() const {
    if (best_at_ == 0) return std::nullopt;
    return candidate(best_at_);
}

void Sweep::sample(std::size_t n, bool exact) {
    if (value_.contains(n) && (!exact || exact_.contains(n))) return;
    if (exact) exact_.insert(n);
    Candidate c = candidate(n);
    const std::span<const std::int64_t> next =
        n < ring_.size() ? std::span<const std::int64_t>(ring_[n]) : std::span<const std::int64_t>();
    std::vector<Mixity> next_mixity;
    search_.compare(c, next, &next_mixity, exact);
    if (n < ring_.size() && !next_mixity.empty()) {
        mixity_[n] = std::move(next_mixity);
        bound_costs();
    }
    cost_[n] = search_.cost(c);
    value_[n].incremental = c.incremental;
    if (search_.account.follows_iterates()) update_costs(n);
}

// Ring n changes the mixities of the rings between its neighbours that are known, and nothing else of D.
void Sweep::update_costs(std::size_t n) {
    std::size_t low = n, high = n + 1;
    while (low > 0 && mixity_[low - 1].empty()) --low;
    while (high < ring_.size() && mixity_[high].empty()) ++high;
    double change = 0.0;
    for (auto it = value_.lower_bound(low); it != value_.end(); ++it) {
        const auto [m, sampled] = *it;
        if (m <= high || std::prev(it)->first < high) change = search_.cost(candidate(m)) - cost_.at(m);
        cost_.at(m) += change;
        it->second.incremental += change;
    }
    search_.best = best_before_;
    for (const auto& [m, sampled] : value_) search_.best = std::min(search_.best, sampled.incremental);
}

std::size_t Sweep::place(std::size_t n) const { return ring_[n - 1].size() == 1 ? index(ring_[n - 1].front()) : n; }

// Returns the place in the middle half that is the multiple of the highest power of two: the energies of steps between
// which the front has moved are then of the same states.
std::size_t Sweep::middle(std::size_t low, std::size_t high) const {
    const std::size_t quarter = (high - low) / 4;
    std::size_t best = low + (high - low) / 2;
    for (std::size_t n = low + std::max<std::size_t>(1, quarter); n + std::max<std::size_t>(1, quarter) <= high; ++n)
        if (std::countr_zero(place(n)) > std::countr_zero(place(best))) best = n;
    return best;
}

double Sweep::cost_of(std::size_t n) const {
    if (search_.account.follows_iterates()) return search_.cost(candidate(n));
    auto known = other_cost_.find(n);
    if (known == other_cost_.end()) known = other_cost_.emplace(n, search_.cost(candidate(n))).first;
    return known->second;
}

// E falls from ring to ring, and D grows.
double Sweep::between(std::size_t low, std::size_t high) const {
    const double first = least_cost(low + 1);
    if (!std::isfinite(value_.at(high).incremental))  // its energy is unknown, or it has no equilibrium
        return search_.floor + first;
    // The gradient energy is not monotone along the front; between samples its lower bound is 0.
    const double gradient =
        search_.pairs().gradient.empty() ? 0.0 : gradient_energy(search_.pairs(), candidate(high).adhesion);
    return value_.at(high).incremental - search_.result.error - gradient - cost_.at(high) + first;
}

std::vector<Sweep::Gap> Sweep::gaps() const {
    std::vector<Gap> found;
    for (auto low = value_.begin(), high = std::next(low); high != value_.end(); low = high++)
        if (high->first > low->first + 1 || !shown(high->first) || !std::isfinite(high->second.incremental))
            found.push_back({low->first, high->first, between(low->first, high->first)});
    const std::size_t last = value_.rbegin()->first;
    if (last < all_)
        found.push_back({last, ring_.size(), search_.floor + least_cost(std::min(last + 1, ring_.size()))});
    return found;
}

std::optional<Sweep::Gap> Sweep::lowest_gap() const {
    const std::vector<Gap> all = gaps();
    const auto lowest = std::ranges::min_element(all, {}, &Gap::least);
    return lowest != all.end() ? std::optional(*lowest) : std::nullopt;
}

LeftOut Sweep::left_out() const {
    LeftOut out;
    if (ring_least_.empty()) {
        out.places.push_back({0, bound()});
        return out;
    }
    out.least = base_.least;
    out.ring = ring_;
    out.ring_least = ring_least_;
    for (const Gap& gap : gaps()) {
        const std::size_t first = std::min(gap.low + 1, ring_.size());
        out.places.push_back({first, gap.least - least_cost(first)});
    }
    return out;
}

double Sweep::bound() const {
    const std::optional<Gap> gap = lowest_gap();
    return gap ? gap->least : infinite;
}

bool Sweep::sample_exactly(std::initializer_list<std::size_t> places) {
    for (const std::size_t n : places) {
        if (exact_.contains(n)) continue;
        if (search_.left <= 0) return false;
        sample(n, true);
    }
    return true;
}

// Halves the intervals on both sides of the lowest sample until its neighbours are sampled. Which of the three is
// lowest must not depend on contact that is left undecided, or was left unchecked in an earlier step: they are sampled
// exactly.
void Sweep::refine_minimum() {
    while (search_.left > 0) {
        // The lowest sample down to which I decreases: beyond the first pairs' resistance it may lie above the start
        // and still be worth relaxing.
        auto lowest = value_.end();
        for (auto it = std::next(value_.begin()); it != value_.end(); ++it)
            if (it->second.incremental < std::prev(it)->second.incremental &&
                (lowest == value_.end() || it->second.incremental < lowest->second.incremental))
                lowest = it;
        best_at_ = lowest != value_.end() ? lowest->first : 0;
        if (best_at_ == 0) return;
        const std::size_t at = lowest->first, left = std::prev(lowest)->first;
        const std::size_t right = std::next(lowest) == value_.end() ? at : std::next(lowest)->first;
        if (at - left <= 1 && right - at <= 1) {
            if (exact_.contains(left) && exact_.contains(at) && exact_.contains(right)) return;
            if (!sample_exactly({left, at, right})) break;
            continue;
        }
        if (at - left > 1) sample(middle(left, at));
        if (right - at > 1 && search_.left > 0) sample(middle(at, right));
    }
    stopped_ = true;
}

// A sample within a gap raises both E and D of a part of its rings; one before it raises D of all of them.
std::size_t Sweep::best_to_sample(const Gap& gap) const {
    double most = 0.0;
    std::size_t best = 0;
    for (auto low = value_.begin(); low != value_.end() && low->first <= gap.low; ++low) {
        const auto next = std::next(low);
        const std::size_t high = low->first == gap.low ? gap.high : next->first;
        if (high <= low->first + 1 && value_.contains(high)) continue;
        if (!value_.contains(high)) return high;
        double gain = 0.0;
        if (!unknown_.empty())
            gain = cost_.at(high) - cost_.at(low->first) - (least_cost(high) - least_cost(low->first));
        if (low->first == gap.low) {
            const double falls =
                low->second.incremental - cost_.at(low->first) - (value_.at(high).incremental - cost_.at(high));
            gain += std::isfinite(falls) ? falls : infinite;
        }
        if (gain > most) {
            most = gain;
            best = middle(low->first, high);
        }
    }
    return best;
}

void Sweep::close_gap() {
    while (true) {
        const std::optional<Gap> gap = lowest_gap();
        if (!gap || gap->least >= search_.best - search_.tolerance) return;
        const std::size_t next = best_to_sample(*gap);
        if (next == 0 || value_.contains(next)) return;
        if (search_.left <= 0) {
            stopped_ = true;
            return;
        }
        sample(next);
    }
}

GrowthProfile Sweep::profile() const {
    GrowthProfile profile{search_.graph.interface_of(index(ring_.front().front())), ring_, {}};
    for (const auto& [n, sampled] : value_) {
        const double gradient =
            search_.pairs().gradient.empty() ? 0.0 : gradient_energy(search_.pairs(), candidate(n).adhesion);
        profile.samples.push_back({n, sampled.incremental - cost_.at(n) - gradient, cost_.at(n) + gradient});
    }
    return profile;
}

// Growth that is stable over a whole edge has lower samples anywhere within it, but neighbouring rings may take turns.
std::size_t Sweep::to_resolve(const GrowthProfile& known, const GrowthProfile::Edge& edge) const {
    if (edge.to <= edge.from + 2) return 0;
    if (!known.sampled_within(edge)) return middle(edge.from, edge.to);
    if (edge.to > edge.from + turns) return 0;
    std::size_t n = edge.from + 1;
    while (n < edge.to && value_.contains(n)) ++n;
    return n < edge.to ? n : 0;
}

void Sweep::resolve_growth(std::span<const double> adhesion) {
    std::size_t last = 0;
    while (last < ring_.size() &&
           adhesion[index(ring_[last].front())] <= 0.5 * base_.adhesion[index(ring_[last].front())])
        ++last;
    last = std::max(last, best_at_);
    for (bool open = last > 2; open && search_.left > 0;) {
        sample(last);
        open = false;
        const GrowthProfile known = profile();
        for (const GrowthProfile::Edge& edge : known.edges(0, last))
            if (const std::size_t next = to_resolve(known, edge); next != 0 && search_.left > 0) {
                sample(next);
                open = true;
            }
    }
}

// New cracks of sizes 1, 2, 4 ... and the largest, from above: what a crack releases is at least what smaller ones do.
// Where no smaller one can be promising, they need no energy. Where the mixity follows the iterates, that of a ring is
// known from the size before it: from below.
void Sweep::sample_new_crack() {
    std::vector<std::size_t> sizes;
    for (std::size_t n = 1; n < ring_.size(); n *= 2) sizes.push_back(n);
    if (!ring_.empty()) sizes.push_back(ring_.size());
    const bool from_below = search_.account.follows_iterates();
    if (!from_below) std::reverse(sizes.begin(), sizes.end());
    for (const std::size_t n : sizes) {
        if (search_.left <= 0) {
            stopped_ = true;
            return;
        }
        if (!from_below && settled_by_a_larger_one(n)) return;
        sample(n);
        if (from_below && search_.floor + least_cost(n) >= search_.best) return;
        if (!from_below) bound_smaller_cracks(n);
    }
}

std::vector<std::int64_t> Sweep::pairs_within(std::size_t n) const {
    std::vector<std::int64_t> pairs;
    for (std::size_t k = 0; k < n; ++k) pairs.insert(pairs.end(), ring_[k].begin(), ring_[k].end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

bool Sweep::not_promising(double energy) const { return energy + (1.0 - promising) * cost_of(1) >= search_.level; }

void Sweep::bound_smaller_cracks(std::size_t n) {
    if (!search_.pairs().gradient.empty() || !std::isfinite(value_.at(n).incremental)) return;
    search_.smaller_cracks.push_back({pairs_within(n), value_.at(n).incremental - search_.result.error - cost_.at(n)});
}

bool Sweep::settled_by_a_larger_one(std::size_t n) const {
    const std::vector<std::int64_t> pairs = pairs_within(n);
    return std::any_of(
        search_.smaller_cracks.begin(), search_.smaller_cracks.end(), [&](const SearchRun::SmallerCracks& b) {
            return not_promising(b.energy) && std::includes(b.pairs.begin(), b.pairs.end(), pairs.begin(), pairs.end());
        });
}

// Rings far apart, at positions that do not move with the front.
void Sweep::sample_coarsely() {
    const std::size_t most = search_.account.follows_iterates() ? fine_mixity : fine;
    std::size_t stride = 1;
    while (ring_.size() / stride > most) stride *= 2;
    for (std::size_t n = 1; n <= ring_.size(); ++n) {
        if (n > 2 && place(n) % stride != 0 && n < ring_.size()) continue;
        if (search_.left <= 0) {
            stopped_ = true;
            return;
        }
        sample(n);
        if (search_.floor + least_cost(n) >= search_.best) return;
    }
}

void Sweep::run() {
    sample(0);
    if (nucleation_)
        sample_new_crack();
    else
        sample_coarsely();
    // A sample that closes a gap may be the lowest, or show mixities with which another one is.
    for (std::size_t known = 1; known != value_.size();) {
        known = value_.size();
        refine_minimum();
        if (!nucleation_) close_gap();
    }
    for (const auto& [n, sampled] : value_) search_.note_lowest(sampled.incremental);
    if (!nucleation_) search_.result.left_out.push_back(left_out());
}

}  // namespace delam
