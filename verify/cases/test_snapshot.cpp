// SPDX-License-Identifier: BSD-3-Clause
// Save, load, go on: the same bits as without the interruption. Bytes that are damaged, cut or of another scene are
// refused and leave the solver as it was. A step that is rolled back never was.
#include "small_march.hpp"

namespace {

using reference::Scene;
using reference::Solver;

constexpr int half = 8;

CASE_TEST(resumed_march) {
    const Scene scene = cases::small_enf();
    Solver whole(scene, 0.0);
    cases::walk(whole, 1, half);
    const auto bytes = whole.save();
    const auto at_half = cases::read_bits(whole);
    cases::walk(whole, half + 1, cases::small_steps);

    // A scene made anew, as after a restart of the host.
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

CASE_TEST(pending_step_is_not_saved) {
    const Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, half);
    const auto before = solver.save();
    solver.step(cases::small_time(half + 1));
    cases::expect(solver.save() == before, "the snapshot holds the committed state");
}

CASE_TEST(rollback_is_exact) {
    const Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, half);
    const auto committed = cases::read_bits(solver);
    const auto bytes = solver.save();

    solver.step(cases::small_time(half + 1));
    const auto pending = cases::read_bits(solver);
    cases::expect(!cases::same_bits(pending.values, committed.values), "a pending step is what is read");
    solver.rollback();
    cases::expect_same(solver, cases::read_bits(solver), committed, "after rollback");
    cases::expect(solver.save() == bytes, "snapshot after rollback");

    // A farther step, refused too, must not leave a trace in the next one.
    solver.step(cases::small_time(half + 5));
    solver.rollback();
    solver.step(cases::small_time(half + 1));
    cases::expect_same(solver, cases::read_bits(solver), pending, "the step taken again");
}

CASE_TEST(equilibrate_moves_no_ledger) {
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

// A two-element bar keeps the exhaustive loops short.
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

CASE_TEST(damaged_bytes) {
    const Scene scene = tiny(8e-5);
    Solver solver(scene, 0.0);
    solver.step(0.5);
    solver.commit();
    solver.step(1.0);
    solver.commit();
    const auto bytes = solver.save();

    Solver fresh(scene, 0.0);
    fresh.step(0.25);
    fresh.commit();
    const auto before = cases::read_bits(fresh);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        auto broken = bytes;
        broken[i] = static_cast<std::uint8_t>(broken[i] ^ (1U << (i % 8)));
        expect_refused(fresh, broken, "bit of byte " + std::to_string(i));
    }
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        std::vector<std::uint8_t> cut;
        cut.reserve(bytes.size());
        cut.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n));
        expect_refused(fresh, cut, "cut after " + std::to_string(n) + " bytes");
    }
    auto longer = bytes;
    longer.push_back(0);
    expect_refused(fresh, longer, "one byte too many");
    cases::expect_same(fresh, cases::read_bits(fresh), before, "after refusals");
    scene.require(fresh.load(bytes), "delam_solver_load");
    cases::expect_same(fresh, cases::read_bits(fresh), cases::read_bits(solver), "after loading");
}

CASE_TEST(other_scene) {
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

}  // namespace

int main() {
    Suite* suite = suite_create("snapshot");
    TCase* tests = tcase_create("bits");
    tcase_add_test(tests, resumed_march);
    tcase_add_test(tests, pending_step_is_not_saved);
    tcase_add_test(tests, rollback_is_exact);
    tcase_add_test(tests, equilibrate_moves_no_ledger);
    tcase_add_test(tests, damaged_bytes);
    tcase_add_test(tests, other_scene);
    suite_add_tcase(suite, tests);
    return cases::run_suite(suite);
}
