// SPDX-License-Identifier: BSD-3-Clause
// The bodies solved by an engine of the host: energies of combinations, whole analyses against the condensed operator,
// states that the engine keeps no longer, what an engine does wrong.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "check.hpp"
#include "evolution/analysis/solver.hpp"
#include "evolution/observe/fields.hpp"
#include "layer_states.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "reduction/condensed/condensed.hpp"
#include "reduction/sparse/engine/engine_operator.hpp"
#include "refused.hpp"
#include "serial_engine.hpp"

using namespace delam;

namespace {

using unit::Engined;
using unit::expect_close;

}  // namespace

// A state that the engine keeps no longer is found again with one more factor.
TEST(one_factor_for_a_forgotten_state) {
    const unit::LayerState scene(unit::layer_cases[0], 1);
    Engined engined(scene.problem);
    Monitor monitor;
    EngineOperator op(engined.problem, monitor);
    Response first, other;
    op.solve(scene.springs, scene.theta, first);
    std::vector<double> theta = scene.theta;
    for (int i = 0; i < 12; ++i) {
        for (double& t : theta) t *= 1.01;
        op.solve(scene.springs, theta, other);
    }
    const int renewed = engined.engine.renewed;
    (void)op.displacement(scene.theta, first);
    ck_assert_int_eq(engined.engine.renewed, renewed + 1);
}

// The energy on the way between two solutions is a parabola; its middle is known from the bodies' displacements.
TEST(energy_of_combinations) {
    const unit::LayerState scene(unit::layer_cases[4], 7);
    Engined engined(scene.problem);
    Monitor monitor;
    EngineOperator op(engined.problem, monitor);
    Zone& zone = *op.zone(scene.springs, scene.wanted, false);
    std::vector<Zone::Solution> ends;
    for (const double scale : {1.0, 0.2}) {
        std::vector<Zone::Coupling> couplings;
        for (std::size_t r = 0; r < scene.springs.stiffness.size(); ++r)
            if (scene.springs.stiffness[r] > 0.0)
                couplings.push_back({static_cast<std::int64_t>(r), static_cast<std::int64_t>(r),
                                     (scene.wanted[r] != 0 ? scale : 1.0) * scene.springs.stiffness[r]});
        ck_assert(zone.factor(couplings, std::vector<std::uint8_t>(scene.springs.held.size(), 0)));
        ends.push_back(zone.solve(scene.theta, {}));
    }
    const auto energy = [&](double s) {
        std::vector<double> x(ends[0].unknowns.size());
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = (1.0 - s) * ends[0].unknowns[i] + s * ends[1].unknowns[i];
        Response response;
        zone.keep(x, response);
        const std::vector<double> u = op.displacement(scene.theta, response);
        std::vector<double> stressed(u.size());
        multiply(BodySystem(scene.problem, {}).stiffness(), u, stressed);
        const double exact = 0.5 * dot(u, stressed);
        expect_close(std::vector<double>{zone.energy_of(scene.theta, x)}, std::vector<double>{exact}, 1e-10, exact,
                     "energy at " + std::to_string(s));
        return exact;
    };
    const double first = energy(0.0), middle = energy(0.5), last = energy(1.0), quarter = energy(0.25);
    expect_close(std::vector<double>{quarter}, std::vector<double>{0.375 * first + 0.75 * middle - 0.125 * last}, 1e-10,
                 first, "parabola");
}

namespace {

struct Analysis {
    const char* name;
    int dimension;
    const char *solution, *mixity_rule;
    double tangential;  // toughness over the normal one
    std::size_t layers;
    double brittle;  // onset over the toughness
};
constexpr Analysis analyses[] = {
    {"ductile", 2, "local", "frozen", 1.0, 2, 0.4},
    {"ductile in space", 3, "local", "frozen", 1.0, 2, 0.4},
    {"three layers, mixed mode", 2, "local", "frozen", 2.5, 3, 0.4},
    {"converged mixity", 2, "local", "converged", 2.5, 2, 0.4},
    {"variational", 2, "local", "variational", 1.2, 2, 0.5},
    {"brittle, local", 2, "local", "frozen", 1.0, 2, 1.0},
    {"brittle, energetic", 2, "energetic", "frozen", 1.0, 2, 1.0},
};

Problem analysis_of(const Analysis& m) {
    unit::Flexure f;
    f.dimension = m.dimension;
    f.layers = m.layers;
    f.along = m.dimension == 2 ? 60 : 30;
    f.across = 3;
    f.through = 2;
    f.law.normal_onset = m.brittle * f.law.normal_toughness;
    f.law.tangential_toughness = m.tangential * f.law.normal_toughness;
    f.law.tangential_onset = m.brittle * f.law.tangential_toughness;
    Problem problem = unit::make_flexure(f);
    problem.options.solution = m.solution;
    problem.options.mixity_rule = m.mixity_rule;
    problem.options.damage_tolerance = 1e-7;
    return problem;
}

}  // namespace

