// SPDX-License-Identifier: BSD-3-Clause
// Two rigidly moved blocks impose a uniform jump: only the interface responds, and follows the bilinear law in mode I
// and mode II through loading, unloading and reloading, with the energies of its ledger.
#include <algorithm>

#include "api.hpp"
#include "support.hpp"

namespace {

using reference::LawData;
using reference::Scene;
using reference::Solver;

struct Mode {
    const char* name;
    double direction[2];  // of the upper block
    double stiffness, onset, toughness;
};
// The modes differ, so that a mixity mistaken for that of the other mode would show.
constexpr LawData law{125e9, 80e9, 100.0, 160.0, 250.0, 480.0};
constexpr Mode modes[] = {{"mode I", {0.0, 1.0}, 125e9, 100.0, 250.0}, {"mode II", {1.0, 0.0}, 80e9, 160.0, 480.0}};

double onset_jump(const Mode& m) { return std::sqrt(2.0 * m.onset / m.stiffness); }
double final_jump(const Mode& m) { return onset_jump(m) * m.toughness / m.onset; }

// Adhesion of the bilinear law after the largest jump so far: the secant stiffness over the first one.
double secant(const Mode& m, double largest) {
    const double d0 = onset_jump(m);
    const double dc = final_jump(m);
    if (largest <= d0) return 1.0;
    if (largest >= dc) return 0.0;
    return d0 * (dc - largest) / (largest * (dc - d0));
}

double dissipated(const Mode& m, double zeta) {
    return m.toughness * m.onset * (1.0 - zeta) / (m.onset + (m.toughness - m.onset) * zeta);
}

double slides_stored(const Mode& m, double zeta) {
    const double d = m.toughness - m.onset;
    return -m.toughness * d * zeta * (1.0 - zeta) / (m.onset + d * zeta);
}

// All nodes are prescribed; the interface is 1 m long, so forces are tractions. The path goes through `turns`,
// fractions of the final jump.
Scene imposed(const Mode& m, const std::vector<double>& turns) {
    Scene scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e9, 0.2);
    scene.law(0, law);
    std::vector<double> times;
    std::vector<double> values;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        times.push_back(static_cast<double>(i));
        values.push_back(turns[i] * final_jump(m));
    }
    const auto load = scene.pattern("open", times, values);
    const auto below = scene.find(0, {0.0, 0.0}, {1.0, 2.0});
    const auto above = scene.find(1, {0.0, 0.0}, {1.0, 2.0});
    for (const std::vector<double>& axis : {std::vector<double>{1.0, 0.0}, std::vector<double>{0.0, 1.0}}) {
        scene.hold(below, axis);
        const double along = axis[0] * m.direction[0] + axis[1] * m.direction[1];
        scene.drive(above, axis, load, std::vector<double>(above.size(), along));
    }
    return scene;
}

const std::vector<double> path = {0.0, 0.3, 0.6, 0.1, 0.75, 0.2, 1.2, 0.4};

double along_path(double time) {
    const auto i = std::min(static_cast<std::size_t>(time), path.size() - 2);
    return path[i] + (path[i + 1] - path[i]) * (time - static_cast<double>(i));
}

