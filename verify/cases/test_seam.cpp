// SPDX-License-Identifier: BSD-3-Clause
// Seams of doubled nodes within one body, in contact. Pulled apart they are as free as without an interface; pressed
// together, uniformly, the body is as stiff as without a seam. Where seams cross, each arm has an interface.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "api.hpp"
#include "condensed_scenes.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

// A cell of the grid and its place within it decide which copy of a node it has: equal numbers, equal copies.
using Copy = std::function<int(const std::vector<double>& node, const std::vector<double>& centre)>;

constexpr std::array<int, 3> divisions{8, 6, 4};  // of the edges of the unit square or cube

// One body of quad4 or hex8, whose nodes are doubled where cells disagree about their copy.
Scene body(int d, const Copy& copy) {
    std::map<std::vector<int>, std::int64_t> numbers;  // grid place and copy
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
    const auto n = [&](int k) { return d == 2 && k == 1 ? divisions[2] : divisions[static_cast<std::size_t>(k)]; };
    const int layers = d == 2 ? 1 : n(2);
    for (int k = 0; k < layers; ++k)
        for (int j = 0; j < n(1); ++j)
            for (int i = 0; i < n(0); ++i) {
                std::vector<double> centre{(i + 0.5) / n(0), (j + 0.5) / n(1)};
                if (d == 3) centre.push_back((k + 0.5) / n(2));
                for (int corner = 0; corner < (d == 2 ? 4 : 8); ++corner) {
                    std::vector<int> place{i + (corner % 4 == 1 || corner % 4 == 2 ? 1 : 0), j + (corner % 4) / 2};
                    if (d == 3) place.push_back(k + corner / 4);
                    std::vector<double> node;
                    for (int c = 0; c < d; ++c)
                        node.push_back(static_cast<double>(place[static_cast<std::size_t>(c)]) / n(c));
                    place.push_back(copy(node, centre));
                    const auto [at, added] = numbers.emplace(place, static_cast<std::int64_t>(nodes.size()) / d);
                    if (added) nodes.insert(nodes.end(), node.begin(), node.end());
                    cells.push_back(at->second);
                }
                bodies.push_back(0);
            }
    return Scene(d, nodes, d == 2 ? DELAM_QUAD4 : DELAM_HEX8, cells, bodies);
}

// The seam lies at half the height, away from the outside.
bool on_seam(const std::vector<double>& x) {
    for (std::size_t k = 0; k + 1 < x.size(); ++k)
        if (!(x[k] > 0.2 && x[k] < 0.8)) return false;
    return std::abs(x.back() - 0.5) < 1e-9;
}
int slit(const std::vector<double>& node, const std::vector<double>& centre) {
    return on_seam(node) && centre.back() > node.back() ? 1 : 0;
}
int whole(const std::vector<double>&, const std::vector<double>&) { return 0; }
// Two seams that cross, each arm free of the others: a copy for each quarter.
int cross(const std::vector<double>& node, const std::vector<double>& centre) {
    const bool level = on_seam(node),
               upright = std::abs(node[0] - 0.5) < 1e-9 && node.back() > 0.2 && node.back() < 0.8;
    return (level && centre.back() > node.back() ? 1 : 0) + (upright && centre[0] > node[0] ? 2 : 0);
}

struct Answer {
    double reaction, energy;
    std::vector<double> stress;
};

// The lower face is held in the plane of symmetry only, so that the stress is uniform without a seam.
Answer answer(Scene& scene, const char* reduction, double drive) {
    const int d = scene.dimension();
    scene.elastic(-1, 1000.0, 0.3);
    const auto box = [&](int k, double x) {
        std::vector<double> lower(static_cast<std::size_t>(d), 0.0), upper(lower.size(), 1.0);
        lower[static_cast<std::size_t>(k)] = upper[static_cast<std::size_t>(k)] = x;
        return scene.find(0, lower, upper);
    };
    const auto axis = [&](int k) {
        std::vector<double> e(static_cast<std::size_t>(d), 0.0);
        e[static_cast<std::size_t>(k)] = 1.0;
        return e;
    };
    for (int k = 0; k < d; ++k) scene.hold(box(k, 0.0), axis(k));
    const auto load = scene.pattern("drive", {0.0, 1.0}, {0.0, drive});
    const auto top = box(d - 1, 1.0);
    scene.drive(top, axis(d - 1), load, std::vector<double>(top.size(), 1.0));
    scene.text("reduction", reduction);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    return {solver.value("reaction:drive"), solver.value("stored_bulk"), solver.field("stress")};
}

void expect_same(const Answer& got, const Answer& wanted, const std::string& where) {
    cases::expect_near(got.reaction, wanted.reaction, 1e-10, std::abs(wanted.reaction), where + ": reaction");
    cases::expect_near(got.energy, wanted.energy, 1e-10, wanted.energy, where + ": energy");
    double size = 0.0;
    for (const double s : wanted.stress) size = std::max(size, std::abs(s));
    for (std::size_t i = 0; i < got.stress.size(); ++i)
        cases::expect_near(got.stress[i], wanted.stress[i], 1e-9, size, where + ": stress");
}

