// SPDX-License-Identifier: BSD-3-Clause
// Plies held only by contact, or by nothing; several interfaces; four blocks around a cross point. The state must pass
// the KKT conditions outside the solver. Free sliding makes displacements non-unique, so the reference pins one node
// where that changes neither stresses nor energies.
#include <algorithm>

#include "acceptance.hpp"
#include "comparison.hpp"
#include "direct.hpp"
#include "support.hpp"

namespace {

using reference::DirectReference;
using reference::Exported;
using reference::LawData;
using reference::Scene;
using reference::Solver;

constexpr LawData law{2e11, 1e11, 150.0, 200.0, 300.0, 500.0};
constexpr double length = 0.04;
constexpr double width = 0.02;
constexpr double ply = 0.003;
constexpr double press = 2e-6;

std::vector<double> point(int d, double x, double y, double z) {
    return d == 2 ? std::vector<double>{x, z} : std::vector<double>{x, y, z};
}

std::vector<double> axis(int d, int k) {
    std::vector<double> e(static_cast<std::size_t>(d), 0.0);
    e[static_cast<std::size_t>(k)] = 1.0;
    return e;
}

std::vector<std::int64_t> all_pairs(const Scene& scene, std::int64_t interface_index) {
    std::vector<std::int64_t> pairs(scene.pairs(interface_index).count());
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = static_cast<std::int64_t>(i);
    return pairs;
}

// Three plies on a fixed bottom face; `loose` interfaces have lost all adhesion. `push` drives nodes of the top face
// near mid-span along the stacking axis; with push 0 nothing touches the top. `pinned`: bodies of which one node is
// held laterally.
Scene plies(int d, const std::vector<std::int64_t>& loose, double push, const std::vector<std::int32_t>& pinned,
            int subdomains) {
    Scene scene(d, d == 2 ? std::vector<double>{length} : std::vector<double>{length, width},
                d == 2 ? std::vector<std::int64_t>{20} : std::vector<std::int64_t>{6, 3}, {ply, ply, ply}, {2, 2, 2},
                d == 2 ? DELAM_QUAD4 : DELAM_HEX8);
    scene.interface(0, 1);
    scene.interface(1, 2);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.law(0, law);
    scene.law(1, law);
    for (const auto i : loose) {
        const auto pairs = all_pairs(scene, i);
        scene.adhesion(i, pairs, std::vector<double>(pairs.size(), 0.0));
    }
    const auto bottom = scene.find(0, point(d, 0, 0, 0), point(d, length, width, 0));
    for (int k = 0; k < d; ++k) scene.hold(bottom, axis(d, k));
    if (push != 0.0) {
        const auto load = scene.pattern("push", {0.0, 1.0}, {0.0, push});
        const auto top = scene.find(2, point(d, 0.3 * length, 0, 3 * ply), point(d, 0.6 * length, width, 3 * ply));
        scene.drive(top, axis(d, d - 1), load, std::vector<double>(top.size(), -1.0));
    }
    // One corner is held in the plane and, in 3D, another one against rotation about the stacking axis.
    for (const auto body : pinned) {
        const double z = (body + 0.5) * ply;
        const auto corner = scene.find(body, point(d, 0, 0, z), point(d, 0, 0, z));
        scene.hold(corner, axis(d, 0));
        if (d == 3) {
            scene.hold(corner, axis(d, 1));
            scene.hold(scene.find(body, point(d, length, 0, z), point(d, length, 0, z)), axis(d, 1));
        }
    }
    scene.number("subdomains", subdomains);
    return scene;
}

void expect_accepted(const Solver& solver, const std::string& where) {
    const auto a = reference::accept(solver, Exported(solver.scene()));
    cases::expect_below(a.worst(), 1e-10, where + ": " + a.text());
}

struct Loose {
    std::vector<std::int64_t> interfaces;
    std::vector<std::int32_t> pinned;
    const char* name;
};
const Loose loose_cases[] = {
    {{1}, {2}, "top ply"}, {{0}, {1}, "two plies together"}, {{0, 1}, {1, 2}, "middle and top ply"}};

// Pressed down in the middle, the loose plies rest on those below; their ends may lift off.
LOOP_TEST(pressed_plies, 0, 6) {
    const int d = loop / 3 == 0 ? 2 : 3;
    const Loose& l = loose_cases[loop % 3];
    const Scene supported = plies(d, l.interfaces, press, l.pinned, 3);
    DirectReference direct(supported);
    const auto state = direct.solve(1.0, Solver(supported, 0.0).field("adhesion"));
    for (const int subdomains : {3, 7}) {
        const std::string where =
            std::string(l.name) + ", " + std::to_string(d) + "D, " + std::to_string(subdomains) + " subdomains";
        const Scene floating = plies(d, l.interfaces, press, {}, subdomains);
        Solver solver(floating, 0.0);
        solver.equilibrate(1.0, {});
        expect_accepted(solver, where);
        cases::expect(solver.value("reaction:push") > 0.0, where + ": the device does work");
        cases::expect(solver.value("contact_pairs") > 0.0, where + ": something rests");

        const Scene pinned = plies(d, l.interfaces, press, l.pinned, subdomains);
        Solver held(pinned, 0.0);
        held.equilibrate(1.0, {});
        const auto comparison = reference::compare(held, state, direct.exported(), 1e-10);
        cases::expect_below(comparison.worst(), 1e-8, where + ", pinned: " + comparison.text());
        cases::expect(comparison.contacts == 0, where + ", pinned: " + comparison.text());
        const double energy = state.stored_bulk + state.stored_interface;
        cases::expect_near(solver.value("stored_bulk"), state.stored_bulk, 1e-8, energy, where + ": stored bulk");
        cases::expect_near(solver.value("stored_interface"), state.stored_interface, 1e-8, energy,
                           where + ": stored interface");
        cases::expect_near(solver.value("reaction:push"), state.pattern[0], 1e-8, state.pattern[0],
                           where + ": reaction");
    }
}

// Pulled up: loose plies leave as a whole, without stress.
LOOP_TEST(lifted_plies, 0, 6) {
    const int d = loop / 3 == 0 ? 2 : 3;
    const Loose& l = loose_cases[loop % 3];
    const std::string where = std::string(l.name) + ", " + std::to_string(d) + "D";
    const Scene scene = plies(d, l.interfaces, -press, {}, 3);
    Solver solver(scene, 0.0);
    solver.equilibrate(1.0, {});
    const double scale = 70e9 * press;  // the stress that holding the plies back would cause, times a ply
    for (const double t : solver.field("traction"))
        cases::expect_near(t, 0.0, 1e-10, scale / ply, where + ": traction");
    for (const double j : solver.field("jump")) cases::expect(std::isfinite(j), where + ": jump");
    cases::expect_near(solver.value("reaction:push"), 0.0, 1e-10, scale, where + ": reaction");
    const auto jump = solver.field("jump");
    for (std::size_t i = 0; i < jump.size(); i += static_cast<std::size_t>(d)) {
        cases::expect(jump[i] >= -1e-10 * press, where + ": gap");
    }
}

// Nothing touches the loose ply: it may lie anywhere above, at rest, without energy.
LOOP_TEST(idle_plies, 0, 6) {
    const int d = loop / 3 == 0 ? 2 : 3;
    const Loose& l = loose_cases[loop % 3];
    const std::string where = std::string(l.name) + ", " + std::to_string(d) + "D";
    const Scene scene = plies(d, l.interfaces, 0.0, {}, 3);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    solver.commit();
    cases::expect_near(solver.value("stored_bulk"), 0.0, 1e-20, 1.0, where + ": stored");
    cases::expect(solver.value("dissipated") == 0.0, where + ": dissipated");
    for (const double u : solver.field("displacement")) cases::expect(std::isfinite(u), where + ": displacement");
}

void lift_by_force(Scene& scene, double force) {
    const auto load = scene.pattern("lift", {0.0, 1.0}, {0.0, 1.0});
    const auto top = scene.find(2, {0.0, 3 * ply}, {length, 3 * ply});
    std::vector<double> forces;
    for (std::size_t i = 0; i < top.size(); ++i)
        forces.insert(forces.end(), {0.0, force / static_cast<double>(top.size())});
    REQUIRE(scene, delam_problem_add_forces, scene.problem(), load, static_cast<std::int64_t>(top.size()), top.data(),
            forces.data(), 0);
}

// A dead load on a ply that is loose from the start is refused with the scene.
TEST(dead_load_on_a_loose_ply) {
    Scene scene = plies(2, {1}, 0.0, {}, 3);
    lift_by_force(scene, 10.0);
    cases::expect(delam_problem_check(scene.problem()) == DELAM_ERROR_PROBLEM, "the scene is refused");
    cases::expect(std::string(delam_context_message(scene.context())) != "", "a message says why");
}

// A dead load beyond the interface's strength tears a ply off: there is no equilibrium, and the solver reports it.
TEST(dead_load_tears_a_ply_off) {
    Scene scene = plies(2, {}, 0.0, {}, 3);
    const double strength = std::sqrt(2.0 * law.normal_stiffness * law.normal_onset);
    lift_by_force(scene, 2.0 * strength * length);
    Solver solver(scene, 0.0);
    solver.step(0.25);
    solver.commit();
    cases::expect(solver.value("dissipated") == 0.0, "half the strength breaks nothing");
    const auto u = solver.field("displacement");
    const std::int32_t status = solver.advance(1.0);
    cases::expect(status == DELAM_LIMIT, std::string("status ") + delam_status_name(status));
    cases::expect(std::string(delam_context_message(scene.context())) != "", "a message says why");
    cases::expect(solver.field("displacement") == u, "the committed state is what is left");
}

// A block slides under one that is held, driven along its upper face. It may fall and turn, and nothing strains it. The
// least change of its places, int |u|^2 dV, turns it about one of its upper corners so that its lower face goes half
// as far: a = 1/2 minimises 2 (1 - a)^2 + 2 a^2. Its contact forces are rounding of the forces within the block, which
// the two normal jumps alone do not show: the block resists neither.
LOOP_TEST(driven_block, 0, 6) {
    constexpr const char* reductions[] = {"condensed", "iterated", "feti"};
    const double slide = loop % 2 == 0 ? 0.0104 : -0.0037;
    Scene scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 17.0, 0.31);
    scene.contact(0);
    scene.text("reduction", reductions[loop / 2]);
    const auto held = scene.find(1, {0.0, 1.0}, {1.0, 2.0}), driven = scene.find(0, {0.0, 1.0}, {1.0, 1.0});
    for (int k = 0; k < 2; ++k) scene.hold(held, axis(2, k));
    scene.drive(driven, axis(2, 0), scene.pattern("slide", {0.0, 1.0}, {0.0, slide}), {1.0, 1.0});
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const std::vector<double> u = solver.field("displacement");
    const double size = std::abs(slide);
    std::vector<double> rise;
    for (const auto node : driven) rise.push_back(u[static_cast<std::size_t>(2 * node + 1)]);
    const auto [falls, stays] = std::minmax(rise[0], rise[1]);
    cases::expect_near(falls, -0.5 * size, 1e-9, size, "the corner that falls");
    cases::expect_near(stays, 0.0, 1e-9, size, "the corner that stays");
    for (const auto node : scene.find(0, {0.0, 0.0}, {1.0, 0.0}))
        cases::expect_near(u[static_cast<std::size_t>(2 * node)], 0.5 * slide, 1e-9, size, "the lower face");
}