LOOP_TEST(analyses_as_without_an_engine, 0, std::size(analyses)) {
    const Analysis& m = analyses[loop];
    Problem plain = analysis_of(m);
    Engined engined(plain);
    plain.options.reduction = "condensed";
    plain.options.step_control = "fixed";  // as it is with an engine
    Monitor monitor;
    Solver a(plain, monitor, 0.0), b(engined.problem, monitor, 0.0);
    std::int64_t broken = 0;
    for (int step = 1; step <= 8; ++step) {
        const double time = 0.125 * step;
        const std::string where = std::string(m.name) + ", step " + std::to_string(step);
        ck_assert_int_eq(a.advance(time).status, DELAM_OK);
        const Outcome outcome = b.advance(time);
        ck_assert_msg(outcome.status == DELAM_OK, "%s: %s", where.c_str(), outcome.text.c_str());
        a.commit();
        b.commit();
        const State &s = a.states().committed(), &t = b.states().committed();
        expect_close(t.adhesion, s.adhesion, 1e-4, 1.0, where + ", adhesion");
        const double energies[] = {s.ledger.stored_bulk, s.ledger.dissipated},
                     others[] = {t.ledger.stored_bulk, t.ledger.dissipated};
        // The variational rule leaves as much of energies with the library's own iteration, too.
        const double allowed = m.mixity_rule == std::string("variational") ? 2e-5 : 1e-6;
        expect_close(others, energies, allowed, max_abs(energies), where + ", energies");
        ck_assert_msg(t.closed == s.closed, "%s: contact", where.c_str());
        const std::vector<double> u = a.observer().displacement();
        expect_close(b.observer().displacement(), u, allowed, max_abs(u), where + ", displacements");
        broken = std::count_if(t.adhesion.begin(), t.adhesion.end(), [](double z) { return z < 1.0; });
    }
    const std::vector<double> k = a.tangent(), other = b.tangent();
    expect_close(other, k, 2e-5, max_abs(k), std::string(m.name) + ", tangent");
    std::printf("%s: %d pairs damaged; %d solves, %d factors, %d recoveries\n", m.name, static_cast<int>(broken),
                engined.engine.solved, engined.engine.renewed, engined.engine.recovered);
    ck_assert_int_gt(broken, 0);
}

