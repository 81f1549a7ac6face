// SPDX-License-Identifier: BSD-3-Clause
// Patterns, the check of a scene with its supports, and the hash.
#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "law/law_parameters.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "scene/check/validate.hpp"
#include "scene/problem.hpp"

using namespace delam;

namespace {

// The error in which an action ends: its status and message. Status 0: none.
struct Outcome {
    std::int32_t status = 0;
    std::string words;
    bool says(const std::string& part) const { return words.find(part) != std::string::npos; }
};

Outcome outcome(const std::function<void()>& action) {
    try {
        action();
        return {};
    } catch (const Error& e) {
        return {e.status(), e.what()};
    }
}

void expect(const Problem& problem, const std::string& part) {
    const Outcome o = outcome([&] { validate(problem); });
    ck_assert_msg(o.status == DELAM_ERROR_PROBLEM && o.says(part), "expected '%s', got %d '%s'", part.c_str(), o.status,
                  o.words.c_str());
}

void expect_valid(const Problem& problem) {
    const Outcome o = outcome([&] { validate(problem); });
    ck_assert_msg(o.status == 0, "got %d '%s'", o.status, o.words.c_str());
}

Law ductile() {
    Law law;
    law.normal_stiffness = law.tangential_stiffness = 125e9;
    law.normal_onset = law.tangential_onset = 100.0;
    law.normal_toughness = law.tangential_toughness = 250.0;
    return law;
}

// Layers of 4 x 1 (x 1) with an interface between neighbours, materials and laws; no supports yet.
Problem stack(int dimension, std::size_t layers) {
    const std::vector<double> lengths{4.0, 1.0};
    const std::vector<std::int64_t> divisions{4, 1};
    const std::vector<double> thickness(layers, 1.0);
    const std::vector<std::int64_t> layer_divisions(layers, 1);
    const auto axes = static_cast<std::size_t>(dimension - 1);
    auto mesh = std::make_shared<Mesh>(make_layers(dimension, std::span(lengths).first(axes),
                                                   std::span(divisions).first(axes), thickness, layer_divisions,
                                                   dimension == 2 ? CellType::quad4 : CellType::hex8));
    for (std::size_t i = 0; i + 1 < layers; ++i) {
        add_interface(*mesh, static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1), 1e-6);
    }
    Problem problem(mesh);
    for (auto& material : problem.material) material = Elastic{75e9, 0.3};
    for (auto& interface : problem.interfaces) interface.law = ductile();
    return problem;
}

std::int64_t node_at(const Problem& problem, std::int32_t body, std::vector<double> place) {
    for (const std::int64_t node : problem.mesh->body_nodes(body)) {
        const auto p = problem.mesh->node(node);
        if (std::equal(p.begin(), p.end(), place.begin())) return node;
    }
    ck_abort_msg("no such node");
    return -1;
}

void hold(Problem& problem, std::int64_t node, int component) {
    problem.constraints.push_back({{problem.mesh->dimension() * node + component}, {1.0}, {}});
}

// Statically determinate: left corner u_x = u_y = 0, right corner u_y = 0.
void hold_bottom(Problem& problem) {
    hold(problem, node_at(problem, 0, {0.0, 0.0}), 0);
    hold(problem, node_at(problem, 0, {0.0, 0.0}), 1);
    hold(problem, node_at(problem, 0, {4.0, 0.0}), 1);
}

void debond(Problem& problem, std::size_t interface) {
    for (double& zeta : problem.interfaces[interface].adhesion) zeta = 0.0;
}

void push(Problem& problem, std::int64_t node, int component) {
    problem.patterns.push_back({"push", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::force});
    problem.forces.push_back(
        {static_cast<std::int64_t>(problem.patterns.size()) - 1, problem.mesh->dimension() * node + component, 1.0});
}

}  // namespace

