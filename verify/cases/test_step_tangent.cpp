// SPDX-License-Identifier: BSD-3-Clause
// The consistent tangent of a step is the derivative of the step's own reactions, damage included: compared with
// central differences of whole steps whose end factors are changed. And the energy of the condensed operator is the
// energy that the solver reports.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "api.hpp"
#include "delam/experimental.h"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

struct Setting {
    const char* name;
    int dimension;
    const char* reduction;
    const char* rule;
    double gradient;
    double asymmetry;  // smallest relative asymmetry that must appear; 0: symmetric
    const char* control = "fixed";
    double second = 0.0;  // stiffness of the second shear; the axes are turned by 30 degrees from the load
    double onset = 0.0, toughness = 0.0;  // of the second shear
    double path_step = 0.0;  // 1: each step has one part, and no pair unloads between parts; 0: the default
};

constexpr Setting settings[] = {
    {"frozen", 2, "condensed", "frozen", 0.0, 0.0},
    {"frozen, FETI", 2, "feti", "frozen", 0.0, 0.0},
    {"converged", 2, "condensed", "converged", 0.0, 1e-6},
    {"variational", 2, "condensed", "variational", 0.0, 0.0},
    {"gradient", 2, "condensed", "frozen", 2e-3, 0.0},
    {"frozen, space", 3, "condensed", "frozen", 0.0, 0.0},
    {"converged, space", 3, "condensed", "converged", 0.0, 1e-6},
    {"frozen, iterated, space", 3, "iterated", "frozen", 0.0, 0.0},
    {"frozen, FETI, space", 3, "feti", "frozen", 0.0, 0.0},
    {"variational, space", 3, "condensed", "variational", 0.0, 0.0},
    {"gradient, space", 3, "condensed", "frozen", 2e-3, 0.0},
    {"along the load", 2, "condensed", "converged", 0.0, 1e-6, "load"},
    {"along the load, space", 3, "condensed", "converged", 0.0, 1e-6, "load"},
    {"two shears", 3, "condensed", "converged", 0.0, 1e-6, "fixed", 3e12},
    {"two shears, variational", 3, "condensed", "variational", 0.0, 0.0, "fixed", 6e12},
    {"two shears, iterated", 3, "iterated", "frozen", 0.0, 0.0, "fixed", 3e12},
    {"two toughnesses in shear", 3, "condensed", "converged", 0.0, 1e-6, "fixed", 1e13, 30.0, 700.0},
    {"two toughnesses in shear, along the load", 3, "condensed", "converged", 0.0, 1e-6, "load", 3e12, 25.0, 900.0,
     0.9},
    {"two toughnesses, two stiffnesses", 3, "condensed", "converged", 0.0, 1e-6, "fixed", 3e12, 25.0, 900.0, 1.0},
    {"more of the onset, less of the toughness", 3, "condensed", "converged", 0.0, 1e-6, "fixed", 3e12, 60.0, 300.0,
     1.0},
    {"two toughnesses in shear, frozen", 3, "condensed", "frozen", 0.0, 0.0, "fixed", 3e12, 25.0, 900.0},
};
constexpr int setting_count = static_cast<int>(std::size(settings));

constexpr int steps = 10;

