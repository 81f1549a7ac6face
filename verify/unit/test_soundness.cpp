// SPDX-License-Identifier: BSD-3-Clause
// The check of every state that a call returns: whatever number is not finite, and whichever support is violated, is
// named. FETI reports by how much its supports are violated; nothing else can.
#include <limits>
#include <string>

#include "base/error.hpp"
#include "check.hpp"
#include "evolution/analysis/solver.hpp"
#include "evolution/increment/state_fields.hpp"
#include "evolution/observe/soundness.hpp"
#include "flexure.hpp"
#include "refused.hpp"

using namespace delam;

namespace {

State state_of(const Problem& problem) {
    Monitor monitor;
    Solver solver(problem, monitor, 0.0);
    ck_assert_int_eq(solver.advance(0.1).status, 0);
    return solver.states().shown();
}

Problem small(const char* reduction) {
    unit::Flexure f;
    f.along = 20;
    f.through = 1;
    Problem problem = unit::make_flexure(f);
    problem.options.reduction = reduction;
    return problem;
}

// The message of the refusal, "" if there is none.
std::string refusal(const Problem& problem, const State& state, bool converged) {
    return unit::refusal(DELAM_ERROR_NUMERICAL, [&] { require_sound(problem, state, converged); });
}

void expect_named(const std::string& refusal, const char* name) {
    ck_assert_msg(refusal.find(name) != std::string::npos, "'%s' does not name %s", refusal.c_str(), name);
}

// Plants one of the saved numbers.
class PlantedNumber {
public:
    explicit PlantedNumber(std::size_t target) : target_(target) {}
    const void* member = nullptr;  // where

    static constexpr std::uint32_t version() { return unsaved - 1; }
    void item(double& v) {
        if (at_++ != target_) return;
        v = std::numeric_limits<double>::quiet_NaN();
        member = &v;
    }
    void item(std::vector<double>& v) {
        if (!v.empty()) item(v.back());
    }
    template <class T>
    void item(T& /*v*/) {}

private:
    std::size_t target_, at_ = 0;
};

}  // namespace

TEST(names_what_is_not_finite) {
    const Problem problem = small("feti");
    const State sound = state_of(problem);
    ck_assert(refusal(problem, sound, true).empty());
    struct Planted {
        const char* name;
        double& (*of)(State&);
    };
    const Planted planted[] = {
        {"jump of pair 3 ", [](State& s) -> double& { return s.response.jump[7]; }},
        {"force of pair 2 ", [](State& s) -> double& { return s.response.force[4]; }},
        {"adhesion of pair 5 ", [](State& s) -> double& { return s.adhesion[5]; }},
        {"mixity of pair 0 ", [](State& s) -> double& { return s.mixity.shear[0]; }},
        {"reaction of pattern 'press'", [](State& s) -> double& { return s.response.conjugate[0]; }},
        {"dual force of multiplier 0 ", [](State& s) -> double& { return s.response.multipliers[0]; }},
        {"rigid motion of coefficient 1 ", [](State& s) -> double& { return s.response.rigid[1]; }},
        {"'stored_bulk'", [](State& s) -> double& { return s.ledger.stored_bulk; }},
        {"'stored_interface'", [](State& s) -> double& { return s.ledger.stored_interface; }},
        {"'stored_interface_slides'", [](State& s) -> double& { return s.ledger.stored_interface_linear; }},
        {"'load_potential'", [](State& s) -> double& { return s.ledger.load_potential; }},
        {"'dissipated'", [](State& s) -> double& { return s.ledger.dissipated; }},
        {"'dissipated_slides'", [](State& s) -> double& { return s.ledger.dissipated_linear; }},
        {"'lower'", [](State& s) -> double& { return s.ledger.lower; }},
        {"'increment'", [](State& s) -> double& { return s.ledger.increment; }},
        {"'increment_lower'", [](State& s) -> double& { return s.ledger.increment_lower; }},
        {"'upper'", [](State& s) -> double& { return s.ledger.upper; }},
        {"'work'", [](State& s) -> double& { return s.ledger.work; }},
        {"'defect'", [](State& s) -> double& { return s.ledger.initial; }},
        {"'defect_slides'", [](State& s) -> double& { return s.ledger.initial_linear; }},
        {"'mixity_error'", [](State& s) -> double& { return s.ledger.mixity_error; }}};
    for (const Planted& plant : planted)
        for (const double value : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN()})
            for (const bool converged : {true, false}) {
                State state = sound;
                plant.of(state) = value;
                expect_named(refusal(problem, state, converged), plant.name);
            }
}

// Every row of the tables of a saved state: what a call returns can be saved and loaded.
TEST(refuses_every_saved_number_that_is_not_finite) {
    const Problem problem = small("feti");
    const State sound = state_of(problem);
    std::size_t count = 0;
    for (bool hit = true; hit; ++count) {
        State state = sound;
        PlantedNumber planted(count);
        walk(planted, state);
        hit = planted.member != nullptr;
        const bool may = planted.member == &state.outcome.search_gap;
        ck_assert_msg(refusal(problem, state, true).empty() == !hit, "number %zu is planted unnoticed", count);
        if (may) state.outcome.search_gap = std::numeric_limits<double>::infinity();
        if (may) ck_assert(refusal(problem, state, true).empty());
    }
    ck_assert_uint_ge(count, 25);
}

TEST(names_the_violated_support) {
    const Problem problem = small("feti");
    State state = state_of(problem);
    const SupportError left = state.response.support;
    ck_assert(left.size > 0.0 && left.error <= 1e-10 * left.size);
    state.response.support = {2, 3e-5, 0.5};
    expect_named(refusal(problem, state, true), "support 2 ");
    expect_named(refusal(problem, state, true), "3e-05");
    ck_assert(refusal(problem, state, false).empty());
    state.response.support.error = std::numeric_limits<double>::quiet_NaN();
    expect_named(refusal(problem, state, true), "support 2 ");
    state.response.support = {2, 4e-7, 0.5};
    ck_assert(refusal(problem, state, true).empty());
    // A host that asks for fewer digits of the solve gets fewer.
    Problem loose = problem;
    loose.options.linear_tolerance = 1e-4;
    state.response.support = {2, 4e-5, 0.5};
    ck_assert(refusal(loose, state, true).empty());
    state.response.support.error = 6e-5;
    expect_named(refusal(loose, state, true), "0.0001");
}

TEST(condensed_supports_need_no_report) {
    const Problem problem = small("condensed");
    const State state = state_of(problem);
    ck_assert_int_eq(state.response.support.constraint, -1);
    ck_assert(refusal(problem, state, true).empty());
}