LOOP_TEST(bilinear_law, 0, 2) {
    const Mode& m = modes[loop];
    const Scene scene = imposed(m, path);
    Solver solver(scene, 0.0);
    const double peak = m.stiffness * onset_jump(m);
    const auto component = static_cast<std::size_t>(loop);  // local: normal, tangent
    double largest = 0.0;
    double zeta_before = 1.0;
    double slides = 0.0;
    const int per_leg = 16;
    for (int k = 1; k <= per_leg * static_cast<int>(path.size() - 1); ++k) {
        const double time = static_cast<double>(k) / per_leg;
        solver.step(time);
        solver.commit();
        const double w = along_path(time) * final_jump(m);
        largest = std::max(largest, w);
        const double zeta = secant(m, largest);
        const double t = zeta * m.stiffness * w;
        slides += m.toughness * (zeta_before - zeta);
        zeta_before = zeta;
        const std::string where = std::string(m.name) + ", step " + std::to_string(k) + ": ";
        for (const double z : solver.field("adhesion")) cases::expect_near(z, zeta, 1e-12, 1.0, where + "adhesion");
        const auto traction = solver.field("traction");
        const auto jump = solver.field("jump");
        for (std::size_t i = 0; i < traction.size(); ++i) {
            const bool driven = i % 2 == component;
            cases::expect_near(std::abs(jump[i]), driven ? w : 0.0, 1e-12, final_jump(m), where + "jump");
            cases::expect_near(std::abs(traction[i]), driven ? t : 0.0, 1e-12, peak, where + "traction");
            cases::expect(traction[i] * jump[i] >= -1e-12 * peak * final_jump(m), where + "the interface pulls back");
        }
        cases::expect_near(solver.value("reaction:open"), t, 1e-12, peak, where + "reaction");
        cases::expect_near(solver.value("stored_interface"), 0.5 * t * w, 1e-12, m.toughness, where + "stored");
        cases::expect_near(solver.value("dissipated"), dissipated(m, zeta), 1e-12, m.toughness, where + "dissipated");
        cases::expect_near(solver.value("stored_interface_slides"), 0.5 * t * w + slides_stored(m, zeta), 1e-12,
                           m.toughness, where + "stored, split of PANM 15");
        cases::expect_near(solver.value("dissipated_slides"), slides, 1e-12, m.toughness,
                           where + "dissipated, split of PANM 15");
        cases::expect_near(solver.value("stored_bulk"), 0.0, 1e-12, m.toughness, where + "rigid blocks");
    }
    cases::expect_near(solver.value("dissipated"), m.toughness, 1e-12, m.toughness, "all of the toughness is spent");
}

// Work is the trapezoid of the reactions of each step. With an imposed jump the traction is piecewise linear, so that
// the defect of the ledger comes from the step in which the slope changes, and decreases with the square of the step.
double ledger_defect(const Mode& m, int steps, double& bound) {
    const Scene scene = imposed(m, {0.0, 1.2});
    Solver solver(scene, 0.0);
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
        const double balance =
            solver.value("stored_bulk") + solver.value("stored_interface") + solver.value("dissipated");
        if (k == steps) {
            const double dw = 1.2 * final_jump(m) / steps;
            bound = 1.0 * m.stiffness * dw * dw;
            cases::expect_near(solver.value("dissipated"), m.toughness, 1e-12, m.toughness, "dissipated");
            return std::abs(balance - solver.value("work"));
        }
    }
    return 0.0;
}

LOOP_TEST(ledger_closes_in_the_limit, 0, 2) {
    const Mode& m = modes[loop];
    double bound_coarse = 0.0;
    double bound_fine = 0.0;
    const double coarse = ledger_defect(m, 60, bound_coarse);
    const double fine = ledger_defect(m, 480, bound_fine);
    cases::expect_below(coarse, bound_coarse, std::string(m.name) + ": defect at 60 steps");
    cases::expect_below(fine, bound_fine, std::string(m.name) + ": defect at 480 steps");
}

// The law function alone, at the same points.
LOOP_TEST(law_function, 0, 2) {
    const Mode& m = modes[loop];
    const Scene scene = imposed(m, {0.0, 1.0});
    delam_law* raw = nullptr;
    REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &raw);
    const reference::Law owned(raw);
    const std::pair<const char*, double> parameters[] = {
        {"normal_stiffness", law.normal_stiffness}, {"tangential_stiffness", law.tangential_stiffness},
        {"normal_onset", law.normal_onset},         {"tangential_onset", law.tangential_onset},
        {"normal_toughness", law.normal_toughness}, {"tangential_toughness", law.tangential_toughness}};
    for (const auto& [key, value] : parameters) scene.require(delam_law_set(raw, key, value), key);
    REQUIRE(scene, delam_law_check, raw);
    const double mixity = loop == 0 ? 0.0 : 1.0;
    for (int i = 0; i <= 100; ++i) {
        const double w = 0.012 * i * final_jump(m);
        const double jump[2] = {loop == 0 ? w : 0.0, loop == 0 ? 0.0 : -w};
        const double old = 1.0;
        double zeta = -1.0;
        double traction[2] = {0.0, 0.0};
        REQUIRE(scene, delam_law_respond, raw, 2, 1, jump, &mixity, &old, &zeta, traction);
        cases::expect_near(zeta, secant(m, w), 1e-12, 1.0, "adhesion");
        const double peak = m.stiffness * onset_jump(m);
        cases::expect_near(traction[loop], secant(m, w) * m.stiffness * jump[loop], 1e-12, peak, "traction");
    }
}

}  // namespace
