// SPDX-License-Identifier: BSD-3-Clause
// The jump operator with the bodies condensed, once.
//
// Between two solves only the process zone and the contact set change. Most unknowns are therefore minimised out at
// their present springs (elimination.hpp); the rest, the zone, is factored in each solve. If the spring of an unknown
// changes although it was minimised out, the zone is chosen again, which costs the path from its superelement to the
// root.
#pragma once

#include <memory>
#include <optional>

#include "reduction/condensed/bulk.hpp"
#include "reduction/condensed/tree_zone.hpp"
#include "reduction/condensed/zone_choice.hpp"
#include "reduction/dense/dense_zone.hpp"
#include "reduction/operator/jump_operator.hpp"

namespace delam {

class Condensed final : public JumpOperator, private Zones {
public:
    // before: factorisations of the bulk that were made for others.
    Condensed(std::shared_ptr<Bulk> bulk, const Problem& problem, Monitor& monitor, std::int64_t before = 0);
    void solve(const Springs& springs, std::span<const double> theta, Response& response) override;
    void expect_changes(std::span<const std::size_t> rows) override { choice_.expect_changes(rows); }
    OperatorTraits traits() const override { return {.proportional = true, .renewable = true}; }
    std::vector<double> displacement(std::span<const double> theta, const Response& response) const override;
    std::optional<LinearReading> reading(std::span<const double> weights) const override;
    std::vector<double> reaction(std::span<const double> theta, const Response& response) const override;
    double equilibrium_defect(std::span<const double> theta, const Response& response) const override;
    double rounding_energy(std::span<const double> theta, const Response& response) const override;
    std::vector<double> row_stiffness() const override;
    const BodySystem* system() const override { return &bulk_->system(); }
    std::span<const std::uint8_t> prescribed_rows() const override { return prescribed_; }
    std::int64_t factorisations() const override { return bulk_->factorisations() - before_; }
    std::unique_ptr<JumpOperator> twin() const override {
        return std::make_unique<Condensed>(bulk_, problem_, monitor_, before_);
    }
    bool renew(Renewed what) override;
    std::string description() const override { return description_of(*bulk_); }
    static std::string description_of(const Bulk& bulk);
    std::vector<double> memory() override;
    void recall(std::span<const double> memory) override;
    void require_memory(std::span<const double> memory) const override {
        if (!memory.empty()) choice_.require(memory);
    }

    Zones* zones() override { return this; }
    Zone* zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) override;

private:
    ZoneTraits zone_traits() const override { return {}; }
    bool complete(const Springs& springs, std::span<const double> theta, const Zone::Solution& solution,
                  Response& response) const override;
    Poll poll();
    bool covers(const Springs& springs) const;
    void choose(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight);
    void condense();
    void condense_dense(std::span<const std::uint8_t> active);
    bool tree_pays(std::span<const std::uint8_t> active);
    void forget_zone();
    std::vector<std::int64_t> rows_of(std::span<const std::uint8_t> inside) const;
    // Sets all rows, forces and energies. multiplier: forces of rows of the zone that are no unknown of their own.
    void respond(const Springs& springs, std::span<const double> theta, std::span<const double> skeleton,
                 std::span<const double> multiplier, Response& response) const;
    std::vector<double> unknowns_of(const Response& response) const;

    std::shared_ptr<Bulk> bulk_;
    Problem problem_;
    Monitor& monitor_;
    std::vector<std::uint8_t> prescribed_;  // [rows]
    ZoneChoice choice_;
    std::optional<Elimination> elimination_;
    std::unique_ptr<ZoneEnergy> energy_;
    std::unique_ptr<DenseZone> dense_;
    std::unique_ptr<TreeFactor> tree_;  // of the zones by the tree; null: there was none yet
    bool tree_offered_ = false;
    std::unique_ptr<TreeZone> by_tree_;
    Zone* zone_ = nullptr;  // one of dense_ and by_tree_; null: none is chosen
    SolvedState solved_;    // the last solve; empty: none since the last memory() or recall()
    std::int64_t condensations_ = 0;
    std::int64_t before_;  // factorisations that others have made
};

}  // namespace delam
