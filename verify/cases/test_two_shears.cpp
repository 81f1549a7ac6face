// SPDX-License-Identifier: BSD-3-Clause
// Two stiffnesses, and two toughnesses, in shear, along axes of the interface: closed forms of one pair under any jump,
// a beam that is turned with and without its axes, solvers against each other and against the direct reference, what
// equal numbers leave as it is, and what is refused.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "api.hpp"
#include "delam/experimental.h"
#include "direct.hpp"
#include "front_points.hpp"
#include "support.hpp"

namespace {

using reference::LawData;
using reference::Scene;
using reference::Solver;

const double degree = std::acos(-1.0) / 180.0;

void turn(const Scene& scene, double angle) {
    const double axis[] = {std::cos(angle), std::sin(angle), 0.0};
    REQUIRE(scene, delam_experimental_mesh_set_tangents, scene.mesh(), 0, 1, axis);
}

// Onset and toughness in the power law with exponent 1.
double mixed(double normal, double tangential, double b) { return 1.0 / ((1.0 - b) / normal + b / tangential); }

// Two blocks, the upper one moved by `direction` times the load: forces are tractions. Axis 1 lies at `axes` from x.
Scene imposed(const LawData& law, const std::array<double, 3>& direction, double axes, const std::vector<double>& times,
              const std::vector<double>& jumps) {
    Scene scene(3, {1.0, 1.0}, {1, 1}, {1.0, 1.0}, {1, 1}, DELAM_HEX8);
    scene.interface(0, 1);
    turn(scene, axes);
    scene.begin();
    scene.elastic(-1, 1e9, 0.2);
    scene.law(0, law);
    const auto load = scene.pattern("move", times, jumps);
    const auto below = scene.find(0, {0.0, 0.0, 0.0}, {1.0, 1.0, 2.0}),
               above = scene.find(1, {0.0, 0.0, 0.0}, {1.0, 1.0, 2.0});
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> axis(3, 0.0);
        axis[c] = 1.0;
        scene.hold(below, axis);
        scene.drive(above, axis, load, std::vector<double>(above.size(), direction[c]));
    }
    return scene;
}

// Loading, unloading and reloading of a pair at any angle between the shears, and with opening: stiffness, onset,
// traction along both axes, energies.
LOOP_TEST(closed_forms_at_any_angle, 0, 12) {
    const double slide = 30.0 * loop * degree, axes = loop % 3 * 40.0 * degree;
    for (const double open : {0.0, 0.6}) {
        const LawData law{200e9, 125e9, 60.0, 100.0, 150.0, 250.0, 1.0, 0.0, 40e9};
        const double along = std::sqrt(1.0 - open * open);
        const std::array<double, 3> direction{along * std::cos(slide), along * std::sin(slide), open};
        const double first = along * std::cos(slide - axes), second = along * std::sin(slide - axes);
        const double normal = law.normal_stiffness * open * open / 2,
                     shear = (law.tangential_stiffness * first * first +
                              law.second_tangential_stiffness * second * second) /
                             2;
        const double b = shear / (normal + shear);
        const double onset = mixed(law.normal_onset, law.tangential_onset, b),
                     total = mixed(law.normal_toughness, law.tangential_toughness, b);
        const double begin = std::sqrt(onset / (normal + shear));
        const std::vector<double> turns{0.0, 1.3, 0.4, 1.8, 0.0, 2.2, 4.0};
        std::vector<double> times, jumps;
        for (std::size_t i = 0; i < turns.size(); ++i) {
            times.push_back(static_cast<double>(i));
            jumps.push_back(turns[i] * begin);
        }
        const Scene scene = imposed(law, direction, axes, times, jumps);
        Solver solver(scene, 0.0);
        double largest = 0.0;
        for (int step = 1; step <= 7 * 6; ++step) {
            const double time = step / 7.0;
            const auto leg = std::min(static_cast<std::size_t>(time), turns.size() - 2);
            const double x = turns[leg] + (turns[leg + 1] - turns[leg]) * (time - static_cast<double>(leg));
            solver.step(time);
            solver.commit();
            largest = std::max(largest, x);
            const double end = total / onset;
            const double s = largest <= 1.0 ? largest : std::max(0.0, (end - largest) / (end - 1.0));
            const double zeta = s / largest, jump = x * begin;
            const std::string where = "angle " + std::to_string(30 * loop) + ", step " + std::to_string(step) + ": ";
            for (const double z : solver.field("adhesion")) cases::expect_near(z, zeta, 1e-12, 1.0, where + "adhesion");
            const double force = 2.0 * zeta * (normal + shear) * jump;
            const double peak = 2.0 * (normal + shear) * begin;
            cases::expect_near(solver.value("reaction:move"), force, 1e-12, peak, where + "reaction");
            cases::expect_near(solver.value("stored_interface"), 0.5 * force * jump, 1e-12, onset, where + "stored");
            const double spent = total * onset * (1.0 - zeta) / (onset + (total - onset) * zeta);
            cases::expect_near(solver.value("dissipated"), spent, 1e-9, onset, where + "dissipated");
            const std::vector<double> traction = solver.field("traction");
            for (std::size_t p = 0; p + 2 < traction.size(); p += 3) {
                cases::expect_near(traction[p + 1], zeta * law.tangential_stiffness * first * jump, 1e-12, peak,
                                   where + "traction along axis 1");
                cases::expect_near(traction[p + 2], zeta * law.second_tangential_stiffness * second * jump, 1e-12, peak,
                                   where + "traction along axis 2");
            }
        }
        cases::expect(largest > total / onset, "the pair did not debond: nothing was tested");
    }
}

