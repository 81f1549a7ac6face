// SPDX-License-Identifier: BSD-3-Clause
// Conforming meshes with junctions, where three bodies or more meet: a linear displacement through perfect bonds is
// exact, and analyses with the condensed, the FETI and the direct realisation agree.
#include <algorithm>
#include <array>
#include <functional>

#include "acceptance.hpp"
#include "comparison.hpp"
#include "direct.hpp"
#include "support.hpp"

namespace {

using reference::LawData;
using reference::Scene;
using reference::Solver;

constexpr double young = 10e9;
constexpr double poisson = 0.3;
constexpr LawData law{3e11, 2e11, 100.0, 150.0, 2000.0, 3000.0};

using Box = std::array<std::int64_t, 3>;
using LabelOf = std::function<std::int32_t(const Box&)>;

// Two upper blocks on a lower one; in 3D the upper ones are also halved along y, so that three lines end in a point
// where four bodies meet.
std::int32_t tee(const Box& box, int d) {
    if (box[static_cast<std::size_t>(d - 1)] < 2) return 0;
    if (d == 2) return box[0] < 3 ? 1 : 2;
    return box[0] < 3 ? 1 : (box[1] < 2 ? 2 : 3);
}
// Four bodies around a point or a line.
std::int32_t cross(const Box& box, int d) {
    return (box[0] < 3 ? 0 : 1) + 2 * (box[static_cast<std::size_t>(d - 1)] < 2 ? 0 : 1);
}
// One body within another.
std::int32_t inclusion(const Box& box, int d) {
    const bool inside = box[0] > 1 && box[0] < 4 && box[1] > 0 && box[1] < 3 && (d == 2 || (box[2] > 0 && box[2] < 3));
    return inside ? 1 : 0;
}

struct Layout {
    const char* name;
    std::int32_t (*label)(const Box&, int);
    std::int64_t interfaces[2];  // in 2D, 3D
};
constexpr Layout layouts[] = {{"T", tee, {3, 6}}, {"cross", cross, {4, 4}}, {"inclusion", inclusion, {1, 1}}};

struct Shape {
    int dimension;
    std::int32_t cell;
    const char* name;
};
constexpr Shape shapes[] = {
    {2, DELAM_QUAD4, "quad4"}, {2, DELAM_TRI6, "tri6"}, {3, DELAM_HEX8, "hex8"}, {3, DELAM_TET4, "tet4"}};

const std::array<double, 3> sides{0.03, 0.02, 0.02};
constexpr Box divisions{6, 4, 4};

// One block, meshed as a mesher would do, and cut into bodies.
Scene conforming(const Shape& shape, const LabelOf& label) {
    const auto d = static_cast<std::size_t>(shape.dimension);
    const std::vector<double> lengths(sides.begin(), sides.begin() + shape.dimension - 1);
    const std::vector<std::int64_t> counts(divisions.begin(), divisions.begin() + shape.dimension - 1);
    const Scene block(shape.dimension, lengths, counts, {sides[d - 1]}, {divisions[d - 1]}, shape.cell);
    std::int64_t needed = 0, cells = 0;
    block.require(delam_mesh_size(block.mesh(), nullptr, nullptr, &cells, nullptr, nullptr), "size");
    block.require(delam_mesh_cells(block.mesh(), nullptr, nullptr, nullptr, 0, nullptr, &needed), "cells");
    std::vector<std::int64_t> connectivity(static_cast<std::size_t>(needed));
    block.require(delam_mesh_cells(block.mesh(), nullptr, nullptr, nullptr, needed, connectivity.data(), nullptr),
                  "cells");
    const auto per_cell = static_cast<std::size_t>(needed / cells);
    std::vector<std::int32_t> bodies;
    for (std::size_t c = 0; c < static_cast<std::size_t>(cells); ++c) {
        Box box{};
        for (std::size_t k = 0; k < d; ++k) {
            double sum = 0.0;  // including mid-side nodes, the mean stays within the cell
            for (std::size_t a = 0; a < per_cell; ++a)
                sum += block.coordinate(connectivity[c * per_cell + a], static_cast<int>(k));
            box[k] = static_cast<std::int64_t>(sum / static_cast<double>(per_cell) / sides[k] *
                                               static_cast<double>(divisions[k]));
        }
        bodies.push_back(label(box));
    }
    return Scene::conforming(shape.dimension, block.nodes(), shape.cell, connectivity, bodies);
}

Scene joined(const Shape& shape, const Layout& layout) {
    Scene scene = conforming(shape, [&](const Box& box) { return layout.label(box, shape.dimension); });
    const std::int64_t count = scene.all_interfaces();
    cases::expect(count == layout.interfaces[shape.dimension - 2],
                  std::string(layout.name) + ", " + shape.name + ": " + std::to_string(count) + " interfaces");
    scene.begin();
    scene.elastic(-1, young, poisson);
    return scene;
}

std::vector<double> unit(int d, int k) {
    std::vector<double> e(static_cast<std::size_t>(d), 0.0);
    e[static_cast<std::size_t>(k)] = 1.0;
    return e;
}

// Nodes where the coordinate along an axis has a value.
std::vector<std::int64_t> face(const Scene& scene, int axis, double value) {
    std::vector<std::int64_t> nodes;
    for (std::int64_t n = 0; n < static_cast<std::int64_t>(scene.node_count()); ++n)
        if (std::abs(scene.coordinate(n, axis) - value) < 1e-9) nodes.push_back(n);
    return nodes;
}

// A full gradient, rotation included; rows are displacement components.
constexpr double gradient[3][3] = {{1.0e-3, 0.4e-3, -0.3e-3}, {-0.7e-3, -0.5e-3, 0.2e-3}, {0.6e-3, 0.9e-3, 0.8e-3}};
double exact(const Scene& scene, std::int64_t node, int component) {
    double u = 0.0;
    for (int k = 0; k < scene.dimension(); ++k) u += gradient[component][k] * scene.coordinate(node, k);
    return u;
}

// Not a number of subdomains: the iterated operator.
constexpr int iterated = -1;

void realise(Scene& scene, int subdomains) {
    scene.text("reduction", subdomains == iterated ? "iterated" : subdomains == 0 ? "condensed" : "feti");
    if (subdomains > 0) scene.number("subdomains", subdomains);
}

LOOP_TEST(linear_field, 0, 12) {
    const Shape& shape = shapes[loop % 4];
    const Layout& layout = layouts[loop / 4];
    const int d = shape.dimension;
    for (const int subdomains : {0, iterated, 4, 9}) {
        Scene scene = joined(shape, layout);
        for (std::int64_t i = 0; i < layout.interfaces[d - 2]; ++i) scene.bonded(i);
        const auto load = scene.pattern("stretch", {0.0, 1.0}, {0.0, 1.0});
        std::vector<std::int64_t> nodes;
        for (int k = 0; k < d; ++k)
            for (const double value : {0.0, sides[static_cast<std::size_t>(k)]})
                for (const auto n : face(scene, k, value)) nodes.push_back(n);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (int k = 0; k < d; ++k) {
            std::vector<double> values;
            for (const auto n : nodes) values.push_back(exact(scene, n, k));
            scene.drive(nodes, unit(d, k), load, values);
        }
        realise(scene, subdomains);
        Solver solver(scene, 0.0);
        solver.equilibrate(1.0, {});
        const std::string where =
            std::string(layout.name) + ", " + shape.name + ", " + std::to_string(subdomains) + " subdomains: ";
        const auto u = solver.field("displacement");
        double size = 0.0;
        for (const double v : u) size = std::max(size, std::abs(v));
        for (std::size_t i = 0; i < u.size(); ++i)
            cases::expect_near(u[i], exact(scene, static_cast<std::int64_t>(i) / d, static_cast<int>(i) % d), 1e-10,
                               size, where + "displacement " + std::to_string(i));
        // Uniform stress.
        const auto stress = solver.field("stress");
        const std::size_t components = d == 2 ? 4 : 6;
        double stress_size = 0.0;
        for (const double s : stress) stress_size = std::max(stress_size, std::abs(s));
        for (std::size_t i = 0; i < stress.size(); ++i)
            cases::expect_near(stress[i], stress[i % components], 1e-10, stress_size,
                               where + "stress " + std::to_string(i));
        for (const double j : solver.field("jump")) cases::expect_near(j, 0.0, 1e-10, size, where + "jump");
    }
}

// Fixed at the bottom, pulled up and sideways at the top until it softens.
Scene pulled(const Shape& shape, const Layout& layout, int subdomains) {
    Scene scene = joined(shape, layout);
    const int d = shape.dimension;
    for (std::int64_t i = 0; i < layout.interfaces[d - 2]; ++i) scene.law(i, law);
    const auto bottom = face(scene, d - 1, 0.0), top = face(scene, d - 1, sides[static_cast<std::size_t>(d - 1)]);
    for (int k = 0; k < d; ++k) scene.hold(bottom, unit(d, k));
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, 2e-4});
    std::vector<double> up, sideways;
    for (const auto n : top) {
        const double x = scene.coordinate(n, 0) / sides[0];
        up.push_back(1.0 - 0.4 * x);
        sideways.push_back(0.5 * x);
    }
    scene.drive(top, unit(d, d - 1), load, up);
    scene.drive(top, unit(d, 0), load, sideways);
    if (d == 3) scene.hold(top, unit(3, 1));
    realise(scene, subdomains);
    return scene;
}

