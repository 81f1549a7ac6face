// SPDX-License-Identifier: BSD-3-Clause
// Growing dead loads on a softening interface: below the limit load the analysis continues, beyond it a call ends with
// DELAM_LIMIT and leaves the state before it.
#include <string>
#include <vector>

#include "controlled_scenes.hpp"
#include "support.hpp"

namespace {

using cases::Scene;
using reference::Solver;

constexpr double length = 0.04;

// The lower ply is clamped along its bottom; the upper one is pulled off at its left end, directly or through a control
// node that the end's nodes share: a peel test under a dead load. Only the interface holds the upper ply.
Scene peel(int d, int which, bool nose) {
    Scene scene = cases::plies_with_controls(d, 1);
    const auto bottom = cases::body_nodes_where(scene, [](const double* x) { return x[1] < 1e-6; });
    for (int k = 0; k < d; ++k) scene.hold(bottom, cases::unit(d, k));
    const auto end = cases::body_nodes_where(scene, [](const double* x) { return x[0] < 1e-6 && x[1] > 0.0059; });
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 1.0});
    const double strength = 2.5e7 * length * (d == 3 ? 0.01 : 1.0);  // sqrt(2 k G_o) over the whole interface
    if (nose) {
        for (const auto n : end) scene.equation({n, 0}, cases::components(d, {{1, 1.0}, {1, -1.0}}));
        for (int k = 0; k < d; ++k)
            if (k != 1) scene.hold({0}, cases::unit(d, k));
        cases::forces(scene, load, {0}, cases::unit(d, 1, 0.4 * strength));
    } else {
        std::vector<double> force;
        for (std::size_t i = 0; i < end.size(); ++i) {
            const auto f = cases::unit(d, 1, 0.4 * strength / static_cast<double>(end.size()));
            force.insert(force.end(), f.begin(), f.end());
        }
        cases::forces(scene, load, end, force);
    }
    constexpr const char* ways[] = {"condensed", "feti", "iterated"};
    scene.text("reduction", ways[which]);
    if (which == 1) scene.number("subdomains", 4);
    return scene;
}

// Returns the time up to which a message says that the state holds; 0: it does not say so.
double known_limit(const Scene& scene) {
    const std::string message = delam_context_message(scene.context()), words = "holds up to time ";
    const std::size_t at = message.find(words);
    return at == std::string::npos ? 0.0 : std::stod(message.substr(at + words.size()));
}

LOOP_TEST(peeled_off, 0, 12) {
    const int d = loop % 2 == 0 ? 2 : 3;
    const Scene scene = peel(d, loop / 2 % 3, loop / 6 == 1);
    Solver solver(scene, 0.0);
    constexpr int steps = 20;
    int reached = 0;
    double damaged = 0.0;
    std::int32_t status = DELAM_OK;
    for (int k = 1; k <= steps; ++k) {
        status = solver.advance(static_cast<double>(k) / steps);
        if (status != DELAM_OK) break;
        solver.commit();
        reached = k;
        damaged = solver.value("front");
    }
    cases::expect(status == DELAM_LIMIT, std::string("ends with ") + delam_status_name(status) + " after step " +
                                             std::to_string(reached) + ": " + delam_context_message(scene.context()));
    cases::expect(std::string(delam_context_message(scene.context())).find("dead force") != std::string::npos,
                  "the message names the dead force");
    const double limit = known_limit(scene);
    cases::expect(limit >= solver.value("time") && limit < static_cast<double>(reached + 1) / steps,
                  "the limit load is told: " + std::to_string(limit));
    Solver at_once(scene, 0.0);
    cases::expect(at_once.advance(1.0) == DELAM_LIMIT, "one step ends there as well");
    cases::expect_near(known_limit(scene), limit, 1e-2, limit, "at the same load");
    cases::expect(solver.value("time") == static_cast<double>(reached) / steps, "the state before is kept");
    cases::expect(solver.value("front") == damaged, "and so is its damage");
    cases::expect(reached >= 1, "a small load is borne");
}

}  // namespace
