// SPDX-License-Identifier: BSD-3-Clause
// Laws of all kinds in complete scenes: closed forms at a point, the energy ledger, a host law against the library's,
// callbacks that fail during an analysis, the effect on the hash.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "api.hpp"
#include "enf.hpp"
#include "host_bilinear.hpp"
#include "support.hpp"

namespace {

using reference::Law;
using reference::Scene;
using reference::Solver;

constexpr double k = 125e9, onset = 100.0;

struct Kind {
    const char* kind;
    double toughness;
    double plateau = -1.0;
    std::vector<double> xi, s;
    // Traction over its peak at x = jump over onset jump >= 1, computed independently.
    std::function<double(double)> softened;
};

// Straight lines through (xi, s), scaled so that the area beyond the onset is (r-1)/2.
double along(const std::vector<double>& xi, const std::vector<double>& s, double r, double x) {
    double area = 0.0;
    for (std::size_t i = 1; i < xi.size(); ++i) area += 0.5 * (s[i] + s[i - 1]) * (xi[i] - xi[i - 1]);
    const double at = (x - 1.0) * 2.0 * area / (r - 1.0);
    for (std::size_t i = 1; i < xi.size(); ++i)
        if (at < xi[i]) return s[i - 1] + (s[i] - s[i - 1]) * (at - xi[i - 1]) / (xi[i] - xi[i - 1]);
    return 0.0;
}

std::vector<Kind> kinds() {
    const std::vector<double> xi{0.0, 0.1, 0.4, 0.4, 1.0}, s{1.0, 0.8, 0.6, 0.4, 0.0};
    return {{"piecewise-linear", 250.0, -1.0, {}, {}, [](double x) { return std::max(0.0, (2.5 - x) / 1.5); }},
            {"exponential", 250.0, -1.0, {}, {}, [](double x) { return std::exp(-(x - 1.0) / 0.75); }},
            {"trapezoidal", 250.0, 0.5, {}, {}, [](double x) { return std::clamp((2.0 - x) / 0.5, 0.0, 1.0); }},
            {"tabulated", 250.0, -1.0, xi, s, [=](double x) { return along(xi, s, 2.5, x); }},
            {"griffith", 100.0, -1.0, {}, {}, [](double) { return 0.0; }}};
}
constexpr int kind_count = 5;

Law make_law(const Scene& scene, const Kind& kind, const char* criterion = "power") {
    delam_law* raw = nullptr;
    REQUIRE(scene, delam_law_create, scene.context(), kind.kind, &raw);
    Law law(raw);
    scene.require(delam_law_set_text(raw, "criterion", criterion), "criterion");
    const auto set = [&](const char* key, double value) { scene.require(delam_law_set(raw, key, value), key); };
    set("normal_stiffness", k);
    set("tangential_stiffness", k);
    set("normal_toughness", kind.toughness);
    set("tangential_toughness", kind.toughness);
    if (std::string(kind.kind) != "griffith") {
        set("normal_onset", onset);
        set("tangential_onset", onset);
    }
    if (kind.plateau >= 0.0) set("plateau", kind.plateau);
    const auto count = static_cast<std::int64_t>(kind.xi.size());
    if (count > 0) REQUIRE(scene, delam_law_set_table, raw, count, kind.xi.data(), kind.s.data());
    REQUIRE(scene, delam_law_check, raw);
    return law;
}

void use(const Scene& scene, const Law& law) { REQUIRE(scene, delam_problem_set_law, scene.problem(), 0, law.get()); }

// Two rigid blocks, the upper one moved by `direction` times the load: forces are tractions.
Scene imposed(const std::vector<double>& direction, const std::vector<double>& times,
              const std::vector<double>& jumps) {
    Scene scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e9, 0.2);
    const auto load = scene.pattern("open", times, jumps);
    const auto below = scene.find(0, {0.0, 0.0}, {1.0, 2.0}), above = scene.find(1, {0.0, 0.0}, {1.0, 2.0});
    for (const std::vector<double>& axis : {std::vector<double>{1.0, 0.0}, std::vector<double>{0.0, 1.0}}) {
        scene.hold(below, axis);
        const double part = axis[0] * direction[0] + axis[1] * direction[1];
        scene.drive(above, axis, load, std::vector<double>(above.size(), part));
    }
    return scene;
}

