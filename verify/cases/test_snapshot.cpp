// SPDX-License-Identifier: BSD-3-Clause
// Save, load, continue: the same bits as without the interruption. Bytes that are damaged, truncated or from another
// scene are refused and leave the solver unchanged. A step that is rolled back leaves no trace.
#include "small_analysis.hpp"

namespace {

using reference::Scene;
using reference::Solver;

constexpr int half = 8;

TEST(resumed_analysis) {
    const Scene scene = cases::small_enf();
    Solver whole(scene, 0.0);
    cases::walk(whole, 1, half);
    const auto bytes = whole.save();
    const auto at_half = cases::read_bits(whole);
    cases::walk(whole, half + 1, cases::small_steps);

    // A new copy of the scene, as after a restart of the host.
    const Scene again = cases::small_enf();
    Solver resumed(again, 0.0);
    again.require(resumed.load(bytes), "delam_solver_load");
    cases::expect_same(resumed, cases::read_bits(resumed), at_half, "after loading");
    cases::expect(resumed.save() == bytes, "saving what was loaded gives the same bytes");
    cases::walk(resumed, half + 1, cases::small_steps);
    cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(whole), "in the end");
    cases::expect(whole.value("dissipated") > 0.0, "the interface is damaged, or nothing was tested");
    cases::expect(resumed.save() == whole.save(), "snapshots in the end");
}

TEST(pending_step_is_not_saved) {
    const Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, half);
    const auto before = solver.save();
    solver.step(cases::small_time(half + 1));
    cases::expect(solver.save() == before, "the snapshot holds the committed state");
}

TEST(rollback_is_exact) {
    const Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, half);
    const auto committed = cases::read_bits(solver);
    const auto bytes = solver.save();

    solver.step(cases::small_time(half + 1));
    const auto pending = cases::read_bits(solver);
    cases::expect(!delam::same_bits(pending.values, committed.values), "a pending step is what is read");
    solver.rollback();
    cases::expect_same(solver, cases::read_bits(solver), committed, "after rollback");
    cases::expect(solver.save() == bytes, "snapshot after rollback");

    // A further step, rolled back too, must leave no trace in the next one.
    solver.step(cases::small_time(half + 5));
    solver.rollback();
    solver.step(cases::small_time(half + 1));
    cases::expect_same(solver, cases::read_bits(solver), pending, "the step taken again");
}

TEST(equilibrate_moves_no_ledger) {
    const Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, half);
    const auto committed = cases::read_bits(solver);
    const double dissipated = solver.value("dissipated");
    const double work = solver.value("work");
    solver.equilibrate(cases::small_time(half + 2), {});
    cases::expect(solver.value("dissipated") == dissipated && solver.value("work") == work, "the ledger moved");
    solver.rollback();
    cases::expect_same(solver, cases::read_bits(solver), committed, "after rollback");
}

// A bar of two elements keeps the exhaustive loops short.
Scene tiny(double end) {
    Scene scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e12, 0.0);
    scene.law(0, {125e9, 125e9, 100.0, 100.0, 250.0, 250.0});
    const auto bottom = scene.find(0, {0.0, 0.0}, {1.0, 0.0});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const auto top = scene.find(1, {0.0, 2.0}, {1.0, 2.0});
    scene.hold(top, {1.0, 0.0});
    scene.drive(top, {0.0, 1.0}, scene.pattern("pull", {0.0, 1.0}, {0.0, end}), {1.0, 1.0});
    return scene;
}

void expect_refused(Solver& solver, const std::vector<std::uint8_t>& bytes, const std::string& what) {
    const std::int32_t status = solver.load(bytes);
    cases::expect(status == DELAM_ERROR_SNAPSHOT, what + ": " + delam_status_name(status));
    cases::expect(std::string(delam_context_message(solver.scene().context())) != "", what + ": no message");
}

TEST(damaged_bytes) {
    const Scene scene = tiny(8e-5);
    Solver solver(scene, 0.0);
    solver.step(0.5);
    solver.commit();
    solver.step(1.0);
    solver.commit();
    const auto bytes = solver.save();

    Solver unused(scene, 0.0);
    unused.step(0.25);
    unused.commit();
    const auto before = cases::read_bits(unused);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        auto broken = bytes;
        broken[i] = static_cast<std::uint8_t>(broken[i] ^ (1U << (i % 8)));
        expect_refused(unused, broken, "bit of byte " + std::to_string(i));
    }
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        std::vector<std::uint8_t> cut;
        cut.reserve(bytes.size());
        cut.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n));
        expect_refused(unused, cut, "cut after " + std::to_string(n) + " bytes");
    }
    auto longer = bytes;
    longer.push_back(0);
    expect_refused(unused, longer, "one byte too many");
    cases::expect_same(unused, cases::read_bits(unused), before, "after refusals");
    scene.require(unused.load(bytes), "delam_solver_load");
    cases::expect_same(unused, cases::read_bits(unused), cases::read_bits(solver), "after loading");
}

