// SPDX-License-Identifier: BSD-3-Clause
// Five plies whose four interfaces soften at once, bent or pulled apart: the zone of the condensed operator is so large
// that it is factored along the tree of the bodies. Every state against the direct reference, the analysis against the
// iterated operator, and a saved state continues bit for bit.
#include <algorithm>
#include <string>

#include "comparison.hpp"
#include "condensed_scenes.hpp"
#include "direct.hpp"
#include "same_fields.hpp"

namespace {

using cases::Scene;
using reference::DirectReference;
using reference::Solver;

constexpr int plies = 5, along = 120;
constexpr double length = 0.06, ply = 1.5e-3;

Scene make(bool apart) {
    Scene scene(2, {length}, {along}, std::vector<double>(plies, ply), std::vector<std::int64_t>(plies, 2),
                DELAM_QUAD4);
    for (int i = 0; i + 1 < plies; ++i) scene.interface(i, i + 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    for (int i = 0; i + 1 < plies; ++i) scene.law(i, {1e12, 1e12, 20.0, 20.0, 2500.0, 2500.0});
    const auto right = cases::nodes_where(scene, -1, [](const double* x) { return x[0] > length - 1e-6; });
    for (int k = 0; k < 2; ++k) scene.hold(right, cases::unit(2, k));
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 1.0});
    for (int i = 0; i < plies; ++i) {
        if (!apart && i + 1 < plies) continue;
        const double height = apart ? ply * (i + 0.5) : ply * plies;
        const auto moved = cases::nodes_where(
            scene, i, [height](const double* x) { return x[0] < 1e-6 && std::abs(x[1] - height) < 1e-6; });
        scene.drive(moved, cases::unit(2, 1), load, {apart ? 1.5e-3 * (i - 0.5 * (plies - 1)) : -3e-3});
    }
    return scene;
}

constexpr const char* kind_of[] = {"bent", "pulled apart"};
constexpr int steps = 10;

// Pairs that have begun to soften and are not yet broken.
int softening(const Solver& solver) {
    const auto zeta = solver.field("adhesion");
    return static_cast<int>(std::count_if(zeta.begin(), zeta.end(), [](double z) { return z > 0.0 && z < 1.0; }));
}

LOOP_TEST(condensed_is_iterated_and_direct, 0, 2) {
    const std::string kind = kind_of[loop];
    Scene condensed = make(loop == 1), iterated = make(loop == 1);
    condensed.text("reduction", "condensed");
    iterated.text("reduction", "iterated");
    for (Scene* scene : {&condensed, &iterated}) scene->number("damage_tolerance", 1e-10);
    Solver a(condensed, 0.0), b(iterated, 0.0);
    DirectReference direct(condensed);
    int most = 0;
    for (int k = 1; k <= steps; ++k) {
        const double time = static_cast<double>(k) / steps;
        const std::string where = kind + ", step " + std::to_string(k);
        a.step(time);
        b.step(time);
        const auto difference = reference::compare(a, direct.solve(time, a.field("adhesion")), direct.exported(), 1e-9);
        cases::expect_below(difference.worst(), 1e-8, where + ", direct: " + difference.text());
        const double energy = a.value("work");
        for (const char* key : {"stored_bulk", "stored_interface", "dissipated", "work"})
            cases::expect_near(a.value(key), b.value(key), 1e-7, energy, where + ": " + key);
        most = std::max(most, softening(a));
        a.commit();
        b.commit();
    }
    // Two rows each: more than `zone_tree_least`.
    cases::expect(most > 150, kind + ": at most " + std::to_string(most) + " pairs soften at once");
}

LOOP_TEST(a_saved_state_continues_bit_for_bit, 0, 2) {
    const Scene scene = [](bool apart) {
        Scene made = make(apart);
        made.text("reduction", "condensed");
        return made;
    }(loop == 1);
    Solver whole(scene, 0.0), resumed(scene, 0.0);
    for (int k = 1; k <= steps; ++k) {
        whole.step(static_cast<double>(k) / steps);
        whole.commit();
        if (k == steps / 2) scene.require(resumed.load(whole.save()), "delam_solver_load");
    }
    for (int k = steps / 2 + 1; k <= steps; ++k) {
        resumed.step(static_cast<double>(k) / steps);
        resumed.commit();
    }
    cases::expect(resumed.save() == whole.save(), std::string(kind_of[loop]) + ": bits in the end");
}

}  // namespace
