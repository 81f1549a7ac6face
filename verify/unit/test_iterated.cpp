// SPDX-License-Identifier: BSD-3-Clause
// What the iterated operator promises beyond all others (test_operators): its iterations whatever the stiffness of the
// interfaces, its estimates of what it leaves, and what it keeps.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "check.hpp"
#include "evolution/contact/contact.hpp"
#include "evolution/contact/contact_levels.hpp"
#include "layer_states.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/sparse/floating.hpp"
#include "reduction/sparse/iterated/conjugate_gradients.hpp"
#include "reduction/sparse/iterated/iterated.hpp"
#include "refused.hpp"

using namespace delam;

namespace {

constexpr auto& cases = unit::layer_cases;

}  // namespace

// Most iterations while the front of a flexure advances column by column through a patch much smaller than the bodies.
static std::int64_t most_iterations(Iterated& iterated, const Problem& problem, const unit::Flexure& f) {
    const InterfaceGeometry& face = problem.mesh->interfaces()[0];
    Response response;
    const std::vector<double> theta(problem.patterns.size(), 1.0);
    std::int64_t most = 0;
    for (int column = 0; column < 8; ++column) {
        Springs springs;
        for (std::size_t p = 0; p < face.node_a.size(); ++p) {
            const double x = problem.mesh->node(face.node_a[p])[0];
            const double spring = x < f.notch + 1e-3 * column ? 0.0 : face.weight[p] * f.law.normal_stiffness;
            springs.stiffness.insert(springs.stiffness.end(), 2, spring);
            springs.held.insert(springs.held.end(), {x < 0.5 * f.notch ? std::uint8_t{1} : std::uint8_t{0}, 0});
        }
        iterated.solve(springs, theta, response);
        ck_assert(response.converged);
        if (column > 0) most = std::max(most, response.iterations);
    }
    return most;
}

// Within a model of Newton's method a tenth of what was wrong at its start may stay, whatever contact does meanwhile;
// where one model foretells the start of the next, nearly nothing may.
LOOP_TEST(a_model_leaves_a_part, 0, std::size(cases)) {
    const unit::LayerCase& c = cases[loop];
    unit::LayerState scene(c, static_cast<unsigned>(loop) + 1U);
    Monitor monitor;
    Iterated iterated(scene.problem, monitor);
    Zone* zone = iterated.zone(scene.springs, scene.wanted, false);
    const auto solve = [&](double scale, bool contact) {
        std::vector<Zone::Coupling> couplings;
        std::vector<std::uint8_t> held(scene.springs.held);
        for (std::size_t r = 0; r < held.size(); ++r) {
            if (contact && r % (7 * scene.dim) == 0) held[r] ^= 1;
            const auto at = static_cast<std::int64_t>(r);
            const double spring = (scene.wanted[r] != 0 ? scale : 1.0) * scene.springs.stiffness[r];
            if (held[r] == 0 && spring > 0.0) couplings.push_back({at, at, spring});
        }
        ck_assert(zone->factor(couplings, held));
        Zone::Solution solution = zone->solve(scene.theta, {});
        ck_assert(solution.balanced && solution.definite && solution.converged);
        return solution;
    };
    ck_assert_double_eq(solve(1.0, false).left, 0.0);
    zone->begin_model();
    const Zone::Solution first = solve(0.5, false), second = solve(0.5, true);
    zone->begin_model();
    const Zone::Solution third = solve(0.5, true);
    std::printf("%s: %d, %d, %d iterations leave %.1e, %.1e, %.1e\n", c.name, static_cast<int>(first.iterations),
                static_cast<int>(second.iterations), static_cast<int>(third.iterations), first.left, second.left,
                third.left);
    ck_assert_double_le(first.left, 0.1);
    ck_assert_double_le(second.left, 0.1);
    // The model is the same as before, so that it has foretold the residual exactly.
    ck_assert_double_le(third.left, 1e-3);
}