// End-notched flexure in space, about z by `turned`; axis 1 lies at `axes` from the beam's own x. unit: metres in a
// unit of length, with forces in N.
struct Beam {
    double turned = 0.0, axes = 0.0;
    double first = 125e9, second = 20e9;
    std::array<double, 2> onset{60.0, 0.0}, toughness{200.0, 0.0};  // of both shears; 0: that of the first
    const char* reduction = "condensed";
    double unit = 1.0;
    const char* solution = "local";
};

constexpr double length = 0.06, width = 0.008, arm = 1.5e-3, notch = 0.0151;

Scene make_beam(const Beam& beam) {
    const Scene flat(3, {length, width}, {24, 3}, {arm, arm}, {1, 1}, DELAM_HEX8);
    std::int64_t cells = 0, entries = 0;
    REQUIRE(flat, delam_mesh_size, flat.mesh(), nullptr, nullptr, &cells, nullptr, nullptr);
    std::vector<std::int32_t> bodies(static_cast<std::size_t>(cells));
    std::vector<std::int64_t> connectivity(bodies.size() * 8);
    REQUIRE(flat, delam_mesh_cells, flat.mesh(), nullptr, bodies.data(), nullptr, cells * 8, connectivity.data(),
            &entries);
    const double c = std::cos(beam.turned), s = std::sin(beam.turned);
    std::vector<double> nodes = flat.nodes();
    for (std::size_t i = 0; i < nodes.size(); i += 3) {
        const double x = nodes[i], y = nodes[i + 1];
        nodes[i] = (c * x - s * y) / beam.unit;
        nodes[i + 1] = (s * x + c * y) / beam.unit;
        nodes[i + 2] /= beam.unit;
    }
    Scene scene(3, nodes, DELAM_HEX8, connectivity, bodies);
    scene.interface(0, 1);
    turn(scene, beam.turned + beam.axes);
    scene.begin();
    const double area = beam.unit * beam.unit;
    scene.elastic(-1, 75e9 * area, 0.3);
    LawData law{125e9, beam.first,  100.0,         beam.onset[0],    250.0, beam.toughness[0], 2.0,
                0.0,   beam.second, beam.onset[1], beam.toughness[1]};
    for (double* k : {&law.normal_stiffness, &law.tangential_stiffness, &law.second_tangential_stiffness})
        *k *= area * beam.unit;
    for (double* g : {&law.normal_onset, &law.tangential_onset, &law.normal_toughness, &law.tangential_toughness,
                      &law.second_tangential_onset, &law.second_tangential_toughness})
        *g *= beam.unit;
    scene.law(0, law);
    const auto at = [&](double x, double z) {  // before it is turned
        std::vector<std::int64_t> found = flat.find(z > arm ? 1 : 0, {x, 0.0, z}, {x, width, z});
        return found;
    };
    std::vector<std::int64_t> open;
    const auto pairs = scene.pairs(0);
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (flat.coordinate(pairs.node_a[p], 0) < notch) open.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    scene.hold(at(0.0, 0.0), {0.0, 0.0, 1.0});
    for (const std::vector<double>& axis : {std::vector<double>{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}})
        scene.hold(at(length, 0.0), axis);
    const auto press = scene.pattern("press", {0.0, 1.0}, {0.0, 2.5e-3 / beam.unit});
    const auto middle = at(length / 2, 2 * arm);
    scene.drive(middle, {0.0, 0.0, -1.0}, press, std::vector<double>(middle.size(), 1.0));
    scene.text("reduction", beam.reduction);
    scene.text("step_control", "fixed");
    scene.text("solution", beam.solution);
    scene.number("damage_tolerance", 1e-10);
    return scene;
}

