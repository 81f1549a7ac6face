// SPDX-License-Identifier: BSD-3-Clause
// A small delamination analysis with each cell type and formulation through the public API: two plies, notched at one
// end and peeled apart there, held at the other. The states satisfy equilibrium and contact checked outside the solver,
// and reactions and energies match the direct reference at the same adhesion; elements that bend well agree with each
// other.
#include <algorithm>
#include <cmath>

#include "acceptance.hpp"
#include "direct.hpp"
#include "support.hpp"

namespace {

using reference::DirectReference;
using reference::Exported;
using reference::Scene;
using reference::Solver;

struct Element {
    int dimension;
    std::int32_t cell;
    const char* formulation;
    const char* name;
    bool bends;
};
constexpr Element elements[] = {{2, DELAM_QUAD4, "standard", "quad4", false},
                                {2, DELAM_QUAD4, "incompatible", "quad4 incompatible", true},
                                {2, DELAM_TRI6, "standard", "tri6", true},
                                {2, DELAM_QUAD8, "standard", "quad8", true},
                                {2, DELAM_QUAD9, "standard", "quad9", true},
                                {3, DELAM_HEX8, "standard", "hex8", false},
                                {3, DELAM_HEX8, "incompatible", "hex8 incompatible", true},
                                {3, DELAM_TET10, "standard", "tet10", true},
                                {3, DELAM_HEX20, "standard", "hex20", true},
                                {3, DELAM_HEX27, "standard", "hex27", true},
                                {3, DELAM_WEDGE6, "standard", "wedge6", false},
                                {3, DELAM_PYRAMID5, "standard", "pyramid5", false},
                                {3, DELAM_WEDGE15, "standard", "wedge15", true}};
constexpr int element_count = static_cast<int>(std::size(elements));

constexpr double length = 0.04;
constexpr double width = 0.01;
constexpr double ply = 0.002;
constexpr double notch = 0.01;
constexpr int steps = 6;

std::vector<double> point(int d, double x, double y, double z) {
    return d == 2 ? std::vector<double>{x, z} : std::vector<double>{x, y, z};
}

// One cell across each ply. The arms are pulled apart at x = 0 by their outer edges.
Scene peel(const Element& e) {
    const int d = e.dimension;
    Scene scene(d, d == 2 ? std::vector<double>{length} : std::vector<double>{length, width},
                d == 2 ? std::vector<std::int64_t>{20} : std::vector<std::int64_t>{12, 1}, {ply, ply}, {1, 1}, e.cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, e.formulation), "formulation");
    scene.law(0, {1e12, 1e12, 50.0, 50.0, 200.0, 200.0});
    std::vector<std::int64_t> open;
    const auto pairs = scene.pairs(0);
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < notch - 1e-6) open.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    const auto end = scene.find(-1, point(d, length, 0, 0), point(d, length, width, 2 * ply));
    for (int k = 0; k < d; ++k) {
        std::vector<double> direction(static_cast<std::size_t>(d), 0.0);
        direction[static_cast<std::size_t>(k)] = 1.0;
        scene.hold(end, direction);
    }
    const auto load = scene.pattern("peel", {0.0, 1.0}, {0.0, 4e-4});
    std::vector<double> up(static_cast<std::size_t>(d), 0.0);
    up.back() = 1.0;
    const auto top = scene.find(1, point(d, 0, 0, 2 * ply), point(d, 0, width, 2 * ply));
    const auto bottom = scene.find(0, point(d, 0, 0, 0), point(d, 0, width, 0));
    scene.drive(top, up, load, std::vector<double>(top.size(), 0.5));
    scene.drive(bottom, up, load, std::vector<double>(bottom.size(), -0.5));
    scene.number("subdomains", 3);
    return scene;
}

struct Outcome {
    double front;
    double reaction;
};

