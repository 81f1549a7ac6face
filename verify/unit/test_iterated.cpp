// SPDX-License-Identifier: BSD-3-Clause
// The iterated operator against the condensed one while a front advances: jumps, forces, energies; its iterations
// whatever the stiffness of the interfaces; its saved state; and contact where answers are only as good as a residual
// says.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "evolution/contact/contact.hpp"
#include "evolution/contact/contact_levels.hpp"
#include "layer_states.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/condensed/condensed.hpp"
#include "reduction/dense/dense_zone.hpp"
#include "reduction/dense/rigid_jumps.hpp"
#include "reduction/sparse/floating.hpp"
#include "reduction/sparse/iterated/conjugate_gradients.hpp"
#include "reduction/sparse/iterated/iterated.hpp"

// Last: its macro fail() would break delam::fail().
#include "quiet_check.hpp"

using namespace delam;

namespace {

constexpr unit::LayerCase cases[] = {
    {.name = "two layers", .dimension = 2, .layers = 2, .subdomains = 0, .stiffness = 125e9},
    {.name = "four layers", .dimension = 2, .layers = 4, .subdomains = 0, .stiffness = 125e9},
    {.name = "soft interface", .dimension = 2, .layers = 2, .subdomains = 0, .stiffness = 1e9},
    {.name = "stiff interface", .dimension = 2, .layers = 2, .subdomains = 0, .stiffness = 1e16},
    {.name = "space", .dimension = 3, .layers = 3, .subdomains = 0, .stiffness = 125e9},
    {.name = "a layer that floats", .dimension = 2, .layers = 3, .subdomains = 0, .stiffness = 125e9, .floating = true},
    {.name = "a layer that floats in space",
     .dimension = 3,
     .layers = 3,
     .subdomains = 0,
     .stiffness = 125e9,
     .floating = true},
    // The condensed operator loses more digits here than this one: its forces balance to 1e-6 only.
    {.name = "layers on weak springs",
     .dimension = 2,
     .layers = 3,
     .subdomains = 0,
     .stiffness = 1e6,
     .floating = true,
     .tolerance = 1e-4},
    {.name = "contact alone", .dimension = 2, .layers = 3, .subdomains = 0, .stiffness = 125e9, .touching = true},
    {.name = "dead forces, eigenstrains",
     .dimension = 2,
     .layers = 3,
     .subdomains = 0,
     .stiffness = 125e9,
     .loaded = true},
    {.name = "a clamped end in space",
     .dimension = 3,
     .layers = 2,
     .subdomains = 0,
     .stiffness = 125e9,
     .clamped = true},
    {.name = "mean opening",
     .dimension = 2,
     .layers = 3,
     .subdomains = 0,
     .stiffness = 125e9,
     .opening = unit::LayerCase::Opening::prescribed},
    {.name = "mean opening in space",
     .dimension = 3,
     .layers = 2,
     .subdomains = 0,
     .stiffness = 125e9,
     .opening = unit::LayerCase::Opening::prescribed},
    {.name = "two mean openings tied to each other",
     .dimension = 3,
     .layers = 3,
     .subdomains = 0,
     .stiffness = 125e9,
     .opening = unit::LayerCase::Opening::tied},
    {.name = "mean opening of a control node",
     .dimension = 2,
     .layers = 3,
     .subdomains = 0,
     .stiffness = 125e9,
     .opening = unit::LayerCase::Opening::control},
};

void expect_close(std::span<const double> a, std::span<const double> b, double tolerance, double size,
                  const std::string& what) {
    ck_assert_uint_eq(a.size(), b.size());
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - b[i]));
    std::printf("%s: off by %.2e of %.3g\n", what.c_str(), off, size);
    ck_assert_msg(off <= tolerance * size, "%s: off by %.2e of %.3g", what.c_str(), off, size);
}

