// SPDX-License-Identifier: BSD-3-Clause
// The baseline of the benchmarks is an independent implementation of plain alternate minimisation: for the ductile ENF,
// h = 1 mm, 10 steps, it must give the same reactions, energies and numbers of alternations as the library. Only then
// are ratios of times fair.
#include "baseline.hpp"
#include "enf.hpp"
#include "scenes.hpp"
#include "support.hpp"

namespace {

constexpr int steps = 10;

bench::SceneData coarse() {
    auto data = bench::find_scene("enf-ductile-1");
    data.steps = steps;
    return data;
}

// The library with plain alternate minimisation; older versions have nothing else.
void declare_plain(bench::Stage& stage) {
    if (!bench::declare(stage, {nullptr, "alternate", 1e-5})) bench::declare(stage, {});
}

void compare(const bench::SceneData& data, double tolerance, bool wide) {
    auto stage = bench::make_mesh(data);
    declare_plain(stage);
    reference::Solver solver(stage.scene, 0.0);
    bench::BaselineOptions options;
    options.wide = wide;
    bench::Baseline baseline(stage.scene, data.law, stage.adhesion, options);
    double largest_reaction = 0.0;
    for (int k = 1; k <= data.steps; ++k) {
        const std::string where = "step " + std::to_string(k) + ", ";
        const double time = bench::step_time(data, k);
        solver.step(time);
        solver.commit();
        const auto record = baseline.advance(time);
        cases::expect(record.has_value() && record->status == DELAM_OK, where + "baseline did not converge");
        largest_reaction = std::max(largest_reaction, std::abs(record->reaction));
        const double energy = record->stored_bulk + record->stored_interface + record->dissipated;
        const auto near = [&](double ours, const char* key, double scale) {
            cases::expect_near(ours, solver.value(key), tolerance, scale, where + key);
        };
        near(record->reaction, "reaction:press", largest_reaction);
        near(record->stored_bulk, "stored_bulk", energy);
        near(record->stored_interface, "stored_interface", energy);
        near(record->dissipated, "dissipated", energy);
        const auto same = [&](std::int64_t ours, const char* key) {
            const double theirs = solver.value(key);
            cases::expect(static_cast<double>(ours) == theirs,
                          where + key + ": baseline " + std::to_string(ours) + ", library " + std::to_string(theirs));
        };
        same(record->am_iterations, "am_iterations");
        same(record->displacement_solves, "displacement_solves");
    }
}

LOOP_TEST(same_analysis, 0, 2) { compare(coarse(), 1e-8, loop == 1); }

TEST(same_analysis_with_patches) {
    auto data = coarse();
    data.patch = 2e-3;
    compare(data, 1e-8, false);
}

TEST(same_analysis_in_3d) {
    auto data = bench::find_scene("block-2");
    data.steps = 4;
    compare(data, 1e-8, false);
}

// The timed scene is the scene tested elsewhere.
TEST(same_scene) {
    cases::Enf e;
    e.h = 1e-3;
    const auto known = cases::make_enf(e);
    auto stage = bench::make_mesh(bench::find_scene("enf-ductile-1"));
    bench::declare(stage, {});
    // The scenes differ in options that do not affect the mechanics; with equal options the hashes agree.
    for (const reference::Scene* scene : {&known, static_cast<const reference::Scene*>(&stage.scene)}) {
        const auto number = [&](const char* key, double value) {
            scene->require(delam_problem_set_number(scene->problem(), key, value), key);
        };
        number("subdomains", 2.0);
        number("linear_limit", 2000.0);
        number("minimisation_limit", 5000.0);
        scene->require(delam_problem_set_text(scene->problem(), "mixity_rule", "frozen"), "mixity_rule");
    }
    char ours[17];
    char theirs[17];
    REQUIRE(known, delam_problem_hash, known.problem(), theirs);
    REQUIRE(known, delam_problem_hash, stage.scene.problem(), ours);
    cases::expect(std::string(ours) == theirs, std::string("hash ") + ours + " instead of " + theirs);
}

}  // namespace