// A strip peeled and sheared at its left end by three devices: two displacements and a force.
Scene strip(const Setting& s) {
    const bool space = s.dimension == 3;
    Scene scene = space ? Scene(3, {0.03, 0.004}, {15, 2}, {1e-3, 1e-3}, {1, 1}, DELAM_HEX8)
                        : Scene(2, {0.03}, {30}, {1e-3, 1e-3}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    const double axis[] = {std::sqrt(0.75), 0.5, 0.0};
    if (s.second > 0.0) REQUIRE(scene, delam_experimental_mesh_set_tangents, scene.mesh(), 0, 1, axis);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    // The loads are chosen so that standard hex8 soften in every setting.
    if (space) REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "standard");
    reference::LawData law{1e13, 1e13, 20.0, 40.0, 200.0, 500.0};
    if (std::string(s.rule) == "variational")  // this rule allows only a weak dependence on the mode
        law.normal_onset = 60.0, law.tangential_onset = 80.0, law.tangential_toughness = 210.0;
    law.gradient = s.gradient;
    law.second_tangential_stiffness = s.second;
    law.second_tangential_onset = s.onset;
    law.second_tangential_toughness = s.toughness;
    scene.law(0, law);
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> notch;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < 0.0055) notch.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    const auto box = [&](double x0, double x1, double z) {
        return space ? std::pair{std::vector<double>{x0, 0.0, z}, std::vector<double>{x1, 0.004, z}}
                     : std::pair{std::vector<double>{x0, z}, std::vector<double>{x1, z}};
    };
    const auto unit = [&](int axis) {
        std::vector<double> e(static_cast<std::size_t>(s.dimension), 0.0);
        e[static_cast<std::size_t>(axis < 0 ? s.dimension - 1 : axis)] = 1.0;
        return e;
    };
    const auto base = box(0.0, 0.03, 0.0);
    const auto foot = scene.find(0, base.first, base.second);
    for (int k = 0; k < s.dimension; ++k) scene.hold(foot, unit(k));
    const auto tip = box(0.0, 0.0, 2e-3);
    const auto top = scene.find(1, tip.first, tip.second);
    scene.drive(top, unit(-1), scene.pattern("lift", {0.0, 1.0}, {0.0, 2.5e-4}), std::vector<double>(top.size(), 1.0));
    scene.drive(top, unit(0), scene.pattern("pull", {0.0, 1.0}, {0.0, -4e-5}), std::vector<double>(top.size(), 1.0));
    const auto press = scene.pattern("press", {0.0, 1.0}, {0.0, 1.0});
    const auto middle = box(0.012, 0.012, 2e-3);
    const auto loaded = scene.find(1, middle.first, middle.second);
    std::vector<double> forces;
    for (std::size_t i = 0; i < loaded.size(); ++i)
        for (const double f : unit(-1)) forces.push_back(f * (space ? 4.0 : 2000.0));
    scene.require(delam_problem_add_forces(scene.problem(), press, static_cast<std::int64_t>(loaded.size()),
                                           loaded.data(), forces.data(), 0),
                  "forces");
    scene.text("reduction", s.reduction);
    scene.text("mixity_rule", s.rule);
    scene.text("step_control", s.control);
    if (s.path_step > 0.0) scene.number("path_step", s.path_step);
    scene.number("damage_tolerance", 1e-11);
    return scene;
}

constexpr const char* names[] = {"lift", "pull", "press"};
constexpr double ends[] = {2.5e-4, -4e-5, 1.0};

std::vector<double> step_tangent(const Solver& solver) {
    std::vector<double> matrix(9);
    REQUIRE(solver.scene(), delam_solver_step_tangent, solver.get(), 9, matrix.data());
    return matrix;
}