struct History {
    std::vector<double> force, dissipated, adhesion;
    std::array<double, 3> rate{};  // mean energy release rate of the front in modes I, II, III, J/m2
};

History analysed(const Beam& beam) {
    const Scene scene = make_beam(beam);
    Solver solver(scene, 0.0);
    History out;
    for (int k = 1; k <= 10; ++k) {
        solver.step(0.1 * k);
        solver.commit();
        out.force.push_back(solver.value("reaction:press"));
        out.dissipated.push_back(solver.value("dissipated") * beam.unit);
    }
    const auto fronts = cases::crack_fronts(solver);
    cases::expect(fronts.size() == 1, "the beam has one front");
    for (const auto& point : fronts[0].points)
        for (std::size_t mode = 0; mode < 3; ++mode)
            out.rate[mode] += point.rate[mode] / beam.unit / static_cast<double>(fronts[0].points.size());
    // In the order of the nodes: that of the pairs follows their places.
    const std::vector<double> adhesion = solver.field("adhesion");
    const std::vector<std::int64_t> node = scene.pairs(0).node_a;
    std::vector<std::pair<std::int64_t, double>> of_node;
    for (std::size_t p = 0; p < node.size(); ++p) of_node.emplace_back(node[p], adhesion[p]);
    std::sort(of_node.begin(), of_node.end());
    for (const auto& [at, zeta] : of_node) out.adhesion.push_back(zeta);
    return out;
}

// The largest difference of the forces, relative to the largest force.
double apart(const History& a, const History& b) {
    double most = 0.0, force = 0.0;
    for (std::size_t k = 0; k < a.force.size(); ++k) {
        most = std::max(most, std::abs(a.force[k] - b.force[k]));
        force = std::max(force, std::abs(a.force[k]));
    }
    return most / force;
}

void expect_same(const History& a, const History& b, double tolerance, const std::string& what) {
    cases::expect_below(apart(a, b), tolerance, what + ": forces");
    cases::expect_near(a.dissipated.back(), b.dissipated.back(), tolerance, b.dissipated.back(), what + ": dissipated");
    for (std::size_t mode = 0; mode < 3; ++mode)
        cases::expect_near(a.rate[mode], b.rate[mode], tolerance, b.rate[1],
                           what + ": energy release rate in mode " + std::to_string(mode + 1));
    for (std::size_t p = 0; p < a.adhesion.size(); ++p)
        cases::expect_near(a.adhesion[p], b.adhesion[p], tolerance, 1.0, what + ": adhesion");
}

