// SPDX-License-Identifier: BSD-3-Clause
// The tree of superelements against the whole, factored at once with its jumps last: the same Schur complement, the
// same minimisers, the same digits whatever was eliminated before.
#include <cmath>
#include <random>
#include <set>

#include "base/monitor.hpp"
#include "base/numbers.hpp"
#include "check.hpp"
#include "flexure.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "reduction/condensed/bulk.hpp"
#include "same_bits.hpp"

using namespace delam;

namespace {

struct Case {
    const char* name;
    unit::Flexure flexure;
    int edit;  // 1: the support becomes a long mean; 2: half of one layer is of another material
};

std::vector<Case> cases() {
    std::vector<Case> all;
    unit::Flexure beam;
    beam.along = 200;
    beam.through = 2;
    all.push_back({"beam", beam, 0});
    unit::Flexure stack = beam;
    stack.layers = 5;
    stack.through = 1;
    stack.thickness = 1e-3;
    stack.press = 2e-3;
    all.push_back({"stack", stack, 0});
    unit::Flexure plate;
    plate.dimension = 3;
    plate.along = 80;
    plate.across = 2;
    plate.through = 1;
    all.push_back({"plate", plate, 0});
    unit::Flexure one;
    one.along = 12;
    one.through = 3;
    all.push_back({"one leaf", one, 0});
    all.push_back({"mean", beam, 1});
    all.push_back({"control node and mean", beam, 1});
    all.back().flexure.control = true;
    return all;
}

Problem problem_of(const Case& c) {
    Problem problem = unit::make_flexure(c.flexure);
    if (c.edit != 1) return problem;
    // The mean of the vertical displacement of 40 nodes of the top face follows the second pattern.
    const Mesh& mesh = *problem.mesh;
    double top = 0.0;
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) top = std::max(top, mesh.node(n)[1]);
    Constraint mean;
    for (std::int64_t n = 0; n < mesh.node_count() && mean.dof.size() < 40; ++n)
        if (mesh.node(n)[1] > top - 1e-9 && mesh.node(n)[0] > 0.01 && mesh.node(n)[0] < 0.05) {
            mean.dof.push_back(2 * n + 1);
            mean.coefficient.push_back(1.0 / 40.0);
        }
    mean.prescribed.assign(problem.patterns.size(), 0.0);
    mean.prescribed[0] = -1e-4;
    if (c.flexure.control) {
        mean.dof.push_back(2 * (mesh.node_count() - 1) + 1);
        mean.coefficient.push_back(-1.0);
        problem.constraints.push_back({{2 * (mesh.node_count() - 1)}, {1.0}, {}});
    }
    problem.constraints.push_back(mean);
    return problem;
}

double largest(const DenseMatrix& a) { return max_abs(a.value); }

// S of [kept displacements | jumps] from one factor of everything.
DenseMatrix whole_schur(const Bulk& bulk, const SparseMatrix& transformed) {
    SparseMatrix m = transformed;
    const std::int64_t trailing = bulk.system().variables().trailing(), leading = m.rows - trailing;
    std::vector<double> shift(index(trailing), 0.0);
    for (std::int64_t t = 0; t < trailing; ++t)
        for (std::int64_t e = m.start[index(leading + t)]; e < m.start[index(leading + t) + 1]; ++e)
            if (m.column[index(e)] == leading + t) {
                shift[index(t)] = std::max(m.value[index(e)], 1e9);
                m.value[index(e)] += shift[index(t)];
            }
    SparseCholesky factor(m, trailing);
    ck_assert(factor.factorise(m));
    DenseMatrix s = lower_times_transpose(factor.trailing_factor());
    for (std::int64_t t = 0; t < trailing; ++t) s(t, t) -= shift[index(t)];
    return s;
}

