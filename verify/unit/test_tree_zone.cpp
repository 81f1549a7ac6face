// SPDX-License-Identifier: BSD-3-Clause
// Zones that are factored with the whole tree of superelements: the factor against dense algebra, the zone against a
// dense one of the same operator, and how little a change of few springs renews.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "check.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "random_dense.hpp"
#include "reduction/condensed/condensed.hpp"
#include "reduction/condensed/tree_factor.hpp"
#include "same_bits.hpp"
#include "scene/problem.hpp"

using namespace delam;
using namespace unit;

namespace {

// Four plies of `along` cells in plane strain, or a block of them in space, held at the left end; the other end of the
// uppermost ply is moved.
Problem laminate(int d, Index along) {
    std::vector<double> lengths{30.0, 4.0};
    std::vector<Index> divisions{along, 2};
    lengths.resize(at(d - 1));
    divisions.resize(at(d - 1));
    const std::vector<double> thickness(4, 1.0);
    const std::vector<Index> across(4, 1);
    auto mesh = std::make_shared<Mesh>(
        make_layers(d, lengths, divisions, thickness, across, d == 2 ? CellType::quad4 : CellType::hex8));
    for (std::int32_t i = 0; i < 3; ++i) add_interface(*mesh, i, i + 1, 1e-6);
    Problem problem(mesh);
    for (auto& material : problem.material) material = Elastic{1000.0, 0.3};
    problem.patterns.push_back({"lift", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::displacement});
    problem.patterns.push_back({"slide", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::displacement});
    for (Index n = 0; n < mesh->node_count(); ++n) {
        const auto place = mesh->node(n);
        if (place[0] == 0.0)
            for (Index k = 0; k < d; ++k) problem.constraints.push_back({{d * n + k}, {1.0}, {}});
        if (place[0] == 30.0 && place[at(d - 1)] == 4.0) {
            problem.constraints.push_back({{d * n + d - 1}, {1.0}, {0.1, 0.0}});
            problem.constraints.push_back({{d * n}, {1.0}, {0.0, -0.03}});
        }
    }
    return problem;
}

// Springs on the skeleton: all jumps have one; pairs of neighbouring rows are coupled.
struct Skeleton {
    std::vector<std::uint8_t> held;
    std::vector<double> spring;
    std::vector<Triplet> cross;
};

Skeleton random_springs(const Superelements& bodies, const TreeFactor& factor, Random& random) {
    const std::size_t n = bodies.variable().size();
    Skeleton s{std::vector<std::uint8_t>(n, 0), std::vector<double>(n, 0.0), {}};
    for (std::size_t p = 0; p < n; ++p) {
        const auto place = static_cast<Index>(p);
        if (bodies.kind(place) != Superelements::Kind::jump) continue;
        s.held[p] = random.one_in(4) ? 1 : 0;
        s.spring[p] = random.real(0.0, 300.0);
        if (p + 1 < n && bodies.kind(place + 1) == Superelements::Kind::jump &&
            factor.owner(place) == factor.owner(place + 1) && random.one_in(2))
            s.cross.push_back({place + 1, place, random.real(-30.0, 30.0)});
    }
    return s;
}

// All of it as a dense matrix in the places that are not held.
struct Dense {
    std::vector<Index> place;
    DenseMatrix matrix;
};

Dense dense_of(const Superelements& bodies, const Skeleton& s) {
    const std::size_t n = bodies.variable().size();
    Dense dense;
    for (std::size_t p = 0; p < n; ++p)
        if (s.held[p] == 0) dense.place.push_back(static_cast<Index>(p));
    const auto m = static_cast<Index>(dense.place.size());
    dense.matrix = DenseMatrix(m, m);
    const std::vector<std::uint8_t> all(n, 1);
    std::vector<Index> number(n, -1);
    for (Index j = 0; j < m; ++j) number[at(dense.place[at(j)])] = j;
    for (Index j = 0; j < m; ++j) {
        std::vector<double> unit(n, 0.0), image(n, 0.0);
        unit[at(dense.place[at(j)])] = 1.0;
        bodies.subtract_image(unit, all, image);
        for (Index i = 0; i < m; ++i) dense.matrix(i, j) = -image[at(dense.place[at(i)])];
        dense.matrix(j, j) += s.spring[at(dense.place[at(j)])];
    }
    for (const Triplet& t : s.cross) {
        const Index i = number[at(t.row)], j = number[at(t.column)];
        if (i < 0 || j < 0) continue;
        dense.matrix(i, j) += t.value;
        dense.matrix(j, i) += t.value;
    }
    return dense;
}

void expect_solves(TreeFactor& factor, const Superelements& bodies, const Skeleton& s, Random& random) {
    const std::size_t n = bodies.variable().size();
    Dense dense = dense_of(bodies, s);
    std::vector<double> b = random.vector(static_cast<Index>(n)), x(n), solution;
    for (const Index p : dense.place) solution.push_back(b[at(p)]);
    const std::vector<double> load = solution;
    ck_assert(factor_definite(dense.matrix));
    solve_lower(dense.matrix, solution);
    solve_lower_transposed(dense.matrix, solution);
    const double work = factor.solve(b, std::vector<std::uint8_t>(bodies.nodes().size(), 1), x);
    std::vector<double> free;
    for (const Index p : dense.place) free.push_back(x[at(p)]);
    expect_close(free, solution, 1e-9, "solution");
    ck_assert_double_eq_tol(work, dot(load, solution), 1e-10 * std::abs(dot(load, solution)));
    for (std::size_t p = 0; p < n; ++p) ck_assert(s.held[p] == 0 || x[p] == 0.0);

    std::vector<std::vector<std::pair<Index, double>>> forces;
    for (std::size_t k = 0; k < dense.place.size(); k += 7) {
        if (bodies.kind(dense.place[k]) != Superelements::Kind::jump) continue;
        forces.push_back({{dense.place[k], random.real()}});
        if (k + 1 < dense.place.size()) forces.back().emplace_back(dense.place[k + 1], random.real());
    }
    const DenseMatrix flexible = factor.flexibility(forces);
    DenseMatrix on(static_cast<Index>(dense.place.size()), flexible.rows);
    for (Index c = 0; c < on.columns; ++c)
        for (const auto& [p, value] : forces[at(c)])
            on(std::lower_bound(dense.place.begin(), dense.place.end(), p) - dense.place.begin(), c) += value;
    solve_lower(dense.matrix, on);
    expect_close(flexible.value, multiply_transposed(on, on).value, 1e-9, "flexibility");
}

constexpr const char* where_of[] = {"plane", "space"};

Problem of_loop(int loop) { return loop == 0 ? laminate(2, 90) : laminate(3, 16); }

}  // namespace

