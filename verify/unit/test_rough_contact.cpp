// SPDX-License-Identifier: BSD-3-Clause
// Contact where answers are only as good as a residual says.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "check.hpp"
#include "evolution/contact/contact.hpp"
#include "evolution/contact/contact_levels.hpp"
#include "layer_states.hpp"
#include "reduction/sparse/iterated/iterated.hpp"

using namespace delam;

namespace {

// Answers that are off by this part of the largest, and say so.
class Disturbed final : public JumpOperator {
public:
    Disturbed(JumpOperator& op, double by, bool willing = false) : op_(op), by_(by), willing_(willing) {}
    bool aim(Accuracy accuracy) override {
        tight_ = accuracy == Accuracy::tight && willing_;
        return willing_;
    }
    void solve(const Springs& springs, std::span<const double> theta, Response& r) override {
        op_.solve(springs, theta, r);
        r.error = {};
        if (tight_) return;
        const double jump = by_ * max_abs(r.jump), force = by_ * max_abs(r.force);
        for (std::size_t i = 0; i < r.jump.size(); ++i) {
            seed_ = seed_ * 6364136223846793005u + 1442695040888963407u;
            const double way = (seed_ >> 63U) != 0 ? 1.0 : -1.0;
            (springs.held[i] != 0 ? r.force : r.jump)[i] += way * (springs.held[i] != 0 ? force : jump);
        }
        r.residual = by_;
        r.error = {4.0 * jump, 4.0 * force};
    }
    std::vector<double> reaction(std::span<const double> t, const Response& r) const override {
        return op_.reaction(t, r);
    }
    std::vector<double> displacement(std::span<const double> t, const Response& r) const override {
        return op_.displacement(t, r);
    }
    double equilibrium_defect(std::span<const double> t, const Response& r) const override {
        return op_.equilibrium_defect(t, r);
    }
    std::vector<double> row_stiffness() const override { return op_.row_stiffness(); }
    std::span<const std::uint8_t> prescribed_rows() const override { return op_.prescribed_rows(); }
    std::string description() const override { return op_.description(); }

private:
    JumpOperator& op_;
    double by_;
    bool willing_, tight_ = false;
    std::uint64_t seed_ = 1;
};

}  // namespace

TEST(contact_settles_on_answers_of_any_accuracy) {
    const unit::LayerCase c{.name = "contact", .layers = 3};
    const unit::LayerState scene(c, 3);
    unit::Reference condensed(scene.problem);
    ContactScene contact;
    contact.bonded.assign(scene.springs.held.size() / scene.dim, 0);
    contact.level.assign(contact.bonded.size(), 0);
    for (const double by : {1e-10, 1e-8, 1e-6}) {
        Disturbed disturbed(*condensed, by);
        std::vector<std::uint8_t> closed(contact.bonded.size(), 0);
        Response response;
        const ContactResult result =
            solve_contact(disturbed, contact, scene.springs.stiffness, scene.theta, closed, response, false);
        std::printf("answers off by %.0e: %d active-set steps\n", by, static_cast<int>(result.solves));
        ck_assert(result.converged && result.solves <= 12);
    }
}

// Rows that such answers leave in doubt are solved again, and the contact sets are those of exact answers.
TEST(doubtful_contact_is_solved_again) {
    int wrong = 0;
    for (const unit::LayerCase& c : unit::layer_cases) {
        if (c.floating || c.touching || c.clamped || c.opening != unit::LayerCase::Opening::none) continue;
        const unit::LayerState scene(c, 3);
        unit::Reference condensed(scene.problem);
        ContactScene contact;
        contact.dimension = c.dimension;
        contact.bonded.assign(scene.springs.held.size() / scene.dim, 0);
        contact.level.assign(contact.bonded.size(), 0);
        const auto set_of = [&](JumpOperator& op, std::int64_t& doubts) {
            std::vector<std::uint8_t> closed(contact.bonded.size(), 0);
            Response response;
            const ContactResult result =
                solve_contact(op, contact, scene.springs.stiffness, scene.theta, closed, response, false);
            ck_assert(result.converged);
            doubts += result.doubts;
            return closed;
        };
        Disturbed stubborn(*condensed, 1e-3), willing(*condensed, 1e-3, true);
        std::int64_t none = 0, doubts = 0, solved = 0;
        const std::vector<std::uint8_t> exact = set_of(*condensed, none);
        wrong += set_of(stubborn, doubts) != exact ? 1 : 0;
        ck_assert_msg(set_of(willing, solved) == exact, "%s: another contact set", c.name);
        std::printf("%s: %d doubts\n", c.name, static_cast<int>(doubts));
        ck_assert(none == 0 && solved >= 1 && doubts >= 1 && doubts <= 4);
    }
    ck_assert_msg(wrong > 0, "no decision was in doubt");
}

// A cold search solves roughly until its set seems right, and ends with the set, and the residual, of accurate solves.
TEST(first_contact_is_found_roughly) {
    std::int64_t rough = 0, accurate = 0;
    for (const unit::LayerCase& c : unit::layer_cases) {
        if (c.floating || c.touching || c.opening != unit::LayerCase::Opening::none) continue;
        const unit::LayerState scene(c, 3);
        unit::Reference condensed(scene.problem);
        Monitor monitor;
        Iterated first(scene.problem, monitor), second(scene.problem, monitor);
        Disturbed unable(second, 0.0);
        ContactScene contact;
        contact.dimension = c.dimension;
        contact.bonded.assign(scene.springs.held.size() / scene.dim, 0);
        contact.level = contact_levels(scene.problem.mesh->interfaces());
        const auto set_of = [&](JumpOperator& op, std::int64_t& iterations) {
            std::vector<std::uint8_t> closed(contact.bonded.size(), 0);
            Response response;
            const ContactResult result =
                solve_contact(op, contact, scene.springs.stiffness, scene.theta, closed, response, true);
            // Accurate solves end where rounding does, which differs among kernels of the BLAS; rough ones leave 1e-2.
            ck_assert_msg(result.converged && result.linear_residual <= 1e-9,
                          "%s: converged %d, residual %.1e, %.1e at worst", c.name, result.converged ? 1 : 0,
                          response.residual, result.linear_residual);
            iterations += result.linear_iterations;
            return closed;
        };
        std::int64_t none = 0;
        const std::vector<std::uint8_t> exact = set_of(*condensed, none);
        ck_assert_msg(set_of(first, rough) == exact, "%s: another contact set", c.name);
        ck_assert_msg(set_of(unable, accurate) == exact, "%s: another contact set", c.name);
    }
    std::printf("cold: %d iterations, accurate in every solve: %d\n", static_cast<int>(rough),
                static_cast<int>(accurate));
    ck_assert_double_lt(static_cast<double>(rough), 0.9 * static_cast<double>(accurate));
}
