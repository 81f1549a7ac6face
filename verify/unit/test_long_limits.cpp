// SPDX-License-Identifier: BSD-3-Clause
// The birth certificates of the numbers that steer Newton's method, restarts, renewals, patches and zones
// (scene/limits.inc, base/restarts.inc): analyses with half and twice of each give the same results as with the number
// itself, at another cost. With DELAM_LIMITS=FILE in the environment, the table of digits and costs is written there;
// with DELAM_LIMIT=NAME, only that number is changed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "check.hpp"
#include "evolution/analysis/solver.hpp"
#include "flexure.hpp"

using namespace delam;

namespace {

// A row of the tables, as a pair of functions.
struct Row {
    std::string name, value, reason;
    std::function<void(Limits& limits, double factor)> scale;
};

// A share above one half, twice, goes half of the way to one: beyond one it has no meaning.
template <class Number>
Number scaled(Number value, double factor) {
    if constexpr (std::is_integral_v<Number>)
        return std::max<Number>(1, static_cast<Number>(std::llround(static_cast<double>(value) * factor)));
    else
        return factor > 1.0 && value > 0.5 && value < 1.0 ? 1.0 - (1.0 - value) / factor : value * factor;
}

std::vector<Row> rows() {
    std::vector<Row> out;
#define DELAM_STEERING(type, name, value, reason) \
    out.push_back(                                \
        {#name, #value, reason, [](Limits& limits, double factor) { limits.name = scaled(limits.name, factor); }});
#include "base/restarts.inc"
#include "scene/limits.inc"
#undef DELAM_STEERING
    return out;
}

struct Scene {
    const char* name;
    int dimension;
    std::size_t layers;
    const char* reduction;
    double onset;              // J/m2; the toughness is 250 J/m2
    double length;             // of a cell, m
    double stiffness = 125e9;  // N/m3
    const char* solution = "local";
    int steps = 8;  // each to time 1/8 more
    const char* kinematics = "linear";
};
// Condensed and iterated, in the plane and in space, one interface and more, softening slowly and at once, soft and so
// stiff that digits are lost.
constexpr Scene scenes[] = {
    {"plane", 2, 2, "condensed", 100.0, 1.5e-3},
    {"plane, brittle", 2, 2, "condensed", 240.0, 3e-3},
    {"plane, stack", 2, 3, "condensed", 100.0, 2e-3},
    {"plane, iterated", 2, 2, "iterated", 100.0, 1.5e-3},
    {"space, condensed", 3, 2, "condensed", 100.0, 6e-3},
    {"space, iterated", 3, 2, "iterated", 100.0, 6e-3},
    {"plane, FETI", 2, 3, "feti", 100.0, 2e-3},
    {"space, FETI", 3, 2, "feti", 100.0, 6e-3},
    {"stiff", 2, 2, "condensed", 1.0, 0.75e-3, 1e13},
    {"rigid", 2, 2, "condensed", 1e-2, 1.5e-3, 1e16},
    {"rigid, stack", 2, 4, "iterated", 1e-2, 5e-3, 1e16, "local", 3},
    {"energetic", 2, 2, "iterated", 200.0, 3e-3, 125e9, "energetic"},
    {"rigid, space", 3, 2, "iterated", 1e-2, 10e-3, 1e16, "local", 2},
    {"rotations", 2, 2, "condensed", 100.0, 1.5e-3, 125e9, "local", 8, "corotational"},
};

// Results of an analysis, and its cost.
struct Found {
    std::vector<double> energies, adhesion, reaction;  // of all steps
    bool converged = true;
    double work = 0.0;  // solves, those in zones included, and Krylov iterations
};

Found analyse(const Scene& scene, const Limits& limits) {
    unit::Flexure f;
    f.dimension = scene.dimension;
    f.layers = scene.layers;
    f.along = static_cast<std::int64_t>(std::lround(f.length / scene.length));
    f.across = 3;
    f.through = scene.dimension == 2 ? 3 : 1;
    f.law.normal_onset = f.law.tangential_onset = scene.onset;
    f.law.normal_stiffness = f.law.tangential_stiffness = scene.stiffness;
    Problem problem = unit::make_flexure(f);
    problem.options.reduction = scene.reduction;
    problem.options.solution = scene.solution;
    problem.options.kinematics = scene.kinematics;
    problem.options.limits = limits;
    Monitor monitor;
    Solver solver(problem, monitor, 0.0);
    Found found;
    for (int n = 1; n <= scene.steps; ++n) {
        const Outcome outcome = solver.advance(n / 8.0);
        found.converged = found.converged && outcome.status == DELAM_OK;
        solver.commit();
        const State& state = solver.states().shown();
        // Without what is released: a step's deficit of energy is recorded as released from a bound on, and the deficit
        // of "energetic" lies at this bound.
        for (const double e : {state.ledger.stored_bulk, state.ledger.stored_interface, state.ledger.dissipated})
            found.energies.push_back(e);
        found.adhesion.insert(found.adhesion.end(), state.adhesion.begin(), state.adhesion.end());
        found.reaction.push_back(state.response.conjugate.front());
        const Effort& effort = state.effort;
        found.work += static_cast<double>(effort.displacement_solves + effort.contact_iterations +
                                          effort.newton_solves + effort.linear_iterations);
    }
    return found;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

// The largest difference of energies, reactions and adhesions, each over its largest value.
double difference(const Found& a, const Found& b) {
    return std::max({distance(a.energies, b.energies) / max_abs(b.energies),
                     distance(a.reaction, b.reaction) / max_abs(b.reaction), distance(a.adhesion, b.adhesion)});
}

// The damage is at rest within damage_tolerance = 1e-6 at the end of each step, and each step starts from the one
// before. (Largest difference that was seen: LIMITS.md.)
constexpr double allowed = 1e-4;

constexpr const char* heading =
    "# Numbers that steer the solvers\n\n"
    "Written by `DELAM_LIMITS=LIMITS.md verify/unit_test_long_limits` in a build folder: what half and twice of each "
    "number "
    "do to the analyses of `verify/unit/test_long_limits.cpp`. Twice a share above one half is half of the way to "
    "one.\n\n"
    "Difference: the largest of energies and reactions, relative, and of adhesions. Work: solves and Krylov iterations "
    "over those with the number itself. Where neither changes, no analysis came to the number: it guards.\n\n"
    "| number | value | reason | half: difference, work | twice: difference, work |\n|---|---|---|---|---|\n";

TEST(test_limits) {
    std::vector<Found> expected;
    for (const Scene& scene : scenes) {
        expected.push_back(analyse(scene, {}));
        ck_assert_msg(expected.back().converged, "%s: not converged", scene.name);
    }
    std::FILE* table = std::getenv("DELAM_LIMITS") != nullptr ? std::fopen(std::getenv("DELAM_LIMITS"), "w") : nullptr;
    if (table != nullptr) std::fputs(heading, table);
    std::string wrong;
    const char* const only = std::getenv("DELAM_LIMIT");
    for (const Row& row : rows()) {
        if (only != nullptr && row.name != only) continue;
        std::string line = "| `" + row.name + "` | " + row.value + " | " + row.reason + " |";
        for (const double factor : {0.5, 2.0}) {
            Limits limits;
            row.scale(limits, factor);
            double largest = 0.0, least = 1.0, most = 1.0;
            for (std::size_t s = 0; s < std::size(scenes); ++s) {
                const Found found = analyse(scenes[s], limits);
                const double off = difference(found, expected[s]), ratio = found.work / expected[s].work;
                if (!(off <= allowed && found.converged))
                    wrong += row.name + " times " + std::to_string(factor) + ", " + scenes[s].name + ": " +
                             std::to_string(off) + (found.converged ? "\n" : ", not converged\n");
                largest = std::max(largest, off);
                least = std::min(least, ratio);
                most = std::max(most, ratio);
            }
            char text[96];
            std::snprintf(text, sizeof text, " %.0e, %.2f to %.2f |", largest, least, most);
            line += text;
        }
        if (table != nullptr) std::fprintf(table, "%s\n", line.c_str());
        std::printf("%s\n", line.c_str());
    }
    if (table != nullptr) std::fclose(table);
    ck_assert_msg(wrong.empty(), "numbers that decide results:\n%s", wrong.c_str());
}

}  // namespace
