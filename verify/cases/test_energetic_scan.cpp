// SPDX-License-Identifier: BSD-3-Clause
// Energetic analyses of the brittle ENF against the exhaustive scan of fronts: after every step no more energy than the
// scan, the jump in the same step and, when located, at the load where the scan's energies cross; no bound violated.
// Finer meshes are in the long tier.
#include <algorithm>

#include "fronts.hpp"
#include "support.hpp"

namespace {

constexpr int scan_steps = 40;

struct ScanRun {
    double h, patch, exponent;
    bool quick = false;
};
// With exponents 1 the toughness does not depend on the mixity, and the two histories cannot differ in it.
constexpr ScanRun runs[] = {{1.5e-3, 0.0, 2.0, true}, {1.5e-3, 3e-3, 1.0, true}, {1e-3, 2e-3, 2.0, true},
                            {1e-3, 0.0, 2.0},         {1e-3, 2e-3, 1.0},         {0.75e-3, 2e-3, 2.0},
                            {0.5e-3, 2e-3, 2.0}};
bool wanted(const ScanRun& run) { return run.quick || cases::whole(); }

reference::Flexure scan_specimen(const ScanRun& run) {
    reference::Flexure data = reference::find_flexure("enf-brittle");
    data.h = run.h;
    data.patch = run.patch;
    data.law.exponent = run.exponent;
    return data;
}

std::vector<double> scan_loads(const reference::Flexure& data) {
    std::vector<double> all;
    for (int k = 1; k <= scan_steps; ++k) all.push_back(data.final_load * k / scan_steps);
    return all;
}

double scan_total(const reference::Solver& solver) {
    return solver.value("stored_bulk") + solver.value("stored_interface") + solver.value("dissipated");
}

LOOP_TEST(no_step_above_the_scan, 0, std::size(runs)) {
    const ScanRun& run = runs[loop];
    if (!wanted(run)) return;
    const reference::Flexure data = scan_specimen(run);
    const auto scan = reference::Fronts(data).scan(scan_loads(data), reference::MixityRule::frozen);
    const reference::FlexureScene flexure = reference::make_flexure(data);
    flexure.scene.require(delam_problem_set_text(flexure.scene.problem(), "solution", "energetic"), "solution");
    reference::Solver solver(flexure.scene, 0.0);
    for (int k = 1; k <= scan_steps; ++k) {
        solver.step(data.end_time * k / scan_steps);
        solver.commit();
    }
    // Read again, so that replaced steps count with their final values.
    for (int k = 1; k <= scan_steps; ++k) {
        REQUIRE(flexure.scene, delam_solver_look, solver.get(), k);
        const reference::ScanStep& s = scan[static_cast<std::size_t>(k - 1)];
        const std::string where = "step " + std::to_string(k) + ": ";
        cases::expect_below(scan_total(solver) / s.total(), 1.0 + 1e-6, where + "energy over the scan's");
        // No significant damage before the scan's jump, and the scan's front after it except for a few pairs: the
        // energy is flat there.
        const double advance = s.dissipated / data.law.tangential_toughness;
        if (s.front == 0)
            cases::expect_below(solver.value("debonded_length"), 0.0, where + "debonded before the scan's jump");
        else
            cases::expect_near(solver.value("debonded_length"), advance, 1.0, 3.0 * data.h, where + "debonded length");
        const double scale = std::max(std::abs(scan_total(solver)), solver.value("work"));
        cases::expect_below(solver.value("lower") - solver.value("increment_lower"), 1e-3 * scale,
                            where + "lower bound");
        cases::expect_below(solver.value("increment") - solver.value("upper"), 1e-3 * scale, where + "upper bound");
    }
}

LOOP_TEST(jump_is_located_where_the_energies_cross, 0, std::size(runs)) {
    const ScanRun& run = runs[loop];
    if (!wanted(run)) return;
    reference::Flexure data = scan_specimen(run);
    const auto crossing = reference::Fronts(data).crossing(reference::MixityRule::frozen);
    const reference::FlexureScene flexure = reference::make_flexure(data);
    const reference::Scene& scene = flexure.scene;
    scene.require(delam_problem_set_text(scene.problem(), "solution", "energetic"), "solution");
    scene.require(delam_problem_set_number(scene.problem(), "jump_tolerance", 1e-3), "jump_tolerance");
    reference::Solver solver(scene, 0.0);
    for (int k = 1; k <= 2; ++k) {
        solver.step(data.end_time * k / scan_steps);
        solver.commit();
    }
    std::int64_t count = 0;
    REQUIRE(scene, delam_solver_jump_count, solver.get(), &count);
    cases::expect(count > 0, "no jump was located");
    double time = 0.0, dissipated = 0.0, released = 0.0;
    REQUIRE(scene, delam_solver_jump, solver.get(), 0, nullptr, nullptr, &time, nullptr, &dissipated, &released,
            nullptr, nullptr, nullptr, nullptr);
    cases::expect_near(data.load(time), crossing.load, 1e-3, crossing.load, "load of the jump");
    cases::expect_near(dissipated, crossing.dissipated, 1.0, 3.0 * data.h * data.law.tangential_toughness,
                       "energy that the jump takes");
    cases::expect_near(released, 0.0, 1e-2, crossing.dissipated, "energy released where the energies cross");
}

}  // namespace
