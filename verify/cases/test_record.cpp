// SPDX-License-Identifier: BSD-3-Clause
// Values that the library records with each commit: they equal what a host would have read step after step, returns
// included, and are part of the saved state.
#include <algorithm>
#include <cmath>

#include "condensed_scenes.hpp"
#include "flexure.hpp"
#include "small_analysis.hpp"

namespace {

using reference::FlexureScene;
using reference::Solver;

constexpr int steps = 40;
double time_of(int k) { return 2.0 * k / steps; }

// Brittle: its jump makes the analysis return to earlier steps.
FlexureScene returning() {
    FlexureScene f = reference::make_flexure(reference::find_flexure("enf-brittle"));
    f.scene.text("backtracking", "on");
    return f;
}

constexpr const char* keys[] = {"step",      "time",           "dissipated",          "work",
                                "lower",     "reaction:press", "energy_release_rate", "front",
                                "revisions", "search_gap",     "crack_length",        "contact_pairs"};

void record(const Solver& solver, const char* key) {
    solver.scene().require(delam_solver_record(solver.get(), key), key);
}
void record_all(const Solver& solver) {
    for (const char* key : keys) record(solver, key);
}

struct Size {
    std::int64_t first = -1, steps = -1;
};
Size size_of(const Solver& solver) {
    Size size;
    REQUIRE(solver.scene(), delam_solver_recorded_size, solver.get(), &size.first, &size.steps);
    return size;
}

std::vector<double> recorded(const Solver& solver, const char* key) {
    std::vector<double> values(static_cast<std::size_t>(size_of(solver).steps));
    solver.scene().require(
        delam_solver_recorded(solver.get(), key, static_cast<std::int64_t>(values.size()), values.data()), key);
    return values;
}

void walk(Solver& solver, int first, int last) {
    for (int k = first; k <= last; ++k) {
        solver.step(time_of(k));
        solver.commit();
    }
}

void select_step(const Solver& solver, std::int64_t step) {
    REQUIRE(solver.scene(), delam_solver_look, solver.get(), step);
}

// The values of the kept steps when they are read again.
void expect_as_selected(Solver& solver, const std::string& where) {
    const Size size = size_of(solver);
    for (const char* key : keys) {
        const std::vector<double> values = recorded(solver, key);
        for (std::size_t i = 0; i < values.size(); ++i) {
            select_step(solver, size.first + static_cast<std::int64_t>(i));
            cases::expect(delam::same_bits(solver.value(key), values[i]),
                          where + ": " + key + " of step " + std::to_string(size.first + static_cast<std::int64_t>(i)));
        }
    }
    select_step(solver, -1);
}

TEST(steps_that_returns_replace) {
    const FlexureScene f = returning();
    Solver solver(f.scene, 0.0), plain(f.scene, 0.0);
    cases::expect(size_of(solver).first == 0 && size_of(solver).steps == 0, "nothing is recorded unless asked for");
    record_all(solver);
    cases::expect(size_of(solver).first == 0 && size_of(solver).steps == 1, "the present state is the first");
    for (int k = 1; k <= steps; ++k) {
        solver.step(time_of(k));
        // Neither reading earlier steps nor rolling back records anything.
        if (k == 3) {
            solver.rollback();
            cases::expect(size_of(solver).steps == k, "a step that was rolled back is recorded");
            solver.step(time_of(k));
        }
        if (k > 1) select_step(solver, k - 1);
        solver.commit();
        plain.step(time_of(k));
        plain.commit();
        cases::expect_same(solver, cases::read_bits(solver), cases::read_bits(plain),
                           "an analysis that records, step " + std::to_string(k));
    }
    const std::vector<double> revisions = recorded(solver, "revisions");
    cases::expect(*std::max_element(revisions.begin(), revisions.end()) >= 1.0, "no step was replaced");
    cases::expect(size_of(solver).steps == steps + 1, "one entry a step");
    expect_as_selected(solver, "in the end");
}

TEST(saved_with_the_state) {
    const FlexureScene f = returning();
    Solver whole(f.scene, 0.0), first(f.scene, 0.0), second(f.scene, 0.0);
    walk(whole, 1, 2);
    walk(first, 1, 2);
    record_all(whole);
    record_all(first);
    walk(whole, 3, steps);
    const int cut = 3;  // before the analysis returns to a step before it
    walk(first, 3, cut);
    const auto bytes = first.save();
    record(second, "stored_bulk");
    f.scene.require(second.load(bytes), "delam_solver_load");
    cases::expect(second.save() == bytes, "saved again");
    std::vector<double> none(1);
    cases::expect(delam_solver_recorded(second.get(), "stored_bulk", 1, none.data()) == DELAM_ERROR_ARGUMENT,
                  "the record is that of the bytes");
    walk(second, cut + 1, steps);
    cases::expect(size_of(second).first == 2 && size_of(second).steps == steps - 1,
                  "from the step on at which it was asked for");
    for (const char* key : keys)
        cases::expect(delam::same_bits(recorded(whole, key), recorded(second, key)),
                      std::string(key) + " after loading");
    // A return to before the start of the record replaces the whole record.
    expect_as_selected(second, "resumed");
}

TEST(in_space_by_feti) {
    reference::Scene scene = cases::make_plies(3, 2, DELAM_HEX8, "standard", {1e13, 1e13, 1.0, 1.0, 20.0, 20.0}, 8);
    scene.text("reduction", "feti");
    Solver solver(scene, 0.0);
    record(solver, "dissipated");
    record(solver, "energy_release_rate");
    std::vector<double> seen{solver.value("dissipated")}, rates{solver.value("energy_release_rate")};
    for (int k = 1; k <= 6; ++k) {
        solver.step(k / 6.0);
        solver.commit();
        seen.push_back(solver.value("dissipated"));
        rates.push_back(solver.value("energy_release_rate"));
    }
    cases::expect(seen.back() > 0.0, "nothing was damaged");
    cases::expect(delam::same_bits(seen, recorded(solver, "dissipated")), "dissipated");
    cases::expect(delam::same_bits(rates, recorded(solver, "energy_release_rate")), "energy release rate");
}

TEST(later_keys_and_set_states) {
    const reference::Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    record(solver, "time");
    cases::walk(solver, 1, 2);
    record(solver, "work");
    record(solver, "time");
    cases::walk(solver, 3, 3);
    const std::vector<double> times = recorded(solver, "time"), work = recorded(solver, "work");
    cases::expect(times.size() == 4 && times[0] == 0.0 && times[3] == cases::small_time(3),
                  "asked for twice, recorded once");
    cases::expect(
        work.size() == 4 && std::isnan(work[0]) && std::isnan(work[1]) && !std::isnan(work[2]) && work[3] > work[2],
        "not a number before it was asked for");
    // A state that is set replaces its step.
    solver.equilibrate(cases::small_time(5), solver.field("adhesion"));
    solver.commit();
    cases::expect(recorded(solver, "time").size() == 4 && recorded(solver, "time")[3] == cases::small_time(5),
                  "a state that was set");
}

TEST(refused) {
    const reference::Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    for (const char* key : {"no_such_value", "", "kkt_gap", "kkt_equilibrium", "rotation_max", "mesh_error",
                            "mesh_excess", "bulk_factorisations", "field_recoveries", "crack_length:7"})
        cases::expect(delam_solver_record(solver.get(), key) == DELAM_ERROR_ARGUMENT, std::string("recorded: ") + key);
    cases::expect(size_of(solver).steps == 0, "a refusal leaves nothing");
    cases::expect(
        delam_solver_record(solver.get(), "kkt_gap") != DELAM_OK &&
            std::string(delam_context_message(scene.context())).find("recovers the displacements") != std::string::npos,
        "the reason is not said");
    record(solver, "time");
    double value = -1.0;
    cases::expect(delam_solver_recorded(solver.get(), "work", 1, &value) == DELAM_ERROR_ARGUMENT, "not recorded");
    cases::expect(std::string(delam_context_message(scene.context())).find("recorded: time") != std::string::npos,
                  "what is recorded is not said");
    cases::expect(delam_solver_recorded(solver.get(), "time", 0, &value) == DELAM_ERROR_ARGUMENT && value == -1.0,
                  "no room");
    solver.step(cases::small_time(1));
    cases::expect(delam_solver_record(solver.get(), "work") == DELAM_ERROR_STATE, "a step is pending");
}

// The descriptions of values agree with the library, and a second name is as good as the first.
TEST(descriptions_and_aliases) {
    const reference::Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    std::int64_t count = 0;
    REQUIRE(scene, delam_solver_value_count, solver.get(), &count);
    std::vector<std::pair<std::string, std::string>> names;
    for (std::int64_t i = 0; i < count; ++i) {
        const std::string name = delam_solver_value_name(solver.get(), i);
        const char *alias = nullptr, *unit = nullptr, *cost = nullptr, *scope = nullptr, *meaning = nullptr;
        std::int32_t recorded = -1;
        scene.require(delam_solver_value_info(solver.get(), i, &alias, &unit, &cost, &scope, &meaning, &recorded),
                      name.c_str());
        cases::expect(*unit != '\0' && *meaning != '\0', name);
        const std::string price = cost, part = scope;
        const bool recovers = name.rfind("kkt_", 0) == 0 || name.rfind("mesh_", 0) == 0 ||
                              name.rfind("rotation_", 0) == 0 || name == "buckling_ratio";
        cases::expect(price == (recovers ? "recovers" : price) && (price != "recovers" || recovers), name + ": cost");
        const bool of_pattern = name.find("load:") == 0 || name.find("reaction:") == 0;
        cases::expect((part == "pattern") == of_pattern, name + ": scope");
        if (part == "whole") cases::expect(name.find(':') == std::string::npos, name + ": scope");
        // Reading what does not recover the displacements recovers none.
        const double before = solver.value("field_recoveries");
        if (price != "recovers") solver.value(name.c_str());
        cases::expect(solver.value("field_recoveries") == before, name + ": recovers after all");
        if (*alias != '\0') names.emplace_back(name, alias);
        cases::expect((delam_solver_record(solver.get(), name.c_str()) == DELAM_OK) == (recorded == 1), name);
    }
    cases::expect(names.size() == 6, "second names");
    cases::walk(solver, 1, 3);
    for (const auto& [name, alias] : names) {
        cases::expect(solver.value(alias.c_str()) == solver.value(name.c_str()), alias);
        cases::expect(recorded(solver, alias.c_str()) == recorded(solver, name.c_str()), alias);
        cases::expect(delam_solver_record(solver.get(), alias.c_str()) == DELAM_OK, alias);
        cases::expect(delam_solver_record(solver.get(), (alias + ":0").c_str()) == DELAM_ERROR_ARGUMENT, alias + ":0");
    }
    cases::expect(solver.value("staggered_iterations") > 0.0, "there is something to compare");
}

// All fields of an instant, and the values that recover the displacements, take one recovery.
TEST(one_recovery_serves_all_fields_of_an_instant) {
    const reference::Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, 3);
    const double before = solver.value("field_recoveries");
    for (const char* name : {"displacement", "stress", "rotation", "mesh_error"}) {
        std::int64_t rows = 0, columns = 0;
        REQUIRE(scene, delam_solver_field_shape, solver.get(), name, -1, &rows, &columns);
        std::vector<double> values(static_cast<std::size_t>(rows * columns));
        REQUIRE(scene, delam_solver_field, solver.get(), name, -1, rows * columns, values.data());
    }
    for (const char* name : {"rotation_max", "mesh_error", "mesh_error_fronts", "mesh_excess"}) solver.value(name);
    cases::expect(solver.value("field_recoveries") == before + 1, "recovered more than once");
}

}  // namespace