// Intact triple layers with two interfaces, one perfectly bonded or both compliant, bent: against the reference.
LOOP_TEST(bent_layers, 0, 4) {
    const int d = loop / 2 == 0 ? 2 : 3;
    const bool bonded = loop % 2 == 1;
    reference::State state;  // of the first, for both
    for (const int subdomains : {3, 8}) {
        Scene scene(d, d == 2 ? std::vector<double>{length} : std::vector<double>{length, width},
                    d == 2 ? std::vector<std::int64_t>{20} : std::vector<std::int64_t>{6, 3}, {ply, ply, ply},
                    {2, 1, 2}, d == 2 ? DELAM_TRI3 : DELAM_TET4);
        scene.interface(0, 1);
        scene.interface(1, 2);
        scene.begin();
        scene.elastic(-1, 70e9, 0.3);
        scene.elastic(1, 5e9, 0.4);
        scene.law(0, law);
        if (bonded) {
            scene.bonded(1);
        } else {
            scene.law(1, law);
        }
        const auto root = scene.find(-1, point(d, 0, 0, 0), point(d, 0, width, 3 * ply));
        std::vector<std::int64_t> held;
        const auto upper = scene.pairs(1).node_b;
        for (const auto n : root) {
            // One support is enough for two permanently bonded nodes: tractions stay unique.
            if (!bonded || std::find(upper.begin(), upper.end(), n) == upper.end()) held.push_back(n);
        }
        for (int k = 0; k < d; ++k) scene.hold(held, axis(d, k));
        const auto load = scene.pattern("bend", {0.0, 1.0}, {0.0, 1e-5});
        const auto tip = scene.find(2, point(d, length, 0, 3 * ply), point(d, length, width, 3 * ply));
        scene.drive(tip, axis(d, d - 1), load, std::vector<double>(tip.size(), -1.0));
        scene.number("subdomains", subdomains);
        Solver solver(scene, 0.0);
        solver.equilibrate(1.0, {});
        const std::string where =
            std::to_string(d) + "D, " + std::to_string(subdomains) + " subdomains" + (bonded ? ", bonded" : "");
        expect_accepted(solver, where);
        if (subdomains == 3) state = DirectReference(scene).solve(1.0, solver.field("adhesion"));
        const auto c = reference::compare(solver, state, Exported(scene), 1e-10);
        cases::expect_below(c.worst(), 1e-8, where + ": " + c.text());
    }
}