namespace {

// The problem without its cells and without the nodes that neither interfaces nor loads need, and the stiffness that an
// engine has for it.
std::pair<Problem, SparseMatrix> skeleton_of(const Problem& whole) {
    const Mesh& mesh = *whole.mesh;
    const std::int64_t dim = mesh.dimension();
    std::vector<std::uint8_t> needed(index(mesh.node_count()), 0);
    for (const InterfaceGeometry& face : mesh.interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            needed[index(face.node_a[p])] = needed[index(face.node_b[p])] = 1;
    for (const Constraint& c : whole.constraints)
        for (const std::int64_t dof : c.dof) needed[index(dof / dim)] = 1;
    std::vector<std::int64_t> place(needed.size()), bodies;
    std::int64_t count = 0;
    for (const int wanted : {1, 0})
        for (std::size_t node = 0; node < needed.size(); ++node)
            if (needed[node] == wanted) place[node] = count++;
    const std::int64_t kept = std::count(needed.begin(), needed.end(), 1);
    std::vector<double> places(index(kept * dim));
    for (std::size_t node = 0; node < needed.size(); ++node)
        for (std::size_t k = 0; k < index(dim) && needed[node] != 0; ++k)
            places[index(place[node] * dim) + k] = mesh.node(static_cast<std::int64_t>(node))[k];
    auto own = std::make_shared<Mesh>(mesh.dimension(), places);
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        std::vector<std::int64_t> nodes;
        for (const std::int64_t node : mesh.body_nodes(body))
            if (needed[index(node)] != 0) nodes.push_back(place[index(node)]);
        own->add_host_body(mesh.body_label(body), nodes);
    }
    for (const InterfaceGeometry& face : mesh.interfaces()) {
        std::vector<std::int64_t> a, b;
        std::vector<double> normals;
        for (std::size_t p = 0; p < face.node_a.size(); ++p) {
            a.push_back(place[index(face.node_a[p])]);
            b.push_back(place[index(face.node_b[p])]);
            for (std::size_t k = 0; k < index(dim); ++k) normals.push_back(face.frame[p * index(dim * dim) + k]);
        }
        add_pairs(*own, mesh.body_label(face.body_a), mesh.body_label(face.body_b), a, b, normals, face.weight, 0, {});
    }
    Problem problem(own);
    problem.plane = whole.plane;
    problem.patterns = whole.patterns;
    problem.options = whole.options;
    for (std::size_t i = 0; i < whole.interfaces.size(); ++i) problem.interfaces[i] = whole.interfaces[i];
    for (Constraint c : whole.constraints) {
        for (std::int64_t& dof : c.dof) dof = place[index(dof / dim)] * dim + dof % dim;
        problem.constraints.push_back(std::move(c));
    }
    const SparseMatrix k = BodySystem(whole, {}).stiffness();
    std::vector<Triplet> entries;
    const auto moved = [&](std::int64_t dof) { return place[index(dof / dim)] * dim + dof % dim; };
    for (std::int64_t r = 0; r < k.rows; ++r)
        for (std::int64_t e = k.start[index(r)]; e < k.start[index(r) + 1]; ++e)
            entries.push_back({moved(r), moved(k.column[index(e)]), k.value[index(e)]});
    return {std::move(problem), from_triplets(k.rows, k.columns, std::move(entries))};
}

}  // namespace

// The library knows the interfaces alone, of bodies that float once they have come off.
LOOP_TEST(bodies_that_only_the_engine_knows, 0, 3) {
    const Analysis& m = analyses[loop];
    Problem plain = analysis_of(m);
    plain.options.reduction = "condensed";
    auto [problem, stiffness] = skeleton_of(analysis_of(m));
    unit::SerialEngine engine(std::move(stiffness));
    problem.engine = std::make_shared<Engine>(engine.functions());
    ck_assert_int_lt(problem.mesh->node_count(), plain.mesh->node_count());
    Monitor monitor;
    Solver a(plain, monitor, 0.0), b(problem, monitor, 0.0);
    for (int step = 1; step <= 6; ++step) {
        const std::string where = std::string(m.name) + ", skeleton, step " + std::to_string(step);
        for (Solver* solver : {&a, &b}) {
            ck_assert_int_eq(solver->advance(0.15 * step).status, DELAM_OK);
            solver->commit();
        }
        expect_close(b.states().committed().adhesion, a.states().committed().adhesion, 1e-4, 1.0, where + ", adhesion");
        const std::vector<double> rho = field(a.observer(), "reaction", -1);
        expect_close(field(b.observer(), "reaction", -1), rho, 1e-6, max_abs(rho), where + ", reactions");
    }
}

// All pairs bonded: the variables that the library knows are zero at any load, and say nothing about a state.
TEST(states_without_jumps) {
    const unit::LayerState scene(unit::layer_cases[0], 3);
    Engined engined(scene.problem);
    Monitor monitor;
    EngineOperator op(engined.problem, monitor);
    Springs springs = scene.springs;
    std::fill(springs.held.begin(), springs.held.end(), std::uint8_t{1});
    Response first, other;
    op.solve(springs, scene.theta, first);
    const std::vector<double> u = op.displacement(scene.theta, first);
    std::vector<double> theta = scene.theta;
    for (int i = 0; i < 12; ++i) {
        for (double& t : theta) t *= 1.3;
        op.solve(springs, theta, other);
    }
    expect_close(op.displacement(scene.theta, first), u, 1e-9, max_abs(u), "a bonded state, found again");
}