TEST(other_scene) {
    const Scene scene = tiny(8e-5);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    solver.commit();
    const auto bytes = solver.save();
    const Scene stronger = tiny(9e-5);
    Solver other(stronger, 0.0);
    expect_refused(other, bytes, "other load");
    Scene option = tiny(8e-5);
    option.number("damage_tolerance", 1e-7);
    Solver strict(option, 0.0);
    expect_refused(strict, bytes, "other options");
    const Scene large = cases::small_enf();
    Solver enf(large, 0.0);
    expect_refused(enf, bytes, "other mesh");
}

// Brittle, condensed, accelerated: fronts jump, so that the condensed operator chooses, releases and renews its zones.
// Its memory of them determines the last digits.
Scene leaping_enf() {
    cases::Enf e;
    e.h = 1e-3;
    e.subdomains = 0;
    e.law = {125e15, 125e15, 0.01, 0.01, 25.0, 25.0};
    Scene scene = cases::make_enf(e);
    scene.text("reduction", "condensed");
    scene.text("minimisation", "accelerated");
    return scene;
}

constexpr int leaps = 40;

void leap(Solver& solver, int first, int last) {
    for (int k = first; k <= last; ++k) {
        solver.step(cases::enf_time(k, leaps));
        solver.commit();
    }
}

TEST(resumed_leaps) {
    const Scene scene = leaping_enf();
    Solver whole(scene, 0.0);
    std::vector<std::vector<std::uint8_t>> bytes{whole.save()};
    for (int k = 1; k <= leaps; ++k) {
        leap(whole, k, k);
        bytes.push_back(whole.save());
    }
    cases::expect(whole.value("dissipated") > 0.0, "nothing was damaged");
    const auto end = cases::read_bits(whole);
    const Scene again = leaping_enf();
    for (const int from : {0, 3, 10, 12, 13, 20, 31, 39}) {
        const std::string where = "resumed at step " + std::to_string(from);
        Solver resumed(again, 0.0);
        again.require(resumed.load(bytes[static_cast<std::size_t>(from)]), "delam_solver_load");
        leap(resumed, from + 1, leaps);
        cases::expect_same(resumed, cases::read_bits(resumed), end, where);
        cases::expect(resumed.save() == bytes.back(), where + ": snapshots in the end");
    }
}

// Every step is computed twice, with a far step and a displacement step in between, both rolled back.
TEST(leaps_rolled_back) {
    const Scene scene = leaping_enf();
    Solver straight(scene, 0.0), wavering(scene, 0.0);
    for (int k = 1; k <= leaps; ++k) {
        leap(straight, k, k);
        wavering.step(cases::enf_time(k, leaps));
        wavering.rollback();
        if (k % 3 == 0) {
            wavering.step(cases::enf_time(k + 9, leaps));
            wavering.rollback();
        }
        if (k % 4 == 0) {
            auto adhesion = wavering.field("adhesion");
            for (std::size_t p = 0; p < adhesion.size(); p += 3) adhesion[p] *= 0.5;
            wavering.equilibrate(cases::enf_time(k, leaps), adhesion);
            wavering.rollback();
        }
        leap(wavering, k, k);
        cases::expect(wavering.save() == straight.save(), "step " + std::to_string(k) + ": snapshots differ");
    }
    cases::expect_same(wavering, cases::read_bits(wavering), cases::read_bits(straight), "in the end");
}

// A solver with another history loads a state and continues from there.
TEST(loaded_over_another_past) {
    const Scene scene = leaping_enf();
    Solver first(scene, 0.0), other(scene, 0.0);
    leap(first, 1, 12);
    const auto bytes = first.save();
    leap(first, 13, 20);
    other.step(cases::enf_time(35, leaps));
    other.commit();
    scene.require(other.load(bytes), "delam_solver_load");
    cases::expect(other.save() == bytes, "what was loaded");
    leap(other, 13, 20);
    cases::expect(other.save() == first.save(), "the steps after it");
}

// A step cancelled at any of its stages leaves no trace.
struct Countdown {
    int left;
};
std::int32_t count_down(const char*, std::int64_t, std::int64_t, void* user) {
    return --static_cast<Countdown*>(user)->left == 0 ? 1 : 0;
}

TEST(cancelled_leaps) {
    const Scene scene = leaping_enf();
    Solver straight(scene, 0.0);
    leap(straight, 1, 14);
    const auto after = straight.save();
    Solver cancelled(scene, 0.0);
    leap(cancelled, 1, 11);
    int cancellations = 0;
    for (int k = 12; k <= 14; ++k) {
        for (int stage = 1;; stage = stage < 12 ? stage + 1 : stage + 7) {
            Countdown countdown{stage};
            REQUIRE(scene, delam_context_set_progress, scene.context(), count_down, &countdown);
            const std::int32_t status = cancelled.advance(cases::enf_time(k, leaps));
            REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
            if (status == DELAM_OK) break;
            cases::expect(status == DELAM_CANCELLED, std::string("status ") + delam_status_name(status));
            ++cancellations;
        }
        cancelled.commit();
    }
    cases::expect(cancellations > 20, std::to_string(cancellations) + " cancellations");
    cases::expect(cancelled.save() == after, "snapshots differ");
}

