// SPDX-License-Identifier: BSD-3-Clause
// Thermal strains: free expansion, a bar between walls, the bimetal strip, a cross-ply laminate; both realisations
// against the direct reference; the ledger of a cure followed by loading.
#include <array>
#include <cmath>
#include <string>

#include "comparison.hpp"
#include "condensed_scenes.hpp"
#include "direct.hpp"
#include "support.hpp"

namespace {

using cases::nodes_where;
using cases::unit;
using reference::LawData;
using reference::Scene;
using reference::Solver;

constexpr double young = 70e9, poisson = 0.3, alpha = 2e-5, heat = 50.0;
constexpr double ply[] = {135e9, 9e9, 9e9, 0.24, 0.24, 0.46, 5.2e9, 5.2e9, 9e9 / 2.92};

std::size_t size(std::int64_t i) { return static_cast<std::size_t>(i); }

void eigenstrain(Scene& scene, std::int64_t pattern, std::int32_t body, const std::array<double, 6>& strain) {
    REQUIRE(scene, delam_problem_add_eigenstrain, scene.problem(), pattern, body, strain.data());
}

void turn(Scene& scene, std::int32_t body, const std::array<double, 6>& axes) {
    REQUIRE(scene, delam_problem_set_orientation, scene.problem(), body, 1, nullptr, axes.data(), 0);
}

struct Element {
    std::int32_t cell;
    const char* formulation;
};
constexpr Element elements[] = {{DELAM_TRI3, "standard"},  {DELAM_QUAD4, "standard"}, {DELAM_QUAD4, "incompatible"},
                                {DELAM_TRI6, "standard"},  {DELAM_QUAD8, "standard"}, {DELAM_QUAD9, "standard"},
                                {DELAM_TET4, "standard"},  {DELAM_HEX8, "standard"},  {DELAM_HEX8, "incompatible"},
                                {DELAM_TET10, "standard"}, {DELAM_HEX20, "standard"}};
constexpr int element_count = 11;
bool flat(std::int32_t cell) {
    return cell == DELAM_TRI3 || cell == DELAM_QUAD4 || cell == DELAM_TRI6 || cell == DELAM_QUAD8 ||
           cell == DELAM_QUAD9;
}

// Two bonded plies; x = 0 is fixed along x, with whatever else holds them in place. With `walls` x = length is fixed
// too.
Scene bar(const Element& e, const char* plane, bool walls) {
    const bool two = flat(e.cell);
    const int d = two ? 2 : 3;
    Scene scene(d, two ? std::vector<double>{0.04} : std::vector<double>{0.04, 0.01},
                two ? std::vector<std::int64_t>{5} : std::vector<std::int64_t>{5, 2}, {0.004, 0.006}, {1, 2}, e.cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, poisson);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, e.formulation), "formulation");
    if (two) scene.require(delam_problem_set_plane(scene.problem(), plane), "plane");
    scene.bonded(0);
    scene.hold(nodes_where(scene, -1, [&](const double* x) { return x[0] < 1e-9 || (walls && x[0] > 0.04 - 1e-9); }),
               unit(d, 0));
    scene.hold(nodes_where(scene, 0, [&](const double* x) { return x[d - 1] < 1e-9; }), unit(d, d - 1));
    if (!two) scene.hold(nodes_where(scene, -1, [](const double* x) { return x[1] < 1e-9; }), unit(d, 1));
    return scene;
}

// sigma_xx, sigma_yy, sigma_zz and the energy per volume of a heated cube that is free, or held along x, z or both.
void check_heated(const Element& e, const char* plane, bool walls) {
    Scene scene = bar(e, plane, walls);
    const auto hot = scene.pattern("heat", {0.0, 1.0}, {0.0, heat});
    eigenstrain(scene, hot, -1, {alpha, alpha, alpha, 0, 0, 0});
    const bool flat_strain = flat(e.cell) && std::string(plane) == "plane-strain";
    const double t = -young * alpha * heat;
    double sx = walls ? t : 0.0, sz = flat_strain ? t : 0.0, density = 0.0;
    if (walls && flat_strain) sx = sz = t / (1.0 - poisson);
    density = 0.5 * (sx * sx + sz * sz - 2.0 * poisson * sx * sz) / young;
    const double volume = 0.04 * 0.01 * (flat(e.cell) ? 1.0 : 0.01);
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        scene.text("reduction", reduction);
        Solver solver(scene, 0.0);
        solver.step(1.0);
        const std::string where = std::string(reduction) + ", " + plane + (walls ? ", walls: " : ", free: ");
        const auto stress = solver.field("stress");
        const std::size_t columns = flat(e.cell) ? 4 : 6;
        for (std::size_t i = 0; i < stress.size(); ++i)
            cases::expect_near(stress[i],
                               i % columns == 0   ? sx
                               : i % columns == 2 ? sz
                                                  : 0.0,
                               1e-9, -t, where + "stress " + std::to_string(i % columns));
        const double scale = 0.5 * young * alpha * alpha * heat * heat * volume;
        cases::expect_near(solver.value("stored_bulk"), density * volume, 1e-9, scale, where + "energy");
        cases::expect(solver.value("stored_bulk") >= 0.0, where + "never negative");
        cases::expect_near(solver.value("reaction:heat"), 2.0 * density * volume / heat, 1e-9, scale / heat,
                           where + "conjugate");
        cases::expect_near(solver.value("work"), density * volume, 1e-9, scale, where + "work");
        cases::expect_below(solver.value("kkt_equilibrium"), 1e-7, where + "equilibrium");
    }
}

}  // namespace