// States of the places: springs, held rows and zones at random, in runs as a front makes them. Zones are anywhere, or
// on a few neighbouring jumps.
std::vector<double> random_states(const Superelements& bodies, std::mt19937& random, bool anywhere) {
    std::vector<double> state(bodies.variable().size(), 0.0);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    double now = 1e10;
    for (std::size_t p = 0; p < state.size(); ++p) {
        if (bodies.kind(static_cast<std::int64_t>(p)) != Superelements::Kind::jump) continue;
        if (const double dice = number(random); dice < 0.02)
            now = Elimination::in_zone;
        else if (dice < 0.05)
            now = Elimination::held;
        else if (dice < 0.1)
            now = 1e10 * number(random);
        state[p] = now;
    }
    if (anywhere) return state;
    const std::size_t first = random() % state.size(), last = first + state.size() / 12;
    for (std::size_t p = 0; p < state.size(); ++p)
        if (bodies.kind(static_cast<std::int64_t>(p)) == Superelements::Kind::jump &&
            (state[p] == Elimination::in_zone) != (p >= first && p < last))
            state[p] = p >= first && p < last ? Elimination::in_zone : 1e9;
    return state;
}

}  // namespace

// Each variable has one owner, and no entry couples two subtrees past their common ancestors.
LOOP_TEST(the_tree_separates, 0, cases().size()) {
    const Case c = cases()[index(loop)];
    const Problem problem = problem_of(c);
    Monitor monitor;
    const Bulk bulk(problem, monitor);
    const SparseMatrix& a = bulk.transformed();
    const JumpVariables& variables = bulk.system().variables();
    const SuperelementTree tree = cut_into_superelements(a, variables, variable_points(problem, variables));
    const auto nodes = static_cast<std::int64_t>(tree.node.size());
    ck_assert_msg((nodes > 1) == (std::string(c.name) != "one leaf"), "%s: %ld nodes", c.name,
                  static_cast<long>(nodes));
    std::vector<std::int64_t> owner(index(variables.count()), -1), parent(index(nodes), -1);
    for (std::int64_t n = 0; n < nodes; ++n) {
        const Superelement& node = tree.node[index(n)];
        for (const std::int64_t child : node.children) {
            ck_assert(child < n && parent[index(child)] == -1);
            parent[index(child)] = n;
        }
        for (const auto* own : {&node.inside, &node.jumps})
            for (const std::int64_t v : *own) {
                ck_assert_int_eq(owner[index(v)], -1);
                owner[index(v)] = n;
            }
    }
    for (std::int64_t v = 0; v < variables.count(); ++v)
        ck_assert((owner[index(v)] == -1) == (v >= variables.leading && v < variables.leading + variables.kept));
    std::set<std::int64_t> places(tree.position.begin(), tree.position.end());
    ck_assert_int_eq(static_cast<std::int64_t>(places.size()), variables.count());
    for (std::int64_t v = 0; v < variables.count(); ++v)
        for (std::int64_t e = a.start[index(v)]; e < a.start[index(v) + 1]; ++e) {
            const std::int64_t w = a.column[index(e)];
            std::int64_t low = owner[index(v)];
            const std::int64_t high = owner[index(w)];
            if (low < 0 || (high >= 0 && high < low)) continue;
            // On the way up from v, every node below the owner of w has w on its border.
            for (; low != high && low >= 0; low = parent[index(low)]) {
                const auto& border = tree.node[index(low)].border;
                ck_assert_msg(std::find(border.begin(), border.end(), w) != border.end(),
                              "%s: variable %ld is missing on a border", c.name, static_cast<long>(w));
            }
            ck_assert(low == high);
        }
}

