// SPDX-License-Identifier: BSD-3-Clause
// Energetic solutions with large rotations: in each step, the state found is compared with all positions of the front.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "rotating_beams.hpp"
#include "small_analysis.hpp"
#include "support.hpp"

namespace {

using beams::Beam;
using reference::LawData;
using reference::Scene;
using reference::Solver;

constexpr double toughness = 2.0;
constexpr LawData brittle{1e5, 1e5, 1.9, 1.9, toughness, toughness, 1.0};

double energy_of(const Solver& solver) { return solver.value("stored_bulk") + solver.value("stored_interface"); }

// Returns the least energy at a time among all positions of a front that moves on from the left, with what they
// dissipate.
double least_energy(const Scene& scene, Solver& solver, double time) {
    const auto pairs = scene.pairs(0);
    std::vector<std::size_t> order(pairs.count());
    for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
    std::ranges::sort(order, {}, [&](std::size_t p) { return scene.coordinate(pairs.node_a[p], 0); });
    std::vector<double> adhesion = solver.field("adhesion");
    double least = std::numeric_limits<double>::infinity(), dissipated = solver.value("dissipated");
    for (const std::size_t p : order) {
        if (adhesion[p] == 0.0) continue;
        solver.equilibrate(time, adhesion);
        least = std::min(least, energy_of(solver) + dissipated);
        solver.rollback();
        dissipated += toughness * pairs.weight[p] * adhesion[p];
        adhesion[p] = 0.0;
    }
    return least;
}

// Compares from step `first` on; nothing moves before it.
void expect_lowest(Scene scene, int steps, int first, double least_jump, const std::string& what) {
    scene.text("solution", "energetic");
    Solver solver(scene, 0.0);
    double jump = 0.0, released = 0.0;
    for (int k = 1; k <= steps; ++k) {
        const double time = static_cast<double>(k) / steps, before = solver.value("dissipated");
        const double least = k < first ? std::numeric_limits<double>::infinity() : least_energy(scene, solver, time);
        solver.step(time);
        solver.commit();
        released += solver.value("released");
        const double own = energy_of(solver) + solver.value("dissipated");
        // Candidates are ranked in a linearised scene.
        if (k >= first)
            cases::expect_below(own - least, 2e-3 * least,
                                what + ": energy above the least, step " + std::to_string(k));
        jump = std::max(jump, solver.value("dissipated") - before);
    }
    cases::expect_below(least_jump, jump, what + ": the front jumps");
    const double energy = energy_of(solver) + solver.value("dissipated");
    cases::expect_near(energy + released, solver.value("work"), 1e-2, energy, what + ": balance");
}

TEST(front_of_a_flexure_specimen) {
    expect_lowest(beams::flexure({100.0, 1.0, 30.0, 50, 1}, brittle, 11.0, "corotational"), 11, 8, 10.0, "flexure");
}

// Analyses that are saved before and after the front has jumped go on alike, bit by bit, in the plane and in space.
LOOP_TEST(saved_before_and_after_a_jump, 2, 4) {
    Beam beam{100.0, 1.0, 30.0, 20, 1};
    beam.dimension = loop;
    beam.width = loop == 3 ? 4.0 : 0.0;
    Scene scene = beams::flexure(beam, brittle, 11.0, "corotational");
    if (loop == 3)
        for (const std::int32_t body : {0, 1})
            scene.hold(cases::nodes_where(scene, body, [](const double* p) { return p[2] < 1e-9; }), beam.along(2));
    scene.text("solution", "energetic");
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 4; ++k) {
        Solver resumed(scene, 0.0);
        if (k > 1) scene.require(resumed.load(solver.save()), "delam_solver_load");
        for (Solver* one : {&solver, &resumed}) {
            one->step(k / 4.0);
            one->commit();
        }
        cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(solver), "step " + std::to_string(k));
    }
    cases::expect_below(1.0, solver.value("dissipated"), "the front moves");
}

}  // namespace