LOOP_TEST(heated, 0, element_count) {
    const Element& e = elements[loop];
    for (const bool walls : {false, true}) {
        check_heated(e, "plane-strain", walls);
        if (flat(e.cell)) check_heated(e, "plane-stress", walls);
    }
}

// S. Timoshenko, J. Opt. Soc. Am. 11 (1925): curvature of a strip of two metals, m = t1/t2, n = E1/E2,
//   kappa = 6 (alpha2 - alpha1) dT (1+m)^2 / (h (3 (1+m)^2 + (1 + m n) (m^2 + 1/(m n)))).
LOOP_TEST(bimetal, 0, 2) {
    const std::int32_t cell = loop == 0 ? DELAM_QUAD8 : DELAM_QUAD4;
    const double length = 0.1, t1 = 0.002, t2 = 0.003, e1 = 200e9, e2 = 70e9, a1 = 1.2e-5, a2 = 2.3e-5;
    Scene scene(2, {length}, {50}, {t1, t2}, {2, 3}, cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(0, e1, 0.0);
    scene.elastic(1, e2, 0.0);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, loop == 0 ? "standard" : "incompatible"),
                  "formulation");
    scene.require(delam_problem_set_plane(scene.problem(), "plane-stress"), "plane");
    scene.bonded(0);
    const auto corner = nodes_where(scene, 0, [](const double* x) { return x[0] < 1e-9 && x[1] < 1e-9; });
    scene.hold(corner, unit(2, 0));
    scene.hold(corner, unit(2, 1));
    scene.hold(nodes_where(scene, 0, [&](const double* x) { return x[0] > length - 1e-9 && x[1] < 1e-9; }), unit(2, 1));
    const auto hot = scene.pattern("heat", {0.0, 1.0}, {0.0, heat});
    eigenstrain(scene, hot, 0, {a1, a1, a1, 0, 0, 0});
    eigenstrain(scene, hot, 1, {a2, a2, a2, 0, 0, 0});
    const double m = t1 / t2, n = e1 / e2, h = t1 + t2;
    const double kappa = 6.0 * (a2 - a1) * heat * (1.0 + m) * (1.0 + m) /
                         (h * (3.0 * (1.0 + m) * (1.0 + m) + (1.0 + m * n) * (m * m + 1.0 / (m * n))));
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        scene.text("reduction", reduction);
        Solver solver(scene, 0.0);
        solver.step(1.0);
        const auto u = solver.field("displacement");
        // Three points of the lower edge, away from the ends: the hotter side is the longer one.
        double y[3] = {};
        for (int i = 0; i < 3; ++i) {
            const double at = length * (0.3 + 0.2 * i);
            const auto node =
                nodes_where(scene, 0, [&](const double* x) { return std::abs(x[0] - at) < 1e-6 && x[1] < 1e-9; });
            y[i] = u[size(node.front()) * 2 + 1];
        }
        const double found = -(y[0] - 2.0 * y[1] + y[2]) / (0.04 * length * length);
        cases::expect_near(found, kappa, 1e-3, kappa, std::string(reduction) + ": curvature");
    }
}