TEST(beam_turns_with_its_axes) {
    const History straight = analysed({});
    cases::expect(straight.dissipated.back() > 0.0, "nothing is damaged: nothing was tested");
    for (const double angle : {45.0, 90.0})
        expect_same(analysed({angle * degree}), straight, 1e-7, "turned by " + std::to_string(angle));
    // Axes that stay where they are exchange the shears after a quarter turn, and lie in between after half of it.
    const History exchanged = analysed({0.0, 0.0, 20e9, 125e9});
    expect_same(analysed({90.0 * degree, -90.0 * degree}), exchanged, 1e-7, "axes that stay");
    const History between = analysed({45.0 * degree, -45.0 * degree});
    cases::expect(apart(straight, exchanged) > 0.02, "the shears do not differ enough to test their exchange");
    cases::expect(between.force[0] < 0.999 * straight.force[0] && between.force[0] > 1.001 * exchanged.force[0],
                  "between the axes the beam is as stiff as along one of them");
}

// The same with onset and toughness of a second shear.
Beam tough(double turned, double axes, bool exchanged = false) {
    if (exchanged) return {turned, axes, 20e9, 125e9, {90.0, 60.0}, {420.0, 200.0}};
    return {turned, axes, 125e9, 20e9, {60.0, 90.0}, {200.0, 420.0}};
}

TEST(beam_turns_with_its_toughnesses) {
    const History straight = analysed(tough(0.0, 0.0));
    cases::expect(straight.dissipated.back() > 0.0, "nothing is damaged: nothing was tested");
    for (const double angle : {45.0, 90.0})
        expect_same(analysed(tough(angle * degree, 0.0)), straight, 1e-7, "turned by " + std::to_string(angle));
    const History exchanged = analysed(tough(0.0, 0.0, true));
    expect_same(analysed(tough(90.0 * degree, -90.0 * degree)), exchanged, 1e-7, "axes that stay");
    // The numbers of the other shear alone, without its stiffness, change the beam, and so do axes between those of it.
    Beam other = tough(0.0, 0.0);
    std::swap(other.onset[0], other.onset[1]);
    std::swap(other.toughness[0], other.toughness[1]);
    cases::expect_below(0.02, apart(analysed(other), straight), "the toughnesses do not differ enough to test them");
    cases::expect_below(0.02, apart(analysed(tough(0.0, 45.0 * degree)), straight), "axes between those of the beam");
}

TEST(searched_states_turn) {
    History found[2];
    for (const int i : {0, 1}) {
        Beam beam = tough(i * 45.0 * degree, 20.0 * degree);
        beam.solution = "energetic";
        found[i] = analysed(beam);
    }
    expect_same(found[1], found[0], 1e-6, "energetic, turned");
    cases::expect(found[0].dissipated.back() > 0.0, "nothing is damaged: nothing was tested");
}

TEST(units_change_nothing) {
    Beam beam = tough(0.0, 30.0 * degree);
    const History metres = analysed(beam);
    beam.unit = 1e-3;
    expect_same(analysed(beam), metres, 1e-7, "in millimetres");
}

LOOP_TEST(solvers_agree, 0, 2) {
    Beam beam = tough(0.0, 30.0 * degree);
    const History condensed = analysed(beam);
    beam.reduction = loop == 0 ? "iterated" : "feti";
    expect_same(analysed(beam), condensed, 1e-5, beam.reduction);
}

// At the adhesion of a state, the displacement step finds what the direct reference finds with springs of its own.
TEST(as_the_direct_reference) {
    const Scene scene = make_beam({0.0, 30.0 * degree});
    Solver solver(scene, 0.0);
    reference::DirectReference direct(scene);
    for (int k = 1; k <= 6; ++k) {
        solver.step(0.1 * k);
        solver.commit();
    }
    const auto found = direct.solve(0.6, solver.field("adhesion"));
    const std::vector<double> jump = solver.field("jump");
    double size = 0.0;
    for (const double j : jump) size = std::max(size, std::abs(j));
    for (std::size_t r = 0; r < jump.size(); ++r)
        cases::expect_near(jump[r], found.jump[r], 1e-7, size, "jump " + std::to_string(r));
}

// Two numbers that are nearly one, along axes between those of the beam: the modes of the front are those of one
// number.
TEST(nearly_one_number) {
    const History one = analysed({0.0, 30.0 * degree, 125e9, 125e9});
    expect_same(analysed({0.0, 30.0 * degree, 125e9, 125e9 * (1.0 + 1e-9)}), one, 1e-6, "nearly one number");
    cases::expect(one.rate[1] > 10.0, "the front releases nothing: nothing was tested");
}