// Four square blocks of n x n cells around (0,0): bodies 0 1 below, 2 3 above. Four interfaces meet in one point.
Scene cross(int n, bool bonded_one) {
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
    const double h = 0.01 / n;
    for (std::int32_t body = 0; body < 4; ++body) {
        const auto first = static_cast<std::int64_t>(nodes.size() / 2);
        const double x0 = body % 2 == 0 ? -0.01 : 0.0;
        const double y0 = body / 2 == 0 ? -0.01 : 0.0;
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) nodes.insert(nodes.end(), {x0 + i * h, y0 + j * h});
        }
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const std::int64_t corner = first + j * (n + 1) + i;
                cells.insert(cells.end(), {corner, corner + 1, corner + n + 2, corner + n + 1});
                bodies.push_back(body);
            }
        }
    }
    Scene scene(2, nodes, DELAM_QUAD4, cells, bodies);
    for (const auto& [a, b] : {std::pair{0, 1}, {2, 3}, {0, 2}, {1, 3}}) scene.interface(a, b);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    for (std::int64_t i = 0; i < 4; ++i) scene.law(i, law);
    if (bonded_one) scene.bonded(3);
    const auto bottom = scene.find(-1, {-0.01, -0.01}, {0.01, -0.01});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, 1e-6});
    const auto top = scene.find(-1, {-0.01, 0.01}, {0.01, 0.01});
    std::vector<double> lift;
    std::vector<double> slide;
    for (const auto node : top) {
        lift.push_back(1.0 + 40.0 * scene.coordinate(node, 0));
        slide.push_back(scene.coordinate(node, 0) < 0.0 ? -0.7 : 0.3);
    }
    scene.drive(top, {0.0, 1.0}, load, lift);
    scene.drive(top, {1.0, 0.0}, load, slide);
    return scene;
}

LOOP_TEST(cross_point, 0, 2) {
    reference::State state;  // of the first, for both
    for (const int subdomains : {4, 9}) {
        Scene scene = cross(6, loop == 1);
        scene.number("subdomains", subdomains);
        Solver solver(scene, 0.0);
        std::vector<double> adhesion(scene.pair_count());
        for (std::size_t i = 0; i < adhesion.size(); ++i) adhesion[i] = 0.1 + 0.9 * static_cast<double>(i % 5) / 4.0;
        if (loop == 1) adhesion = solver.field("adhesion");
        solver.equilibrate(1.0, adhesion);
        const std::string where = std::to_string(subdomains) + " subdomains";
        expect_accepted(solver, where);
        if (subdomains == 4) state = DirectReference(scene).solve(1.0, adhesion);
        const auto c = reference::compare(solver, state, Exported(scene), 1e-10);
        cases::expect_below(c.worst(), 1e-8, where + ": " + c.text());
        cases::expect(c.contacts == 0, where + ": " + c.text());
    }
}

}  // namespace