TEST(patterns_are_piecewise_linear) {
    const Pattern pattern{"p", {1.0, 2.0, 4.0}, {0.0, 3.0, -1.0}};
    ck_assert_double_eq(pattern.at(-5.0), 0.0);
    ck_assert_double_eq(pattern.at(1.0), 0.0);
    ck_assert_double_eq(pattern.at(1.5), 1.5);
    ck_assert_double_eq(pattern.at(2.0), 3.0);
    ck_assert_double_eq(pattern.at(3.0), 1.0);
    ck_assert_double_eq(pattern.at(4.0), -1.0);
    ck_assert_double_eq(pattern.at(9.0), -1.0);
    const Pattern constant{"c", {0.0}, {2.0}};
    ck_assert_double_eq(constant.at(-1.0), 2.0);
    ck_assert_double_eq(constant.at(1.0), 2.0);
}

TEST(incomplete_scenes_are_refused_by_name) {
    Problem good = stack(2, 2);
    hold_bottom(good);
    expect_valid(good);

    Problem problem = good;
    problem.material[1].reset();
    expect(problem, "body 1: no material");

    problem = good;
    problem.interfaces[0].law.reset();
    expect(problem, "interface 0: no law");

    problem.interfaces[0].bonded = true;
    expect_valid(problem);
    problem.interfaces[0].adhesion[2] = 0.0;
    expect(problem, "pair 2 has an adhesion of 0");

    problem = good;
    problem.interfaces[0].law->normal_toughness = 50.0;
    expect(problem, "interface 0: ");

    problem = good;
    problem.patterns.push_back({"idle", {0.0}, {1.0}});
    expect(problem, "pattern 'idle' drives neither");

    problem = good;
    hold(problem, node_at(problem, 0, {0.0, 0.0}), 0);
    expect(problem, "follows from other constraints");

    // A mean over nodes that are already fixed, and the same mean twice.
    problem = good;
    const std::int64_t left = node_at(problem, 0, {0.0, 0.0});
    const std::int64_t right = node_at(problem, 0, {4.0, 0.0});
    const std::int64_t middle = node_at(problem, 0, {2.0, 0.0});
    problem.constraints.push_back({{2 * left + 1, 2 * right + 1}, {0.5, 0.5}, {}});
    expect(problem, "constraint 3 (of 2 displacements");
    problem.constraints.back() = {{2 * left + 1, 2 * middle + 1}, {0.5, 0.5}, {}};
    expect_valid(problem);
    problem.constraints.push_back(problem.constraints.back());
    expect(problem, "constraint 4 (of 2 displacements");
}

TEST(missing_supports_are_described) {
    Problem problem = stack(2, 2);
    expect(problem, "missing support: no displacement is prescribed anywhere");

    hold(problem, node_at(problem, 0, {0.0, 0.0}), 1);
    hold(problem, node_at(problem, 0, {4.0, 0.0}), 1);
    expect(problem, "bodies 0, 1 can translate along x");

    hold(problem, node_at(problem, 1, {0.0, 2.0}), 0);
    expect_valid(problem);

    problem.constraints.clear();
    hold(problem, node_at(problem, 0, {4.0, 0.0}), 0);
    hold(problem, node_at(problem, 0, {4.0, 0.0}), 1);
    expect(problem, "bodies 0, 1 can rotate about the point (4, 0)");

    // A support on a slope leaves the motion along the slope free.
    problem.constraints.clear();
    for (const double x : {0.0, 4.0}) {
        const std::int64_t node = node_at(problem, 0, {x, 0.0});
        problem.constraints.push_back({{2 * node, 2 * node + 1}, {0.6, 0.8}, {}});
    }
    expect(problem, "translate along (");
}

TEST(missing_supports_in_space_are_described) {
    Problem problem = stack(3, 2);
    const std::int64_t a = node_at(problem, 0, {0.0, 0.0, 0.0});
    const std::int64_t b = node_at(problem, 0, {4.0, 0.0, 0.0});
    for (int c = 0; c < 3; ++c) hold(problem, a, c);
    hold(problem, b, 1);
    hold(problem, b, 2);
    expect(problem, "bodies 0, 1 can rotate about the axis along x through (2, 0, 0)");
    hold(problem, node_at(problem, 0, {0.0, 1.0, 0.0}), 2);
    expect_valid(problem);
    problem.constraints.erase(problem.constraints.begin());
    expect(problem, "bodies 0, 1 can translate along x");
}