// Loading, unloading and reloading at one pair, in both modes and between them (equal modes and exponent 1, so that the
// toughness is the same): the traction follows the curve, and the dissipation is the area under it less what unloading
// returns.
LOOP_TEST(closed_forms, 0, kind_count) {
    const Kind kind = kinds()[static_cast<std::size_t>(loop)];
    const double d0 = std::sqrt(2.0 * onset / k), peak = k * d0;
    const std::vector<double> turns{0.0, 1.3, 0.4, 1.8, 0.0, 2.2, 5.0};
    for (const double angle : {0.0, 1.0, 0.5 * std::acos(-1.0)}) {
        std::vector<double> times, jumps;
        for (std::size_t i = 0; i < turns.size(); ++i) {
            times.push_back(static_cast<double>(i));
            jumps.push_back(turns[i] * d0);
        }
        const Scene scene = imposed({std::sin(angle), std::cos(angle)}, times, jumps);
        Law law = make_law(scene, kind);
        for (const char* key : {"onset_exponent", "toughness_exponent"})
            if (std::string(kind.kind) != "griffith" || key[0] != 'o')
                scene.require(delam_law_set(law.get(), key, 1.0), key);
        use(scene, law);
        Solver solver(scene, 0.0);
        double largest = 0.0, area = 0.0;
        const int per_leg = 17;  // no step exactly at an onset or a drop
        for (int step = 1; step <= per_leg * 6; ++step) {
            const double time = static_cast<double>(step) / per_leg;
            const auto leg = std::min(static_cast<std::size_t>(time), turns.size() - 2);
            const double x = turns[leg] + (turns[leg + 1] - turns[leg]) * (time - static_cast<double>(leg));
            solver.step(time);
            solver.commit();
            constexpr int parts = 4000;  // midpoint rule; a jump of the curve causes an error of half a part
            for (int i = 0; i < parts && x > largest && x > 1.0; ++i) {
                const double from = std::max(1.0, largest), at = from + (x - from) * (i + 0.5) / parts;
                area += kind.softened(at) * (x - from) / parts;
            }
            largest = std::max(largest, x);
            const double s = largest <= 1.0 ? largest : kind.softened(largest);
            const double zeta = s / largest, t = zeta * k * x * d0;
            const std::string where = std::string(kind.kind) + ", step " + std::to_string(step) + ": ";
            for (const double z : solver.field("adhesion")) cases::expect_near(z, zeta, 1e-12, 1.0, where + "adhesion");
            cases::expect_near(solver.value("reaction:open"), t, 1e-12, peak, where + "reaction");
            cases::expect_near(solver.value("stored_interface"), 0.5 * t * x * d0, 1e-12, onset, where + "stored");
            const double under = largest <= 1.0 ? 0.5 * largest * largest : 0.5 + area;
            const double spent = 2.0 * onset * (under - 0.5 * s * largest);
            cases::expect_near(solver.value("dissipated"), spent, 1e-4, onset, where + "spent");
            const double slides = solver.value("stored_interface_slides") + solver.value("dissipated_slides");
            cases::expect_near(solver.value("stored_interface") + solver.value("dissipated"), slides, 1e-12, onset,
                               where + "the split of PANM 15");
        }
        const double rest = std::string(kind.kind) == "exponential" ? 0.02 : 1e-12;
        cases::expect_near(solver.value("dissipated"), kind.toughness, rest, kind.toughness, "all is spent");
    }
}

// Small ENF: stored + dissipated - work, relative to the dissipated energy.
double defect(const Kind& kind, int steps, double& spent) {
    cases::Enf e;
    e.h = 1.5e-3;
    const Scene scene = cases::make_enf(e);
    use(scene, make_law(scene, kind, "benzeggagh-kenane"));
    Solver solver(scene, 0.0);
    for (int step = 1; step <= steps; ++step) {
        solver.step(cases::enf_time(step, steps));
        solver.commit();
    }
    spent = solver.value("dissipated");
    return (solver.value("stored_bulk") + solver.value("stored_interface") + spent - solver.value("work")) / spent;
}

