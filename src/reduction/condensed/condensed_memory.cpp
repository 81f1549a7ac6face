// SPDX-License-Identifier: BSD-3-Clause
// What a saved state keeps of the condensed operator: the choice of the zone, on which the last digits of the next
// solve depend.
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/condensed/condensed.hpp"

namespace delam {

// The near unknowns before any release.
std::vector<std::uint8_t> Condensed::first_near() const {
    std::vector<std::uint8_t> near = near_;
    for (const auto& group : released_)
        for (const std::int64_t i : group) near[index(i)] = 0;
    return near;
}

// Per unknown: springs (outer, now, last) and a code of age, inside, and near before any release; then the released
// groups.
std::vector<double> Condensed::memory() const {
    if (zone_ == nullptr) return {};
    const std::size_t unknowns = always_.size();
    const std::vector<std::uint8_t> near = first_near();
    std::vector<double> m;
    m.reserve(4 * unknowns + 64);
    for (std::size_t i = 0; i < unknowns; ++i) m.push_back(age_[i] + 4 * inside_[i] + 8 * near[i]);
    for (const auto* springs : {&outer_spring_, &spring_, &last_}) m.insert(m.end(), springs->begin(), springs->end());
    m.push_back(multiplications_);
    for (const auto& group : released_) {
        m.push_back(static_cast<double>(group.size()));
        m.insert(m.end(), group.begin(), group.end());
    }
    return m;
}

Condensed::Choice Condensed::parse(std::span<const double> memory) const {
    const std::size_t unknowns = always_.size();
    const auto damaged = [](bool yes) {
        if (yes) fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a zone that the condensed operator cannot have");
    };
    damaged(memory.size() < 4 * unknowns + 1);
    Choice choice;
    auto& [age, inside, near, outer_spring, spring, last, multiplications, groups] = choice;
    for (auto* codes : {&age, &inside, &near}) codes->resize(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) {
        damaged(!(memory[i] >= 0.0 && memory[i] < 16.0) || memory[i] != std::floor(memory[i]));
        const auto code = static_cast<unsigned>(memory[i]);
        age[i] = code & 3U;
        inside[i] = (code >> 2U) & 1U;
        near[i] = (code >> 3U) & 1U;
    }
    std::vector<std::uint8_t> reached = near;
    for (std::size_t at = 4 * unknowns + 1; at < memory.size();) {
        const double size = memory[at++];
        damaged(!(size >= 1.0 && size <= static_cast<double>(memory.size() - at)));
        std::vector<std::int64_t> group;
        for (std::size_t k = 0; k < static_cast<std::size_t>(size); ++k, ++at) {
            damaged(!(memory[at] >= 0.0 && memory[at] < static_cast<double>(unknowns)));
            const auto i = static_cast<std::int64_t>(memory[at]);
            damaged(reached[index(i)] != 0);
            reached[index(i)] = 1;
            group.push_back(i);
        }
        groups.push_back(std::move(group));
    }
    for (std::size_t i = 0; i < unknowns; ++i) {
        damaged(inside[i] != 0 && reached[i] == 0);
        damaged(inside[i] == 0 && always_[i] != 0);
    }
    // Negative zero equals zero, but would be saved with its sign.
    std::size_t at = unknowns;
    for (auto* springs : {&outer_spring, &spring, &last})
        for (std::size_t i = 0; i < unknowns; ++i, ++at) {
            damaged(!(memory[at] >= 0.0 || memory[at] == -1.0));
            springs->push_back(memory[at] + 0.0);
        }
    damaged(!(memory[at] >= 0.0));
    multiplications = memory[at] + 0.0;
    return choice;
}

void Condensed::recall(std::span<const double> memory) {
    const std::size_t unknowns = always_.size();
    if (memory.empty()) {  // before the first zone was chosen
        age_.assign(unknowns, forgotten);
        near_.assign(unknowns, 1);
        inside_.assign(unknowns, 1);
        outer_spring_.clear();
        spring_.clear();
        last_.assign(unknowns, 0.0);
        released_.clear();
        multiplications_ = 0.0;
        zone_.reset();
        inner_.reset();
        outer_.reset();
        return;
    }
    if (std::ranges::equal(memory, this->memory())) return;
    auto [age, inside, near, outer_spring, spring, last, multiplications, groups] = parse(memory);
    zone_.reset();  // as in choose
    age_ = std::move(age);
    inside_ = std::move(inside);
    last_ = std::move(last);
    const bool same_outer =
        outer_ != nullptr && near == first_near() && outer_spring == outer_spring_ && groups == released_;
    if (!same_outer) {
        spring_ = std::move(outer_spring);
        condense_outer(near);
        for (auto& group : groups) release(std::move(group));
    }
    spring_ = std::move(spring);
    condense_inner();
    multiplications_ = multiplications;
}

}  // namespace delam
