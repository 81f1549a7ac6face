// SPDX-License-Identifier: BSD-3-Clause
// Matrices that are no bodies are refused by name; what bodies without faces lack; motions of two bodies in one call.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "host_bodies.hpp"

namespace {

using namespace cases;
using reference::Solver;

// A kernel declared for two bodies in one call, three motions of each.
TEST(kernel_of_two_bodies) {
    Scene own = two_layers(2.0, 2, 1.0, 1, 1e9, 0.3);
    Scene scene = without_cells(own, {0, 1});
    const Csr both = stacked(body_matrix(own, 0), body_matrix(own, 1));
    const auto nodes = joined(nodes_of(own, 0), nodes_of(own, 1));
    const std::size_t rows = nodes.size();  // of a body, in the plane
    std::vector<double> kernel(6 * 2 * rows, 0.0);
    for (std::size_t body = 0; body < 2; ++body)
        for (std::size_t i = 0; i < rows / 2; ++i) {
            const std::int64_t node = nodes[body * rows / 2 + i];
            const std::size_t x = body * rows + 2 * i;
            kernel[(3 * body) * 2 * rows + x] = kernel[(3 * body + 1) * 2 * rows + x + 1] = 1.0;
            kernel[(3 * body + 2) * 2 * rows + x] = -own.coordinate(node, 1);
            kernel[(3 * body + 2) * 2 * rows + x + 1] = own.coordinate(node, 0);
        }
    scene.require(give(scene, nodes, both, 6, kernel.data()), "six motions of two bodies");
}

// Errors are named, and the problem stays unchanged.
TEST(refusals) {
    Scene own = two_layers(2.0, 2, 1.0, 1, 1e9, 0.3);
    const Csr k = body_matrix(own, 0);
    const auto nodes = nodes_of(own, 0);
    Scene scene = without_cells(own, {0, 1});
    const auto refused = [&](std::int32_t status, std::int32_t expected, const char* words) {
        const std::string text = delam_context_message(scene.context());
        cases::expect(status == expected && text.find(words) != std::string::npos,
                      std::string(words) + ": " + delam_status_name(status) + ", " + text);
    };
    const auto changed = [&](const std::function<void(Csr&, std::vector<std::int64_t>&)>& change, const char* words) {
        Csr other = k;
        auto list = nodes;
        change(other, list);
        refused(give(scene, list, other), DELAM_ERROR_ARGUMENT, words);
    };
    changed([](Csr& c, auto&) { c.value[1] *= 1.001; }, "not symmetric");
    changed([](Csr& c, auto&) { c.value[2] = NAN; }, "values[2]");
    changed([](Csr& c, auto&) { c.column[2] = 99; }, "columns[2] = 99");
    changed([](Csr& c, auto&) { c.start[3] = 1; }, "row_starts[3] = 1");
    changed([](Csr&, auto& list) { list[1] = list[0]; }, "occurs twice");
    changed([](Csr&, auto& list) { list[1] = 999; }, "nodes[1] = 999");
    changed([&](Csr&, auto& list) { list[1] = nodes_of(own, 1)[0]; }, "is missing");
    changed(
        [](Csr& c, auto&) {
            for (double& v : c.value) v = -v;
        },
        "diagonal");
    // Twice the shear coupling: symmetric, a positive diagonal, indefinite.
    changed(
        [](Csr& c, auto&) {
            for (std::size_t r = 0; r + 1 < c.start.size(); ++r)
                for (auto e = static_cast<std::size_t>(c.start[r]); e < static_cast<std::size_t>(c.start[r + 1]); ++e)
                    if (static_cast<std::size_t>(c.column[e]) != r) c.value[e] *= 3.0;
        },
        "indefinite");
    // Two squares that share one node: a hinge.
    {
        Made made(2, {0, 0, 1, 0, 0, 1, 1, 1, 2, 1, 1, 2, 2, 2});
        const std::vector<std::int64_t> cells{0, 1, 3, 2, 3, 4, 6, 5};
        made.expect(delam_mesh_add_cells(made.m, DELAM_QUAD4, 2, cells.data(), nullptr, 0));
        Scene hinged = made.scene();
        hinged.elastic(-1, 1e9, 0.3);
        const Csr h = body_matrix(hinged, 0);
        const std::int32_t status = give(hinged, nodes_of(hinged, 0), h);
        const std::string text = delam_context_message(hinged.context());
        cases::expect(status == DELAM_ERROR_ARGUMENT && text.find("mechanism") != std::string::npos, "hinge: " + text);
    }
    // A support that is neither stiff nor absent.
    changed([&](Csr& c, auto&) { c.value[0] *= 1.0 + 3e-10; }, "give the kernel");
    // One matrix that couples two bodies.
    {
        Csr two = stacked(k, body_matrix(own, 1));
        two.column[5] = static_cast<std::int64_t>(two.start.size()) - 2;
        refused(give(scene, joined(nodes, nodes_of(own, 1)), two), DELAM_ERROR_ARGUMENT, "couples bodies 0 and 1");
    }
    // Nothing was taken over.
    refused(delam_problem_check(scene.problem()), DELAM_ERROR_PROBLEM, "body 0: no cells and no stiffness");
    scene.require(give(scene, nodes, k), "a sound one");
    refused(delam_problem_check(scene.problem()), DELAM_ERROR_PROBLEM, "body 1: no cells and no stiffness");
    scene.require(give(scene, nodes_of(own, 1), body_matrix(own, 1)), "a sound one");
    const auto heat = scene.pattern("heat", {0.0}, {1.0});
    const std::vector<double> strain{1e-3, 1e-3, 0, 0, 0, 0};
    scene.law(0, {1e9, 1e9, 1.0, 1.0, 2.0, 2.0});
    scene.require(delam_problem_add_eigenstrain(scene.problem(), heat, -1, strain.data()), "eigenstrain");
    refused(delam_problem_check(scene.problem()), DELAM_ERROR_PROBLEM, "has the host's stiffness and an eigenstrain");
    // Meshes.
    delam_mesh* mesh = scene.mesh();
    const std::vector<std::int64_t> one{0}, cell{0, 1, 4, 3};
    refused(delam_mesh_add_host_body(mesh, 0, 1, one.data(), 0), DELAM_ERROR_MESH, "body 0 exists already");
    refused(delam_mesh_add_host_body(mesh, 7, 1, one.data(), 0), DELAM_ERROR_MESH, "belongs to body 0");
    refused(delam_mesh_add_cells(mesh, DELAM_QUAD4, 1, cell.data(), nullptr, 0), DELAM_ERROR_MESH,
            "made without cells");
    std::int64_t index = 0;
    const double normal[2] = {0.0, 1.0}, good = 1.0;
    refused(delam_mesh_add_pairs(mesh, 0, 1, 1, one.data(), one.data(), normal, &good, 0, 0, nullptr, 0, &index),
            DELAM_ERROR_ARGUMENT, "joined by interface");
}

// Without faces there are no fronts, and nothing for a gradient term to act on.
TEST(no_faces) {
    Scene own = two_layers(2.0, 2, 1.0, 1, 1e9, 0.3);
    const auto pairs = own.pairs(0);
    Made made(2, {own.nodes().begin(), own.nodes().end()});
    for (const std::int32_t body : {0, 1}) made.add_host_body(body, nodes_of(own, body));
    delam_mesh* m = made.m;
    delam_context* c = made.context.get();
    const std::vector<double> normals{0, 1, 0, 1, 0, 1};
    std::vector<double> weights = pairs.weight;
    std::int64_t index = -1;
    weights[1] = -1.0;
    cases::expect(delam_mesh_add_pairs(m, 0, 1, 3, pairs.node_a.data(), pairs.node_b.data(), normals.data(),
                                       weights.data(), 0, 0, nullptr, 0, &index) == DELAM_ERROR_ARGUMENT &&
                      std::string(delam_context_message(c)).find("weights[1] = -1") != std::string::npos,
                  delam_context_message(c));
    weights[1] = pairs.weight[1];
    made.expect(delam_mesh_add_pairs(m, 0, 1, 3, pairs.node_a.data(), pairs.node_b.data(), normals.data(),
                                     weights.data(), 0, 0, nullptr, 0, &index));
    Scene scene = made.scene();
    for (const std::int32_t body : {0, 1})
        scene.require(give(scene, nodes_of(own, body), body_matrix(own, body)), "stiffness");
    reference::LawData law{1e9, 1e9, 1.0, 1.0, 2.0, 2.0};
    law.gradient = 1e-3;
    scene.law(0, law);
    const auto foot = scene.find(0, {0.0, 0.0}, {2.0, 0.0});
    scene.hold(foot, {1.0, 0.0});
    scene.hold(foot, {0.0, 1.0});
    const auto top = scene.find(1, {0.0, 2.0}, {0.0, 2.0});
    scene.drive(top, {0.0, 1.0}, scene.pattern("drive", {0.0, 1.0}, {0.0, 3e-4}), {1.0});
    cases::expect(delam_problem_check(scene.problem()) == DELAM_ERROR_PROBLEM &&
                      std::string(delam_context_message(scene.context())).find("no faces") != std::string::npos,
                  delam_context_message(scene.context()));
    law.gradient = 0.0;
    scene.law(0, law);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    std::int64_t fronts = -1;
    REQUIRE(scene, delam_solver_front_count, solver.get(), 0, &fronts, nullptr);
    cases::expect(fronts == 0, "fronts without faces");
    const auto stress = solver.field("stress");
    cases::expect(stress.empty(), "stresses without cells");
    cases::expect(delam_mesh_interface_faces(m, index, nullptr) == DELAM_OK, "NULL for no faces");
}

}  // namespace