// Where only energies are asked for, they are too high by no more than what is allowed, and by about what is said; a
// request for energies ends with the next zone.
LOOP_TEST(energies_within_what_is_allowed, 0, std::size(cases)) {
    const unit::LayerCase& c = cases[loop];
    unit::LayerState scene(c, static_cast<unsigned>(loop) + 1U);
    Monitor monitor;
    Iterated iterated(scene.problem, monitor);
    Zone* zone = iterated.zone(scene.springs, scene.wanted, false);
    struct Outcome {
        double energy, error;
        std::int64_t iterations;
    };
    const auto solve = [&](double scale) -> Outcome {
        std::vector<Zone::Coupling> couplings;
        for (std::size_t r = 0; r < scene.wanted.size(); ++r) {
            const auto at = static_cast<std::int64_t>(r);
            const double spring = (scene.wanted[r] != 0 ? scale : 1.0) * scene.springs.stiffness[r];
            if (scene.springs.held[r] == 0 && spring > 0.0) couplings.push_back({at, at, spring});
        }
        ck_assert(zone->factor(couplings, scene.springs.held));
        const Zone::Solution solution = zone->solve(scene.theta, {});
        ck_assert(solution.balanced && solution.definite && solution.converged);
        const std::vector<double> jump = zone->jumps(scene.theta, solution.unknowns);
        double energy = zone->energy_of(scene.theta, solution.unknowns);
        for (const Zone::Coupling& s : couplings) energy += 0.5 * s.value * jump[index(s.row)] * jump[index(s.row)];
        return {energy, solution.energy_error, solution.iterations};
    };
    const auto ask = [&](double scale, double allowed) {
        zone = iterated.zone(scene.springs, scene.wanted, false);
        zone->ask_for_energies(allowed);
        return solve(scale);
    };
    std::int64_t saved = 0;
    for (const double scale : {0.5, 0.1, 1e-3}) {
        const Outcome exact = ask(scale, 0.0);
        ck_assert_double_eq(exact.error, 0.0);
        // Far larger forces of the bodies cancel where they hang on weak springs.
        const double size = std::abs(exact.energy), rounding = std::max(1e-6, c.tolerance) * size;
        for (const double part : {1e-2, 1e-4}) {
            const Outcome rough = ask(scale, part * size);
            const std::string where = std::string(c.name) + text(", scale ", scale, ", allowed ", part, ": ");
            ck_assert_msg(rough.energy >= exact.energy - rounding, "%sbelow the least energy", where.c_str());
            ck_assert_msg(rough.energy - exact.energy <= part * size + rounding, "%sabove by %.2e", where.c_str(),
                          (rough.energy - exact.energy) / size);
            ck_assert_msg(rough.error <= part * size, "%ssays %.2e", where.c_str(), rough.error / size);
            if (part > 1e-3) saved += exact.iterations - rough.iterations;
        }
    }
    std::printf("%s: %d iterations spared\n", c.name, static_cast<int>(saved));
    ck_assert_int_ge(saved, 0);
    zone = iterated.zone(scene.springs, scene.wanted, false);
    ck_assert_double_eq(solve(0.5).error, 0.0);
}

// While a front advances, a check of what has become softer mostly shows that nothing floats; and what floats is found.
TEST(floating_parts_are_found) {
    const unit::LayerCase c{.name = "", .dimension = 3, .layers = 4};
    const unit::LayerState scene(c, 1);
    const BodySystem bodies(scene.problem, {});
    JumpSystem system(bodies, bodies.transformed({}), {});
    Floating kept(bodies, system);
    const std::vector<std::uint8_t> held(scene.springs.stiffness.size(), 0);
    std::int64_t states = 0, afloat = 0;
    for (const double weak : {1.0, 1e-10, 0.0, 1.0})
        for (double front = 0.0; front < 0.13; front += 0.01, ++states) {
            std::vector<Zone::Coupling> couplings;
            std::size_t row = 0;
            for (const InterfaceGeometry& face : scene.problem.mesh->interfaces())
                for (const std::int64_t node : face.node_a) {
                    const double at = scene.problem.mesh->node(node)[0];
                    const double spring = (at < front ? weak : 1.0) * 1e12 * face.weight.front();
                    for (std::size_t k = 0; k < scene.dim && spring > 0.0; ++k)
                        couplings.push_back(
                            {static_cast<std::int64_t>(row + k), static_cast<std::int64_t>(row + k), spring});
                    row += scene.dim;
                }
            system.set(std::move(couplings), held);
            kept.update();
            Floating unused(bodies, system);
            unused.update();
            ck_assert_uint_eq(kept.free().size(), unused.free().size());
            ck_assert_uint_eq(kept.weak().size(), unused.weak().size());
            afloat += kept.free().size() + kept.weak().size() > 0 ? 1 : 0;
            // Nothing is held where all interfaces have separated, and all is where little has.
            if (front > 0.12 + 1e-9 && weak < 1e-3) ck_assert_uint_gt(kept.free().size() + kept.weak().size(), 0);
            if (front < 0.06) ck_assert_uint_eq(kept.free().size() + kept.weak().size(), 0);
        }
    std::printf("%d states, %d with floating parts: %d examinations\n", static_cast<int>(states),
                static_cast<int>(afloat), static_cast<int>(kept.examinations()));
    ck_assert(afloat > 0 && kept.examinations() < states / 2);
}

