// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/search/zone_energies.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam {

namespace {

// (Measured by verify/bench/constants.py with verify/cases/search/energetic.py: half and twice of all numbers here
// change no digit and no count.)
constexpr std::int64_t energy_contact_steps = 200;  // beyond them the energy is not known
// Share of the allowed error within which contact is left undecided.
constexpr double undecided = 1e-3;
constexpr std::size_t most_solved = 64;  // contact sets that are remembered
// Contact outside is checked again in states that differ in so many times as many pairs; then so many zones at most.
constexpr std::size_t recheck_factor = 2;
constexpr int rounds_outside = 5;

}  // namespace

bool ZoneEnergies::focus(const State& known, std::span<const std::uint8_t> wanted, double allowed, bool with_jumps) {
    known_ = &known;
    wanted_.assign(wanted.begin(), wanted.end());
    allowed_ = allowed;
    with_jumps_ = with_jumps;
    checked_ = 0;
    return choose();
}

bool ZoneEnergies::choose() {
    const auto dim = index(pairs_.dimension);
    Springs springs{spring_stiffness(pairs_, known_->adhesion), held_rows(contact_, known_->closed)};
    std::vector<std::uint8_t> rows;
    for (std::size_t p = 0; p < wanted_.size(); ++p) rows.insert(rows.end(), dim, wants(p) ? 1 : 0);
    Zone* zone = zones_.zone(springs, rows, true);
    if (zone == nullptr) return false;
    system_.emplace(*zone, contact_, op_.prescribed_rows(), springs.held, known_->theta);
    system_->stay_near(known_->response.jump);
    if (solved_.empty()) solved_.push_back({known_->adhesion, known_->closed});
    place_.assign(wanted_.size(), -1);
    for (const ZoneSystem::Pair& p : system_->pairs()) place_[p.pair] = static_cast<std::int64_t>(p.first);
    zone->unknowns_at(known_->theta, known_->response);
    zone->ask_for_energies(0.0);
    const std::optional<double> energy = zone_energy(known_->adhesion);
    if (!energy) return false;
    allow_errors(false);
    // The search itself handles the gradient term, which does not depend on displacements.
    offset_ = known_->ledger.energy() - gradient_energy(pairs_, known_->adhesion) - *energy;
    return true;
}

void ZoneEnergies::allow_errors(bool exact) {
    system_->zone().ask_for_energies(exact || (with_jumps_ && !whole_) ? 0.0 : allowed_);
    system_->allow_doubt(exact || with_jumps_ ? 0.0 : undecided * allowed_);
}

std::optional<double> ZoneEnergies::energy(std::span<const double> adhesion, bool exact) {
    if (exact) allow_errors(true);
    std::size_t differ = 0;
    for (std::size_t p = 0; p < adhesion.size(); ++p) differ += adhesion[p] != known_->adhesion[p] ? 1 : 0;
    std::optional<double> energy = zone_energy(adhesion);
    settled_ = !energy || whole_ || (!exact && differ < std::max<std::size_t>(1, recheck_factor * checked_));
    for (int round = 0; !settled_ && round < rounds_outside; ++round) {
        const std::vector<std::size_t> wrong = wrong_outside();
        settled_ = wrong.empty();
        if (settled_) {
            checked_ = std::max(checked_, differ);
            break;
        }
        if (joined_.empty()) joined_.assign(adhesion.size(), 0);
        for (const std::size_t p : wrong) joined_[p] = 1;
        if (!choose()) return std::nullopt;  // not settled: the operator has to tell
        if (exact) allow_errors(true);
        energy = zone_energy(adhesion);
        settled_ = !energy;
    }
    if (exact) allow_errors(false);
    return energy ? std::optional<double>(*energy + offset_) : std::nullopt;
}

std::vector<std::size_t> ZoneEnergies::wrong_outside() const {
    const Solved& last = solved_.back();
    Response response;
    if (!zones_.complete({spring_stiffness(pairs_, last.adhesion), held_rows(contact_, last.closed)}, known_->theta,
                         system_->solution(), response))
        return {};
    std::vector<std::size_t> wrong = pairs_on_the_wrong_side(op_, contact_, known_->theta, last.closed, response);
    std::erase_if(wrong, [&](std::size_t p) { return inside(p); });
    return wrong;
}