LOOP_TEST(pressed_and_pulled, 0, 6) {
    const int d = loop / 3 == 0 ? 2 : 3;
    const char* reduction = std::array{"condensed", "iterated", "feti"}[static_cast<std::size_t>(loop) % 3];
    const auto of = [&](const Copy& copy, std::int64_t arms, double drive, const char* with, const std::string& where) {
        Scene scene = body(d, copy);
        std::int64_t seams = 0;
        REQUIRE(scene, delam_mesh_add_seams, scene.mesh(), 0.0, &seams);
        cases::expect(seams == arms, where + ": " + std::to_string(seams) + " seams");
        REQUIRE(scene, delam_mesh_add_seams, scene.mesh(), 0.0, &seams);
        cases::expect(seams == 0, where + ": none is left");
        scene.begin();
        for (std::int64_t i = 0; i < arms; ++i) scene.contact(i);
        return answer(scene, with, drive);
    };
    const auto without = [&](const Copy& copy, double drive) {
        Scene scene = body(d, copy);
        scene.begin();
        return answer(scene, reduction, drive);
    };
    const std::string where = std::to_string(d) + "D, " + reduction;
    expect_same(of(slit, 1, -1e-2, reduction, where), without(whole, -1e-2), where + ", a slit, pressed");
    expect_same(of(slit, 1, 1e-2, reduction, where), without(slit, 1e-2), where + ", a slit, pulled");
    // In space the arms of the upright slit join before and behind the level one.
    const std::int64_t arms = d == 2 ? 4 : 3;
    expect_same(of(cross, arms, -1e-2, reduction, where), without(whole, -1e-2), where + ", a cross, pressed");
    expect_same(of(cross, arms, 1e-2, reduction, where), of(cross, arms, 1e-2, "condensed", where),
                where + ", a cross, pulled");
}

// Two arms with a spacer between their ends, all bonded, as one body with itself or as three bodies: the free ends of
// the arms close their gap under a load.
struct Arms {
    double first, last;  // energy before they meet, and at the end
    double closed;       // pairs in contact
};

Arms arms(int d, const char* reduction, bool one_body) {
    constexpr double apart = 0.05;
    const std::vector<cases::Block> blocks{{{0.0, 0.0, 0.0}, {3.0, 1.0, 1.0}, {9, 2, 2}},
                                           {{0.0, 1.0, 0.0}, {1.0, 1.0 + apart, 1.0}, {3, 1, 2}},
                                           {{0.0, 1.0 + apart, 0.0}, {3.0, 2.0 + apart, 1.0}, {9, 2, 2}}};
    Scene scene = cases::make_blocks(d, blocks, nullptr, 0, one_body);
    std::int64_t count = 0, contact = 2;
    if (one_body) {
        REQUIRE(scene, delam_mesh_add_seams, scene.mesh(), 0.0, &count);
        cases::expect(count == 2, "two seams");
        REQUIRE(scene, delam_mesh_add_self_contact, scene.mesh(), 1.2 * apart, &count);
        cases::expect(count == 1, "one pair of walls");
    } else {
        scene.interface(0, 1);
        scene.interface(1, 2);
        REQUIRE(scene, delam_mesh_add_mortar_interface, scene.mesh(), 0, 2, 1.2 * apart, &contact);
    }
    scene.begin();
    scene.elastic(-1, 1000.0, 0.3);
    scene.bonded(0);
    scene.bonded(1);
    scene.contact(contact);
    const auto always = scene.pattern("gaps", {0.0}, {1.0});
    REQUIRE(scene, delam_problem_set_gaps, scene.problem(), contact, always, nullptr, 0.0);
    const auto ground = cases::nodes_where(scene, -1, [](const double* x) { return x[1] < 1e-9; });
    for (int k = 0; k < d; ++k) scene.hold(ground, cases::unit(d, k));
    const auto press = scene.pattern("press", {0.0, 1.0}, {0.0, 0.1});
    const auto end =
        cases::nodes_where(scene, -1, [](const double* x) { return x[1] > 2.0 + apart - 1e-9 && x[0] > 2.5; });
    scene.drive(end, cases::unit(d, 1, -1.0), press, std::vector<double>(end.size(), 1.0));
    scene.text("reduction", reduction);
    Solver solver(scene, 0.0);
    Arms found{};
    for (const double time : {0.25, 1.0}) {
        solver.step(time);
        solver.commit();
        (time < 1.0 ? found.first : found.last) = solver.value("stored_bulk");
        cases::expect((solver.value("contact_pairs") > 0.0) == (time == 1.0), "the arms meet on the way");
    }
    found.closed = solver.value("contact_pairs");
    return found;
}

LOOP_TEST(walls_of_one_body, 0, 6) {
    const int d = loop / 3 == 0 ? 2 : 3;
    const char* reduction = std::array{"condensed", "iterated", "feti"}[static_cast<std::size_t>(loop) % 3];
    const Arms one = arms(d, reduction, true), three = arms(d, reduction, false);
    cases::expect_near(one.first, three.first, 1e-9, three.first, std::string(reduction) + ": energy of apart arms");
    cases::expect_near(one.last, three.last, 1e-9, three.last, std::string(reduction) + ": energy of closed arms");
    cases::expect(one.closed == three.closed, "pairs in contact");
}

}  // namespace