// [0/90/0] cooled after its cure: in the middle, sigma_x = E_x (eps - alpha_x dT), eps = sum t E_x alpha_x dT / sum t
// E_x.
TEST(cross_ply) {
    const double length = 0.08, thick = 0.002, inner = 0.003, a1 = -0.3e-6, a2 = 28e-6, cold = -120.0;
    Scene scene(2, {length}, {40}, {thick, inner, thick}, {2, 3, 2}, DELAM_QUAD8);
    scene.interface(0, 1);
    scene.interface(1, 2);
    scene.begin();
    scene.require(delam_problem_set_plane(scene.problem(), "plane-stress"), "plane");
    scene.require(delam_problem_set_orthotropic(scene.problem(), -1, ply), "orthotropic");
    turn(scene, -1, {1, 0, 0, 0, 0, -1});
    turn(scene, 1, {0, 0, 1, 1, 0, 0});
    scene.bonded(0);
    scene.bonded(1);
    scene.hold(nodes_where(scene, -1, [](const double* x) { return x[0] < 1e-9; }), unit(2, 0));
    scene.hold(nodes_where(scene, 0, [](const double* x) { return x[0] < 1e-9 && x[1] < 1e-9; }), unit(2, 1));
    const auto cure = scene.pattern("cure", {0.0, 1.0}, {0.0, cold});
    eigenstrain(scene, cure, -1, {a1, a2, a2, 0, 0, 0});
    const double eps =
        (2.0 * thick * ply[0] * a1 + inner * ply[1] * a2) / (2.0 * thick * ply[0] + inner * ply[1]) * cold;
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const auto stress = solver.field("stress");
    for (std::size_t c = 0; c < stress.size() / 4; ++c) {
        const std::size_t column = c % 40;
        if (column > 10) continue;
        const bool within = c >= 80 && c < 200;
        const double expected = within ? ply[1] * (eps - a2 * cold) : ply[0] * (eps - a1 * cold);
        cases::expect_near(stress[c * 4], expected, 2e-3, std::abs(expected), "cell " + std::to_string(c));
    }
}

namespace {

// Plies that open, slide and press under a pattern, in addition with thermal strains of rotated orthotropic plies.
Scene loaded(int which, const LawData& law) {
    static const struct {
        int d;
        std::int32_t cell;
        const char* formulation;
        const char* plane;
    } kind[] = {{2, DELAM_QUAD4, "incompatible", "plane-strain"},
                {2, DELAM_TRI6, "standard", "plane-stress"},
                {3, DELAM_HEX8, "incompatible", ""},
                {3, DELAM_TET10, "standard", ""}};
    const auto& k = kind[which];
    Scene scene = cases::make_plies(k.d, 2, k.cell, k.formulation, law);
    if (k.d == 2) scene.require(delam_problem_set_plane(scene.problem(), k.plane), "plane");
    scene.require(delam_problem_set_orthotropic(scene.problem(), 1, ply), "orthotropic");
    turn(scene, 1, k.d == 2 ? std::array<double, 6>{2, 1, 0.5, 0, 1, 0} : std::array<double, 6>{1, 1, 0, -1, 1, 0.2});
    const auto cure = scene.pattern("cure", {-1.0, 0.0, 1.0}, {0.0, -80.0, -80.0});
    const auto wet = scene.pattern("wet", {-1.0, 0.0, 1.0}, {0.0, 0.0, 1.0});
    eigenstrain(scene, cure, 1, {-0.3e-6, 28e-6, 25e-6, 1e-6, -2e-6, 3e-6});
    eigenstrain(scene, cure, 0, {12e-6, 12e-6, 12e-6, 0, 0, 0});
    eigenstrain(scene, wet, 1, {0.0, 4e-4, 5e-4, 0, 0, 0});
    return scene;
}

}  // namespace

LOOP_TEST(against_the_reference, 0, 4) {
    Scene scene = loaded(loop, cases::block_law);
    std::vector<double> adhesion(scene.pair_count());
    for (std::size_t i = 0; i < adhesion.size(); ++i) adhesion[i] = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.4 : 1.0;
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        scene.text("reduction", reduction);
        reference::DirectReference direct(scene);
        Solver solver(scene, -1.0);
        for (const double time : {-0.3, 0.5, 1.0}) {
            solver.equilibrate(time, adhesion);
            const auto state = direct.solve(time, adhesion);
            const auto result = reference::compare(solver, state, direct.exported(), 1e-7);
            cases::expect_below(result.worst(), 1e-6, std::string(reduction) + ": " + result.text());
            solver.commit();
        }
    }
}