// Digits, and saved states, are those of a law that has one number.
TEST(equal_numbers_are_one) {
    std::vector<std::uint8_t> saved[2];
    char hash[2][17] = {};
    for (const int i : {0, 1}) {
        const Scene scene = make_beam({0.0, 0.0, 125e9, i == 0 ? 0.0 : 125e9});
        REQUIRE(scene, delam_problem_hash, scene.problem(), hash[i]);
        Solver solver(scene, 0.0);
        for (int k = 1; k <= 6; ++k) {
            solver.step(0.1 * k);
            solver.commit();
        }
        saved[i] = solver.save();
    }
    cases::expect(saved[0] == saved[1], "the states differ");
    cases::expect(std::string(hash[0]) == hash[1], "the hashes differ");
    const Scene other = make_beam({0.0, 0.0, 125e9, 100e9});
    char own[17] = {};
    REQUIRE(other, delam_problem_hash, other.problem(), own);
    cases::expect(std::string(own) != hash[0], "another stiffness leaves the hash");
}

void expect_refused(const Scene& scene, std::int32_t status, std::int32_t wanted, const std::string& words) {
    const std::string said = delam_context_message(scene.context());
    cases::expect(status == wanted, "status " + std::to_string(status) + ": " + said);
    cases::expect(said.find(words) != std::string::npos, said);
}

TEST(refused_by_name) {
    const Scene scene(3, {1.0, 1.0}, {1, 1}, {1.0, 1.0}, {1, 1}, DELAM_HEX8);
    Scene& open = const_cast<Scene&>(scene);
    open.interface(0, 1);
    const double normal[] = {0.0, 0.0, -2.0}, none[] = {0.0, 0.0, 0.0}, x[] = {1.0, 0.0, 0.0};
    const auto set = [&](std::int64_t interface, std::int64_t count, const double* direction) {
        return delam_experimental_mesh_set_tangents(scene.mesh(), interface, count, direction);
    };
    expect_refused(scene, set(0, 1, normal), DELAM_ERROR_MESH, "is the normal there");
    expect_refused(scene, set(0, 1, none), DELAM_ERROR_ARGUMENT, "length 0");
    expect_refused(scene, set(0, 3, x), DELAM_ERROR_ARGUMENT, "the number of pairs");
    expect_refused(scene, set(1, 1, x), DELAM_ERROR_ARGUMENT, "interface_index");
    expect_refused(scene, set(0, 1, nullptr), DELAM_ERROR_ARGUMENT, "directions");

    delam_law* raw = nullptr;
    REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &raw);
    const reference::Law law(raw);
    for (const char* key : {"normal_stiffness", "tangential_stiffness"})
        scene.require(delam_law_set(raw, key, 1e9), key);
    for (const char* key : {"normal_toughness", "tangential_toughness"})
        scene.require(delam_law_set(raw, key, 9.0), key);
    for (const char* key : {"normal_strength", "tangential_strength"}) scene.require(delam_law_set(raw, key, 1e5), key);
    scene.require(delam_law_set(raw, "second_tangential_stiffness", 1e9), "the same stiffness");
    REQUIRE(scene, delam_law_check, raw);
    scene.require(delam_law_set(raw, "second_tangential_stiffness", 2e9), "another stiffness");
    expect_refused(scene, delam_law_check(raw), DELAM_ERROR_PROBLEM, "tangential_onset");

    Scene plane(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    plane.interface(0, 1);
    expect_refused(plane, delam_experimental_mesh_set_tangents(plane.mesh(), 0, 1, x), DELAM_ERROR_ARGUMENT,
                   "dimension 2");
    plane.begin();
    plane.elastic(-1, 1e9, 0.2);
    plane.law(0, {1e9, 1e9, 1.0, 1.0, 9.0, 9.0, 1.0, 0.0, 2e9});
    expect_refused(plane, delam_problem_check(plane.problem()), DELAM_ERROR_PROBLEM, "one direction of sliding");
}

}  // namespace
