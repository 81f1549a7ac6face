// SPDX-License-Identifier: BSD-3-Clause
// The evolution within a step that was followed at the load of its end, against closed forms: a stiffness k(a) with -k'
// = a (2 - a), so that a crack of length a grows at the load u with u^2 = 2 Gc/(a (2 - a)). It is unstable up to a = 1
// and stable beyond.
#include <cmath>
#include <vector>

#include "check.hpp"
#include "evolution/path/within_step.hpp"

using namespace delam;

namespace {

constexpr double toughness = 0.5, whole = 5.0;  // Gc, k(0)
constexpr int points = 4000;

double removed(double a) { return a * a - a * a * a / 3.0; }  // k(0) - k(a)
double critical(double a) { return std::sqrt(2.0 * toughness / (a * (2.0 - a))); }

// States from length a to the one at which growth at the load `end` comes to rest.
std::vector<PathPoint> path(double a, double end) {
    const double last = 1.0 + std::sqrt(1.0 - 2.0 * toughness / (end * end));
    std::vector<PathPoint> found;
    for (int i = 0; i <= points; ++i) {
        const double now = a + (last - a) * i / points;
        found.push_back({0.5 * (whole - removed(now)) * end * end,
                         0.0,
                         toughness * (now - a),
                         {0.0, now},
                         {end * (whole - removed(now))}});
    }
    return found;
}

}  // namespace

// The jump begins at the load of the initial crack and ends at the length 2 - a with the same load.
TEST(jump_within_the_step) {
    const double a = 0.2, jump = critical(a), end = 1.3 * jump, begin = 0.9 * jump;
    const std::vector<PathPoint> states = path(a, end);
    const WithinStep within = within_step(states, begin / end, false);
    const double released = 0.5 * jump * jump * (removed(2.0 - a) - removed(a)) - toughness * (2.0 - 2.0 * a);
    ck_assert_double_eq_tol(within.jump.load, jump / end, 1e-3);
    ck_assert_double_eq_tol(within.jump.released, released, 2e-3 * released);
    ck_assert_double_eq_tol(within.released, released, 2e-3 * released);
    ck_assert_double_eq_tol(within.jump.debonded, 2.0 - 2.0 * a, 5e-3);
    ck_assert_int_eq(within.jump.interface, 1);
    ck_assert_double_eq_tol(within.jump.conjugate_before[0], jump * (whole - removed(a)), 1e-2);
    ck_assert_double_eq_tol(within.jump.conjugate_after[0], jump * (whole - removed(2.0 - a)), 2e-2);
    const double drop = 1.0 - (whole - removed(2.0 - a)) / (whole - removed(a));
    ck_assert_double_eq_tol(within.jump.drop, drop, 5e-3);
    // Before the jump the load works at the initial crack.
    const double energy_before = 0.5 * (whole - removed(a)) * begin * begin;
    const double change = states.back().energy - energy_before + states.back().dissipated;
    ck_assert_double_eq_tol(within.work, change + within.released, 1e-12 * within.work);
    ck_assert_double_gt(within.work, 0.5 * (whole - removed(a)) * (jump * jump - begin * begin));
}

// From a = 1 on growth is steady at u_c(a): nothing is released, and the work is the integral of the load.
TEST(steady_growth) {
    const double a = 1.2, begin = critical(a), end = 1.2 * begin;
    const std::vector<PathPoint> states = path(a, end);
    const WithinStep within = within_step(states, begin / end, false);
    double work = 0.0, before = begin;
    for (int i = 1; i <= points; ++i) {
        const double at = a + (states.back().debonded[1] - a) * (i - 0.5) / points,
                     now = critical(at + 0.5 * (states.back().debonded[1] - a) / points);
        work += (whole - removed(at)) * 0.5 * (now * now - before * before);
        before = now;
    }
    ck_assert_double_le(within.released, 1e-12);
    ck_assert_double_eq_tol(within.work, work, 1e-3 * work);
    ck_assert_double_eq(within.jump.debonded, 0.0);
}

// More than the states give is recorded nowhere: the balance shows it.
TEST(a_shortfall_is_not_hidden) {
    const double a = 1.2, begin = critical(a), end = 1.2 * begin;
    std::vector<PathPoint> states = path(a, end);
    for (PathPoint& p : states) p.dissipated *= 1.5;
    const WithinStep within = within_step(states, begin / end, false);
    const double energy_before = 0.5 * (whole - removed(a)) * begin * begin;
    const double defect =
        states.back().energy - energy_before + states.back().dissipated + within.released - within.work;
    ck_assert_double_gt(defect, 0.05 * states.back().dissipated);
}
