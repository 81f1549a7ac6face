// SPDX-License-Identifier: BSD-3-Clause
// Onset and toughness of a second shear: closed forms of one pair that slides in any direction of its interface, also
// with opening, for three shapes of softening and three criteria; paths that turn from one shear to the other; saved
// states; what is refused.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "api.hpp"
#include "delam/experimental.h"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

const double degree = std::acos(-1.0) / 180.0;

// A law in the words of its keys.
struct Sheared {
    const char* kind = "piecewise-linear";
    const char* criterion = "power";
    double exponent = 1.6;
    double k[3] = {200e9, 125e9, 40e9};  // opening, first and second shear
    double onset[3] = {60.0, 100.0, 45.0};
    double total[3] = {250.0, 400.0, 700.0};
    bool strengths = false;  // instead of onsets
};

// Onset or toughness at the mixity b and the share s of the second shear, by the definition of the criterion.
double mixed(const Sheared& law, const double (&g)[3], double b, double s) {
    const double e = law.exponent;
    if (std::string(law.criterion) == "benzeggagh-kenane") {
        const double shear = g[1] + (g[2] - g[1]) * s;
        return g[0] + (shear - g[0]) * std::pow(b, e);
    }
    // With other exponents of opening (e) and sliding (e + 0.5), by halving an interval.
    const double p = e, q = std::string(law.criterion) == "power" ? e : e + 0.5;
    double low = 0.0, high = 1e6;
    for (int i = 0; i < 200; ++i) {
        const double x = 0.5 * (low + high);
        const double sum = std::pow((1.0 - b) * x / g[0], p) + std::pow(b * (1.0 - s) * x / g[1] + b * s * x / g[2], q);
        (sum > 1.0 ? high : low) = x;
    }
    return low;
}

// Traction over its peak, and the area under it from 0, of a first loading to x times the jump at the onset. end: total
// over onset.
struct Curve {
    double traction, area;
};
constexpr double plateau = 0.4;
Curve curve_of(const Sheared& law, double end, double x) {
    if (x <= 1.0) return {x, 0.5 * x * x};
    const double z = x - 1.0;
    const std::string kind = law.kind;
    if (kind == "exponential") {
        const double length = 0.5 * (end - 1.0);
        return {std::exp(-z / length), 0.5 + length * -std::expm1(-z / length)};
    }
    const double flat = kind == "trapezoidal" ? plateau : 0.0;
    const double length = (end - 1.0) / (1.0 + flat), hold = flat * length;
    if (z <= hold) return {1.0, 0.5 + z};
    const double at = std::min(z, length), rest = at - hold;
    return {(1.0 - at / length) / (1.0 - flat), 0.5 + hold + rest * (1.0 - 0.5 * rest / (length - hold))};
}

reference::Law make(const Scene& scene, const Sheared& law) {
    delam_law* raw = nullptr;
    REQUIRE(scene, delam_law_create, scene.context(), law.kind, &raw);
    reference::Law own(raw);
    REQUIRE(scene, delam_law_set_text, raw, "criterion", law.criterion);
    const auto set = [&](const std::string& key, double value) {
        scene.require(delam_law_set(raw, key.c_str(), value), key.c_str());
    };
    const char* names[] = {"normal_", "tangential_", "second_tangential_"};
    for (std::size_t m = 0; m < 3; ++m) {
        const std::string name = names[m];
        set(name + "stiffness", law.k[m]);
        if (law.strengths)
            set(name + "strength", std::sqrt(2.0 * law.k[m] * law.onset[m]));
        else
            set(name + "onset", law.onset[m]);
        set(name + "toughness", law.total[m]);
    }
    for (const std::string what : {"onset", "toughness"})
        if (std::string(law.criterion) == "valoroso-champaney") {
            set(what + "_exponent_1", law.exponent);
            set(what + "_exponent_2", law.exponent + 0.5);
        } else {
            set(what + "_exponent", law.exponent);
        }
    if (std::string(law.kind) == "trapezoidal") set("plateau", plateau);
    return own;
}