LOOP_TEST(tangent_is_the_derivative, 0, setting_count) {
    const Setting& s = settings[loop];
    if (std::string(s.name) == "frozen, FETI, space" && !cases::whole()) return;
    const Scene scene = strip(s);
    Solver solver(scene, 0.0);
    bool damaged = false, softened = false, divided = false;
    double asymmetry = 0.0;
    std::vector<double> factors(3);
    for (int k = 1; k <= steps; ++k) {
        const double time = static_cast<double>(k) / steps;
        for (std::size_t p = 0; p < 3; ++p) {
            factors[p] = ends[p] * time;
            REQUIRE(scene, delam_solver_set_history, solver.get(), static_cast<std::int64_t>(p), 1, &time, &factors[p]);
        }
        solver.step(time);
        const std::vector<double> tangent = step_tangent(solver);
        std::vector<double> secant(9);
        REQUIRE(scene, delam_solver_tangent, solver.get(), 9, secant.data());
        divided = divided || solver.value("substeps") > 1.0;
        damaged = damaged || (k > 2 && solver.value("dissipated") > 0.0);
        const auto at = [&](int q, double change) {
            for (int p = 0; p < 3; ++p) {
                const double value = factors[static_cast<std::size_t>(p)] + (p == q ? change : 0.0);
                REQUIRE(scene, delam_solver_set_history, solver.get(), p, 1, &time, &value);
            }
            solver.step(time);
            std::vector<double> reactions;
            for (const char* name : names) reactions.push_back(solver.value(std::string("reaction:") + name));
            solver.rollback();
            return reactions;
        };
        solver.rollback();
        // Compared as energies: entries times the factors of their row and column at the end.
        double size = 0.0;
        for (int p = 0; p < 3; ++p)
            size = std::max(size, std::abs(tangent[static_cast<std::size_t>(4 * p)]) * ends[p] * ends[p]);
        for (int q = 0; q < 3; ++q) {
            const double e = 2e-7 * ends[q];  // small: no pair may start to soften within it
            const auto above = at(q, e), below = at(q, -e);
            for (int p = 0; p < 3; ++p) {
                const auto i = static_cast<std::size_t>(3 * p + q);
                const double difference =
                    (above[static_cast<std::size_t>(p)] - below[static_cast<std::size_t>(p)]) / (2.0 * e);
                // Variational tangents hold the mixity that the elastic solution of the first loaded step gives.
                if (k > 1 || std::string(s.rule) != "variational")
                    cases::expect_near(
                        tangent[i] * ends[p] * ends[q], difference * ends[p] * ends[q], 2e-4, size,
                        std::string(s.name) + ", step " + std::to_string(k) + ", d " + names[p] + " / d " + names[q]);
                softened = softened || std::abs(tangent[i] - secant[i]) * ends[p] * ends[q] > 0.02 * size;
                if (k == 1) continue;  // there the mixities of the elastic solution depend on all loads
                asymmetry = std::max(asymmetry, std::abs(tangent[i] - tangent[static_cast<std::size_t>(3 * q + p)]) *
                                                    ends[p] * ends[q] / size);
            }
        }
        // Changed histories that were rolled back leave the planned value.
        for (int p = 0; p < 3; ++p)
            REQUIRE(scene, delam_solver_set_history, solver.get(), p, 1, &time, &factors[static_cast<std::size_t>(p)]);
        solver.step(time);
        solver.commit();
    }
    cases::expect(damaged && softened, std::string(s.name) + ": the steps did not soften, nothing was tested");
    cases::expect(divided == (std::string(s.control) == "load"), std::string(s.name) + ": steps in substeps");
    if (s.asymmetry > 0.0)
        cases::expect(asymmetry > s.asymmetry, std::string(s.name) + ": should not be symmetric");
    else
        cases::expect_below(asymmetry, 1e-6, std::string(s.name) + ": asymmetry");
}

// At fixed adhesion and contact set: compared with displacement steps beside the state.
LOOP_TEST(load_tangent_is_the_derivative, 0, setting_count) {
    const Setting& s = settings[loop];
    if (std::string(s.name) == "frozen, FETI, space" && !cases::whole()) return;
    const Scene scene = strip(s);
    Solver solver(scene, 0.0);
    for (const double time : {0.3, 0.6, 0.9}) {
        solver.step(time);
        solver.commit();
        std::vector<double> tangent(9);
        REQUIRE(scene, delam_solver_tangent, solver.get(), 9, tangent.data());
        double size = 0.0;
        for (std::size_t p = 0; p < 3; ++p) size = std::max(size, std::abs(tangent[4 * p]) * ends[p] * ends[p]);
        const double beside = time + 1e-3;
        const auto at = [&](std::size_t q, double change) {
            for (std::size_t p = 0; p < 3; ++p) {
                const double value = ends[p] * (time + (p == q ? change : 0.0));
                REQUIRE(scene, delam_solver_set_history, solver.get(), static_cast<std::int64_t>(p), 1, &beside,
                        &value);
            }
            REQUIRE(scene, delam_solver_equilibrate, solver.get(), beside, nullptr);
            std::vector<double> reactions;
            for (const char* name : names) reactions.push_back(solver.value(std::string("reaction:") + name));
            solver.rollback();
            return reactions;
        };
        for (std::size_t q = 0; q < 3; ++q) {
            const auto above = at(q, 1e-5), below = at(q, -1e-5);
            for (std::size_t p = 0; p < 3; ++p)
                cases::expect_near(tangent[3 * p + q] * ends[p] * ends[q], (above[p] - below[p]) / 2e-5 * ends[p], 1e-5,
                                   size,
                                   std::string(s.name) + ", load tangent at " + std::to_string(time) + ", d " +
                                       names[p] + " / d " + names[q]);
        }
        for (std::size_t p = 0; p < 3; ++p) {
            const double end = 1.0;
            REQUIRE(scene, delam_solver_set_history, solver.get(), static_cast<std::int64_t>(p), 1, &end, &ends[p]);
        }
    }
}

