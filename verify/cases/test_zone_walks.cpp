// SPDX-License-Identifier: BSD-3-Clause
// Long sequences in which a few pairs change at a time, so that zones of the condensed operator are newly chosen,
// released and renewed: every state is compared with that of a solver without history.
#include <algorithm>
#include <random>

#include "comparison.hpp"
#include "condensed_scenes.hpp"
#include "direct.hpp"
#include "enf.hpp"
#include "same_fields.hpp"

namespace {

using cases::block_law;
using cases::expect_equal;
using cases::Scene;
using reference::DirectReference;
using reference::Solver;

struct Walk {
    const char* name;
    Scene (*make)();
    int states;
    double time;
};
const Walk walks[] = {
    {"ENF",
     [] {
         cases::Enf e;
         e.h = 1.5e-3;
         e.subdomains = 0;
         return cases::make_enf(e);
     },
     80, 1.0},
    {"ENF of k = 1e18",
     [] {
         cases::Enf e;
         e.h = 1.5e-3;
         e.subdomains = 0;
         e.law.normal_stiffness = e.law.tangential_stiffness = 1e18;
         return cases::make_enf(e);
     },
     80, 1.0},
    {"plies 3D", [] { return cases::make_plies(3, 2, DELAM_HEX8, "standard", block_law, 24); }, 50, 1.0},
    {"four plies", [] { return cases::make_plies(2, 4, DELAM_QUAD4, "standard", block_law, 40); }, 50, -1.0},
    {"opened", [] { return cases::make_opened(2, 33.0); }, 60, 1.0},
};
constexpr int walk_count = static_cast<int>(std::size(walks));

// A front that advances slowly, sometimes with a change elsewhere, a jump back, or a change everywhere.
LOOP_TEST(long_walk, 0, walk_count) {
    const Walk& w = walks[loop];
    Scene scene = w.make();
    scene.text("reduction", "condensed");
    Solver walker(scene, 0.0);
    std::mt19937 random(5U + static_cast<unsigned>(loop));
    std::uniform_real_distribution<double> draw(0.0, 1.0);
    auto zeta = walker.field("adhesion");
    const auto initial = zeta;
    const auto pairs = zeta.size();
    std::size_t front = pairs / 4;
    const int states = cases::whole() ? w.states : w.states / 3;
    for (int k = 0; k < states; ++k) {
        const double kind = draw(random);
        if (kind < 0.75) {
            for (std::size_t i = 0; i < 3; ++i) {
                zeta[front % pairs] = i == 0 ? 0.0 : draw(random);
                ++front;
            }
            front -= 2;
        } else if (kind < 0.9) {
            zeta[static_cast<std::size_t>(draw(random) * static_cast<double>(pairs))] =
                draw(random) < 0.5 ? 1e-12 : draw(random);
        } else if (kind < 0.95) {
            front = static_cast<std::size_t>(draw(random) * static_cast<double>(pairs));
        } else {
            zeta = initial;
        }
        const double time = w.time * (0.2 + 0.8 * draw(random));
        walker.equilibrate(time, zeta);
        Solver unused(scene, 0.0);
        unused.equilibrate(time, zeta);
        const std::string where = std::string(w.name) + ", state " + std::to_string(k);
        expect_equal(walker, unused, {"displacement", "jump", "traction", "reaction"}, 1e-8, where);
        cases::expect_below(walker.value("kkt_equilibrium"), 1e-10, where + ": equilibrium");
        walker.commit();
    }
}

// Nothing adheres: the first step is computed, rolled back, and another one computed.
TEST(rollback_of_the_first_step) {
    const auto make = [] {
        Scene scene = cases::make_plies(2, 2, DELAM_QUAD4, "standard", block_law, 60);
        std::vector<std::int64_t> all(scene.pair_count());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int64_t>(i);
        scene.adhesion(0, all, std::vector<double>(all.size(), 0.0));
        return scene;
    };
    const Scene scene = make();
    Solver solver(scene, 0.0), unused(scene, 0.0);
    solver.step(0.4);
    solver.rollback();
    solver.step(0.7);
    unused.step(0.7);
    cases::expect(solver.field("jump") == unused.field("jump") && solver.field("traction") == unused.field("traction"),
                  "bits of the step");
    solver.commit();
    unused.commit();
    cases::expect(solver.save() == unused.save(), "bytes of the snapshot");
}

// A soft arm below or above one 1e8 times stiffer: its tractions result from its own stiffness, whichever side it is
// on.
LOOP_TEST(soft_on_stiff, 0, 2) {
    const double ratio = loop == 0 ? 1e8 : 1e-8;
    Scene scene(2, {0.04}, {40}, {2e-3, 2e-3}, {2, 2}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(0, 70e9 * std::min(1.0, 1.0 / ratio), 0.3);
    scene.elastic(1, 70e9 * std::min(1.0, ratio), 0.3);
    scene.law(0, {1e14, 1e14, 1e30, 1e30, 1e30, 1e30});
    const auto right = scene.find(-1, {0.04, 0.0}, {0.04, 4e-3});
    scene.hold(right, {1.0, 0.0});
    scene.hold(right, {0.0, 1.0});
    scene.drive(scene.find(1, {0.0, 4e-3}, {0.0, 4e-3}), {0.0, 1.0}, scene.pattern("lift", {0.0, 1.0}, {0.0, 1e-5}),
                {1.0});
    scene.text("reduction", "condensed");
    Solver solver(scene, 0.0);
    solver.step(1.0);
    DirectReference direct(scene);
    const auto comparison =
        reference::compare(solver, direct.solve(1.0, solver.field("adhesion")), direct.exported(), 1e-10);
    cases::expect_below(comparison.traction, 1e-7,
                        "E upper / E lower " + std::to_string(ratio) + ": " + comparison.text());
}

}  // namespace