// Without loads of its own, a part that only springs hold is in balance.
void expect_balance(const DenseMatrix& motions, const std::vector<double>& force, const std::string& where) {
    for (std::int64_t c = 0; c < motions.columns; ++c) {
        double sum = 0.0, size = 0.0;
        for (std::int64_t r = 0; r < motions.rows; ++r) {
            sum += motions(r, c) * force[index(r)];
            size += std::abs(motions(r, c) * force[index(r)]);
        }
        ck_assert_msg(std::abs(sum) <= 1e-5 * size, "%s, motion %d: %.2e of %.2e", where.c_str(), static_cast<int>(c),
                      sum, size);
    }
}

void expect_alike(const Response& a, const Response& b, double tolerance, const std::string& where) {
    expect_close(a.jump, b.jump, tolerance, max_abs(b.jump), where + ", jumps");
    expect_close(a.force, b.force, tolerance, max_abs(b.force), where + ", forces");
    expect_close(a.conjugate, b.conjugate, tolerance, max_abs(b.conjugate), where + ", conjugate forces");
    const double energies[] = {a.stored_bulk, a.load_potential}, others[] = {b.stored_bulk, b.load_potential};
    expect_close(energies, others, tolerance, std::max(max_abs(others), std::abs(dot(b.force, b.jump))),
                 where + ", energies");
}

// Answers that are off by this part of the largest, and say so.
class Disturbed final : public JumpOperator {
public:
    Disturbed(JumpOperator& op, double by, bool willing = false) : op_(op), by_(by), willing_(willing) {}
    bool aim(Accuracy accuracy) override {
        tight_ = accuracy == Accuracy::tight && willing_;
        return willing_;
    }
    void solve(const Springs& springs, std::span<const double> theta, Response& r) override {
        op_.solve(springs, theta, r);
        r.error = {};
        if (tight_) return;
        const double jump = by_ * max_abs(r.jump), force = by_ * max_abs(r.force);
        for (std::size_t i = 0; i < r.jump.size(); ++i) {
            seed_ = seed_ * 6364136223846793005u + 1442695040888963407u;
            const double way = (seed_ >> 63U) != 0 ? 1.0 : -1.0;
            (springs.held[i] != 0 ? r.force : r.jump)[i] += way * (springs.held[i] != 0 ? force : jump);
        }
        r.residual = by_;
        r.error = {4.0 * jump, 4.0 * force};
    }
    std::vector<double> reaction(std::span<const double> t, const Response& r) const override {
        return op_.reaction(t, r);
    }
    std::vector<double> displacement(std::span<const double> t, const Response& r) const override {
        return op_.displacement(t, r);
    }
    double equilibrium_defect(std::span<const double> t, const Response& r) const override {
        return op_.equilibrium_defect(t, r);
    }
    std::span<const std::uint8_t> prescribed_rows() const override { return op_.prescribed_rows(); }
    std::string description() const override { return op_.description(); }

private:
    JumpOperator& op_;
    double by_;
    bool willing_, tight_ = false;
    std::uint64_t seed_ = 1;
};

}  // namespace

START_TEST(answers_as_the_condensed_operator) {
    const unit::LayerCase& c = cases[_i];
    const unit::LayerState scene(c, static_cast<unsigned>(_i) + 1U);
    Monitor monitor;
    auto bulk = std::make_shared<Bulk>(scene.problem, monitor);
    bulk->condense(monitor);
    Condensed condensed(bulk, scene.problem, monitor);
    Iterated iterated(scene.problem, monitor);
    ck_assert(std::ranges::equal(condensed.prescribed_rows(), iterated.prescribed_rows()));
    const DenseMatrix motions = rigid_jumps(scene.problem);
    Response a, b;
    std::vector<double> theta = scene.theta;
    for (const double x : {0.0, 0.06, 0.07, 0.075}) {
        const std::string where = std::string(c.name) + ", front at " + std::to_string(x);
        for (double& t : theta) t *= 1.1;
        const Springs springs = unit::advanced(scene, x);
        condensed.solve(springs, theta, b);
        iterated.solve(springs, theta, a);
        ck_assert_int_eq(a.balanced, b.balanced);
        if (!b.balanced) continue;
        ck_assert_msg(a.converged && a.iterations <= 12, "%s: %d iterations, residual %.1e", where.c_str(),
                      static_cast<int>(a.iterations), a.residual);
        const double tolerance = c.tolerance > 1e-7 ? c.tolerance : 1e-8;  // 1e-7 is the default, for FETI
        if (c.floating) expect_balance(motions, a.force, where);
        expect_alike(a, b, tolerance, where);
        const std::vector<double> u = condensed.displacement(theta, b);
        expect_close(iterated.displacement(theta, a), u, tolerance, max_abs(u), where + ", displacements");
        const std::vector<double> rho = condensed.reaction(theta, b);
        expect_close(iterated.reaction(theta, a), rho, 10.0 * tolerance, max_abs(rho), where + ", reactions");
        ck_assert(iterated.equilibrium_defect(theta, a) <= 10.0 * tolerance * max_abs(rho));
    }
}
END_TEST