TEST(tangent_refused) {
    const Scene scene = strip(settings[0]);
    Solver solver(scene, 0.0);
    std::vector<double> matrix(9);
    cases::expect(delam_solver_step_tangent(solver.get(), 9, matrix.data()) == DELAM_ERROR_STATE, "no step is pending");
    solver.step(0.1);
    cases::expect(delam_solver_step_tangent(solver.get(), 8, matrix.data()) == DELAM_ERROR_ARGUMENT, "capacity");
    const auto before = solver.save();
    std::map<std::string, double> values;
    for (const char* key : {"stored_bulk", "dissipated", "reaction:lift", "am_iterations", "contact_pairs"})
        values[key] = solver.value(key);
    step_tangent(solver);
    cases::expect(solver.save() == before, "the state has changed");
    for (const char* key : {"stored_bulk", "dissipated", "reaction:lift", "am_iterations", "contact_pairs"})
        cases::expect(solver.value(key) == values.at(key), std::string("the pending step has changed: ") + key);
    // With backtracking, a step in parts has no tangent, because its parts may start elsewhere.
    {
        Scene parts = strip(settings[0]);
        parts.text("backtracking", "on");
        parts.number("mixity_step_tolerance", 1e-3);
        Solver walked(parts, 0.0);
        bool refused = false;
        for (int k = 1; k <= 4 && !refused; ++k) {
            walked.step(0.25 * k);
            if (walked.value("substeps") > 1.0) {
                cases::expect(delam_solver_step_tangent(walked.get(), 9, matrix.data()) == DELAM_ERROR_STATE,
                              "a step in parts");
                refused = true;
            }
            walked.commit();
        }
        cases::expect(refused, "no step was walked in parts");
    }
    // Reading the tangent does not affect the next step.
    solver.commit();
    solver.step(0.2);
    solver.commit();
    const auto asked = solver.save();
    Solver other(scene, 0.0);
    other.step(0.1);
    other.commit();
    other.step(0.2);
    other.commit();
    cases::expect(asked == other.save(), "the step after it differs");
}

// E = 1/2 x.S x - theta.L x + 1/2 theta.A theta at the jumps of an analysis, and its jumps from x.
LOOP_TEST(operator_is_the_energy, 0, 2) {
    const Scene scene = strip(settings[loop == 0 ? 0 : 5]);
    Solver solver(scene, 0.0);
    std::int64_t n = 0, entries = 0, patterns = 0;
    REQUIRE(scene, delam_solver_condensed_size, solver.get(), &n, &entries);
    REQUIRE(scene, delam_problem_pattern_count, scene.problem(), &patterns);
    const auto un = static_cast<std::size_t>(n), up = static_cast<std::size_t>(patterns);
    const std::size_t rows = scene.pair_count() * static_cast<std::size_t>(scene.dimension());
    std::vector<double> s(un * un), load(up * un), constant(up * up), value(static_cast<std::size_t>(entries)),
        offset(rows * up);
    std::vector<std::int64_t> start(rows + 1), column(static_cast<std::size_t>(entries));
    cases::expect(delam_solver_condensed(solver.get(), n * n - 1, s.data(), nullptr, nullptr, nullptr, nullptr, nullptr,
                                         nullptr) == DELAM_ERROR_ARGUMENT,
                  "capacity");
    REQUIRE(scene, delam_solver_condensed, solver.get(), n * n, s.data(), load.data(), constant.data(), start.data(),
            column.data(), value.data(), offset.data());
    for (int k = 1; k <= 5; ++k) {
        solver.step(0.2 * k);
        const auto jump = solver.field("jump");
        std::vector<double> theta;
        for (const char* name : names) theta.push_back(solver.value(std::string("load:") + name));
        std::vector<double> x(un, 0.0);
        double largest = 0.0;
        for (std::size_t r = 0; r < rows; ++r) {
            largest = std::max(largest, std::abs(jump[r]));
            if (start[r + 1] - start[r] != 1 || value[static_cast<std::size_t>(start[r])] != 1.0) continue;
            double own = jump[r];
            for (std::size_t p = 0; p < up; ++p) own -= offset[r * up + p] * theta[p];
            x[static_cast<std::size_t>(column[static_cast<std::size_t>(start[r])])] = own;
        }
        for (std::size_t r = 0; r < rows; ++r) {
            double j = 0.0;
            for (auto e = static_cast<std::size_t>(start[r]); e < static_cast<std::size_t>(start[r + 1]); ++e)
                j += value[e] * x[static_cast<std::size_t>(column[e])];
            for (std::size_t p = 0; p < up; ++p) j += offset[r * up + p] * theta[p];
            cases::expect_near(j, jump[r], 1e-10, largest, "jump " + std::to_string(r));
        }
        double energy = 0.0;
        for (std::size_t i = 0; i < un; ++i)
            for (std::size_t j = 0; j < un; ++j) energy += 0.5 * x[i] * s[i * un + j] * x[j];
        for (std::size_t p = 0; p < up; ++p) {
            for (std::size_t i = 0; i < un; ++i) energy -= theta[p] * load[p * un + i] * x[i];
            for (std::size_t q = 0; q < up; ++q) energy += 0.5 * theta[p] * constant[p * up + q] * theta[q];
        }
        const double stored = solver.value("stored_bulk") + solver.value("load_potential");
        cases::expect_near(energy, stored, 1e-9,
                           std::abs(solver.value("stored_bulk")) + std::abs(solver.value("load_potential")),
                           "energy of bodies and loads");
        solver.commit();
    }
    for (std::size_t i = 0; i < un; ++i)
        for (std::size_t j = 0; j < i; ++j) cases::expect(s[i * un + j] == s[j * un + i], "symmetry");
}