LOOP_TEST(the_factor_is_that_of_the_whole, 0, 2) {
    const Problem problem = of_loop(loop);
    Monitor monitor;
    Bulk bulk(problem, monitor);
    bulk.condense(monitor);
    const Superelements& bodies = bulk.superelements();
    ck_assert_msg(bodies.nodes().size() > 3, "%s: one piece", where_of[loop]);
    TreeFactor factor(bodies);
    Random random(3U + static_cast<unsigned>(loop));
    Skeleton s = random_springs(bodies, factor, random);
    for (int trial = 0; trial < 6; ++trial) {
        if (trial % 3 == 0) s = random_springs(bodies, factor, random);
        for (int k = 0; k < 5; ++k) {
            const auto p = at(random.below(static_cast<Index>(s.held.size())));
            if (bodies.kind(static_cast<Index>(p)) != Superelements::Kind::jump) continue;
            (random.one_in(2) ? s.held[p] ^= 1U : s.held[p]) &= 1U;
            s.spring[p] = random.real(0.0, 300.0);
        }
        ck_assert(factor.factor(s.held, s.spring, s.cross, {}));
        expect_solves(factor, bodies, s, random);
        // No digit of earlier factors and solves is left.
        TreeFactor unused(bodies);
        ck_assert(unused.factor(s.held, s.spring, s.cross, {}));
        const std::vector<std::uint8_t> all(bodies.nodes().size(), 1);
        const std::vector<double> b = random.vector(static_cast<Index>(s.held.size()));
        std::vector<double> x(b.size()), y(b.size());
        ck_assert(factor.solve(b, all, x) == unused.solve(b, all, y));
        ck_assert(same_bits(x, y));
    }
}

