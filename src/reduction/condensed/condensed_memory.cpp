// SPDX-License-Identifier: BSD-3-Clause
// A saved state keeps the choice of the zone of the condensed operator, because the last digits of the next solve
// depend on it.
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/condensed/condensed.hpp"

namespace delam {

// Saves three numbers for each unknown: a code of age and inside, the spring at which it is minimised out, and that of
// the last solve.
std::vector<double> Condensed::choice() const {
    if (zone_ == nullptr) return {};
    zone_->forget();  // the factor that earlier solves have left is not saved
    std::vector<double> m;
    m.reserve(3 * always_.size());
    for (std::size_t i = 0; i < always_.size(); ++i) m.push_back(age_[i] + 4 * inside_[i]);
    for (const auto* springs : {&spring_, &last_}) m.insert(m.end(), springs->begin(), springs->end());
    return m;
}

Condensed::Choice Condensed::parse(std::span<const double> memory) const {
    const std::size_t unknowns = always_.size();
    const auto damaged = [](bool yes) {
        if (yes) fail(DELAM_ERROR_SNAPSHOT, "snapshot holds a zone that the condensed operator cannot have");
    };
    damaged(memory.size() != 3 * unknowns);
    Choice choice;
    auto& [age, inside, spring, last] = choice;
    for (auto* codes : {&age, &inside}) codes->resize(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) {
        damaged(!(memory[i] >= 0.0 && memory[i] < 8.0) || memory[i] != std::floor(memory[i]));
        const auto code = static_cast<unsigned>(memory[i]);
        age[i] = code & 3U;
        inside[i] = (code >> 2U) & 1U;
        damaged(inside[i] == 0 && always_[i] != 0);
    }
    // Negative zero equals zero, but would be saved with its sign.
    std::size_t at = unknowns;
    for (auto* springs : {&spring, &last})
        for (std::size_t i = 0; i < unknowns; ++i, ++at) {
            damaged(!(memory[at] >= 0.0 || memory[at] == -1.0));
            springs->push_back(memory[at] + 0.0);
        }
    return choice;
}

void Condensed::recall(std::span<const double> memory) {
    const std::size_t unknowns = always_.size();
    expect_changes({});
    if (memory.empty()) {  // before the first zone was chosen
        age_.assign(unknowns, forgotten());
        inside_.assign(unknowns, 1);
        spring_.clear();
        last_.assign(unknowns, 0.0);
        zone_.reset();
        energy_.reset();
        return;
    }
    if (std::ranges::equal(memory, choice())) {
        zone_->forget();
        return;
    }
    auto [age, inside, spring, last] = parse(memory);
    zone_.reset();  // as in choose
    age_ = std::move(age);
    inside_ = std::move(inside);
    last_ = std::move(last);
    spring_ = std::move(spring);
    condense();
}

}  // namespace delam