LOOP_TEST(all_jumps_have_the_schur_complement_of_the_whole, 0, cases().size()) {
    const Case c = cases()[index(loop)];
    const Problem problem = problem_of(c);
    Monitor monitor;
    Bulk bulk(problem, monitor);
    const SparseMatrix transformed = bulk.transformed();
    const DenseMatrix s = whole_schur(bulk, transformed);
    bulk.condense(monitor);
    Elimination whole = bulk.elimination();
    std::vector<double> state(bulk.superelements().variable().size(), 0.0);
    for (std::size_t p = 0; p < state.size(); ++p)
        if (bulk.superelements().kind(static_cast<std::int64_t>(p)) == Superelements::Kind::jump)
            state[p] = Elimination::in_zone;
    whole.update(state, {});
    ck_assert_int_eq(whole.energy().rows(), bulk.system().variables().trailing());
    double error = 0.0;
    const std::int64_t leading = transformed.rows - bulk.system().variables().trailing();
    for (std::int64_t j = 0; j < s.columns; ++j)
        for (std::int64_t i = 0; i < s.rows; ++i) {
            const auto at = [&](std::int64_t k) {
                return bulk.superelements().variable()[index(whole.places()[index(k)])] - leading;
            };
            error = std::max(error, std::abs(whole.energy().stiffness(i, j) - s(at(i), at(j))));
        }
    ck_assert_msg(error < 1e-12 * largest(s), "%s: %g of %g", c.name, error, largest(s));
}

// Condensed further, the energy of all jumps gives the energy of a zone, and the minimiser of all else.
LOOP_TEST(zones_are_those_of_the_dense_energy, 0, cases().size()) {
    const Case c = cases()[index(loop)];
    const Problem problem = problem_of(c);
    Monitor monitor;
    Bulk bulk(problem, monitor);
    bulk.condense(monitor);
    Elimination whole = bulk.elimination(), part = bulk.elimination();
    const Superelements& bodies = bulk.superelements();
    std::vector<double> all(bodies.variable().size(), 0.0);
    for (std::size_t p = 0; p < all.size(); ++p)
        if (bodies.kind(static_cast<std::int64_t>(p)) == Superelements::Kind::jump) all[p] = Elimination::in_zone;
    whole.update(all, {});
    std::mt19937 random(7);
    const std::vector<double> theta(problem.patterns.size(), 0.7);
    for (int trial = 0; trial < 8; ++trial) {
        const std::vector<double> state = random_states(bodies, random, trial % 2 == 0);
        part.update(state, {});
        std::vector<std::int64_t> kept, eliminated;
        std::vector<double> springs(whole.places().size(), 0.0);
        for (std::size_t i = 0; i < springs.size(); ++i) {
            const std::int64_t p = whole.places()[i];
            const bool jump = bodies.kind(p) == Superelements::Kind::jump;
            if (!jump || state[index(p)] == Elimination::in_zone)
                kept.push_back(static_cast<std::int64_t>(i));
            else if (state[index(p)] >= 0.0) {
                eliminated.push_back(static_cast<std::int64_t>(i));
                springs[i] = state[index(p)];
            }
        }
        const Condensation dense(whole.energy(), kept, eliminated, springs);
        ck_assert_int_eq(dense.energy().rows(), part.energy().rows());
        const double scale = largest(whole.energy().stiffness), load = largest(whole.energy().load);
        double error = 0.0, load_error = 0.0;
        for (std::size_t i = 0; i < part.energy().stiffness.value.size(); ++i)
            error = std::max(error, std::abs(part.energy().stiffness.value[i] - dense.energy().stiffness.value[i]));
        for (std::size_t i = 0; i < part.energy().load.value.size(); ++i)
            load_error = std::max(load_error, std::abs(part.energy().load.value[i] - dense.energy().load.value[i]));
        ck_assert_msg(error < 1e-11 * scale, "%s: %g of %g", c.name, error, scale);
        ck_assert_msg(load_error < 1e-9 * load, "%s: loads %g of %g", c.name, load_error, load);
        std::vector<double> zone(kept.size()), skeleton(bodies.variable().size()), jumps(whole.places().size(), 0.0);
        for (std::size_t i = 0; i < zone.size(); ++i) zone[i] = 1e-6 * std::sin(static_cast<double>(i));
        part.recover(theta, zone, skeleton);
        dense.recover(theta, zone, jumps);
        double size = 0.0, off = 0.0;
        for (std::size_t i = 0; i < jumps.size(); ++i) {
            size = std::max(size, std::abs(jumps[i]));
            off = std::max(off, std::abs(jumps[i] - skeleton[index(whole.places()[i])]));
        }
        ck_assert_msg(off < 1e-8 * size, "%s: jumps off by %g of %g", c.name, off, size);
    }
}

