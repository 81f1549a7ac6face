// SPDX-License-Identifier: BSD-3-Clause
// Work that an analysis leaves out changes nothing: contact where pairs cannot close, mixity where the law does not
// depend on it, displacements that nobody reads. And the bodies are factored only once.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "check.hpp"
#include "evolution/analysis/plan.hpp"
#include "evolution/analysis/solver.hpp"
#include "evolution/observe/fields.hpp"
#include "evolution/observe/values.hpp"
#include "flexure.hpp"

using namespace delam;

namespace {

constexpr int steps = 8;

unit::Flexure linear_law() {
    unit::Flexure f;
    f.law.normal_onset = f.law.tangential_onset = 100.0;
    for (double Law::*exponent :
         {&Law::onset_exponent_1, &Law::onset_exponent_2, &Law::toughness_exponent_1, &Law::toughness_exponent_2})
        f.law.*exponent = 1.0;
    return f;
}

// All values that do not need displacements, step by step.
std::vector<double> history(const Problem& problem, Solver** kept = nullptr) {
    static Monitor monitor;
    auto solver = std::make_unique<Solver>(problem, monitor, 0.0);
    std::vector<double> all;
    for (int k = 1; k <= steps; ++k) {
        ck_assert_int_eq(solver->advance(static_cast<double>(k) / steps).status, 0);
        solver->commit();
        for (const std::string& key : value_names(problem))
            if (key.rfind("kkt_", 0) != 0 && key.rfind("mesh_", 0) != 0 && key.rfind("rotation_", 0) != 0 &&
                key != "buckling_ratio")
                all.push_back(value(*solver, key));
    }
    ck_assert(value(*solver, "dissipated") > 0.0);
    if (kept != nullptr) *kept = solver.release();
    return all;
}

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    ck_assert_uint_eq(a.size(), b.size());
    ck_assert_int_eq(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
}

}  // namespace

LOOP_TEST(mixity_left_out_changes_no_digit, 0, 2) {
    Problem problem = unit::make_flexure(linear_law());
    problem.options.reduction = loop == 0 ? "condensed" : "feti";
    ck_assert(!problem.interfaces[0].law->depends_on_mixity());
    Solver* left_out = nullptr;
    Solver* computed = nullptr;
    const auto without = history(problem, &left_out);
    problem.options.mixity = "always";
    const auto with = history(problem, &computed);
    expect_same_bits(without, with);
    double seen = 0.0;
    for (std::size_t p = 0; p < left_out->states().shown().mixity.size(); ++p) {
        ck_assert(left_out->states().shown().mixity.shear[p] == 0.0);
        seen = std::max(seen, computed->states().shown().mixity.shear[p]);
    }
    ck_assert(seen > 0.5);  // bending shears the interface, so there was something to leave out
    delete left_out;
    delete computed;
}

TEST(mixity_stays_where_the_law_sees_it) {
    Law law = linear_law().law;
    ck_assert(!law.depends_on_mixity());
    for (double Law::*member :
         {&Law::normal_onset, &Law::tangential_toughness, &Law::onset_exponent_1, &Law::toughness_exponent_2}) {
        Law other = law;
        other.*member *= 1.5;
        ck_assert(other.depends_on_mixity());
    }
    const Toughness at_one_end = law.toughness(0.0);
    for (const double b : {1e-12, 0.1, 1.0 / 3.0, 0.7, 1.0}) {
        ck_assert(law.toughness(b).onset == at_one_end.onset);
        ck_assert(law.toughness(b).total == at_one_end.total);
    }
}

LOOP_TEST(contact_left_out_changes_no_digit, 0, 2) {
    Problem problem = unit::make_flexure({});
    if (loop == 1) {  // one layer pulled off the other by its whole face: no pair can close
        unit::Flexure f;
        f.along = 12;
        f.through = 1;
        f.notch = 0.0;
        problem = unit::make_flexure(f);
        problem.constraints.clear();
        problem.patterns[0] = {"lift", {0.0, 1.0}, {0.0, 5e-9}, Pattern::Drives::displacement};
        for (std::int64_t node = 0; node < problem.mesh->node_count(); ++node)
            for (int c = 0; c < 2; ++c)
                problem.constraints.push_back(
                    {{2 * node + c}, {1.0}, {c == 1 && node >= problem.mesh->node_count() / 2 ? 1e4 : 0.0}});
    }
    const auto without = history(problem);
    problem.options.contact = "always";
    expect_same_bits(without, history(problem));
}