// Two blocks of unit area, the upper one moved by three histories of the same times: forces are tractions. The first
// axis of the law lies at `axes` from x.
Scene moved(const Sheared& law, double axes, const std::vector<double>& times,
            const std::array<std::vector<double>, 3>& jumps, const char* rule = "converged") {
    Scene scene(3, {1.0, 1.0}, {1, 1}, {1.0, 1.0}, {1, 1}, DELAM_HEX8);
    scene.interface(0, 1);
    const double axis[] = {std::cos(axes), std::sin(axes), 0.0};
    REQUIRE(scene, delam_experimental_mesh_set_tangents, scene.mesh(), 0, 1, axis);
    scene.begin();
    scene.elastic(-1, 1e9, 0.2);
    const reference::Law own = make(scene, law);
    REQUIRE(scene, delam_problem_set_law, scene.problem(), 0, own.get());
    const auto below = scene.find(0, {0.0, 0.0, 0.0}, {1.0, 1.0, 2.0}),
               above = scene.find(1, {0.0, 0.0, 0.0}, {1.0, 1.0, 2.0});
    const char* names[] = {"x", "y", "z"};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> unit(3, 0.0);
        unit[c] = 1.0;
        scene.hold(below, unit);
        scene.drive(above, unit, scene.pattern(names[c], times, jumps[c]), std::vector<double>(above.size(), 1.0));
    }
    scene.text("mixity_rule", rule);
    return scene;
}

// A first loading along a straight path, in steps; the third ends at the onset.
void expect_closed_form(const Sheared& law, double slide, double axes, double open) {
    const double along = std::sqrt(1.0 - open * open);
    const double direction[3] = {along * std::cos(slide), along * std::sin(slide), open};
    const double parts[3] = {law.k[0] * open * open / 2.0, law.k[1] * std::pow(along * std::cos(slide - axes), 2) / 2.0,
                             law.k[2] * std::pow(along * std::sin(slide - axes), 2) / 2.0};
    const double shear = parts[1] + parts[2], all = parts[0] + shear;
    const double b = shear / all, s = parts[2] / shear;
    const double onset = mixed(law, law.onset, b, s), total = mixed(law, law.total, b, s), end = total / onset;
    const double begin = std::sqrt(onset / all), peak = 2.0 * all * begin;
    std::vector<double> places{0.0, 0.4, 0.8, 1.0};
    for (int i = 1; i <= 8; ++i) places.push_back(1.0 + (end - 1.0) * 1.1 * i / 8.0);
    std::vector<double> times;
    std::array<std::vector<double>, 3> jumps;
    for (std::size_t i = 0; i < places.size(); ++i) {
        times.push_back(static_cast<double>(i));
        for (std::size_t c = 0; c < 3; ++c) jumps[c].push_back(direction[c] * places[i] * begin);
    }
    const Scene scene = moved(law, axes, times, jumps);
    Solver solver(scene, 0.0);
    double most = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
        solver.step(times[i]);
        solver.commit();
        const double x = places[i];
        const Curve curve = curve_of(law, end, x);
        const std::string where = std::string(law.kind) + ", " + law.criterion + ", angle " +
                                  std::to_string(slide / degree) + ", step " + std::to_string(i) + ": ";
        double traction = 0.0;
        const char* names[] = {"reaction:x", "reaction:y", "reaction:z"};
        for (std::size_t c = 0; c < 3; ++c) traction += direction[c] * solver.value(names[c]);
        most = std::max(most, traction);
        cases::expect_near(traction, peak * curve.traction, 1e-9, peak, where + "traction");
        for (const double z : solver.field("adhesion"))
            cases::expect_near(z, curve.traction / x, 1e-9, 1.0, where + "adhesion");
        cases::expect_near(solver.value("dissipated"), 2.0 * onset * (curve.area - 0.5 * curve.traction * x), 1e-8,
                           total, where + "dissipated");
        for (const double m : solver.field("mixity"))
            cases::expect_near(m, b, 1e-9, 1.0, where + "the mixity is B, whatever the share of the second shear");
    }
    cases::expect_near(most, peak, 1e-9, peak, "the peak of the traction");
}

LOOP_TEST(closed_forms_at_any_angle, 0, 7) {
    for (const char* kind : {"piecewise-linear", "exponential", "trapezoidal"})
        for (const char* criterion : {"power", "valoroso-champaney", "benzeggagh-kenane"})
            for (const double open : {0.0, 0.6}) {
                Sheared law{kind, criterion};
                law.strengths = loop % 2 == 1;
                expect_closed_form(law, 15.0 * loop * degree, loop % 3 * 40.0 * degree, open);
            }
}

// One stiffness, but two onsets and toughnesses; one onset, but two toughnesses; and the other way round.
LOOP_TEST(each_pair_of_numbers_alone, 0, 3) {
    Sheared law;
    if (loop == 0) law.k[2] = law.k[1];
    if (loop == 1) law.onset[2] = law.onset[1];
    if (loop == 2) law.total[2] = law.total[1];
    expect_closed_form(law, 35.0 * degree, 0.0, 0.5);
}