// At fixed adhesion and contact, E is quadratic in the factors, so a central difference is its exact derivative.
LOOP_TEST(conjugates_are_derivatives, 0, 4) {
    Scene scene = loaded(loop, cases::block_law);
    const std::vector<double> adhesion(scene.pair_count(), 1.0);
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        scene.text("reduction", reduction);
        Solver solver(scene, -1.0);
        const auto energy = [&](double time, double& power) {
            solver.equilibrate(time, adhesion);
            const double e = solver.value("stored_bulk") + solver.value("stored_interface");
            power = 0.0;
            for (const char* name : {"wet", "bend", "slide"})
                power += solver.value(std::string("reaction:") + name) * (std::string(name) == "wet"    ? 1.0
                                                                          : std::string(name) == "bend" ? 1e-5
                                                                                                        : 3e-6);
            solver.rollback();
            return e;
        };
        double low = 0.0, middle = 0.0, high = 0.0;
        const double before = energy(0.399, low), after = energy(0.401, high);
        energy(0.4, middle);
        cases::expect_near((after - before) / 0.002, middle, 1e-5, std::abs(middle) + std::abs(low) + std::abs(high),
                           std::string(reduction) + ": dE/dt");
        cases::expect_near(0.5 * (low + high), middle, 1e-6, std::abs(low) + std::abs(high),
                           std::string(reduction) + ": linear in t");
    }
}

namespace {

// Two plies, held at the left end and notched at the right one, where they are opened after cooling.
Scene cured(int which) {
    const std::int32_t cell = which == 0 ? DELAM_QUAD4 : which == 1 ? DELAM_TRI6 : DELAM_HEX8;
    const int d = which == 2 ? 3 : 2;
    Scene scene(d, d == 2 ? std::vector<double>{0.04} : std::vector<double>{0.04, 0.01},
                d == 2 ? std::vector<std::int64_t>{40} : std::vector<std::int64_t>{20, 2}, {0.002, 0.003}, {1, 1},
                cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(0, young, poisson);
    scene.require(delam_problem_set_orthotropic(scene.problem(), 1, ply), "orthotropic");
    turn(scene, 1, d == 2 ? std::array<double, 6>{0, 0, 1, 1, 0, 0} : std::array<double, 6>{1, 1, 0, -1, 1, 0});
    if (cell != DELAM_TRI6)
        scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
    scene.law(0, {2e11, 2e11, 20.0, 20.0, 100.0, 100.0, 1.0});
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> notch;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) > 0.03 + 1e-9) notch.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    for (int k = 0; k < d; ++k)
        scene.hold(nodes_where(scene, -1, [](const double* x) { return x[0] < 1e-9; }), unit(d, k));
    const auto tip = [&](int body) {
        return nodes_where(scene, body, [&](const double* x) {
            return x[0] > 0.04 - 1e-9 && std::abs(x[d - 1] - (body == 0 ? 0.0 : 0.005)) < 1e-9;
        });
    };
    const auto open = scene.pattern("open", {0.0, 1.0, 2.0}, {0.0, 0.0, 4e-4});
    const auto cure = scene.pattern("cure", {0.0, 1.0}, {0.0, -150.0});
    scene.drive(tip(1), unit(d, d - 1), open, std::vector<double>(tip(1).size(), 1.0));
    scene.drive(tip(0), unit(d, d - 1), open, std::vector<double>(tip(0).size(), -1.0));
    eigenstrain(scene, cure, 0, {20e-6, 20e-6, 20e-6, 0, 0, 0});
    eigenstrain(scene, cure, 1, {-0.3e-6, 28e-6, 28e-6, 0, 0, 0});
    return scene;
}

}  // namespace

// Cure first, then load until the plies debond: the bounds hold in every step and the ledger closes.
LOOP_TEST(cure_then_load, 0, 3) {
    Scene scene = cured(loop);
    double kept = 0.0, spent = 0.0;
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        scene.text("reduction", reduction);
        Solver solver(scene, 0.0);
        double residual = 0.0, released = 0.0;
        for (int k = 1; k <= 40; ++k) {
            solver.step(0.05 * k);
            const double size = std::abs(solver.value("work")) + solver.value("stored_bulk");
            cases::expect(solver.value("stored_bulk") >= 0.0, "stored");
            cases::expect_below(solver.value("increment") - solver.value("upper"), 1e-6 * size,
                                "upper bound of step " + std::to_string(k));
            cases::expect_below(solver.value("lower") - solver.value("increment"), 1e-6 * size,
                                "lower bound of step " + std::to_string(k));
            released += solver.value("released");
            solver.commit();
            if (k == 20) residual = solver.value("stored_bulk");
        }
        const double total =
            solver.value("stored_bulk") + solver.value("stored_interface") + solver.value("dissipated");
        cases::expect(residual > 0.0 && solver.value("dissipated") > 0.01 * total,
                      "residual stress, and something debonds");
        cases::expect_near(solver.value("defect"), total + released - solver.value("work"), 1e-9, total, "defect");
        cases::expect_below(released, 0.01 * total, "nothing jumps");
        cases::expect_below(std::abs(solver.value("defect")), 0.05 * total, "the ledger closes with the step");
        if (reduction == std::string("condensed")) {
            kept = solver.value("stored_bulk");
            spent = solver.value("dissipated");
        } else {
            cases::expect_near(solver.value("stored_bulk"), kept, 1e-5, kept, "FETI: stored");
            cases::expect_near(solver.value("dissipated"), spent, 1e-4, spent + kept, "FETI: dissipated");
        }
    }
}