// Each realisation runs its own analysis; at its adhesion the direct solver must find its state.
LOOP_TEST(analyses_agree, 0, 6) {
    if ((loop == 1 || loop == 5) && !cases::whole()) return;  // in space one layout alone
    const Shape& shape = shapes[loop % 2 == 0 ? 0 : 2];
    const Layout& layout = layouts[loop / 2];
    std::vector<std::vector<double>> energies;
    double damaged = 0.0;
    for (const int subdomains : {0, iterated, 4, 9}) {
        const Scene scene = pulled(shape, layout, subdomains);
        const std::string where =
            std::string(layout.name) + ", " + shape.name + ", " + std::to_string(subdomains) + " subdomains";
        reference::DirectReference direct(scene);
        Solver solver(scene, 0.0);
        energies.emplace_back();
        for (int k = 1; k <= 6; ++k) {
            solver.step(k / 6.0);
            const auto accepted = reference::accept(solver, direct.exported());
            cases::expect_below(accepted.worst(), 1e-9, where + ": " + accepted.text());
            solver.commit();
            const auto state = direct.solve(k / 6.0, solver.field("adhesion"));
            Solver still(scene, 0.0);
            still.equilibrate(k / 6.0, solver.field("adhesion"));
            const auto comparison = reference::compare(still, state, direct.exported(), 1e-9);
            cases::expect_below(comparison.worst(), 1e-8,
                                where + ", step " + std::to_string(k) + ": " + comparison.text());
            cases::expect(comparison.contacts == 0, where + ": " + comparison.text());
            for (const char* key : {"stored_bulk", "stored_interface", "dissipated"})
                energies.back().push_back(solver.value(key));
        }
        damaged = 0.0;
        for (const double zeta : solver.field("adhesion")) damaged += zeta < 0.9 ? 1.0 : 0.0;
        cases::expect(damaged > 2.0, where + ": nothing is damaged");
        double size = 0.0;
        for (const double e : energies[0]) size = std::max(size, std::abs(e));
        for (std::size_t i = 0; i < energies[0].size(); ++i)
            cases::expect_near(energies.back()[i], energies[0][i], 1e-4, size, where + ": energy " + std::to_string(i));
    }
}