// An exchange of the axes, and of their numbers, changes nothing.
TEST(axes_are_exchanged) {
    std::vector<double> spent[2], force[2];
    for (const int i : {0, 1}) {
        Sheared law;
        if (i == 1)
            for (double* of : {law.k, law.onset, law.total}) std::swap(of[1], of[2]);
        const Scene scene =
            moved(law, i * 90.0 * degree, {0.0, 1.0, 2.0}, {{{0.0, 4e-5, 9e-5}, {0.0, 3e-5, 1e-4}, {0.0, 1e-5, 3e-5}}});
        Solver solver(scene, 0.0);
        for (int k = 1; k <= 20; ++k) {
            solver.step(0.1 * k);
            solver.commit();
            spent[i].push_back(solver.value("dissipated"));
            force[i].push_back(solver.value("reaction:x"));
        }
    }
    const double most = *std::max_element(force[0].begin(), force[0].end());
    for (std::size_t k = 0; k < spent[0].size(); ++k) {
        cases::expect_near(spent[0][k], spent[1][k], 1e-10, spent[0].back(), "dissipated");
        cases::expect_near(force[0][k], force[1][k], 1e-10, most, "force");
    }
    cases::expect(spent[0].back() > 0.0, "nothing is damaged: nothing was tested");
}

// A path of the jump from one shear to the other, and the energy that it dissipates by the law itself in fine steps:
// zeta = min(zeta, zeta*(B, S, Y)), and int Y (-dzeta).
struct Turned {
    bool first_along_1;
    std::array<double, 2> jump(double t) const {
        const double size = 3e-5 + 7e-5 * t, angle = 90.0 * degree * (first_along_1 ? t : 1.0 - t);
        return {size * std::cos(angle), size * std::sin(angle)};
    }
};

std::pair<double, double> followed(const Sheared& law, const Turned& path) {
    constexpr int steps = 40000;
    double zeta = 1.0, spent = 0.0, last = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const auto [u, v] = path.jump(static_cast<double>(i) / steps);
        const double first = law.k[1] * u * u / 2.0, second = law.k[2] * v * v / 2.0, y = first + second;
        const double s = second / y, onset = mixed(law, law.onset, 1.0, s), total = mixed(law, law.total, 1.0, s);
        const double next = std::clamp((total * std::sqrt(onset / y) - onset) / (total - onset), 0.0, zeta);
        spent += 0.5 * (y + (i > 0 ? last : y)) * (zeta - next);
        zeta = next;
        last = y;
    }
    return {spent, zeta};
}

TEST(paths_that_turn) {
    Sheared law;
    law.exponent = 1.0;
    double spent[2];
    for (const int i : {0, 1}) {
        const Turned path{i == 0};
        constexpr int steps = 200;
        std::vector<double> times;
        std::array<std::vector<double>, 3> jumps;
        for (int k = 0; k <= steps; ++k) {
            times.push_back(static_cast<double>(k) / steps);
            const auto [u, v] = path.jump(times.back());
            jumps[0].push_back(u);
            jumps[1].push_back(v);
            jumps[2].push_back(0.0);
        }
        const Scene scene = moved(law, 0.0, times, jumps);
        Solver solver(scene, 0.0);
        for (const double time : times) {
            if (!(time > 0.0)) continue;
            solver.step(time);
            solver.commit();
        }
        const auto [wanted, zeta] = followed(law, path);
        spent[i] = solver.value("dissipated");
        cases::expect_near(spent[i], wanted, 1e-3, wanted, "dissipated on the way");
        for (const double z : solver.field("adhesion")) cases::expect_near(z, zeta, 1e-6, 1.0, "adhesion at its end");
        cases::expect(zeta > 0.0 && zeta < 0.9, "the pair does not soften: nothing was tested");
    }
    cases::expect(std::abs(spent[0] - spent[1]) > 0.02 * spent[0], "the order of the shears does not matter");
}