// A softening spring makes it indefinite where a dense factor says so, too, and what follows is not harmed.
LOOP_TEST(indefinite_springs_are_told, 0, 2) {
    const Problem problem = of_loop(loop);
    Monitor monitor;
    Bulk bulk(problem, monitor);
    bulk.condense(monitor);
    const Superelements& bodies = bulk.superelements();
    TreeFactor factor(bodies);
    Random random(11);
    const Skeleton s = random_springs(bodies, factor, random);
    int definite = 0, indefinite = 0;
    for (int trial = 0; trial < 12; ++trial) {
        Skeleton soft = s;
        for (std::size_t p = 0; p < soft.spring.size(); ++p)
            if (bodies.kind(static_cast<Index>(p)) == Superelements::Kind::jump && random.one_in(6))
                soft.spring[p] = (loop == 0 ? -60.0 : -6.0) * trial;
        Dense dense = dense_of(bodies, soft);
        const bool expected = factor_definite(dense.matrix);
        ck_assert_msg(factor.factor(soft.held, soft.spring, soft.cross, {}) == expected, "%s, trial %d", where_of[loop],
                      trial);
        if (expected) expect_solves(factor, bodies, soft, random);
        ++(expected ? definite : indefinite);
        ck_assert(factor.factor(s.held, s.spring, s.cross, {}));
        expect_solves(factor, bodies, s, random);
    }
    ck_assert_msg(definite > 1 && indefinite > 1, "%s: %d and %d", where_of[loop], definite, indefinite);
}

// One spring renews the fronts from its piece to the root, and nothing renews none.
TEST(few_springs_renew_few_fronts) {
    const Problem problem = laminate(2, 400);
    Monitor monitor;
    Bulk bulk(problem, monitor);
    bulk.condense(monitor);
    const Superelements& bodies = bulk.superelements();
    const auto nodes = static_cast<Index>(bodies.nodes().size());
    TreeFactor factor(bodies);
    Random random(5);
    Skeleton s = random_springs(bodies, factor, random);
    ck_assert(factor.factor(s.held, s.spring, s.cross, {}));
    ck_assert_int_eq(factor.fronts_made(), nodes);
    ck_assert(factor.factor(s.held, s.spring, s.cross, {}));
    ck_assert_int_eq(factor.fronts_made(), nodes);
    std::vector<Index> jumps, parent(bodies.nodes().size(), -1);
    for (Index n = 0; n < nodes; ++n)
        for (const Index child : bodies.nodes()[at(n)].children) parent[at(child)] = n;
    for (std::size_t p = 0; p < s.spring.size(); ++p)
        if (bodies.kind(static_cast<Index>(p)) == Superelements::Kind::jump && s.held[p] == 0)
            jumps.push_back(static_cast<Index>(p));
    Index most = 0;
    for (std::size_t k = 0; k < jumps.size(); k += 40) {
        const Index before = factor.fronts_made();
        s.spring[at(jumps[k])] += 1.0;
        ck_assert(factor.factor(s.held, s.spring, s.cross, {}));
        most = std::max(most, factor.fronts_made() - before);
        const std::array<Index, 1> one{jumps[k]};
        Index path = 0;
        for (Index n = factor.owner(jumps[k]); n >= 0; n = parent[at(n)]) ++path;
        ck_assert_int_eq(factor.fronts_made() - before, path);
        ck_assert_msg(factor.operations(one) < 0.4 * factor.operations(jumps), "%g of %g", factor.operations(one),
                      factor.operations(jumps));
    }
    ck_assert_msg(most >= 3 && 4 * most < nodes, "%ld of %ld fronts", static_cast<long>(most),
                  static_cast<long>(nodes));
}