TEST(floating_plies_are_legal) {
    // The upper ply lies loose on the lower one: held by contact, or free.
    Problem loose = stack(2, 2);
    hold_bottom(loose);
    debond(loose, 0);
    expect_valid(loose);

    // A dead force on it is an error; one on the supported ply is not.
    Problem pulled = loose;
    push(pulled, node_at(loose, 1, {0.0, 2.0}), 0);
    expect(pulled, "dead forces of pattern 'push'");
    Problem held = loose;
    push(held, node_at(loose, 0, {0.0, 1.0}), 0);
    expect_valid(held);

    // Two plies bonded to each other, loose on a third; a ply attached at a single pair (in 2D it can rotate there).
    Problem pair = stack(2, 3);
    hold_bottom(pair);
    debond(pair, 0);
    expect_valid(pair);
    Problem hinge = loose;
    hinge.interfaces[0].adhesion.front() = 1.0;
    expect_valid(hinge);
    push(hinge, node_at(hinge, 1, {4.0, 2.0}), 0);
    expect(hinge, "body 1 can rotate about the point (0, 1)");

    // Supports on the loose ply do not replace those missing on the structure.
    Problem nothing = stack(2, 2);
    debond(nothing, 0);
    expect(nothing, "no displacement is prescribed");
    hold(nothing, node_at(nothing, 0, {0.0, 0.0}), 0);
    expect(nothing, "bodies 0, 1 can translate along y");
}

TEST(bodies_without_contact_need_their_own_supports) {
    const std::vector<double> lengths{1.0};
    const std::vector<std::int64_t> divisions{1};
    const std::vector<double> thickness{1.0, 1.0};
    const std::vector<std::int64_t> layer_divisions{1, 1};
    Problem problem(
        std::make_shared<Mesh>(make_layers(2, lengths, divisions, thickness, layer_divisions, CellType::tri3)));
    for (auto& material : problem.material) material = Elastic{1.0, 0.0};
    hold(problem, node_at(problem, 0, {0.0, 0.0}), 0);
    hold(problem, node_at(problem, 0, {0.0, 0.0}), 1);
    hold(problem, node_at(problem, 0, {1.0, 0.0}), 1);
    expect(problem,
           "body 1 can translate along x; body 1 can translate along y; body 1 can rotate about the point (0.5, 1.5)");
}

TEST(cells_that_share_a_node_are_hinged) {
    // Two squares touch at (1, 1): one body for the host, two pieces that rotate about the common node.
    const std::vector<double> nodes{0, 0, 1, 0, 0, 1, 1, 1, 2, 1, 1, 2, 2, 2};
    auto mesh = std::make_shared<Mesh>(2, nodes);
    const std::vector<std::int64_t> cells{0, 1, 3, 2, 3, 4, 6, 5};
    const std::vector<std::int32_t> labels{7, 7};
    mesh->add_cells(CellType::quad4, cells, labels);
    Problem problem(mesh);
    problem.material[0] = Elastic{1.0, 0.0};
    for (const std::int64_t node : {0, 1}) {
        hold(problem, node, 1);
        if (node == 0) hold(problem, node, 0);
    }
    expect(problem, "body 7 can rotate about the point (1, 1)");
    hold(problem, 6, 0);
    expect_valid(problem);
}