LOOP_TEST(history_leaves_no_digit, 0, cases().size()) {
    const Case c = cases()[index(loop)];
    const Problem problem = problem_of(c);
    Monitor monitor;
    Bulk bulk(problem, monitor);
    bulk.condense(monitor);
    Elimination one = bulk.elimination();
    std::mt19937 random(11);
    std::vector<double> state = random_states(bulk.superelements(), random, true);
    for (int trial = 0; trial < 12; ++trial) {
        if (trial % 2 == 0) {
            state = random_states(bulk.superelements(), random, trial % 4 == 0);
        } else {  // one jump alone
            for (std::size_t p = 0; p < state.size(); ++p)
                if (state[p] > 0.0) {
                    state[p] *= 0.5;
                    break;
                }
        }
        one.update(state, {});
        Elimination unused = bulk.elimination();
        unused.update(state, {});
        ck_assert(one.places() == unused.places());
        ck_assert(same_bits(one.energy().stiffness.value, unused.energy().stiffness.value));
        ck_assert(same_bits(one.energy().load.value, unused.energy().load.value));
    }
}

// Other loads pass through the factors that are there, with the digits of an elimination that was made for them.
LOOP_TEST(other_loads_leave_no_digit, 0, cases().size()) {
    const Case c = cases()[index(loop)];
    const Problem problem = problem_of(c);
    Monitor monitor;
    Bulk bulk(problem, monitor);
    bulk.condense(monitor);
    const Superelements& bodies = bulk.superelements();
    Elimination one = bulk.elimination();
    std::mt19937 random(13);
    std::uniform_real_distribution<double> number(0.5, 2.0);
    std::vector<double> state = random_states(bodies, random, true);
    for (int trial = 0; trial < 12; ++trial) {
        if (trial % 3 == 2) state = random_states(bodies, random, trial % 2 == 0);
        DenseMatrix load = bulk.elimination().loads();
        for (double& l : load.value) l *= number(random);
        one.take_loads(load);
        one.update(state, {});
        Elimination unused(bodies, load);
        unused.update(state, {});
        ck_assert(one.places() == unused.places());
        ck_assert(same_bits(one.energy().stiffness.value, unused.energy().stiffness.value));
        ck_assert(same_bits(one.energy().load.value, unused.energy().load.value));
        const std::vector<double> theta(index(load.columns), 0.7), zone(one.places().size(), 1e-6);
        std::vector<double> skeleton(bodies.variable().size()), expected(skeleton.size());
        one.recover(theta, zone, skeleton);
        unused.recover(theta, zone, expected);
        ck_assert(same_bits(skeleton, expected));
    }
}

// Copies of a piece are condensed once; a piece of another material is no copy.
TEST(copies_share_a_piece) {
    unit::Flexure beam;
    beam.along = 1600;
    beam.through = 2;
    Problem problem = unit::make_flexure(beam);
    Monitor monitor;
    const Bulk alike(problem, monitor);
    ck_assert_uint_ge(alike.superelements().leaves(), 16);
    ck_assert_msg(2 * alike.superelements().pieces() < alike.superelements().leaves(), "%zu pieces for %zu leaves",
                  alike.superelements().pieces(), alike.superelements().leaves());
    // Every cell has a size of its own.
    const Mesh& mesh = *problem.mesh;
    std::vector<double> nodes(mesh.nodes().begin(), mesh.nodes().end());
    for (std::size_t n = 0; 2 * n < nodes.size(); ++n) {
        double& x = nodes[2 * n];
        x += 1e-3 * x * (0.12 - x);
    }
    auto graded = std::make_shared<Mesh>(2, nodes);
    for (std::int64_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const std::int32_t label = mesh.body_label(mesh.cell_body(cell));
        graded->add_cells(mesh.cell_type(cell), mesh.cell(cell), std::span(&label, 1));
    }
    add_interface(*graded, 0, 1, 1e-6);
    problem.mesh = graded;
    const Bulk different(problem, monitor);
    ck_assert_uint_eq(different.superelements().pieces(), different.superelements().leaves());
}
