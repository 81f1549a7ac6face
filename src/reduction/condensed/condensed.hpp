// SPDX-License-Identifier: BSD-3-Clause
// The jump operator with the bodies condensed, once.
//
// Between two solves only the process zone and the contact set change. Most unknowns are therefore minimised out at
// their present springs (elimination.hpp); the rest, the zone, is factored in each solve. If the spring of an unknown
// changes although it was minimised out, the zone is chosen again, which costs the path from its superelement to the
// root.
#pragma once

#include <memory>

#include "reduction/condensed/bulk.hpp"
#include "reduction/dense/dense_zone.hpp"
#include "reduction/operator/jump_operator.hpp"

namespace delam {

class Condensed final : public JumpOperator, private Zones {
public:
    Condensed(std::shared_ptr<Bulk> bulk, const Problem& problem, Monitor& monitor);
    void solve(const Springs& springs, std::span<const double> theta, Response& response) override;
    void expect_changes(std::span<const std::size_t> rows) override;
    OperatorTraits traits() const override { return {.proportional = true}; }
    std::vector<double> displacement(std::span<const double> theta, const Response& response) const override;
    std::vector<double> reaction(std::span<const double> theta, const Response& response) const override;
    double equilibrium_defect(std::span<const double> theta, const Response& response) const override;
    double rounding_energy(std::span<const double> theta, const Response& response) const override;
    std::vector<double> row_stiffness() const override;
    std::span<const std::uint8_t> prescribed_rows() const override { return prescribed_; }
    std::int64_t factorisations() const override { return bulk_->factorisations(); }
    std::unique_ptr<JumpOperator> twin() const override {
        return std::make_unique<Condensed>(bulk_, problem_, monitor_);
    }
    std::string description() const override { return description_of(*bulk_); }
    static std::string description_of(const Bulk& bulk);
    std::vector<double> memory() override { return choice(); }
    void recall(std::span<const double> memory) override;
    void require_memory(std::span<const double> memory) const override {
        if (!memory.empty()) parse(memory);
    }

    Zones* zones() override { return this; }
    DenseZone* zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) override;
    // Sets all rows, forces and energies from a zone solution with these springs; null: no unknown moves.
    void respond(const Springs& springs, std::span<const double> theta, const Zone::Solution* solution,
                 Response& response) const;

private:
    ZoneTraits zone_traits() const override { return {}; }
    bool complete(const Springs& springs, std::span<const double> theta, const Zone::Solution& solution,
                  Response& response) const override;
    // The content of memory().
    std::vector<double> choice() const;
    // An unknown that has not changed may leave the zone so many choices later.
    std::uint8_t forgotten() const { return static_cast<std::uint8_t>(limits().zone_forgotten); }
    const Limits& limits() const { return problem_.options.limits; }
    // The same, read.
    struct Choice {
        std::vector<std::uint8_t> age, inside;
        std::vector<double> spring, last;
    };
    // Throws Error(DELAM_ERROR_SNAPSHOT) if it contradicts itself or this operator.
    Choice parse(std::span<const double> memory) const;
    Poll poll();
    bool covers(const Springs& springs) const;
    void choose(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight = false);
    bool floats_unless_held(std::span<const std::uint8_t> unknowns, std::span<const double> springs) const;
    void condense();
    std::vector<std::uint8_t> grown(std::vector<std::uint8_t> set, std::size_t count) const;
    std::vector<double> skeleton_of(std::span<const double> theta, const Zone::Solution* solution) const;
    std::vector<double> unknowns_of(const Response& response) const;
    double spring_of(const Springs& springs, std::size_t unknown) const;  // -1: held

    std::shared_ptr<Bulk> bulk_;
    Problem problem_;
    Monitor& monitor_;
    std::vector<std::uint8_t> prescribed_;  // [rows]
    std::vector<std::uint8_t>
        always_;  // [unknowns] stay in the zone: anchors of rigid motions, rows that share unknowns
    std::vector<std::int64_t> neighbour_start_, neighbour_;  // of unknowns

    // The present choice, [unknowns]. Springs: -1 is held.
    std::vector<std::uint8_t> inside_;    // in the zone
    std::vector<double> spring_;          // at which the others are minimised out
    std::vector<double> last_;            // of the previous solve; all 0: there was none, or nothing was held
    std::vector<std::uint8_t> age_;       // number of choices since it last changed or was requested, up to `forgotten`
    std::vector<std::uint8_t> expected_;  // [unknowns] in every zone until the expectation ends; empty: none
    bool unmet_ = false;                  // no zone has been chosen for it yet
    Elimination elimination_;
    std::unique_ptr<ZoneEnergy> energy_;
    std::unique_ptr<DenseZone> zone_;
    std::int64_t condensations_ = 0;
};

}  // namespace delam