LOOP_TEST(bodies_are_factored_once_and_displacements_recovered_on_request, 0, 3) {
    Problem problem = unit::make_flexure({});
    problem.options.reduction = loop == 0 ? "condensed" : "feti";
    problem.options.subdomains = loop == 2 ? 5 : 0;
    Solver* solver = nullptr;
    history(problem, &solver);
    const double factorisations = loop == 0 ? 1.0 : loop == 1 ? 2.0 : 5.0;
    ck_assert(value(*solver, "bulk_factorisations") == factorisations);
    ck_assert(value(*solver, "field_recoveries") == 0.0);
    for (const char* key : {"jump", "traction", "adhesion", "mixity", "contact"}) field(solver->observer(), key, -1);
    ck_assert(value(*solver, "field_recoveries") == 0.0);
    field(solver->observer(), "displacement", -1);
    ck_assert(value(*solver, "field_recoveries") == 1.0);
    field(solver->observer(), "displacement", -1);
    field(solver->observer(), "stress", -1);
    value(*solver, "kkt_gap");
    ck_assert(value(*solver, "field_recoveries") == 1.0);
    solver->advance(1.1);
    field(solver->observer(), "displacement", -1);
    ck_assert(value(*solver, "field_recoveries") == 2.0);
    ck_assert(value(*solver, "bulk_factorisations") == factorisations);
    delete solver;
}

// The forecast says what the solver says afterwards, but factors nothing.
// loop: realisation, and whether all displacements are prescribed.
LOOP_TEST(the_plan_is_known_beforehand, 0, 8) {
    Problem problem = unit::make_flexure({});
    constexpr const char* ways[] = {"auto", "condensed", "iterated", "feti"};
    problem.options.reduction = ways[loop % 4];
    if (loop >= 4) {
        problem.constraints.clear();
        for (std::int64_t dof = 0; dof < 2 * problem.mesh->node_count(); ++dof)
            problem.constraints.push_back(
                {{dof}, {1.0}, {dof % 2 == 1 && dof >= problem.mesh->node_count() ? 1e4 : 0.0}});
    }
    std::vector<std::string> stages;
    Monitor monitor;
    monitor.progress_user = &stages;
    monitor.progress_callback = [](const char* stage, std::int64_t, std::int64_t, void* user) {
        static_cast<std::vector<std::string>*>(user)->emplace_back(stage);
        return 0;
    };
    const Forecast before = forecast(problem, monitor);
    ck_assert(loop >= 4 || (before.setup > 0.0 && before.memory > 0.0));
    for (const char* stage : {"factor", "condense", "displacement", "subdomain"})
        ck_assert_msg(std::ranges::count(stages, stage) == 0, "%s", stage);
    const Solver solver(problem, monitor, 0.0);
    const std::vector<PlanItem> after = plan_of(solver);
    ck_assert_uint_eq(before.plan.size(), after.size());
    ck_assert(before.memory == solver.stepper().reduction().own().bytes);
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (ways[loop % 4] == std::string("feti") && after[i].subject == "FETI")
            continue;  // its partition is not known
        const std::string forecast_words = plan_in_words({before.plan[i]}), words = plan_in_words({after[i]});
        ck_assert_str_eq(forecast_words.c_str(), words.c_str());
    }
}

// Loads in proportion that damage nothing need no solve: the displacements grow with them. Alternation solves always.
TEST(nothing_is_solved_where_loads_grow_alone) {
    Problem problem = unit::make_flexure({});
    problem.options.step_control = "fixed";
    Monitor monitor;
    Solver grown(problem, monitor, 0.0);
    problem.options.minimisation = "alternate";
    Solver solved(problem, monitor, 0.0);
    int alone = 0;
    for (int k = 1; k <= 12; ++k) {
        for (Solver* solver : {&grown, &solved}) {
            ck_assert_int_eq(solver->advance(0.02 * k).status, 0);
            solver->commit();
        }
        const bool damaged = value(solved, "dissipated") > 0.0;
        if (!damaged) {
            ck_assert(value(grown, "displacement_solves") == (k == 1 ? 1.0 : 0.0));
            ck_assert(value(solved, "displacement_solves") >= 1.0);
            ++alone;
        }
        for (const char* key : {"stored_bulk", "stored_interface", "reaction:press", "work"}) {
            const double a = value(grown, key), b = value(solved, key);
            ck_assert_msg(std::abs(a - b) <= (damaged ? 1e-4 : 1e-10) * std::abs(b), "step %d: %s is %.15g, not %.15g",
                          k, key, a, b);
        }
    }
    ck_assert_int_ge(alone, 3);
    ck_assert(value(grown, "dissipated") > 0.0);
}