// The questions of Newton's method: minimisers with springs and held rows, and whether tangents leave a minimum at all.
START_TEST(zone_answers_as_the_dense_one) {
    const unit::LayerCase& c = cases[_i];
    unit::LayerState scene(c, static_cast<unsigned>(_i) + 1U);
    scene.problem.options.damage_tolerance = 1e-8;
    Monitor monitor;
    auto bulk = std::make_shared<Bulk>(scene.problem, monitor);
    bulk->condense(monitor);
    Condensed condensed(bulk, scene.problem, monitor);
    Iterated iterated(scene.problem, monitor);
    ck_assert(iterated.zones()->zone_traits().whole);
    Zone* dense = condensed.zone(scene.springs, scene.wanted, false);
    Zone* sparse = iterated.zone(scene.springs, scene.wanted, false);
    std::vector<unit::ZoneAnswer> a, b;
    const double tolerance = c.tolerance > 1e-7 ? c.tolerance : 1e-7;
    for (const double scale : {1.0, 0.3}) {
        a.push_back(unit::ask(*sparse, scene, scale));
        b.push_back(unit::ask(*dense, scene, scale));
        const std::string where = std::string(c.name) + ", scale " + std::to_string(scale);
        expect_close(a.back().jump, b.back().jump, tolerance, max_abs(b.back().jump), where + ", jumps");
        expect_close(a.back().force, b.back().force, tolerance, max_abs(b.back().force), where + ", forces");
    }
    // Each zone has an energy of its own up to a constant, and that of all bodies is the larger one.
    const double off = (a[1].energy - a[0].energy) - (b[1].energy - b[0].energy);
    const double size = std::max(std::abs(a[0].energy), std::abs(b[0].energy));
    ck_assert_msg(std::abs(off) <= 1e-8 * size, "%s: energies off by %.2e of %.3g", c.name, off, size);

    int indefinite = 0, definite = 0;
    // Along a motion in which a layer floats, tangents of any size leave no minimum.
    for (const double share :
         {-1e-15, -1e-12, -1e-10, -1e-8, -1e-6, -1e-4, -1e-3, -3e-3, -1e-2, -3e-2, -0.1, -0.3, -1.0, -3.0}) {
        const auto has_minimum = [&](Zone& zone, const std::vector<double>& theta) {
            std::vector<Zone::Coupling> couplings;
            std::vector<std::uint8_t> held(zone.jump_rows().size());
            for (std::size_t z = 0; z < held.size(); ++z) {
                const std::size_t r = index(zone.jump_rows()[z]);
                held[z] = scene.springs.held[r];
                const double s = scene.wanted[r] != 0 ? share * bulk->diagonal(0) : scene.springs.stiffness[r];
                const auto at = static_cast<std::int64_t>(z);
                if (held[z] == 0 && s != 0.0) couplings.push_back({at, at, s});
            }
            return zone.factor(couplings, held) && zone.solve(theta, {}).definite;
        };
        const bool expected = has_minimum(*dense, scene.theta);
        (expected ? definite : indefinite) += 1;
        ck_assert_msg(has_minimum(*sparse, scene.theta) == expected, "%s: with tangents of %g of the bodies", c.name,
                      share);
        // Rigid motions are checked whether or not a load acts on them.
        const std::vector<double> nothing(scene.theta.size(), 0.0);
        ck_assert_msg(!c.floating || has_minimum(*sparse, nothing) == expected, "%s: without load, tangents of %g",
                      c.name, share);
    }
    ck_assert(indefinite > 0 && (definite > 0 || c.floating));
}
END_TEST

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
START_TEST(a_model_leaves_a_part) {
    const unit::LayerCase& c = cases[_i];
    unit::LayerState scene(c, static_cast<unsigned>(_i) + 1U);
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
END_TEST

// Where only energies are asked for, they are too high by no more than what is allowed, and by about what is said; a
// request for energies ends with the next zone.
START_TEST(energies_within_what_is_allowed) {
    const unit::LayerCase& c = cases[_i];
    unit::LayerState scene(c, static_cast<unsigned>(_i) + 1U);
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
END_TEST

// While a front advances, a check of what has become softer mostly shows that nothing floats; and what floats is found.
START_TEST(floating_parts_are_found) {
    const unit::LayerCase c{.name = "", .dimension = 3, .layers = 4, .subdomains = 0, .stiffness = 125e9};
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
            Floating fresh(bodies, system);
            fresh.update();
            ck_assert_uint_eq(kept.free().size(), fresh.free().size());
            ck_assert_uint_eq(kept.weak().size(), fresh.weak().size());
            afloat += kept.free().size() + kept.weak().size() > 0 ? 1 : 0;
            // Nothing is held where all interfaces have separated, and all is where little has.
            if (front > 0.12 + 1e-9 && weak < 1e-3) ck_assert_uint_gt(kept.free().size() + kept.weak().size(), 0);
            if (front < 0.06) ck_assert_uint_eq(kept.free().size() + kept.weak().size(), 0);
        }
    std::printf("%d states, %d with floating parts: %d examinations\n", static_cast<int>(states),
                static_cast<int>(afloat), static_cast<int>(kept.examinations()));
    ck_assert(afloat > 0 && kept.examinations() < states / 2);
}
END_TEST

START_TEST(iterations_do_not_depend_on_the_stiffness) {
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
END_TEST

// The mean opening of an interface is prescribed: one row more, and no more entries of the matrix, nor iterations.
// Where a solve ends early, what it leaves open of jumps and forces is what it says, and not many times more.
START_TEST(errors_are_estimated) {
    const unit::LayerCase& c = cases[_i];
    const unit::LayerState scene(c, static_cast<unsigned>(_i) + 1U);
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
END_TEST

START_TEST(constraints_on_many_jumps_fill_nothing) {
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
END_TEST

// Held rows that a constraint on their jumps contradicts: the constraint is met, and the row that cannot be held says
// so. Contact refuses what no opening of pairs can mend.
START_TEST(constraints_come_before_held_rows) {
    const unit::LayerCase c{.name = "pressed",
                            .dimension = 2,
                            .layers = 2,
                            .subdomains = 0,
                            .stiffness = 125e9,
                            .opening = unit::LayerCase::Opening::prescribed};
    unit::LayerState scene(c, 3);
    Monitor monitor;
    auto bulk = std::make_shared<Bulk>(scene.problem, monitor);
    bulk->condense(monitor);
    Condensed condensed(bulk, scene.problem, monitor);
    Iterated iterated(scene.problem, monitor);
    const Constraint& mean = scene.problem.constraints.back();
    for (std::size_t r = 0; r < scene.springs.held.size(); r += scene.dim) scene.springs.held[r] = 1;
    for (JumpOperator* op : {static_cast<JumpOperator*>(&condensed), static_cast<JumpOperator*>(&iterated)}) {
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
        try {
            solve_contact(*op, contact, scene.springs.stiffness, pressed, closed, response, false);
            ck_abort_msg("%s: faces pass through each other", op->description().c_str());
        } catch (const Error& e) {
            std::printf("%s\n", e.what());
            ck_assert_int_eq(e.status(), DELAM_ERROR_PROBLEM);
        }
    }
}
END_TEST

START_TEST(continues_bit_for_bit) {
    const unit::LayerCase& c = cases[_i];
    const unit::LayerState scene(c, 7);
    Monitor monitor;
    Iterated one(scene.problem, monitor), other(scene.problem, monitor);
    Response first, second;
    for (const double x : {0.0, 0.05, 0.06}) one.solve(unit::advanced(scene, x), scene.theta, first);
    const std::vector<double> memory = one.memory();
    ck_assert(!memory.empty());
    other.require_memory(memory);
    other.recall(memory);
    second = first;
    for (const double x : {0.065, 0.08}) {
        one.solve(unit::advanced(scene, x), scene.theta, first);
        other.solve(unit::advanced(scene, x), scene.theta, second);
        ck_assert(first.jump == second.jump && first.force == second.force && first.multipliers == second.multipliers);
        ck_assert(first.stored_bulk == second.stored_bulk && first.iterations == second.iterations);
    }
    ck_assert(one.memory() == other.memory());
    for (const std::size_t damaged : {std::size_t{0}, memory.size() - 1}) {
        std::vector<double> wrong = memory;
        wrong[damaged] = -1.0;
        try {
            other.require_memory(wrong);
            ck_abort_msg("a damaged memory was taken");
        } catch (const Error& e) {
            ck_assert_int_eq(e.status(), DELAM_ERROR_SNAPSHOT);
        }
    }
}
END_TEST

// A search solves other states; the factor of the state that it came from is still there, with the same bits.
START_TEST(comes_back_without_factoring) {
    unit::LayerState scene(cases[_i], 7);
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
END_TEST

// A curvature that is not finite has no sign: not converged, but not indefinite.
START_TEST(numbers_that_are_not_finite_are_not_negative) {
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
END_TEST

START_TEST(contact_settles_on_answers_of_any_accuracy) {
    const unit::LayerCase c{.name = "contact", .dimension = 2, .layers = 3, .subdomains = 0, .stiffness = 125e9};
    const unit::LayerState scene(c, 3);
    Monitor monitor;
    auto bulk = std::make_shared<Bulk>(scene.problem, monitor);
    bulk->condense(monitor);
    Condensed condensed(bulk, scene.problem, monitor);
    ContactScene contact;
    contact.bonded.assign(scene.springs.held.size() / scene.dim, 0);
    contact.level.assign(contact.bonded.size(), 0);
    for (const double by : {1e-10, 1e-8, 1e-6}) {
        Disturbed disturbed(condensed, by);
        std::vector<std::uint8_t> closed(contact.bonded.size(), 0);
        Response response;
        const ContactResult result =
            solve_contact(disturbed, contact, scene.springs.stiffness, scene.theta, closed, response, false);
        std::printf("answers off by %.0e: %d active-set steps\n", by, static_cast<int>(result.solves));
        ck_assert(result.converged && result.solves <= 12);
    }
}
END_TEST

// Rows that such answers leave in doubt are solved again, and the contact sets are those of exact answers.
START_TEST(doubtful_contact_is_solved_again) {
    int wrong = 0;
    for (const unit::LayerCase& c : cases) {
        if (c.floating || c.touching || c.clamped || c.opening != unit::LayerCase::Opening::none) continue;
        const unit::LayerState scene(c, 3);
        Monitor monitor;
        auto bulk = std::make_shared<Bulk>(scene.problem, monitor);
        bulk->condense(monitor);
        Condensed condensed(bulk, scene.problem, monitor);
        ContactScene contact;
        contact.dimension = c.dimension;
        contact.bonded.assign(scene.springs.held.size() / scene.dim, 0);
        contact.level.assign(contact.bonded.size(), 0);
        const auto set_of = [&](JumpOperator& op, std::int64_t& doubts) {
            std::vector<std::uint8_t> closed(contact.bonded.size(), 0);
            Response response;
            const ContactResult result =
                solve_contact(op, contact, scene.springs.stiffness, scene.theta, closed, response, false);
            ck_assert(result.converged);
            doubts += result.doubts;
            return closed;
        };
        Disturbed stubborn(condensed, 1e-3), willing(condensed, 1e-3, true);
        std::int64_t none = 0, doubts = 0, solved = 0;
        const std::vector<std::uint8_t> exact = set_of(condensed, none);
        wrong += set_of(stubborn, doubts) != exact ? 1 : 0;
        ck_assert_msg(set_of(willing, solved) == exact, "%s: another contact set", c.name);
        std::printf("%s: %d doubts\n", c.name, static_cast<int>(doubts));
        ck_assert(none == 0 && solved >= 1 && doubts >= 1 && doubts <= 4);
    }
    ck_assert_msg(wrong > 0, "no decision was in doubt");
}
END_TEST

// A cold search solves roughly until its set seems right, and ends with the set, and the residual, of accurate solves.
START_TEST(first_contact_is_found_roughly) {
    std::int64_t rough = 0, accurate = 0;
    for (const unit::LayerCase& c : cases) {
        if (c.floating || c.touching || c.opening != unit::LayerCase::Opening::none) continue;
        const unit::LayerState scene(c, 3);
        Monitor monitor;
        auto bulk = std::make_shared<Bulk>(scene.problem, monitor);
        bulk->condense(monitor);
        Condensed condensed(bulk, scene.problem, monitor);
        Iterated first(scene.problem, monitor), second(scene.problem, monitor);
        Disturbed unable(second, 0.0);
        ContactScene contact;
        contact.dimension = c.dimension;
        contact.bonded.assign(scene.springs.held.size() / scene.dim, 0);
        contact.level = contact_levels(scene.problem.mesh->interfaces());
        const auto set_of = [&](JumpOperator& op, std::int64_t& iterations) {
            std::vector<std::uint8_t> closed(contact.bonded.size(), 0);
            Response response;
            const ContactResult result =
                solve_contact(op, contact, scene.springs.stiffness, scene.theta, closed, response, true);
            // Accurate solves end where rounding does, which differs among kernels of the BLAS; rough ones leave 1e-2.
            ck_assert_msg(result.converged && result.linear_residual <= 1e-9,
                          "%s: converged %d, residual %.1e, %.1e at worst", c.name, result.converged ? 1 : 0,
                          response.residual, result.linear_residual);
            iterations += result.linear_iterations;
            return closed;
        };
        std::int64_t none = 0;
        const std::vector<std::uint8_t> exact = set_of(condensed, none);
        ck_assert_msg(set_of(first, rough) == exact, "%s: another contact set", c.name);
        ck_assert_msg(set_of(unable, accurate) == exact, "%s: another contact set", c.name);
    }
    std::printf("cold: %d iterations, accurate in every solve: %d\n", static_cast<int>(rough),
                static_cast<int>(accurate));
    ck_assert_double_lt(static_cast<double>(rough), 0.9 * static_cast<double>(accurate));
}
END_TEST

START_TEST(tightens_at_request) {
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
END_TEST

int main() {
    Suite* suite = suite_create("iterated");
    TCase* tests = tcase_create("operator");
    tcase_add_loop_test(tests, answers_as_the_condensed_operator, 0, static_cast<int>(std::size(cases)));
    tcase_add_loop_test(tests, zone_answers_as_the_dense_one, 0, static_cast<int>(std::size(cases)));
    tcase_add_loop_test(tests, a_model_leaves_a_part, 0, static_cast<int>(std::size(cases)));
    tcase_add_loop_test(tests, energies_within_what_is_allowed, 0, static_cast<int>(std::size(cases)));
    tcase_add_test(tests, floating_parts_are_found);
    tcase_add_test(tests, iterations_do_not_depend_on_the_stiffness);
    tcase_add_loop_test(tests, errors_are_estimated, 0, static_cast<int>(std::size(cases)));
    tcase_add_test(tests, constraints_on_many_jumps_fill_nothing);
    tcase_add_test(tests, constraints_come_before_held_rows);
    tcase_add_loop_test(tests, continues_bit_for_bit, 0, static_cast<int>(std::size(cases)));
    tcase_add_loop_test(tests, comes_back_without_factoring, 0, static_cast<int>(std::size(cases)));
    tcase_add_test(tests, numbers_that_are_not_finite_are_not_negative);
    tcase_add_test(tests, contact_settles_on_answers_of_any_accuracy);
    tcase_add_test(tests, first_contact_is_found_roughly);
    tcase_add_test(tests, tightens_at_request);
    tcase_add_test(tests, doubtful_contact_is_solved_again);
    suite_add_tcase(suite, tests);
    SRunner* runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