TEST(iterations_do_not_depend_on_the_stiffness) {
    for (const double stiffness : {1e9, 1e11, 1e13, 1e15, 1e17}) {
        unit::Flexure f;
        f.along = 400;
        f.through = 4;
        f.length = 0.4;
        f.law.normal_stiffness = f.law.tangential_stiffness = stiffness;
        const Problem problem = unit::make_flexure(f);
        Monitor monitor;
        Iterated iterated(problem, monitor);
        const std::int64_t most = most_iterations(iterated, problem, f);
        std::printf("k = %.0e: at most %d iterations, %d factorisations\n", stiffness, static_cast<int>(most),
                    static_cast<int>(iterated.factorisations()));
        ck_assert_int_le(most, 12);
    }
}

// The mean opening of an interface is prescribed: one row more, and no more entries of the matrix, nor iterations.
// Where a solve ends early, what it leaves open of jumps and forces is what it says, and not many times more.
LOOP_TEST(errors_are_estimated, 0, std::size(cases)) {
    const unit::LayerCase& c = cases[loop];
    const unit::LayerState scene(c, static_cast<unsigned>(loop) + 1U);
    Monitor monitor;
    Iterated exact(scene.problem, monitor);
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
        Problem problem = scene.problem;
        problem.options.linear_tolerance = tolerance;
        Iterated iterated(problem, monitor);
        for (const double x : {0.0, 0.06, 0.07, 0.075}) {
            const Springs springs = unit::advanced(scene, x);
            Response a, b;
            iterated.solve(springs, scene.theta, a);
            exact.solve(springs, scene.theta, b);
            if (!b.balanced) continue;
            double jump = 0.0, force = 0.0;
            for (std::size_t r = 0; r < a.jump.size(); ++r) {
                jump = std::max(jump, std::abs(a.jump[r] - b.jump[r]));
                if (springs.held[r] != 0) force = std::max(force, std::abs(a.force[r] - b.force[r]));
            }
            std::printf("%s, %g: jumps %.1e of %.1e, forces %.1e of %.1e\n", c.name, tolerance, jump, a.error.jump,
                        force, a.error.force);
            // The finer one has an error of its own.
            const double rounding = 1e-9, own_jump = b.error.jump + rounding * max_abs(b.jump),
                         own_force = b.error.force + rounding * max_abs(b.force);
            ck_assert(jump <= a.error.jump + own_jump && force <= a.error.force + own_force);
            // Without wide patches the forces of held rows are overestimated most: 2e4 times where a layer floats, and
            // up to 5e5 times where weak springs hold it: the correction, a rigid motion, is rounded to single
            // precision.
            const double most = c.tolerance > 1e-7 ? 2e6 : 1e5;
            ck_assert(a.error.jump <= 1e3 * jump + 1e3 * own_jump);
            ck_assert_msg(a.error.force <= most * force + 1e3 * own_force,
                          "%s, %g, front at %g: forces off by %.1e, %.1e estimated", c.name, tolerance, x, force,
                          a.error.force);
        }
    }
}

TEST(constraints_on_many_jumps_fill_nothing) {
    for (const std::int64_t along : {200, 400}) {
        unit::Flexure f;
        f.along = along;
        f.length = 1e-3 * static_cast<double>(along);
        const Problem plain = unit::make_flexure(f);
        Monitor monitor;
        Iterated without(plain, monitor);
        const std::int64_t a = most_iterations(without, plain, f);
        Problem problem = plain;
        unit::bind_opening(problem, unit::LayerCase::Opening::prescribed);
        Iterated with(problem, monitor);
        ck_assert(with.size().transformed == without.size().transformed);
        const std::int64_t b = most_iterations(with, problem, f);
        std::printf("%d pairs, %.0f entries: at most %d iterations, %d with a mean opening\n",
                    static_cast<int>(along) + 1, with.size().transformed, static_cast<int>(a), static_cast<int>(b));
        ck_assert_int_le(b, 12);
    }
}