TEST(no_operator_by_feti) {
    const Scene scene = strip(settings[1]);
    Solver solver(scene, 0.0);
    std::int64_t n = 0;
    cases::expect(delam_solver_condensed_size(solver.get(), &n, nullptr) == DELAM_ERROR_STATE,
                  "FETI has a condensed operator");
    cases::expect(
        std::string(delam_context_message(scene.context())).find("reduction = condensed") != std::string::npos,
        delam_context_message(scene.context()));
}

// Derivatives by numbers of laws are followed from the initial state on; a state that was set or loaded has none, nor
// have the steps from it.
TEST(sensitivities_end_where_a_state_is_set) {
    const Scene scene = strip(settings[2]);
    Solver solver(scene, 0.0);
    const std::int64_t interface = 0, nowhere = 7;
    const auto follow = [&](const std::int64_t& where, const char* key) {
        return delam_experimental_solver_follow(solver.get(), 1, &where, key, nullptr);
    };
    std::vector<double> by(3);
    const auto known = [&] { return delam_experimental_solver_sensitivity(solver.get(), 3, by.data(), nullptr); };
    cases::expect(follow(nowhere, "normal_toughness") == DELAM_ERROR_ARGUMENT, "an interface that is not there");
    cases::expect(follow(interface, "toughness") == DELAM_ERROR_ARGUMENT, "a number that the law does not have");
    cases::expect(follow(interface, "normal_stiffness") == DELAM_OK, delam_context_message(scene.context()));
    solver.step(0.2);
    solver.commit();
    cases::expect(known() == DELAM_OK && by[0] > 0.0, "a stiffer interface pulls more");
    cases::expect(follow(interface, "normal_toughness") == DELAM_ERROR_STATE, "not from a later state on");
    const std::vector<std::uint8_t> saved = solver.save();
    const std::vector<double> adhesion = solver.field("adhesion");
    solver.equilibrate(0.3, adhesion);
    solver.commit();
    cases::expect(known() == DELAM_ERROR_STATE, "a state that was set");
    solver.step(0.4);
    cases::expect(known() == DELAM_ERROR_STATE, "a step from it");
    solver.commit();
    solver.load(saved);
    cases::expect(known() == DELAM_ERROR_STATE, "a state that was loaded");
    solver.step(0.3);
    cases::expect(known() == DELAM_ERROR_STATE, "a step from that");
}

}  // namespace