// Where the traction decreases continuously, the defect decreases with the step. Where it drops (the last two), the
// pairs break one by one, and the energy that each releases is lost: none of it may be gained.
LOOP_TEST(ledger, 0, kind_count + 1) {
    std::vector<Kind> all = kinds();
    Kind smooth = all[3];
    smooth.xi = {0.0, 0.1, 0.4, 0.7, 1.0};
    all.insert(all.begin() + 3, smooth);
    const Kind& kind = all[static_cast<std::size_t>(loop)];
    double spent_coarse = 0.0, spent_fine = 0.0;
    const double coarse = defect(kind, 20, spent_coarse), fine = defect(kind, 160, spent_fine);
    const std::string name = kind.kind;
    std::printf("%s: %.3e of what is dissipated at 20 steps, %.3e at 160; dissipated %.6g, %.6g\n", kind.kind, coarse,
                fine, spent_coarse, spent_fine);
    cases::expect(spent_fine > 1.0, name + ": nothing is damaged");
    if (loop < 4)
        cases::expect_below(std::abs(fine), std::min(1e-3, 0.5 * std::abs(coarse)), name + ": defect");
    else
        cases::expect_below(fine, 0.0, name + ": energy gained");
}

// A short mixed-mode flexure (the notched end rests on the upper arm) in 2D and 3D.
Scene flexure(int dimension) {
    const double length = 0.06, arm = 3e-3, width = 6e-3, notch = 0.0151;
    const bool solid = dimension == 3;
    Scene scene = solid ? Scene(3, {length, width}, {24, 2}, {arm, arm}, {1, 1}, DELAM_HEX8)
                        : Scene(2, {length}, {40}, {arm, arm}, {2, 2}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    std::vector<std::int64_t> open;
    const auto pairs = scene.pairs(0);
    for (std::size_t i = 0; i < pairs.count(); ++i)
        if (scene.coordinate(pairs.node_a[i], 0) < notch) open.push_back(static_cast<std::int64_t>(i));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    const auto at = [&](std::int32_t body, double x, double height) {
        if (solid) return scene.find(body, {x, 0.0, height}, {x, width, height});
        return scene.find(body, {x, height}, {x, height});
    };
    const auto axis = [&](int i) {
        std::vector<double> e(static_cast<std::size_t>(dimension), 0.0);
        e[static_cast<std::size_t>(i)] = 1.0;
        return e;
    };
    std::vector<double> down = axis(dimension - 1);
    down.back() = -1.0;
    scene.hold(at(1, 0.0, arm), axis(dimension - 1));
    for (int i = 0; i < dimension; ++i) scene.hold(at(0, length, 0.0), axis(i));
    const auto press = scene.pattern("press", {0.0, 1.0}, {0.0, 2.5e-3});
    const auto middle = at(1, 0.5 * length, 2.0 * arm);
    scene.drive(middle, down, press, std::vector<double>(middle.size(), 1.0));
    return scene;
}

Law bilinear(const Scene& scene, laws::Bilinear& data, bool host) {
    delam_law* raw = nullptr;
    if (host) {
        REQUIRE(scene, delam_law_create_host, scene.context(), "mine", laws::adhesion, laws::dissipation, &data, &raw);
    } else {
        REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &raw);
        scene.require(delam_law_set_text(raw, "criterion", "benzeggagh-kenane"), "criterion");
    }
    Law law(raw);
    std::vector<std::pair<const char*, double>> parameters{{"normal_stiffness", 125e9}, {"tangential_stiffness", 60e9}};
    if (!host)
        for (const auto& parameter :
             std::initializer_list<std::pair<const char*, double>>{{"normal_onset", data.normal_onset},
                                                                   {"tangential_onset", data.tangential_onset},
                                                                   {"normal_toughness", data.normal_toughness},
                                                                   {"tangential_toughness", data.tangential_toughness},
                                                                   {"onset_exponent", data.eta},
                                                                   {"toughness_exponent", data.eta}})
            parameters.push_back(parameter);
    for (const auto& [key, value] : parameters) scene.require(delam_law_set(raw, key, value), key);
    return law;
}

LOOP_TEST(host_law_gives_the_history_of_ours, 0, 2) {
    const int dimension = 2 + loop;
    const Scene first = flexure(dimension), second = flexure(dimension);
    laws::Bilinear data;
    for (const Scene* scene : {&first, &second})
        scene->require(delam_problem_set_number(scene->problem(), "damage_tolerance", 1e-11), "damage_tolerance");
    use(first, bilinear(first, data, false));
    use(second, bilinear(second, data, true));
    Solver own(first, 0.0), host(second, 0.0);
    double worst = 0.0;
    for (int step = 1; step <= 10; ++step) {
        for (Solver* solver : {&own, &host}) {
            solver->step(0.1 * step);
            solver->commit();
        }
        const auto a = own.field("adhesion"), b = host.field("adhesion");
        for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
        for (const char* key : {"stored_bulk", "stored_interface", "dissipated", "work"})
            cases::expect_near(host.value(key), own.value(key), 1e-9, std::max(1e-3, std::abs(own.value(key))), key);
    }
    cases::expect_below(worst, 1e-9, "adhesion");
    const auto mixity = own.field("mixity");
    const auto [low, high] = std::minmax_element(mixity.begin(), mixity.end());
    cases::expect(own.value("front") > 0.0 && *high - *low > 0.2, "the analysis is mixed and damages");
}