// A body that is held and one that is driven meet at the crossing, where both are bonded to a third one.
LOOP_TEST(driven_apart_through_a_body, 0, 6) {
    const Shape& shape = shapes[loop % 2 == 0 ? 0 : 2];
    const int d = shape.dimension;
    Scene scene = joined(shape, layouts[1]);
    const std::vector<double> lower(static_cast<std::size_t>(d), -1.0), upper(static_cast<std::size_t>(d), 1.0);
    for (int k = 0; k < d; ++k) scene.hold(scene.find(0, lower, upper), unit(d, k));
    const auto apart = scene.pattern("apart", {0.0, 1.0}, {0.0, 1e-4});
    const auto driven = scene.find(3, lower, upper);
    for (int k = 0; k < d; ++k) scene.drive(driven, unit(d, k), apart, std::vector<double>(driven.size(), 1.0));
    for (std::int64_t i = 0; i < layouts[1].interfaces[d - 2]; ++i) {
        std::int32_t a = -1, b = -1;
        scene.require(delam_mesh_interface_size(scene.mesh(), i, &a, &b, nullptr, nullptr, nullptr), "interface");
        a == 1 || b == 1 ? scene.bonded(i) : scene.contact(i);
    }
    realise(scene, loop / 2 == 0 ? 0 : loop / 2 == 1 ? iterated : 4);
    delam_solver* solver = nullptr;
    const std::int32_t status = delam_solver_create(scene.problem(), 0.0, &solver);
    delam_solver_destroy(&solver);
    cases::expect(status == DELAM_ERROR_PROBLEM, std::string(shape.name) + ": " + delam_status_name(status));
}

}  // namespace