// Two plies of hexahedra, unbonded at one end, which is peeled off by its corners, one pulled harder and sideways: all
// three modes.
struct Peel {
    const char* name;
    reference::LawData law;
    std::vector<std::pair<const char*, const char*>> texts;
    std::int64_t subdomains = 0;
};

const reference::LawData ductile{125e9, 125e9, 100.0, 160.0, 250.0, 700.0},
    weakly_mixed{125e9, 125e9, 100.0, 120.0, 250.0, 270.0}, brittle{125e13, 125e13, 1.0, 1.0, 25.0, 60.0};

const Peel peels[] = {
    {"condensed", ductile, {{"reduction", "condensed"}}},
    {"FETI", ductile, {{"reduction", "feti"}}, 4},
    {"iterated", ductile, {{"reduction", "iterated"}}},
    {"brittle", brittle, {{"reduction", "condensed"}, {"minimisation", "accelerated"}}},
    {"brittle, FETI", brittle, {{"reduction", "feti"}}, 2},
    {"variational", weakly_mixed, {{"mixity_rule", "variational"}}},
    {"converged", ductile, {{"mixity_rule", "converged"}}},
    {"energetic",
     {125e13, 125e13, 600.0, 600.0, 600.0, 600.0, 1.0},
     {{"solution", "energetic"}, {"backtracking", "on"}}},
};

Scene make_peel(const Peel& p) {
    constexpr double length = 0.024, width = 4e-3, ply = 2e-3, crack = 0.006;
    Scene scene(3, {length, width}, {12, 2}, {ply, ply}, {1, 1}, DELAM_HEX8);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    scene.law(0, p.law);
    std::vector<std::int64_t> open;
    const auto pairs = scene.pairs(0);
    for (std::size_t i = 0; i < pairs.count(); ++i)
        if (scene.coordinate(pairs.node_a[i], 0) < crack - 1e-4) open.push_back(static_cast<std::int64_t>(i));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    const auto bottom = scene.find(0, {0.0, 0.0, 0.0}, {length, width, 0.0});
    for (const std::vector<double>& axis : {std::vector<double>{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}})
        scene.hold(bottom, axis);
    const auto edge = scene.find(1, {0.0, 0.0, 2.0 * ply}, {0.0, width, 2.0 * ply});
    std::vector<double> uneven;
    for (const auto node : edge) uneven.push_back(1.0 + 0.2 * scene.coordinate(node, 1) / width);
    scene.drive(edge, {0.0, 0.0, 1.0}, scene.pattern("peel", {0.0, 1.0}, {0.0, 4e-4}), uneven);
    scene.drive(edge, {0.0, 1.0, 0.0}, scene.pattern("sideways", {0.0, 1.0}, {0.0, 1e-4}),
                std::vector<double>(edge.size(), 1.0));
    for (const auto& [key, value] : p.texts) scene.text(key, value);
    if (p.subdomains > 0) scene.number("subdomains", static_cast<double>(p.subdomains));
    return scene;
}

constexpr int peel_steps = 12;

void peel(Solver& solver, int step) {
    solver.step(static_cast<double>(step) / peel_steps);
    solver.commit();
}

LOOP_TEST(resumed_peel, 0, std::size(peels)) {
    const Peel& p = peels[loop];
    const Scene scene = make_peel(p);
    Solver whole(scene, 0.0);
    std::vector<std::vector<std::uint8_t>> bytes{whole.save()};
    std::vector<cases::Bits> bits{cases::read_bits(whole)};
    std::vector<double> dissipated{0.0};
    for (int k = 1; k <= peel_steps; ++k) {
        peel(whole, k);
        bytes.push_back(whole.save());
        bits.push_back(cases::read_bits(whole));
        dissipated.push_back(whole.value("dissipated"));
    }
    // A new copy of the scene, as after a restart of the host.
    const Scene again = make_peel(p);
    for (const std::size_t from : {3U, 6U, 9U}) {
        cases::expect(dissipated[from] > 0.0 && dissipated.back() > dissipated[from],
                      std::string(p.name) + ": no damage before step " + std::to_string(from) + ", or none after it");
        Solver resumed(again, 0.0);
        again.require(resumed.load(bytes[from]), "delam_solver_load");
        for (std::size_t k = from;; ++k) {
            const std::string where =
                std::string(p.name) + " resumed at step " + std::to_string(from) + ", step " + std::to_string(k);
            cases::expect_same(resumed, cases::read_bits(resumed), bits[k], where);
            cases::expect(resumed.save() == bytes[k], where + ": snapshots differ");
            if (k == peel_steps) break;
            peel(resumed, static_cast<int>(k) + 1);
        }
    }
}

}  // namespace