TEST(supports_do_not_depend_on_units) {
    for (const double unit : {1e-6, 1.0, 1e6}) {
        const std::vector<double> lengths{120.0 * unit};
        const std::vector<std::int64_t> divisions{240};
        const std::vector<double> thickness{3.0 * unit, 3.0 * unit};
        const std::vector<std::int64_t> layer_divisions{6, 6};
        auto mesh =
            std::make_shared<Mesh>(make_layers(2, lengths, divisions, thickness, layer_divisions, CellType::quad4));
        add_interface(*mesh, 0, 1, 1e-6);
        Problem problem(mesh);
        for (auto& material : problem.material) material = Elastic{75e9, 0.3};
        problem.interfaces[0].law = ductile();
        // Neighbouring nodes restrain a rotation too, if softly.
        hold(problem, 0, 0);
        hold(problem, 0, 1);
        expect(problem, "rotate about the point (0, 0)");
        hold(problem, 1, 1);
        expect_valid(problem);
    }
}

// Another number in each row of the table, another kind, another criterion.
std::vector<std::function<void(Law&)>> law_changes() {
    std::vector<std::function<void(Law&)>> changes;
    for (const LawParameter& row : law_parameters()) {
        if (row.value != nullptr)
            changes.push_back([&row](Law& law) {
                law.*row.value += 1.0;
                if (row.second != nullptr) law.*row.second += 1.0;
            });
        for (std::size_t kind = 0; kind < law_kinds.size() && row.write != nullptr; ++kind)
            if ((row.kinds >> kind & 1u) != 0)
                changes.push_back([&row, kind](Law& law) {
                    softening_of(law_kinds[kind].name, law.softening);
                    row.write(law.softening, row.read(law.softening) + 0.25);
                });
    }
    for (const LawKind& kind : law_kinds)
        if (kind.name != std::string(ductile().kind().name))
            changes.push_back([&kind](Law& law) { softening_of(kind.name, law.softening); });
    for (const Criterion criterion : {Criterion::power, Criterion::benzeggagh_kenane})
        changes.push_back([criterion](Law& law) { law.criterion = criterion; });
    return changes;
}

TEST(hash_changes_with_every_datum) {
    Problem base = stack(2, 2);
    hold_bottom(base);
    push(base, node_at(base, 0, {0.0, 1.0}), 0);
    base.patterns.push_back({"move", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::displacement});
    base.constraints[0].prescribed = {0.0, 1.0};
    const std::uint64_t origin = hash(base);
    ck_assert(hash(Problem(base)) == origin);
    std::vector<std::function<void(Problem&)>> changes{
        [](Problem& p) { p.plane = Plane::stress; },
        [](Problem& p) { std::get<Elastic>(*p.material[1]).young = 76e9; },
        [](Problem& p) { std::get<Elastic>(*p.material[1]).poisson = 0.31; },
        [](Problem& p) { p.material[0].reset(); },
        [](Problem& p) { p.interfaces[0].bonded = true; },
        [](Problem& p) { p.interfaces[0].law.reset(); },
        [](Problem& p) { p.interfaces[0].adhesion[1] = 0.5; },
        [](Problem& p) { p.patterns[0].name = "pull"; },
        [](Problem& p) { p.patterns[0].times[1] = 2.0; },
        [](Problem& p) { p.patterns[0].values[1] = 2.0; },
        [](Problem& p) { p.patterns[0].drives = Pattern::Drives::nothing; },
        [](Problem& p) { p.constraints.pop_back(); },
        [](Problem& p) { p.constraints[0].dof[0] += 1; },
        [](Problem& p) { p.constraints[0].coefficient[0] = 0.5; },
        [](Problem& p) { p.constraints[0].prescribed[1] = 2.0; },
        [](Problem& p) { p.forces[0].pattern = 1; },
        [](Problem& p) { p.forces[0].dof += 1; },
        [](Problem& p) { p.forces[0].value = 2.0; },
        [](Problem& p) { p.options.contact_limit = 7; },  // all others: case_test_options
    };
    for (const auto& change : law_changes()) changes.push_back([change](Problem& p) { change(*p.interfaces[0].law); });
    std::vector<std::uint64_t> seen{origin, hash(stack(2, 2)), hash(stack(2, 3)), hash(stack(3, 2))};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Problem changed = base;
        changes[i](changed);
        seen.push_back(hash(changed));
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) ck_assert_msg(seen[i] != seen[j], "changes %zu and %zu hash alike", i, j);
    }
}
