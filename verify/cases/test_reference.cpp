// SPDX-License-Identifier: BSD-3-Clause
// The direct reference against closed forms, because other tests rely on it: uniform tension and compression across an
// interface of any stiffness, and the refusal of what it cannot solve. The library only assembles here; its solver is
// not used.
#include <algorithm>

#include "direct.hpp"
#include "support.hpp"

namespace {

using reference::DirectReference;
using reference::Scene;

constexpr double young = 70e9;
constexpr double length = 0.3;
constexpr double height = 0.25;

bool in_plane(std::int32_t cell) {
    return cell == DELAM_TRI3 || cell == DELAM_QUAD4 || cell == DELAM_TRI6 || cell == DELAM_QUAD8 ||
           cell == DELAM_QUAD9;
}

// Two blocks without lateral contraction, the lower face fixed, the upper one driven by `w` along the stack. With
// `redundant` supports both nodes of the pairs at the rim are held sideways.
Scene stack(std::int32_t cell, double k, double w, bool hold_below, bool redundant) {
    const int d = in_plane(cell) ? 2 : 3;
    const bool plane = d == 2;
    Scene scene(d, plane ? std::vector<double>{length} : std::vector<double>{length, length},
                plane ? std::vector<std::int64_t>{4} : std::vector<std::int64_t>{3, 2}, {0.1, 0.15}, {2, 2}, cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, 0.0);
    scene.law(0, {k, k, 1e3, 1e3, 2e3, 2e3});
    const auto n = static_cast<std::size_t>(d);
    std::vector<double> low(n, 0.0);
    std::vector<double> high(n, length);
    std::vector<double> axial(n, 0.0);
    axial.back() = 1.0;
    high.back() = 0.0;
    const auto bottom = scene.find(0, low, high);
    low.back() = high.back() = height;
    const auto top = scene.find(1, low, high);
    low.back() = 0.0;
    for (int i = 0; i + 1 < d; ++i) {
        std::vector<double> lateral(n, 0.0);
        lateral[static_cast<std::size_t>(i)] = 1.0;
        scene.hold(redundant ? scene.find(-1, low, high) : bottom, lateral);
    }
    if (hold_below) scene.hold(bottom, axial);
    const auto load = scene.pattern("move", {0.0, 1.0}, {0.0, w});
    scene.drive(top, axial, load, std::vector<double>(top.size(), 1.0));
    return scene;
}

constexpr std::int32_t cells[] = {DELAM_TRI3,  DELAM_QUAD4, DELAM_TET4,  DELAM_HEX8, DELAM_TRI6,
                                  DELAM_QUAD8, DELAM_QUAD9, DELAM_TET10, DELAM_HEX20};

double area(std::int32_t cell) { return in_plane(cell) ? length : length * length; }

// Interfaces far softer than this show the rounding of the assembled matrices: the bulk's K u is then only the
// difference of numbers as large as E w / h, and a translation has an error of eps times these.
LOOP_TEST(tension_at_any_stiffness, 0, 9) {
    for (const double k : {1e9, 1.25e11, 1e15, 1e20, 1e22}) {
        for (const bool redundant : {false, true}) {
            const double w = 1e-5;
            const Scene scene = stack(cells[loop], k, w, true, redundant);
            DirectReference direct(scene);
            const auto state = direct.solve(1.0, std::vector<double>(scene.pair_count(), 1.0));
            const double t = w / (height / young + 1.0 / k);
            const auto d = static_cast<std::size_t>(scene.dimension());
            const std::string where = "k " + std::to_string(k) + ": ";
            for (std::size_t i = 0; i < state.jump.size(); ++i) {
                const double exact = i % d == 0 ? t : 0.0;
                cases::expect_near(state.traction[i], exact, 1e-12, t, where + "traction");
                cases::expect_near(state.jump[i], exact / k, 1e-12, t / k, where + "jump");
            }
            const double force = t * area(cells[loop]);
            // The nodal forces of 20-node bricks have both signs: their sum has more rounding.
            const double rounding = cells[loop] == DELAM_HEX20 ? 2e-12 : 1e-12;
            cases::expect_near(state.pattern[0], force, rounding, force, where + "reaction");
            const double work = 0.5 * force * w;
            const double bulk = work * (t / w) * height / young;
            cases::expect_near(state.stored_bulk, bulk, rounding, work, where + "stored in the bulk");
            const double spring = work * (t / w) / k;
            cases::expect_near(state.stored_interface, spring, 1e-12, spring, where + "stored in the interface");
        }
    }
}

// Compressed faces close whatever adhesion they have, and carry the pressure of a monolithic block.
LOOP_TEST(compression_closes, 0, 9) {
    for (const double adhesion : {0.0, 0.5, 1.0}) {
        const double w = -1e-5;
        const Scene scene = stack(cells[loop], 1e12, w, true, true);
        DirectReference direct(scene);
        const auto state = direct.solve(1.0, std::vector<double>(scene.pair_count(), adhesion));
        const double pressure = -w * young / height;
        const auto d = static_cast<std::size_t>(scene.dimension());
        for (std::size_t p = 0; p < state.contact.size(); ++p) {
            cases::expect(state.contact[p], "closed");
            cases::expect(state.jump[p * d] == 0.0, "no gap");
            cases::expect_near(state.traction[p * d], -pressure, 1e-12, pressure, "pressure");
        }
        cases::expect_near(state.pattern[0], -pressure * area(cells[loop]), 1e-12, pressure * area(cells[loop]),
                           "reaction");
        cases::expect(state.stored_interface == 0.0, "nothing is stored in closed faces");
    }
}

// A separated block that is driven away: its faces open freely, and no force is left.
LOOP_TEST(debonded_block_opens, 0, 9) {
    const Scene scene = stack(cells[loop], 1e12, 1e-5, true, true);
    DirectReference direct(scene);
    const auto state = direct.solve(1.0, std::vector<double>(scene.pair_count(), 0.0));
    const auto d = static_cast<std::size_t>(scene.dimension());
    for (std::size_t p = 0; p < state.contact.size(); ++p) {
        cases::expect(!state.contact[p], "open");
        cases::expect_near(state.jump[p * d], 1e-5, 1e-12, 1e-5, "opening");
    }
    cases::expect_near(state.pattern[0], 0.0, 1e-12, 1e-5 * young / height, "reaction");
}

// Nothing holds the lower block once its bond is gone: refused by a message, without numbers.
LOOP_TEST(free_body_is_refused, 0, 9) {
    const Scene scene = stack(cells[loop], 1e12, 1e-5, false, false);
    DirectReference direct(scene);
    std::string message;
    try {
        direct.solve(1.0, std::vector<double>(scene.pair_count(), 0.0));
    } catch (const reference::Failure& failure) {
        message = failure.what();
    }
    cases::expect(message.find("free to move") != std::string::npos, "message: " + message);
}

}  // namespace