// Two forces that balance each other on a part that nothing holds: each does work along the motion that is taken out.
TEST(forces_on_a_part_that_floats) {
    unit::LayerState scene(unit::layer_cases[5], 5);
    std::fill(scene.springs.stiffness.begin(), scene.springs.stiffness.end(), 0.0);
    std::fill(scene.springs.held.begin(), scene.springs.held.end(), std::uint8_t{0});
    const std::int64_t dof = 2 * (scene.problem.mesh->node_count() - 1);
    for (const double value : {1e3, -1e3}) {
        const std::string name = value > 0.0 ? "there" : "back";
        scene.problem.patterns.push_back({name, {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::force});
        scene.problem.forces.push_back({static_cast<std::int64_t>(scene.problem.patterns.size()) - 1, dof, value});
        scene.theta.push_back(1.0);
    }
    Engined engined(scene.problem);
    Monitor monitor;
    EngineOperator op(engined.problem, monitor);
    Response response;
    op.solve(scene.springs, scene.theta, response);
    ck_assert(response.balanced);
    const std::vector<double> u = op.displacement(scene.theta, response);
    const double exact = -1e3 * u[index(dof)];
    expect_close(std::vector<double>{response.conjugate[scene.theta.size() - 2]}, std::vector<double>{exact}, 1e-9,
                 std::max(std::abs(exact), 1e3 * max_abs(u)), "conjugate of a force");
}

// Two solvers of one problem take turns: the engine has room for the variables of one of them.
TEST(solvers_take_turns) {
    const Problem plain = analysis_of(analyses[0]);
    Engined engined(plain);
    Monitor monitor;
    {
        Solver alone(engined.problem, monitor, 0.0);
        Solver one(engined.problem, monitor, 0.0), two(engined.problem, monitor, 0.0);
        for (int step = 1; step <= 6; ++step) {
            for (Solver* solver : {&alone, &one, &two}) {
                ck_assert_int_eq(solver->advance(0.15 * step).status, DELAM_OK);
                solver->commit();
            }
            expect_close(one.states().committed().adhesion, two.states().committed().adhesion, 1e-6, 1.0,
                         "two solvers");
        }
        ck_assert_int_ge(engined.engine.prepared, 18);
        const std::vector<double> u = one.observer().displacement();
        expect_close(two.observer().displacement(), u, 1e-6, max_abs(u), "displacements of two solvers");
    }
    engined.problem.engine.reset();
    ck_assert_int_eq(engined.engine.released, 1);
}

TEST(failures_and_cancellation) {
    Engined engined(analysis_of(analyses[0]));
    Monitor monitor;
    Solver solver(engined.problem, monitor, 0.0);
    ck_assert_int_eq(solver.advance(0.5).status, DELAM_OK);
    solver.commit();
    const std::vector<double> adhesion = solver.states().committed().adhesion;
    engined.engine.fails = DELAM_ERROR_MEMORY;
    ck_assert_refused(DELAM_ERROR_MEMORY, "engine: solve: as asked", solver.advance(0.9));
    monitor.progress_callback = [](const char* stage, std::int64_t, std::int64_t, void*) {
        return std::string(stage) == "linear solve" ? 1 : 0;
    };
    ck_assert_refused(DELAM_CANCELLED, "", solver.advance(0.9));
    monitor.progress_callback = nullptr;
    ck_assert(solver.states().committed().adhesion == adhesion);
    Problem plain = analysis_of(analyses[0]);
    Solver other(plain, monitor, 0.0);
    for (const double time : {0.5, 0.9}) {
        ck_assert_int_eq(other.advance(time).status, DELAM_OK);
        other.commit();
    }
    ck_assert_int_eq(solver.advance(0.9).status, DELAM_OK);
    solver.commit();
    expect_close(solver.states().committed().adhesion, other.states().committed().adhesion, 2e-5, 1.0,
                 "after a failure");

    delam_experimental_engine wrong = engined.engine.functions();
    wrong.kept = 3;
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "", Engine(wrong));
    engined.problem.options.reduction = "feti";
    ck_assert_refused(DELAM_ERROR_PROBLEM, "", Solver(engined.problem, monitor, 0.0));
}