bool ZoneEnergies::serves(std::span<const std::uint8_t> wanted) const {
    std::size_t rows = 0;
    for (std::size_t p = 0; p < wanted.size(); ++p) {
        if (wanted[p] == 0 && (joined_.empty() || joined_[p] == 0)) continue;
        if (!inside(p)) return false;
        rows += index(pairs_.dimension);
    }
    return whole_ || system_->zone().jump_rows().size() <= 2 * rows + spare_rows;
}

// Every pair as in the nearest of the solved states that has the same adhesion there. A pair that is debonded for the
// first time begins closed where several fronts have left it closed, and else open.
std::vector<std::uint8_t> ZoneEnergies::start_of_contact(std::span<const double> adhesion) const {
    std::vector<std::pair<std::int64_t, const Solved*>> nearest;
    for (const Solved& s : solved_) {
        std::int64_t differ = 0;
        for (std::size_t p = 0; p < adhesion.size(); ++p) differ += s.adhesion[p] != adhesion[p] ? 1 : 0;
        nearest.emplace_back(differ, &s);
    }
    std::stable_sort(nearest.begin(), nearest.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto dim = index(pairs_.dimension);
    std::vector<std::uint8_t> closed;
    for (const std::size_t row : system_->contact_rows().row) {
        const std::size_t p = index(system_->zone().jump_rows()[row]) / dim;
        const auto same = std::find_if(nearest.begin(), nearest.end(),
                                       [&](const auto& s) { return s.second->adhesion[p] == adhesion[p]; });
        const auto everywhere = [&] {
            return nearest.back().first > 2 * nearest.front().first &&
                   std::all_of(nearest.begin(), nearest.end(), [&](const auto& s) { return s.second->closed[p] != 0; });
        };
        if (same != nearest.end())
            closed.push_back(same->second->closed[p]);
        else if (adhesion[p] > 0.0)
            closed.push_back(nearest.front().second->closed[p]);
        else
            closed.push_back(everywhere() ? 1 : 0);
    }
    return closed;
}

void ZoneEnergies::remember(std::span<const double> adhesion, const std::vector<std::uint8_t>& closed) {
    const auto dim = index(pairs_.dimension);
    Solved solved{{adhesion.begin(), adhesion.end()}, known_->closed};
    for (std::size_t i = 0; i < closed.size(); ++i)
        solved.closed[index(system_->zone().jump_rows()[system_->contact_rows().row[i]]) / dim] = closed[i];
    if (solved_.size() == most_solved) solved_.erase(solved_.begin());
    solved_.push_back(std::move(solved));
}

std::optional<double> ZoneEnergies::zone_energy(std::span<const double> adhesion) {
    const auto dim = index(pairs_.dimension);
    const std::vector<std::int64_t>& rows = system_->zone().jump_rows();
    std::vector<double> spring(rows.size());
    std::vector<Zone::Coupling> couplings;
    for (std::size_t z = 0; z < rows.size(); ++z) {
        const std::size_t row = index(rows[z]), p = row / dim;
        if (pairs_.law[p] == nullptr) continue;
        const Law& law = *pairs_.law[p];
        spring[z] = pairs_.weight[p] * adhesion[p] * law.stiffness(row % dim);
        if (spring[z] > 0.0)
            couplings.push_back({static_cast<std::int64_t>(z), static_cast<std::int64_t>(z), spring[z]});
    }
    system_->load(std::move(couplings), {});
    std::vector<std::uint8_t> closed = start_of_contact(adhesion);
    if (!find_active_set(*system_, system_->contact_rows(), closed, energy_contact_steps).settled) return std::nullopt;
    remember(adhesion, closed);
    double energy = system_->doubt().above + system_->zone().energy_of(known_->theta, system_->solution().unknowns);
    const std::span<const double> jump = system_->jump();
    for (std::size_t z = 0; z < spring.size(); ++z) energy += 0.5 * spring[z] * jump[z] * jump[z];
    return energy;
}

}  // namespace delam