TEST(callback_fails) {
    const Scene scene = flexure(2);
    laws::Bilinear data;
    use(scene, bilinear(scene, data, true));
    Solver solver(scene, 0.0), steady(scene, 0.0);
    solver.step(0.4);
    solver.commit();
    steady.step(0.4);
    steady.commit();
    data.failing = 5;
    const std::int32_t status = solver.advance(0.8);
    const std::string message = delam_context_message(scene.context());
    cases::expect(status == DELAM_ERROR_PROBLEM, "status " + std::to_string(status));
    cases::expect(message.find("law 'mine': the ") == 0 && message.find("callback failed with 5 at mixity B = 0.9") > 0,
                  message);
    data.failing = 0;
    solver.step(0.8);
    solver.commit();
    steady.step(0.8);
    steady.commit();
    cases::expect(solver.save() == steady.save(), "a failed step leaves something behind");
}

std::string hash_of(const Scene& scene) {
    char out[17];
    REQUIRE(scene, delam_problem_hash, scene.problem(), out);
    return out;
}

TEST(hash_and_keys) {
    const Scene scene = flexure(2);
    std::vector<std::string> seen;
    const auto expect_new = [&](const Law& law, const std::string& what) {
        use(scene, law);
        const std::string hash = hash_of(scene);
        cases::expect(std::find(seen.begin(), seen.end(), hash) == seen.end(), what + " does not change the hash");
        seen.push_back(hash);
    };
    for (const Kind& kind : kinds()) expect_new(make_law(scene, kind), kind.kind);
    for (const char* criterion : {"valoroso-champaney", "benzeggagh-kenane"})
        expect_new(make_law(scene, kinds()[0], criterion), criterion);
    Kind other = kinds()[2];
    other.plateau = 0.25;
    expect_new(make_law(scene, other), "plateau");
    other = kinds()[3];
    other.s[1] = 0.7;
    expect_new(make_law(scene, other), "table");
    const Law law = make_law(scene, kinds()[0]);
    scene.require(delam_law_set(law.get(), "gradient", 0.01), "gradient");
    expect_new(law, "gradient");
    laws::Bilinear data;
    expect_new(bilinear(scene, data, true), "host");
    delam_law* raw = nullptr;
    REQUIRE(scene, delam_law_create_host, scene.context(), "other", laws::adhesion, laws::dissipation, &data, &raw);
    const Law named(raw);
    scene.require(delam_law_set(raw, "normal_stiffness", 125e9), "key");
    scene.require(delam_law_set(raw, "tangential_stiffness", 60e9), "key");
    expect_new(named, "name of the host's law");

    const auto refused = [&](std::int32_t status, const std::string& part) {
        const std::string message = delam_context_message(scene.context());
        cases::expect(status == DELAM_ERROR_ARGUMENT && message.find(part) != std::string::npos, message);
    };
    delam_law* none = nullptr;
    refused(delam_law_create(scene.context(), "host", &none), "delam_law_create_host");
    const auto host = [&](const char* name, delam_adhesion_callback adhesion, delam_dissipation_callback dissipation) {
        return delam_law_create_host(scene.context(), name, adhesion, dissipation, nullptr, &none);
    };
    refused(host("", laws::adhesion, laws::dissipation), "name is empty");
    refused(host("x", nullptr, laws::dissipation), "adhesion is NULL");
    refused(host("x", laws::adhesion, nullptr), "dissipation is NULL");
    cases::expect(none == nullptr, "a refused law");
    refused(delam_law_set(raw, "normal_onset", 1.0), "'normal_onset' does not belong to kind host; known are");
    refused(delam_law_set(law.get(), "onset_exponent_1", 1.0), "does not belong to criterion power; known are");
    refused(delam_law_set(law.get(), "gradient", -1.0), "'gradient' = -1 must be finite and >= 0");
    refused(delam_law_set_text(law.get(), "criterion", "bk"), "'bk' is not known; known are valoroso-champaney, power");
    refused(delam_law_set_text(law.get(), "gradient", "1"), "'gradient' is a number: use delam_law_set");
    const double xi[] = {0.0, 1.0}, s[] = {1.0, 0.0};
    refused(delam_law_set_table(law.get(), 2, xi, s), "'softening' does not belong to kind piecewise-linear");

    // Every key of every kind can be read, is of a known type, and says whether it must be given.
    const std::pair<const char*, std::int64_t> counts[] = {
        {"piecewise-linear", 21}, {"exponential", 21}, {"trapezoidal", 22}, {"tabulated", 22},
        {"griffith", 11},         {"host", 4},         {"cubic", 0}};
    for (const auto& [kind, count] : counts) {
        cases::expect(delam_law_parameter_count(kind) == count, kind);
        for (std::int64_t i = 0; i < count; ++i) {
            const char *key = nullptr, *type = nullptr, *unit = nullptr;
            const char *initial = nullptr, *range = nullptr, *meaning = nullptr;
            scene.require(delam_law_parameter_info(kind, i, &key, &type, &unit, &initial, &range, &meaning), kind);
            for (const char* text : {key, type, unit, range, meaning})
                cases::expect(text != nullptr && *text != '\0', kind);
            cases::expect(initial != nullptr, kind);
        }
        cases::expect(delam_law_parameter_info(kind, count, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr) ==
                          DELAM_ERROR_ARGUMENT,
                      kind);
    }
    cases::expect(delam_law_parameter_count(nullptr) == 0, "NULL");
}