// Held rows that a constraint on their jumps contradicts: the constraint is met, and the row that cannot be held says
// so. Contact refuses what no opening of pairs can mend.
TEST(constraints_come_before_held_rows) {
    const unit::LayerCase c{.name = "pressed", .opening = unit::LayerCase::Opening::prescribed};
    unit::LayerState scene(c, 3);
    Monitor monitor;
    unit::Reference condensed(scene.problem);
    Iterated iterated(scene.problem, monitor);
    const Constraint& mean = scene.problem.constraints.back();
    for (std::size_t r = 0; r < scene.springs.held.size(); r += scene.dim) scene.springs.held[r] = 1;
    for (JumpOperator* op : {static_cast<JumpOperator*>(&*condensed), static_cast<JumpOperator*>(&iterated)}) {
        Response response;
        op->solve(scene.springs, scene.theta, response);
        const std::vector<double> u = op->displacement(scene.theta, response);
        double opening = 0.0;
        std::size_t open = 0;
        for (std::size_t i = 0; i < mean.dof.size(); ++i) opening += mean.coefficient[i] * u[index(mean.dof[i])];
        for (std::size_t r = 0; r < scene.springs.held.size(); r += scene.dim)
            if (response.jump[r] != 0.0) {
                ++open;
                ck_assert(response.force[r] == 0.0);
                const double width = response.jump[r] * mean.coefficient[r];  // two displacements a pair
                ck_assert(std::abs(width - 1e-5) <= 1e-12 || std::abs(-width - 1e-5) <= 1e-12);
            }
        ck_assert_uint_eq(open, 1);
        ck_assert(std::abs(opening - 1e-5) <= 1e-12);

        ContactScene contact;
        contact.bonded.assign(scene.springs.held.size() / scene.dim, 0);
        contact.level.assign(contact.bonded.size(), 0);
        const std::vector<double> pressed{0.0, -1.0};
        std::vector<std::uint8_t> closed(contact.bonded.size(), 1);
        ck_assert_refused(DELAM_ERROR_PROBLEM, "",
                          solve_contact(*op, contact, scene.springs.stiffness, pressed, closed, response, false));
    }
}

// A search solves other states; the factor of the state that it came from is still there, with the same bits.
LOOP_TEST(comes_back_without_factoring, 0, std::size(cases)) {
    unit::LayerState scene(cases[loop], 7);
    for (const bool energetic : {true, false}) {
        scene.problem.options.solution = energetic ? "energetic" : "local";
        Monitor monitor;
        Iterated one(scene.problem, monitor), other(scene.problem, monitor);
        Response first, second, elsewhere;
        one.solve(unit::advanced(scene, 0.0), scene.theta, first);
        const std::vector<double> memory = one.memory();
        for (const double x : {0.08, 0.11}) {
            one.recall({});
            one.solve(unit::advanced(scene, x), scene.theta, elsewhere);
        }
        const std::int64_t factors = one.factorisations();
        ck_assert_int_ge(factors, 3);
        one.recall(memory);
        ck_assert_int_eq(one.factorisations(), energetic ? factors : factors + 1);
        ck_assert(one.memory() == memory);
        other.recall(memory);
        second = first;
        one.solve(unit::advanced(scene, 0.05), scene.theta, first);
        other.solve(unit::advanced(scene, 0.05), scene.theta, second);
        ck_assert(first.jump == second.jump && first.multipliers == second.multipliers);
        ck_assert(one.memory() == other.memory());
    }
}

// A curvature that is not finite has no sign: not converged, but not indefinite.
TEST(numbers_that_are_not_finite_are_not_negative) {
    for (const double curvature : {std::nan(""), -2.0}) {
        CgSystem system;
        system.apply = [=](std::span<const double> x, std::span<double> y) {
            y[0] = x[0];
            y[1] = curvature * x[1];
        };
        system.precondition = [](std::span<const double> r, std::span<double> z) { std::ranges::copy(r, z.begin()); };
        system.restart = [](std::span<double> x, std::span<double> r) {
            for (std::size_t i = 0; i < 2; ++i) r[i] = 1.0 - x[i];
        };
        system.size = [](std::span<const double>) { return 1.0; };
        system.rounding = [](std::span<const double>) { return 0.0; };
        system.confirm = [](std::span<const double>, std::span<const double>) { return false; };
        system.each_iteration = [](std::int64_t) {};
        std::vector<double> x(2, 0.0);
        const CgOutcome outcome = conjugate_gradients(system, x, 1e-12, 100);
        ck_assert(outcome.definite == std::isnan(curvature));
        ck_assert(!outcome.converged);
    }
}

TEST(tightens_at_request) {
    unit::LayerState scene(cases[1], 3);
    scene.problem.options.linear_tolerance = 0.1;
    Monitor monitor;
    Iterated iterated(scene.problem, monitor);
    Response first, second;
    for (const double x : {0.0, 0.06, 0.075}) {
        iterated.solve(unit::advanced(scene, x), scene.theta, first);
        second = first;
        ck_assert(iterated.aim(Accuracy::tight));
        iterated.solve(unit::advanced(scene, x), scene.theta, second);
        ck_assert(!iterated.aim(Accuracy::usual));
        ck_assert(second.converged && second.residual <= 1e-11);
        ck_assert(second.error.jump <= 1e-8 * max_abs(second.jump));
    }
    ck_assert(first.residual > 1e-10);
}
