// SPDX-License-Identifier: BSD-3-Clause
// An analysis on the iterated operator that is cancelled in each of its stages goes on with the same bits: in the
// solver that was cancelled, and in a new one that loads its saved state.
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "evolution/analysis/snapshot.hpp"
#include "evolution/analysis/solver.hpp"
#include "evolution/observe/values.hpp"
#include "flexure.hpp"
#include "refused.hpp"

using namespace delam;

namespace {

constexpr int steps = 4;
constexpr const char* of_setup[] = {"assemble", "analyse"};
constexpr const char* of_steps[] = {"factor", "patch", "linear solve"};

// Counts how often each stage polls, and cancels at one of these polls.
struct Watch {
    std::map<std::string, int> polls;
    std::string stage;
    int stop_at = 0;

    static std::int32_t poll(const char* stage, std::int64_t, std::int64_t, void* user) {
        auto& w = *static_cast<Watch*>(user);
        return ++w.polls[stage] == w.stop_at && w.stage == stage ? 1 : 0;
    }
    void stop(const std::string& in, int at) {
        polls.clear();
        stage = in;
        stop_at = at;
    }
};

struct Analysis {
    Watch watch;
    Monitor monitor;

    Analysis() {
        monitor.progress_user = &watch;
        monitor.progress_callback = &Watch::poll;
    }
};

Problem scene() {
    unit::Flexure f;
    f.dimension = 3;
    f.along = 80;
    f.across = 1;
    f.through = 1;
    Problem problem = unit::make_flexure(f);
    problem.options.reduction = "iterated";
    return problem;
}

std::int32_t advance(Solver& solver, int step) {
    try {
        return solver.advance(static_cast<double>(step) / steps).status;
    } catch (const Error& e) {
        return e.status();
    }
}

void finish(Solver& solver) {
    for (int k = static_cast<int>(solver.states().committed().step) + 1; k <= steps; ++k) {
        ck_assert_int_eq(advance(solver, k), DELAM_OK);
        solver.commit();
    }
}

// Computed once, before the tests, in which check reports.
struct Reference {
    std::vector<std::uint8_t> end;
    std::vector<std::map<std::string, int>> polls;  // of the step to each state

    Reference() {
        Analysis analysis;
        const Problem problem = scene();
        Solver solver(problem, analysis.monitor, 0.0);
        polls.push_back(analysis.watch.polls);
        for (int k = 1; k <= steps; ++k) {
            analysis.watch.stop("", 0);
            if (advance(solver, k) != DELAM_OK) throw Error(DELAM_ERROR_INTERNAL, "a step fails undisturbed");
            solver.commit();
            polls.push_back(analysis.watch.polls);
        }
        if (!(value(solver, "dissipated") > 0.0)) throw Error(DELAM_ERROR_INTERNAL, "nothing is damaged");
        end = save(solver);
    }
};

std::unique_ptr<const Reference> undisturbed;
void analyse_undisturbed() { undisturbed = std::make_unique<const Reference>(); }
BEFORE_TESTS(analyse_undisturbed);

void expect_same(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    ck_assert_uint_eq(a.size(), b.size());
    ck_assert_int_eq(std::memcmp(a.data(), b.data(), a.size()), 0);
}

}  // namespace

// loop: stage. At the first, the middle and the last poll of it.
LOOP_TEST(cancelled_while_it_is_set_up, 0, 2) {
    const Problem problem = scene();
    const Reference& reference = *undisturbed;
    const int polls = reference.polls[0].at(of_setup[loop]);
    for (const int at : {1, (polls + 1) / 2, polls}) {
        Analysis analysis;
        analysis.watch.stop(of_setup[loop], at);
        ck_assert_refused(DELAM_CANCELLED, "", Solver(problem, analysis.monitor, 0.0));
        if (at != polls) continue;
        analysis.watch.stop("", 0);
        Solver solver(problem, analysis.monitor, 0.0);
        finish(solver);
        expect_same(save(solver), reference.end);
    }
}

// loop: stage
LOOP_TEST(cancelled_in_a_step, 0, 3) {
    const Problem problem = scene();
    const Reference& reference = *undisturbed;
    const std::string stage = of_steps[loop];
    int cancelled = 0;
    for (int k = 2; k <= steps && cancelled < 2; ++k) {
        const auto found = reference.polls[static_cast<std::size_t>(k)].find(stage);
        if (found == reference.polls[static_cast<std::size_t>(k)].end()) continue;
        Analysis analysis;
        Solver solver(problem, analysis.monitor, 0.0);
        for (int j = 1; j < k; ++j) {
            ck_assert_int_eq(advance(solver, j), DELAM_OK);
            solver.commit();
        }
        const std::vector<std::uint8_t> before = save(solver);
        analysis.watch.stop(stage, (found->second + 1) / 2);
        ck_assert_int_eq(advance(solver, k), DELAM_CANCELLED);
        analysis.watch.stop("", 0);
        const std::vector<std::uint8_t> kept = save(solver);
        expect_same(kept, before);
        Solver other(problem, analysis.monitor, 0.0);
        load(other, kept);
        finish(other);
        expect_same(save(other), reference.end);
        finish(solver);
        expect_same(save(solver), reference.end);
        ++cancelled;
    }
    ck_assert_int_gt(cancelled, 0);
}