// One material and one expansion throughout: nothing loads the interface, and rounding must not count as contact.
LOOP_TEST(nothing_to_hold, 0, element_count) {
    const Element& e = elements[loop];
    const int d = flat(e.cell) ? 2 : 3;
    Scene scene(d, d == 2 ? std::vector<double>{0.04} : std::vector<double>{0.04, 0.01},
                d == 2 ? std::vector<std::int64_t>{6} : std::vector<std::int64_t>{6, 2}, {0.003, 0.003}, {1, 1},
                e.cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, poisson);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, e.formulation), "formulation");
    scene.law(0, cases::block_law);
    scene.hold(nodes_where(scene, 0, [](const double* x) { return x[0] < 1e-9; }), unit(d, 0));
    scene.hold(nodes_where(scene, 0, [&](const double* x) { return x[d - 1] < 1e-9; }), unit(d, d - 1));
    if (d == 3) scene.hold(nodes_where(scene, 0, [](const double* x) { return x[1] < 1e-9; }), unit(d, 1));
    const auto hot = scene.pattern("heat", {0.0, 1.0}, {0.0, heat});
    eigenstrain(scene, hot, -1, {alpha, alpha, alpha, 0, 0, 0});
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        scene.text("reduction", reduction);
        Solver solver(scene, 0.0);
        solver.step(1.0);
        cases::expect(solver.value("contact_iterations") <= 3.0, "contact settles");
        for (const double t : solver.field("traction"))
            cases::expect_near(t, 0.0, 1e-8, young * alpha * heat, std::string(reduction) + ": traction");
    }
}

// An unsupported ply is heated: it expands, and no part of it resists.
LOOP_TEST(floating_ply, 0, element_count) {
    const Element& e = elements[loop];
    const int d = flat(e.cell) ? 2 : 3;
    Scene loose(d, d == 2 ? std::vector<double>{0.04} : std::vector<double>{0.04, 0.01},
                d == 2 ? std::vector<std::int64_t>{6} : std::vector<std::int64_t>{6, 2}, {0.003, 0.003}, {1, 1},
                e.cell);
    loose.interface(0, 1);
    loose.begin();
    loose.elastic(-1, young, poisson);
    loose.require(delam_problem_set_formulation(loose.problem(), -1, e.formulation), "formulation");
    if (d == 2) loose.require(delam_problem_set_plane(loose.problem(), "plane-stress"), "plane");
    loose.law(0, cases::block_law);
    loose.hold(nodes_where(loose, 0, [](const double* x) { return x[0] < 1e-9; }), unit(d, 0));
    loose.hold(nodes_where(loose, 0, [&](const double* x) { return x[d - 1] < 1e-9; }), unit(d, d - 1));
    if (d == 3) loose.hold(nodes_where(loose, 0, [](const double* x) { return x[1] < 1e-9; }), unit(d, 1));
    const auto hot = loose.pattern("heat", {0.0, 1.0}, {0.0, heat});
    eigenstrain(loose, hot, -1, {alpha, alpha, alpha, 0, 0, 0});
    const std::vector<double> none(loose.pair_count(), 0.0);
    std::vector<std::int64_t> all(loose.pair_count());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int64_t>(i);
    loose.adhesion(0, all, none);
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        loose.text("reduction", reduction);
        Solver solver(loose, 0.0);
        solver.step(1.0);
        const double scale = 0.5 * young * alpha * alpha * heat * heat * 0.04 * 0.006 * (d == 2 ? 1.0 : 0.01);
        cases::expect_below(solver.value("stored_bulk"), 1e-9 * scale, std::string(reduction) + ": stored");
        for (const double s : solver.field("stress"))
            cases::expect_near(s, 0.0, 1e-7, young * alpha * heat, std::string(reduction) + ": stress");
    }
}
