// SPDX-License-Identifier: BSD-3-Clause
// Chooses the unknowns that form the zone, and the springs at which all others are minimised out. A saved state keeps
// this choice, because the last digits of the next solve depend on it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "reduction/condensed/bulk.hpp"
#include "reduction/operator/response.hpp"

namespace delam {

class ZoneChoice {
public:
    // `bulk` and `problem` must outlive it.
    ZoneChoice(const Bulk& bulk, const Problem& problem);

    std::size_t unknowns() const { return always_.size(); }
    const std::vector<std::uint8_t>& inside() const { return inside_; }
    // Returns springs of the unknowns; -1: held, here and below.
    const std::vector<double>& spring() const { return spring_; }
    std::vector<double> springs_of(const Springs& springs) const;
    // True if no unknown outside the zone has changed.
    bool covers(const Springs& springs) const;
    // Adds unknowns outside the zone that have changed.
    void add_changed(const Springs& springs, std::span<std::uint8_t> wanted) const;

    // Announces rows that may change. Until it is told otherwise, every zone has all of them.
    void expect_changes(std::span<const std::size_t> rows);
    // True if no zone has been chosen for them yet; the next call says no.
    bool take_unmet() { return std::exchange(unmet_, false); }
    // Returns the unknowns whose springs are not those of the previous solve, and keeps them from leaving the zone.
    std::vector<std::uint8_t> changed_since_last(std::span<const double> now);
    void solved_at(std::vector<double> now) { last_ = std::move(now); }
    // Lets all unknowns that are not wanted leave the zone at the next choice.
    void let_go() { age_.assign(age_.size(), forgotten()); }
    void choose(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight);
    // Returns to where no choice has been made.
    void clear();
    // Takes what has changed in the bulk: rows whose frames turn may share unknowns that they had for themselves.
    void renew() {
        find_always();
        clear();
    }

    // A saved state has these numbers. require() and recall() throw Error(DELAM_ERROR_SNAPSHOT) if they contradict
    // themselves or this operator.
    std::vector<double> memory() const;
    void require(std::span<const double> memory) const;
    void recall(std::span<const double> memory);

private:
    // The content of memory().
    struct Saved {
        std::vector<std::uint8_t> age, inside;
        std::vector<double> spring, last;
    };
    Saved parse(std::span<const double> memory) const;
    void find_always();
    double spring_of(const Springs& springs, std::size_t unknown) const;
    std::vector<std::uint8_t> grown(std::vector<std::uint8_t> set, std::size_t size) const;
    bool floats_unless_held(std::span<const std::uint8_t> unknowns, std::span<const double> springs) const;
    // An unknown that has not changed may leave the zone so many choices later. A saved state has two bits for them.
    std::uint8_t forgotten() const {
        constexpr std::int64_t oldest = 3;
        return static_cast<std::uint8_t>(std::min(limits_.zone_forgotten, oldest));
    }

    const Bulk& bulk_;
    const Limits& limits_;
    // [unknowns] 1: stays in the zone, for it anchors rigid motions, or rows share it.
    std::vector<std::uint8_t> always_;
    std::vector<std::int64_t> neighbour_start_, neighbour_;  // of unknowns

    // The present choice, [unknowns].
    std::vector<std::uint8_t> inside_;    // in the zone
    std::vector<double> spring_;          // at which the others are minimised out
    std::vector<double> last_;            // of the previous solve; all 0: there was none, or nothing was held
    std::vector<std::uint8_t> age_;       // number of choices since it last changed or was requested, up to `forgotten`
    std::vector<std::uint8_t> expected_;  // [unknowns] in every zone until the expectation ends; empty: none
    bool unmet_ = false;                  // no zone has been chosen for it yet
};

}  // namespace delam