// A kind made by its name in the list of kinds.
Law listed_law(const Scene& scene, std::int64_t i) {
    const char *kind = nullptr, *meaning = nullptr;
    std::int32_t hosted = -1;
    REQUIRE(scene, delam_law_kind_info, i, &kind, &meaning, &hosted);
    cases::expect(*meaning != '\0' && hosted == (kind == std::string("host") ? 1 : 0), kind);
    delam_law* raw = nullptr;
    scene.require(hosted == 1
                      ? delam_law_create_host(scene.context(), "mine", laws::adhesion, laws::dissipation, nullptr, &raw)
                      : delam_law_create(scene.context(), kind, &raw),
                  kind);
    return Law(raw);
}

// Bounds hold for delam_law_set, and the words of the range say the same.
void check_bounds(const char* kind, std::int64_t i, const Law& law) {
    const char *key = nullptr, *type = nullptr, *range = nullptr;
    delam_law_parameter_info(kind, i, &key, &type, nullptr, nullptr, &range, nullptr);
    double lower = 1.0, upper = -1.0;
    std::int32_t lower_open = -1, upper_open = -1;
    const std::string where = std::string(kind) + " " + key;
    cases::expect(delam_law_parameter_bounds(kind, i, &lower, &upper, &lower_open, &upper_open) == DELAM_OK, where);
    if (type == std::string("text")) cases::expect(std::isinf(lower) && std::isinf(upper), where);
    if (type != std::string("real")) return;
    for (const char* criterion : {"valoroso-champaney", "power"}) {
        delam_law_set_text(law.get(), "criterion", criterion);
        const auto taken = [&](double value) { return delam_law_set(law.get(), key, value) == DELAM_OK; };
        if (!taken(0.5)) continue;  // the other criterion has it
        const double inf = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
        cases::expect(taken(lower) == (lower_open == 0) && taken(std::nextafter(lower, inf)), where + ": lower");
        cases::expect(!taken(std::nextafter(lower, -inf)), where + ": below");
        cases::expect(
            taken(upper) == (upper_open == 0) && taken(std::isinf(upper) ? largest : std::nextafter(upper, 0)),
            where + ": upper");
        cases::expect(!taken(std::nextafter(upper, inf)), where + ": above");
    }
    const std::string words = range;
    cases::expect((words.find(">= 0") != std::string::npos) == (lower_open == 0) && lower == 0.0, where + ": " + words);
    cases::expect((words.find("< 1") != std::string::npos) == (upper == 1.0), where + ": " + words);
}

