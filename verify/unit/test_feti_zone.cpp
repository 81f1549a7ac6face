// SPDX-License-Identifier: BSD-3-Clause
// The zone of total FETI against the zone of the condensed operator on the same scene: jumps, forces and energies at
// the same springs and held rows; and that its bits do not depend on what was asked before.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "layer_states.hpp"
#include "reduction/condensed/condensed.hpp"
#include "reduction/feti/feti.hpp"
#include "reduction/operator/zone.hpp"

// Last: its macro fail() would break delam::fail().
#include "quiet_check.hpp"

using namespace delam;

namespace {

using Case = unit::LayerCase;
using Scene = unit::LayerState;

constexpr Case cases[] = {
    {"two layers", 2, 2, 0, 125e9},
    {"three layers in seven subdomains", 2, 3, 7, 125e9},
    {"soft interface", 2, 2, 3, 1e9},
    {"stiff interface", 2, 2, 3, 1e16},
    {"space", 3, 2, 4, 125e9},
    {"a layer that floats", 2, 3, 5, 125e9, true},
    {"a layer that floats in space", 3, 3, 0, 125e9, true},
    {"contact alone", 2, 3, 0, 125e9, false, true},
    {"dead forces, eigenstrains", 2, 3, 4, 125e9, false, false, true},
    {"lumped preconditioner", 2, 2, 4, 125e9, false, false, false, "lumped"},
    {"a clamped end", 2, 3, 5, 125e9, false, false, false, "series", true},
    {"a clamped end in space", 3, 2, 0, 125e9, false, false, false, "series", true},
};

using Answer = unit::ZoneAnswer;
using unit::ask;

void expect_close(std::span<const double> a, std::span<const double> b, double tolerance, const std::string& what) {
    ck_assert_uint_eq(a.size(), b.size());
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - b[i]));
    std::printf("%s: off by %.2e of %.3g\n", what.c_str(), off, max_abs(b));
    ck_assert_msg(off <= tolerance * max_abs(b), "%s: off by %.2e of %.3g", what.c_str(), off, max_abs(b));
}

}  // namespace

START_TEST(answers_as_the_condensed_zone) {
    const Case& c = cases[_i];
    const Scene scene(c, static_cast<unsigned>(_i) + 1U);
    Monitor monitor;
    auto bulk = std::make_shared<Bulk>(scene.problem, monitor);
    bulk->condense(monitor);
    Condensed condensed(bulk, scene.problem, monitor);
    Feti feti(scene.problem, monitor);
    ck_assert(feti.zones() != nullptr);
    Zone* of_condensed = condensed.zone(scene.springs, scene.wanted, false);
    Zone* of_feti = feti.zone(scene.springs, scene.wanted, false);
    ck_assert(of_condensed != nullptr);
    ck_assert_msg(of_feti != nullptr, "%s: no zone", c.name);
    std::vector<Answer> a, b;
    for (const double scale : {1.0, 0.3}) {
        a.push_back(ask(*of_feti, scene, scale));
        b.push_back(ask(*of_condensed, scene, scale));
        const std::string where = std::string(c.name) + ", scale " + std::to_string(scale);
        expect_close(a.back().jump, b.back().jump, c.tolerance, where + ", jumps");
        expect_close(a.back().force, b.back().force, c.tolerance, where + ", forces");
    }
    // Each zone has an energy of its own up to a constant.
    const double off = (a[1].energy - a[0].energy) - (b[1].energy - b[0].energy), size = b[1].energy - b[0].energy;
    std::printf("%s: energies off by %.2e of %.3g\n", c.name, off, size);
    ck_assert_msg(std::abs(off) <= c.tolerance * std::abs(size), "%s: energies off by %.2e of %.3g", c.name, off, size);
}
END_TEST

// Another zone first, a solve between, another operator: the same bits.
START_TEST(does_not_depend_on_the_past) {
    const Case& c = cases[_i];
    const Scene scene(c, 7), other(c, 8);
    Monitor monitor;
    Feti fresh(scene.problem, monitor), used(scene.problem, monitor);
    std::vector<std::uint8_t> elsewhere(scene.wanted.size(), 0);
    std::fill(elsewhere.end() - static_cast<std::ptrdiff_t>(scene.dim) * 20, elsewhere.end(), std::uint8_t{1});
    ck_assert(used.zone(other.springs, elsewhere, false) != nullptr);
    Response before, after;
    used.solve(scene.springs, scene.theta, before);
    ck_assert(used.zone(scene.springs, elsewhere, false) != nullptr);
    DenseZone* of_used = used.zone(scene.springs, scene.wanted, false);
    DenseZone* of_fresh = fresh.zone(scene.springs, scene.wanted, false);
    ck_assert(of_used->jump_rows() == of_fresh->jump_rows());
    ck_assert(of_used->energy().stiffness.value == of_fresh->energy().stiffness.value);
    ck_assert(of_used->energy().load.value == of_fresh->energy().load.value);
    // Nor does a solve depend on the zones before it.
    fresh.solve(scene.springs, scene.theta, after);
    ck_assert(before.jump == after.jump && before.force == after.force);
    ck_assert(before.stored_bulk == after.stored_bulk);
}
END_TEST

int main() {
    Suite* suite = suite_create("FETI zone");
    TCase* zones = tcase_create("zones");
    tcase_add_loop_test(zones, answers_as_the_condensed_zone, 0, static_cast<int>(std::size(cases)));
    tcase_add_loop_test(zones, does_not_depend_on_the_past, 0, 6);
    suite_add_tcase(suite, zones);
    SRunner* runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