namespace {

struct Operators {
    Problem tree_problem, dense_problem;
    Monitor monitor;
    std::unique_ptr<Condensed> tree, dense;

    explicit Operators(int loop) : tree_problem(of_loop(loop)), dense_problem(of_loop(loop)) {
        tree_problem.options.limits.zone_tree = 0.0;
        tree_problem.options.limits.zone_tree_least = 0.0;
        dense_problem.options.limits.zone_tree_least = 1e9;
        tree = make(tree_problem);
        dense = make(dense_problem);
    }
    std::unique_ptr<Condensed> make(const Problem& problem) {
        auto bulk = std::make_shared<Bulk>(problem, monitor);
        bulk->condense(monitor);
        return std::make_unique<Condensed>(bulk, problem, monitor);
    }
    std::size_t rows() const { return static_cast<std::size_t>(tree_problem.jump_count()); }
};

Springs random_state(const Operators& operators, Random& random) {
    const auto d = static_cast<std::size_t>(operators.tree_problem.mesh->dimension());
    Springs s{std::vector<double>(operators.rows()), std::vector<std::uint8_t>(operators.rows(), 0)};
    for (std::size_t r = 0; r < s.stiffness.size(); ++r) {
        s.stiffness[r] = random.one_in(3) ? 0.0 : random.real(0.0, 200.0);
        if (r % d == 0 && random.one_in(5)) s.held[r] = 1;
    }
    return s;
}

struct Answer {
    std::vector<double> jump, force;
    std::vector<double> energy;  // above that of the solution: where the zone is entered twice, and between these
};

Answer answer(Zone& zone, std::span<const double> theta, const std::array<Response, 2>& entered,
              const std::vector<Zone::Coupling>& couplings, const std::vector<std::uint8_t>& held,
              const std::vector<double>& row_force) {
    const std::vector<double> first = zone.unknowns_at(theta, entered[0]), second = zone.unknowns_at(theta, entered[1]);
    std::vector<double> between(first);
    for (std::size_t i = 0; i < between.size(); ++i) between[i] = 0.5 * (first[i] + second[i]);
    ck_assert(zone.factor(couplings, held));
    const Zone::Solution solution = zone.solve(theta, row_force);
    Answer found{zone.jumps(theta, solution.unknowns), row_force, {}};
    for (double& f : found.force) f = -f;
    for (const Zone::Coupling& c : couplings) found.force[at(c.row)] += c.value * found.jump[at(c.column)];
    zone.complete_forces(theta, solution, found.force);
    for (const std::vector<double>& unknowns : {first, second, between})
        found.energy.push_back(zone.energy_of(theta, unknowns) - zone.energy_of(theta, solution.unknowns));
    return found;
}

}  // namespace