TEST(kinds_and_bounds) {
    const Scene scene = imposed({0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0});
    std::string listed;
    for (std::int64_t i = 0; i < delam_law_kind_count(); ++i) {
        const Law law = listed_law(scene, i);
        const char* kind = nullptr;
        delam_law_kind_info(i, &kind, nullptr, nullptr);
        listed += std::string(kind) + " ";
        for (std::int64_t p = 0; p < delam_law_parameter_count(kind); ++p) check_bounds(kind, p, law);
        cases::expect(delam_law_parameter_bounds(kind, -1, nullptr, nullptr, nullptr, nullptr) == DELAM_ERROR_ARGUMENT,
                      "parameter -1");
    }
    cases::expect(listed == "piecewise-linear exponential trapezoidal tabulated griffith host ", listed);
    cases::expect(delam_law_kind_info(delam_law_kind_count(), nullptr, nullptr, nullptr) == DELAM_ERROR_ARGUMENT,
                  "a kind beyond the last");
}

// A law by its strengths, with a quadratic onset and the toughness of Benzeggagh and Kenane, set in any order.
TEST(strengths_and_onset_criterion) {
    const Scene scene = imposed({0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0});
    const double kn = 4e14, kt = 1e14, sn = 60e6, st = 90e6, gn = 300.0, gt = 800.0, eta = 2.3;
    for (const bool onset_first : {false, true}) {
        delam_law* raw = nullptr;
        REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &raw);
        const Law law(raw);
        const auto text = [&](const char* key, const char* value) {
            scene.require(delam_law_set_text(raw, key, value), key);
        };
        const auto set = [&](const char* key, double value) { scene.require(delam_law_set(raw, key, value), key); };
        const auto set_onset = [&] {
            text("onset_criterion", "power");
            set("onset_exponent", 1.0);
            set("normal_strength", sn);
            set("tangential_strength", st);
        };
        if (onset_first) set_onset();
        text("criterion", "benzeggagh-kenane");
        set("toughness_exponent", eta);
        set("normal_stiffness", kn);
        set("tangential_stiffness", kt);
        set("normal_toughness", gn);
        set("tangential_toughness", gt);
        if (!onset_first) set_onset();
        std::vector<double> mixity, go(11), gc(11);
        for (int i = 0; i <= 10; ++i) mixity.push_back(i / 10.0);
        REQUIRE(scene, delam_law_toughness, raw, 11, mixity.data(), go.data(), gc.data());
        for (std::size_t i = 0; i < mixity.size(); ++i) {
            const double b = mixity[i];
            // (t_n/s_n)^2 + (t_t/s_t)^2 = 1 with t^2 = 2 k Y of each mode.
            const double quadratic = 1.0 / ((1.0 - b) * 2.0 * kn / (sn * sn) + b * 2.0 * kt / (st * st));
            cases::expect_near(go[i], quadratic, 1e-13, quadratic, "onset");
            const double kenane = gn + (gt - gn) * std::pow(b, eta);
            cases::expect_near(gc[i], kenane, 1e-13, kenane, "toughness");
        }
        // The last one of an onset and a strength counts.
        set("normal_onset", 2.0);
        scene.require(delam_law_toughness(raw, 1, mixity.data(), go.data(), nullptr), "onset again");
        cases::expect_near(go[0], 2.0, 0.0, 1.0, "onset again");
        set("normal_strength", sn);
        scene.require(delam_law_toughness(raw, 1, mixity.data(), go.data(), nullptr), "strength again");
        cases::expect_near(go[0], sn * sn / (2.0 * kn), 1e-15, 1.0, "strength again");
        // A peak at jumps of the pure modes.
        const double jump[] = {sn / kn, 0.0};
        double adhesion = 0.0, traction[2] = {};
        const double zero = 0.0, one = 1.0;
        REQUIRE(scene, delam_law_respond, raw, 2, 1, jump, &zero, &one, &adhesion, traction);
        cases::expect_near(traction[0], sn, 1e-12, sn, "peak");
        set("normal_strength", 1e3 * sn);
        cases::expect(delam_law_check(raw) == DELAM_ERROR_PROBLEM, "a strength beyond the toughness");
    }
    delam_law* raw = nullptr;
    scene.require(delam_law_create(scene.context(), "griffith", &raw), "griffith");
    const Law brittle(raw);
    for (const char* key : {"normal_strength", "tangential_strength"})
        cases::expect(delam_law_set(raw, key, 1.0) == DELAM_ERROR_ARGUMENT, key);
    cases::expect(delam_law_set_text(raw, "onset_criterion", "power") == DELAM_ERROR_ARGUMENT, "onset_criterion");
}

}  // namespace
