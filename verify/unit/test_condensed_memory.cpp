// SPDX-License-Identifier: BSD-3-Clause
// The memory of the condensed operator determines its last digits and must therefore be complete: an operator that
// restores it continues with the same bits as the one that saved it, whatever either has computed before.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "check.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "reduction/condensed/condensed.hpp"
#include "same_bits.hpp"
#include "scene/problem.hpp"

using namespace delam;

namespace {

constexpr std::int64_t along = 60;

// Two layers in plane strain with `along` + 1 pairs; the lower one is held at its bottom, the upper one lifted at its
// left edge.
Problem peel() {
    const std::array<double, 1> lengths{60.0}, thickness_of{1.0};
    const std::array<std::int64_t, 1> divisions{along};
    const std::vector<double> thickness(2, thickness_of[0]);
    const std::vector<std::int64_t> across(2, 1);
    auto mesh = std::make_shared<Mesh>(make_layers(2, lengths, divisions, thickness, across, CellType::quad4));
    add_interface(*mesh, 0, 1, 1e-6);
    Problem problem(mesh);
    for (auto& material : problem.material) material = Elastic{1000.0, 0.3};
    problem.patterns.push_back({"lift", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::displacement});
    for (std::int64_t n = 0; n < mesh->node_count(); ++n) {
        const auto place = mesh->node(n);
        if (place[1] == 0.0)
            for (std::int64_t d = 0; d < 2; ++d) problem.constraints.push_back({{2 * n + d}, {1.0}, {}});
        if (place[1] == 2.0 && place[0] == 0.0) problem.constraints.push_back({{2 * n + 1}, {1.0}, {0.1}});
    }
    return problem;
}

// Springs of pairs, the first `broken` of which have none.
Springs springs(const Problem& problem, std::size_t broken) {
    const auto rows = static_cast<std::size_t>(problem.jump_count());
    Springs s{std::vector<double>(rows, 50.0), std::vector<std::uint8_t>(rows, 0), {}};
    std::fill_n(s.stiffness.begin(), 2 * broken, 0.0);
    return s;
}

std::vector<std::uint8_t> rows_of_pairs(const Problem& problem, std::size_t first, std::size_t last) {
    std::vector<std::uint8_t> rows(static_cast<std::size_t>(problem.jump_count()), 0);
    for (std::size_t p = first; p < last; ++p) rows[2 * p] = rows[2 * p + 1] = 1;
    return rows;
}

class Operators {
public:
    Operators() : problem_(peel()), bulk_(std::make_shared<Bulk>(problem_, monitor_)) { bulk_->condense(monitor_); }
    std::unique_ptr<Condensed> make() { return std::make_unique<Condensed>(bulk_, problem_, monitor_); }
    const Problem& problem() const { return problem_; }

private:
    Monitor monitor_;
    Problem problem_;
    std::shared_ptr<Bulk> bulk_;
};

void solve_alike(const Problem& problem, Condensed& one, Condensed& other) {
    for (const std::size_t broken : {3U, 4U, 9U, 30U, 31U}) {
        const std::vector<double> theta{1.0};
        Response a, b;
        one.solve(springs(problem, broken), theta, a);
        other.solve(springs(problem, broken), theta, b);
        ck_assert_msg(same_bits(a.jump, b.jump) && same_bits(a.force, b.force), "%zu broken pairs: other bits", broken);
        ck_assert_msg(same_bits(one.memory(), other.memory()), "%zu broken pairs: another memory", broken);
    }
}

}  // namespace

// A search works only in the zone, often for several steps, before it solves for the whole.
TEST(zone_before_a_solve) {
    Operators all;
    const auto one = all.make(), other = all.make();
    one->zone(springs(all.problem(), 2), rows_of_pairs(all.problem(), 0, 4), false);
    other->recall(one->memory());
    ck_assert(same_bits(one->memory(), other->memory()));
    solve_alike(all.problem(), *one, *other);
}

// Negative zero equals zero; it must not survive in an operator that restores a memory with positive zero.
TEST(zeros_with_a_sign) {
    Operators all;
    const auto one = all.make(), other = all.make();
    const std::vector<double> theta{1.0};
    Response response;
    one->solve(springs(all.problem(), 2), theta, response);
    const std::vector<double> memory = one->memory();
    std::vector<double> with_signs = memory;
    std::size_t zeros = 0;
    for (std::size_t i = static_cast<std::size_t>(all.problem().jump_count()); i < with_signs.size(); ++i)
        if (with_signs[i] == 0.0) {
            with_signs[i] = -0.0;
            ++zeros;
        }
    ck_assert_uint_ge(zeros, 4);
    other->recall(with_signs);
    ck_assert(same_bits(other->memory(), memory));
    other->recall(memory);
    solve_alike(all.problem(), *one, *other);
}

// Also after zones with another history, and after a discarded one.
TEST(another_past) {
    Operators all;
    const auto one = all.make(), other = all.make();
    const std::vector<double> theta{1.0};
    Response response;
    for (const std::size_t broken : {1U, 2U, 7U}) one->solve(springs(all.problem(), broken), theta, response);
    const std::vector<double> memory = one->memory();
    for (const std::size_t broken : {50U, 5U, 6U}) other->solve(springs(all.problem(), broken), theta, response);
    other->recall(memory);
    solve_alike(all.problem(), *one, *other);
    one->recall(memory);
    other->recall({});
    ck_assert(other->memory().empty());
    other->recall(memory);
    solve_alike(all.problem(), *one, *other);
}

// A search for contact announces the rows that may change. Its zone has other digits, but it is no other system, and
// nothing of it is left for the time after.
TEST(expected_changes) {
    Operators all;
    const auto one = all.make(), other = all.make();
    const std::vector<double> theta{1.0};
    std::vector<std::size_t> normal;
    for (std::size_t r = 0; r < static_cast<std::size_t>(all.problem().jump_count()); r += 2) normal.push_back(r);
    one->expect_changes(normal);
    for (const std::size_t closed : {0U, 40U, 20U, 50U, 31U}) {
        Springs s = springs(all.problem(), 3);
        for (std::size_t p = 61 - closed; p < 61; ++p) s.held[2 * p] = 1;
        Response a, b;
        one->solve(s, theta, a);
        other->solve(s, theta, b);
        double jump = 0.0, force = 0.0, error = 0.0, force_error = 0.0;
        for (std::size_t r = 0; r < a.jump.size(); ++r) {
            jump = std::max(jump, std::abs(b.jump[r]));
            force = std::max(force, std::abs(b.force[r]));
            error = std::max(error, std::abs(a.jump[r] - b.jump[r]));
            force_error = std::max(force_error, std::abs(a.force[r] - b.force[r]));
        }
        ck_assert_msg(error <= 1e-10 * jump && force_error <= 1e-10 * force, "%zu closed: %g, %g", closed, error / jump,
                      force_error / force);
    }
    one->expect_changes({});
    other->recall(one->memory());
    solve_alike(all.problem(), *one, *other);
}