// Responses of the operator, and all that a zone answers, with coupled tangents, forces of their own and contact sets.
LOOP_TEST(a_zone_answers_as_a_dense_one, 0, 2) {
    Operators operators(loop);
    Random random(23);
    const std::vector<double> theta{0.8, -0.5};
    const std::size_t d = loop == 0 ? 2 : 3;
    for (int trial = 0; trial < 5; ++trial) {
        const Springs springs = random_state(operators, random);
        std::vector<std::uint8_t> wanted(operators.rows(), 0);
        for (std::size_t r = 0; r + d <= wanted.size(); r += d)
            if (random.one_in(3)) std::fill_n(wanted.begin() + static_cast<std::ptrdiff_t>(r), d, std::uint8_t{1});
        Response by_tree, by_dense;
        operators.tree->solve(springs, theta, by_tree);
        operators.dense->solve(springs, theta, by_dense);
        expect_close(by_tree.jump, by_dense.jump, 1e-9, "jumps of the operator");
        expect_close(by_tree.force, by_dense.force, 1e-8, "forces of the operator");
        expect_close(by_tree.conjugate, by_dense.conjugate, 1e-9, "conjugate forces");
        ck_assert_double_eq_tol(by_tree.stored_bulk, by_dense.stored_bulk, 1e-9 * by_dense.stored_bulk);

        Zone *tree = operators.tree->zone(springs, wanted, false),
             *dense = operators.dense->zone(springs, wanted, false);
        ck_assert(dynamic_cast<DenseZone*>(tree) == nullptr && dynamic_cast<DenseZone*>(dense) != nullptr);
        ck_assert(tree->jump_rows() == dense->jump_rows());
        const std::size_t rows = tree->jump_rows().size();
        std::vector<Zone::Coupling> couplings;
        std::vector<std::uint8_t> held(rows, 0);
        std::vector<double> force(rows, 0.0);
        for (std::size_t r = 0; r < rows; ++r) {
            const auto row = at(tree->jump_rows()[r]);
            const auto i = static_cast<Index>(r);
            held[r] = row % d == 0 && random.one_in(4) ? 1 : 0;
            force[r] = random.real();
            couplings.push_back({i, i, random.real(40.0, 200.0)});
            if (row % d != 0 || r + 1 >= rows || at(tree->jump_rows()[r + 1]) != row + 1) continue;
            const double both = random.real(-30.0, 30.0);
            couplings.push_back({i, i + 1, both});
            couplings.push_back({i + 1, i, both});
        }
        // Where the zone is entered: after the solve of the operator, and from other jumps.
        Response moved = by_dense;
        for (double& j : moved.jump) j *= random.real(0.5, 1.5);
        const Answer of_tree = answer(*tree, theta, {by_tree, moved}, couplings, held, force),
                     of_dense = answer(*dense, theta, {by_dense, moved}, couplings, held, force);
        expect_close(of_tree.jump, of_dense.jump, 1e-9, "jumps");
        expect_close(of_tree.force, of_dense.force, 1e-8, "forces");
        expect_close(of_tree.energy, of_dense.energy, 1e-9, "energies");

        std::vector<std::vector<Zone::RowForce>> forces;
        for (std::size_t r = 0; r + 1 < rows; r += 5)
            forces.push_back({{static_cast<Index>(r), random.real()}, {static_cast<Index>(r + 1), random.real()}});
        ck_assert(tree->factor(couplings, held) && dense->factor(couplings, held));
        expect_close(tree->flexibility(forces)->value, dense->flexibility(forces)->value, 1e-9, "flexibility");
        for (Zone::Coupling& c : couplings)
            if (c.row == c.column) c.value = -1e4;
        ck_assert(!tree->factor(couplings, held) && !dense->factor(couplings, held));
    }
}

// A saved memory continues with the same bits.
TEST(memory_continues_with_the_same_bits) {
    Operators one(0), other(0);
    Random random(31);
    const std::vector<double> theta{1.0, 0.2};
    Response response;
    for (int k = 0; k < 3; ++k) one.tree->solve(random_state(one, random), theta, response);
    const std::vector<double> memory = one.tree->memory();
    other.tree->recall(memory);
    for (int k = 0; k < 3; ++k) {
        const Springs next = random_state(one, random);
        Response a, b;
        one.tree->solve(next, theta, a);
        other.tree->solve(next, theta, b);
        ck_assert(same_bits(a.jump, b.jump));
        ck_assert(same_bits(a.force, b.force));
    }
}