Outcome analyse(const Element& e) {
    const Scene scene = peel(e);
    Solver solver(scene, 0.0);
    DirectReference direct(scene);
    const Exported exported(scene);
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        const auto accepted = reference::accept(solver, exported);
        cases::expect_below(accepted.worst(), 1e-8, std::string(e.name) + ": " + accepted.text());
        solver.commit();
    }
    const auto state = direct.solve(1.0, solver.field("adhesion"));
    const double reaction = solver.value("reaction:peel");
    cases::expect_near(reaction, state.pattern[0], 1e-7, std::abs(reaction), std::string(e.name) + ": reaction");
    cases::expect_near(solver.value("stored_bulk"), state.stored_bulk, 1e-7, state.stored_bulk,
                       std::string(e.name) + ": stored in the bulk");
    const double per_width = e.dimension == 2 ? 1.0 : width;
    return {solver.value("front") / per_width, reaction / per_width};
}

void expect_moves(const Element& e, const Outcome& o) {
    cases::expect(o.front > 1e-3 && o.front < length - notch, std::string(e.name) + ": the front moves");
}

constexpr int first_solid = 5;
LOOP_TEST(solids, 0, element_count - first_solid) {
    const Element& e = elements[first_solid + loop];
    expect_moves(e, analyse(e));
}

// One cell across a ply is enough for elements that bend well: plane strain, so the plane ones are comparable.
TEST(plane_elements_agree) {
    const Outcome fine = analyse(elements[4]);
    expect_moves(elements[4], fine);
    for (const Element& e : elements) {
        if (e.dimension == 3 || e.cell == DELAM_QUAD9) continue;
        const Outcome o = analyse(e);
        expect_moves(e, o);
        const bool quadratic = e.cell != DELAM_QUAD4;
        const double off = std::abs(o.front / fine.front - 1.0);
        if (e.bends) cases::expect_below(off, quadratic ? 0.005 : 0.1, std::string(e.name) + ": front");
        if (!e.bends) cases::expect(off > 0.3, std::string(e.name) + ": locks, its front is far ahead");
    }
}

// Saved and loaded, with the formulation as part of the scene's identity.
TEST(formulation_is_part_of_the_scene) {
    const Scene scene = peel(elements[1]);
    const Scene other = peel(elements[0]);
    char a[17];
    char b[17];
    scene.require(delam_problem_hash(scene.problem(), a), "hash");
    other.require(delam_problem_hash(other.problem(), b), "hash");
    cases::expect(std::string(a) != b, "hashes differ");
    Solver solver(scene, 0.0);
    Solver wrong(other, 0.0);
    cases::expect(wrong.load(solver.save()) == DELAM_ERROR_SNAPSHOT, "a snapshot of another formulation is refused");
}

TEST(refusals) {
    const Scene triangles = peel(elements[2]);
    const auto message = [](const Scene& scene) { return std::string(delam_context_message(scene.context())); };
    cases::expect(delam_problem_set_formulation(triangles.problem(), 1, "incompatible") == DELAM_ERROR_ARGUMENT,
                  "tri6 has no such formulation");
    cases::expect(message(triangles).find("of body 1: it has no cells with such modes") != std::string::npos &&
                      message(triangles).find("cells that have them are quad4 and hex8") != std::string::npos,
                  message(triangles));
    cases::expect(delam_problem_set_formulation(triangles.problem(), -1, "standard") == DELAM_OK,
                  "standard is for all");
    const Scene squares = peel(elements[0]);
    cases::expect(delam_problem_set_formulation(squares.problem(), 0, "reduced") == DELAM_ERROR_ARGUMENT, "unknown");
    cases::expect(message(squares).find("known are standard, incompatible") != std::string::npos, message(squares));
    cases::expect(delam_problem_set_formulation(squares.problem(), 7, "standard") == DELAM_ERROR_ARGUMENT,
                  "no such body");
    cases::expect(delam_problem_set_formulation(squares.problem(), 0, nullptr) == DELAM_ERROR_ARGUMENT, "NULL");
}

}  // namespace
