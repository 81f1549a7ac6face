// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/search/candidate_energies.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/increment/path_dissipation.hpp"

namespace delam {

namespace {

// Rows of a dense zone: beyond them whole displacement solves are cheaper. (Measured by verify/bench/constants.py with
// verify/cases/search/energetic.py: half and twice of this number and the next one change no digit and no count.)
constexpr std::size_t largest_dense_zone = 1500;
// Searches for which an energy that they do not ask for is kept.
constexpr std::int64_t forgotten = 4;
// A key is saved in two halves, which a double holds exactly.
constexpr unsigned half = 32;
constexpr double layout = -1.0;  // begins the energies that are saved; in the first layout a key, >= 0, did
constexpr std::size_t numbers_of_an_energy = 7, numbers_in_first_layout = 5;  // besides mixities

bool whole(double v) { return v >= 0.0 && v < std::ldexp(1.0, half) && v == std::floor(v); }

std::uint64_t key_of_halves(double upper, double lower) {
    return (static_cast<std::uint64_t>(upper) << half) | static_cast<std::uint64_t>(lower);
}

std::uint64_t key_of(std::span<const double> adhesion) {
    std::uint64_t h = checksum_start;
    for (const double z : adhesion) {
        h ^= std::bit_cast<std::uint64_t>(z);
        h *= checksum_factor;
        h ^= h >> 29U;
    }
    return h;
}

}  // namespace

CandidateEnergies::CandidateEnergies(JumpOperator& op, const ContactScene& contact, Monitor& monitor,
                                     ZoneEnergies* zone, const PairGraph& graph, const Increment& increment,
                                     bool follow_mixity, const State& from, double allowed)
    : op_(op),
      contact_(contact),
      monitor_(monitor),
      zone_(zone),
      graph_(graph),
      increment_(increment),
      from_(from),
      follow_mixity_(follow_mixity),
      allowed_(allowed),
      size_(max_abs(from.theta)),
      direction_(from.theta),
      closed_(from.closed),
      response_(from.response) {
    for (double& d : direction_) d /= size_ > 0.0 ? size_ : 1.0;
}

std::size_t CandidateEnergies::largest_zone() const {
    const bool dense = zone_ != nullptr && !zone_->whole();
    return dense ? largest_dense_zone : std::numeric_limits<std::size_t>::max();
}

void CandidateEnergies::focus(std::span<const std::uint8_t> wanted) {
    if (zone_ == nullptr) return;
    std::vector<std::uint8_t> pairs(wanted.begin(), wanted.end());
    for (std::size_t p = 0; p < pairs.size(); ++p)
        if (from_.adhesion[p] != increment_.adhesion_before()[p]) pairs[p] = 1;
    if (focused_ && zone_->serves(pairs)) {
        zone_->recheck_contact();
        return;
    }
    lose_focus();
    wanted_ = std::move(pairs);
}

// A pair that has broken at another load has done so with another mixity.
void CandidateEnergies::recall(std::span<const double> memory) {
    const std::size_t patterns = direction_.size();
    if (follow_mixity_ || memory.size() <= patterns || !std::ranges::equal(memory.first(patterns), direction_)) return;
    std::span<const double> left = memory.subspan(patterns);
    if (left.front() != layout) return recall_first_layout(left);
    left = left.subspan(1);
    while (left.size() >= numbers_of_an_energy) {
        if (!whole(left[0]) || !whole(left[1]) || !whole(left[4]) || !whole(left[6])) return;
        Known known{{left[2], left[3], {}, {}, left[5] != 0.0}, static_cast<std::int64_t>(left[4]) + 1};
        const std::uint64_t key = key_of_halves(left[0], left[1]);
        const auto count = static_cast<std::size_t>(left[6]);
        left = left.subspan(numbers_of_an_energy);
        if (left.size() < 2 * count) return;
        for (std::size_t i = 0; i < count; ++i) {
            if (!whole(left[2 * i]) || !(left[2 * i + 1] >= 0.0 && left[2 * i + 1] <= 1.0)) return;
            known.energy.next.push_back(static_cast<std::int64_t>(left[2 * i]));
            known.energy.next_mixity.emplace_back(left[2 * i + 1]);
        }
        left = left.subspan(2 * count);
        known_[key] = std::move(known);
    }
}

// States that earlier versions have saved.
void CandidateEnergies::recall_first_layout(std::span<const double> entries) {
    for (std::size_t at = 0; at + numbers_in_first_layout <= entries.size(); at += numbers_in_first_layout) {
        if (!whole(entries[at]) || !whole(entries[at + 1]) || !whole(entries[at + 4])) return;
        known_[key_of_halves(entries[at], entries[at + 1])] = {{entries[at + 2], entries[at + 3], {}, {}},
                                                               static_cast<std::int64_t>(entries[at + 4]) + 1};
    }
}

std::vector<double> CandidateEnergies::memory() const {
    std::vector<double> m(direction_);
    m.push_back(layout);
    if (follow_mixity_) return m;
    for (const auto& [key, known] : known_) {
        const CandidateEnergy& e = known.energy;
        if (known.age > forgotten || !std::isfinite(e.value)) continue;
        const std::size_t count = e.next_mixity.size();
        for (const double number :
             {static_cast<double>(key >> half), static_cast<double>(key & 0xffffffffU), e.value, e.error,
              static_cast<double>(known.age), e.exact ? 1.0 : 0.0, static_cast<double>(count)})
            m.push_back(number);
        for (std::size_t i = 0; i < count; ++i) {
            m.push_back(static_cast<double>(e.next[i]));
            m.push_back(e.next_mixity[i].shear);
        }
    }
    return m;
}

Mixity CandidateEnergies::breaking_mixity(std::size_t pair, std::span<const double> adhesion, const Mixity& known,
                                          const std::function<std::span<const double>(std::size_t)>& jump) const {
    const PairLaws& pairs = increment_.pairs();
    const std::span<const double> own = jump(pair);
    std::span<const double> opened = own;
    double most = 0.0;
    for (const std::int64_t q : graph_.neighbours(pair)) {
        if (pairs.law[index(q)] == nullptr || adhesion[index(q)] > 0.0) continue;
        const std::span<const double> there = jump(index(q));
        const double driving = there.empty() ? 0.0 : driving_energy(*pairs.law[index(q)], there).total();
        if (driving > most) opened = there;
        most = std::max(most, driving);
    }
    return path_mixity(pairs, pair, own, opened, known);
}

bool CandidateEnergies::within_zone(std::span<const double> adhesion, std::span<const std::int64_t> next) const {
    bool within = focused_;
    for (std::size_t p = 0; within && p < adhesion.size(); ++p)
        within = adhesion[p] == from_.adhesion[p] || zone_->inside(p);
    for (std::size_t i = 0; within && follow_mixity_ && i < next.size(); ++i) within = zone_->inside(index(next[i]));
    return within;
}

void CandidateEnergies::from_zone(std::span<const double> adhesion, const PairMixities& known, bool exact,
                                  CandidateEnergy& e) {
    const std::optional<double> value = zone_->energy(adhesion, exact);
    if (!zone_->settled()) {
        from_operator(adhesion, known, e);
        return;
    }
    if (!value) return;
    e.value = *value / (size_ * size_);
    e.error = zone_->error() / (size_ * size_);
    e.exact = exact;
    for (std::size_t i = 0; follow_mixity_ && i < e.next.size(); ++i) {
        const std::size_t p = index(e.next[i]);
        e.next_mixity.push_back(breaking_mixity(p, adhesion, known[p], [&](std::size_t q) {
            return zone_->inside(q) ? zone_->jump(q) : std::span<const double>();
        }));
    }
}

void CandidateEnergies::from_operator(std::span<const double> adhesion, const PairMixities& known, CandidateEnergy& e) {
    const PairLaws& pairs = increment_.pairs();
    focused_ = false;  // the solve may choose another zone
    e.exact = true;
    try {
        if (!solve_contact(op_, contact_, spring_stiffness(pairs, adhesion), direction_, closed_, response_, false)
                 .converged)
            return;
        e.value = response_.stored_bulk + response_.load_potential + stored_energy(pairs, adhesion, response_.jump) -
                  gradient_energy(pairs, adhesion);  // this energy does not grow with the load
        if (!follow_mixity_) return;
        // A pair breaks on its way between two jumps, and the place depends on their size.
        std::vector<double> jump(response_.jump);
        for (double& j : jump) j *= size_;
        const auto dim = index(pairs.dimension);
        for (const std::int64_t p : e.next)
            e.next_mixity.push_back(breaking_mixity(index(p), adhesion, known[index(p)], [&](std::size_t q) {
                return std::span<const double>(jump).subspan(q * dim, dim);
            }));
    } catch (const Error& error) {
        if (error.status() != DELAM_LIMIT) throw;
    }
}

const CandidateEnergy& CandidateEnergies::at(const std::vector<double>& adhesion, std::span<const std::int64_t> next,
                                             const PairMixities& known, std::int64_t candidates, bool exact) {
    const std::uint64_t key = key_of(adhesion);
    if (const auto it = known_.find(key);
        it != known_.end() && (!exact || it->second.energy.exact) &&
        (!follow_mixity_ || next.empty() || std::ranges::equal(it->second.energy.next, next))) {
        it->second.age = 0;
        return it->second.energy;
    }
    monitor_.progress("search", candidates, 0);
    CandidateEnergy e{infinite, 0.0, {next.begin(), next.end()}, {}};
    if (!wanted_.empty()) {
        focused_ = zone_->focus(from_, wanted_, allowed_, follow_mixity_);
        wanted_.clear();
    }
    if (within_zone(adhesion, next))
        from_zone(adhesion, known, exact, e);
    else
        from_operator(adhesion, known, e);
    return (known_[key] = {std::move(e), 0}).energy;
}

}  // namespace delam