// An analysis that is saved on its way goes on with the same bits, under both rules.
LOOP_TEST(saved_states_resume, 0, 2) {
    const Scene scene =
        moved(Sheared{}, 20.0 * degree, {0.0, 1.0, 2.0}, {{{0.0, 5e-5, 5e-5}, {0.0, 1e-5, 9e-5}, {0.0, 1e-5, 3e-5}}},
              loop == 0 ? "converged" : "frozen");
    Solver through(scene, 0.0), again(scene, 0.0);
    for (int k = 1; k <= 20; ++k) {
        through.step(0.1 * k);
        through.commit();
        if (k == 9) cases::expect(again.load(through.save()) == DELAM_OK, "the state is taken");
        if (k <= 9) continue;
        again.step(0.1 * k);
        again.commit();
        cases::expect(again.save() == through.save(), "step " + std::to_string(k) + " differs");
    }
    cases::expect(through.value("dissipated") > 0.0, "nothing is damaged: nothing was tested");
}

// The numbers of a law whose second shear has the numbers of the first, and of one without them.
LOOP_TEST(equal_numbers_are_one, 0, 3) {
    const char* criteria[] = {"power", "valoroso-champaney", "benzeggagh-kenane"};
    std::vector<std::uint8_t> saved[2];
    for (const int i : {0, 1}) {
        Scene scene(3, {1.0, 1.0}, {2, 2}, {1.0, 1.0}, {1, 1}, DELAM_HEX8);
        scene.interface(0, 1);
        scene.begin();
        scene.elastic(-1, 1e9, 0.2);
        delam_law* raw = nullptr;
        REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &raw);
        const reference::Law own(raw);
        REQUIRE(scene, delam_law_set_text, raw, "criterion", criteria[loop]);
        for (const auto& [key, value] :
             {std::pair("normal_stiffness", 2e11), std::pair("tangential_stiffness", 1e11),
              std::pair("normal_strength", 4e6), std::pair("tangential_strength", 5e6),
              std::pair("normal_toughness", 250.0), std::pair("tangential_toughness", 400.0)})
            scene.require(delam_law_set(raw, key, value), key);
        if (i == 1)
            for (const auto& [key, value] :
                 {std::pair("second_tangential_stiffness", 1e11), std::pair("second_tangential_strength", 5e6),
                  std::pair("second_tangential_toughness", 400.0)})
                scene.require(delam_law_set(raw, key, value), key);
        REQUIRE(scene, delam_problem_set_law, scene.problem(), 0, raw);
        const auto foot = scene.find(0, {0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}),
                   head = scene.find(1, {0.0, 0.0, 2.0}, {1.0, 1.0, 2.0});
        const double coefficients[] = {1.0, 0.6, 0.4};
        const auto load = scene.pattern("move", {0.0, 1.0}, {0.0, 4e-2});
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<double> unit(3, 0.0);
            unit[c] = 1.0;
            scene.hold(foot, unit);
            scene.drive(head, unit, load, std::vector<double>(head.size(), coefficients[c]));
        }
        Solver solver(scene, 0.0);
        for (int k = 1; k <= 8; ++k) {
            solver.step(0.125 * k);
            solver.commit();
        }
        cases::expect(solver.value("dissipated") > 0.0, "nothing is damaged: nothing was tested");
        saved[i] = solver.save();
    }
    cases::expect(saved[0] == saved[1], "the states differ");
}

void expect_refused(const Scene& scene, std::int32_t status, std::int32_t wanted, const std::string& words) {
    const std::string said = delam_context_message(scene.context());
    cases::expect(status == wanted, "status " + std::to_string(status) + ": " + said);
    cases::expect(said.find(words) != std::string::npos, said);
}

TEST(refused_by_name) {
    const Sheared law;
    const Scene variational = moved(law, 0.0, {0.0, 1.0}, {{{0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}}}, "variational");
    expect_refused(variational, delam_problem_check(variational.problem()), DELAM_ERROR_PROBLEM,
                   "use mixity_rule = frozen or converged");
    Scene plane(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    plane.interface(0, 1);
    plane.begin();
    plane.elastic(-1, 1e9, 0.2);
    plane.law(0, {1e9, 1e9, 1.0, 1.0, 9.0, 9.0, 1.0, 0.0, 0.0, 2.0});
    expect_refused(plane, delam_problem_check(plane.problem()), DELAM_ERROR_PROBLEM,
                   "second_tangential_onset 2 of its law");
    delam_law* griffith = nullptr;
    REQUIRE(plane, delam_law_create, plane.context(), "griffith", &griffith);
    const reference::Law own(griffith);
    expect_refused(plane, delam_law_set(griffith, "second_tangential_onset", 2.0), DELAM_ERROR_ARGUMENT,
                   "does not belong to kind griffith");
    expect_refused(plane, delam_law_set(griffith, "second_tangential_toughness", -2.0), DELAM_ERROR_ARGUMENT,
                   "must be finite and > 0");
}

}  // namespace
