// SPDX-License-Identifier: BSD-3-Clause
// Two blocks with unmatched meshes under a linear displacement on their outside. Tied by means over segments they are
// exact, whichever is finer. Tied to points, they are exact where one mesh refines the other and is b; otherwise with
// an error that stays at the interface and decreases as b gets finer. All realisations give the same result.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "api.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

double max_abs(const std::vector<double>& v) {
    double m = 0.0;
    for (const double x : v) m = std::max(m, std::abs(x));
    return m;
}

constexpr double gradient[3][3] = {{1.0e-3, 0.4e-3, -0.3e-3}, {-0.7e-3, -0.5e-3, 0.2e-3}, {0.6e-3, 0.9e-3, 0.8e-3}};

// Blocks of 1 (x 1) x 0.5 upon each other, `lower` and `upper` cells along x (and y).
Scene blocks(int d, std::int64_t lower, std::int64_t upper) {
    const std::int32_t cell = d == 2 ? DELAM_QUAD4 : DELAM_HEX8;
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
    const std::size_t per_cell = d == 2 ? 4 : 8;
    for (const std::int64_t n : {lower, upper}) {
        const Scene part(d, d == 2 ? std::vector<double>{1.0} : std::vector<double>{1.0, 1.0},
                         d == 2 ? std::vector<std::int64_t>{n} : std::vector<std::int64_t>{n, n}, {0.5}, {3}, cell);
        const auto first = static_cast<std::int64_t>(nodes.size()) / d;
        for (std::size_t i = 0; i < part.nodes().size(); ++i)
            nodes.push_back(
                part.nodes()[i] +
                (!bodies.empty() && i % static_cast<std::size_t>(d) + 1 == static_cast<std::size_t>(d) ? 0.5 : 0.0));
        std::int64_t needed = 0;
        part.require(delam_mesh_cells(part.mesh(), nullptr, nullptr, nullptr, 0, nullptr, &needed), "cells");
        const auto begin = cells.size();
        cells.resize(begin + static_cast<std::size_t>(needed));
        part.require(delam_mesh_cells(part.mesh(), nullptr, nullptr, nullptr, needed, &cells[begin], nullptr), "cells");
        for (std::size_t i = begin; i < cells.size(); ++i) cells[i] += first;
        bodies.resize(cells.size() / per_cell, bodies.empty() ? 0 : 1);
    }
    return Scene(d, nodes, cell, cells, bodies);
}

struct Stresses {
    std::vector<double> value;
    double error = 0.0;  // largest of a component, over the largest component
};
using Join = decltype(delam_mesh_add_projected_interface);
Stresses stresses(int d, std::int64_t lower, std::int64_t upper, const char* reduction,
                  Join* join = delam_mesh_add_projected_interface) {
    Scene scene = blocks(d, lower, upper);
    std::int64_t index = -1;
    REQUIRE(scene, join, scene.mesh(), 0, 1, 0.0, &index);
    scene.begin();
    scene.elastic(-1, 10e9, 0.3);
    scene.bonded(0);
    const auto load = scene.pattern("stretch", {0.0, 1.0}, {0.0, 1.0});
    std::vector<std::int64_t> outer;
    const auto paired = scene.pairs(0).node_b;
    for (std::int64_t n = 0; n < static_cast<std::int64_t>(scene.node_count()); ++n) {
        bool surface = false;
        for (int k = 0; k < d; ++k) surface = surface || scene.coordinate(n, k) == 0.0 || scene.coordinate(n, k) == 1.0;
        // Through a tie to a point, a takes what acts on the rim of b where b is; through a mean it does not.
        const bool taken =
            join == delam_mesh_add_projected_interface && std::find(paired.begin(), paired.end(), n) != paired.end();
        if (surface && !taken) outer.push_back(n);
    }
    const auto exact = [&](std::int64_t n, int c) {
        double u = 0.0;
        for (int k = 0; k < d; ++k) u += gradient[c][k] * scene.coordinate(n, k);
        return u;
    };
    for (int c = 0; c < d; ++c) {
        std::vector<double> direction(static_cast<std::size_t>(d), 0.0), values;
        direction[static_cast<std::size_t>(c)] = 1.0;
        for (const auto n : outer) values.push_back(exact(n, c));
        scene.drive(outer, direction, load, values);
    }
    scene.text("reduction", reduction);
    Solver solver(scene, 0.0);
    solver.equilibrate(1.0, {});
    const auto stress = solver.field("stress");
    const std::size_t components = d == 2 ? 4 : 6;
    double trace = 0.0;
    for (int k = 0; k < d; ++k) trace += gradient[k][k];
    const double lambda = 10e9 * 0.3 / (1.3 * 0.4), mu = 10e9 / 2.6;
    const auto normal = [&](int k) { return lambda * trace + (k < d ? 2.0 * mu * gradient[k][k] : 0.0); };
    const auto shear = [&](int i, int j) { return mu * (gradient[i][j] + gradient[j][i]); };
    const std::vector<double> expected =
        d == 2 ? std::vector<double>{normal(0), normal(1), normal(2), shear(0, 1)}
               : std::vector<double>{normal(0), normal(1), normal(2), shear(0, 1), shear(1, 2), shear(2, 0)};
    double largest = 0.0, error = 0.0;
    for (const double s : expected) largest = std::max(largest, std::abs(s));
    for (std::size_t i = 0; i < stress.size(); ++i)
        error = std::max(error, std::abs(stress[i] - expected[i % components]));
    return {stress, error / largest};
}

double stress_error(int d, std::int64_t lower, std::int64_t upper, const char* reduction) {
    return stresses(d, lower, upper, reduction).error;
}

LOOP_TEST(patch, 0, 6) {
    const int d = loop / 3 == 0 ? 2 : 3;
    const char* reduction = std::array{"condensed", "feti", "iterated"}[static_cast<std::size_t>(loop) % 3];
    const std::string where = std::to_string(d) + "D, " + reduction;
    cases::expect_below(stress_error(d, 2, 4, reduction), 1e-9, where + ", b refines a");
    cases::expect_below(stress_error(d, 3, 3, reduction), 1e-9, where + ", matching");
    // Many nodes on faces of one body: rows of FETI that are all coupled.
    cases::expect_below(stress_error(d, 6, 12, reduction), 1e-9, where + ", 12 faces on 6");
    double before = 1.0;
    std::string table;
    for (const std::int64_t n : {4, 5, 7}) {
        const bool itself = std::string(reduction) == "condensed";
        const Stresses own = stresses(d, 3, n, reduction), other = itself ? own : stresses(d, 3, n, "condensed");
        const double error = own.error, size = max_abs(other.value);
        for (std::size_t i = 0; i < own.value.size(); ++i)
            cases::expect_near(own.value[i], other.value[i], 1e-9, size, where + ": stress beside the condensed one");
        table += " 1:" + std::to_string(static_cast<double>(n) / 3.0) + " " + std::to_string(error);
        cases::expect(error < 0.9 * before, where + ": errors" + table);
        before = error;
    }
    cases::expect_below(before, d == 2 ? 0.002 : 0.025, where + ": errors" + table);
    const double coarser = stress_error(d, 3, 2, reduction);
    cases::expect(coarser > 10.0 * before, where + ": b coarser than a, error " + std::to_string(coarser));
}

// Two quarter rings of radii 1, 1.5 and 2 around each other, `inner` and `outer` cells along their arcs: the largest
// error of the displacement beside Lame's, u = (r - 4/r) / (-3) 1e-3, over the largest displacement.
double ring_error(std::int64_t inner, std::int64_t outer, bool outer_is_b) {
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
    for (const auto& [along, body] : {std::pair{inner, 0}, {outer, 1}}) {
        const auto first = static_cast<std::int64_t>(nodes.size()) / 2, across = along / 2, column = across + 1;
        for (std::int64_t i = 0; i <= along; ++i)
            for (std::int64_t j = 0; j <= across; ++j) {
                const double angle =
                    0.5 * std::numbers::pi * static_cast<double>(along - i) / static_cast<double>(along);
                const double r = 1.0 + 0.5 * (body + static_cast<double>(j) / static_cast<double>(across));
                nodes.insert(nodes.end(), {i == 0 ? 0.0 : r * std::cos(angle), i == along ? 0.0 : r * std::sin(angle)});
                if (i == along || j == across) continue;
                const std::int64_t n = first + i * column + j;
                cells.insert(cells.end(), {n, n + column, n + column + 1, n + 1});
                bodies.push_back(body);
            }
    }
    Scene scene(2, nodes, DELAM_QUAD4, cells, bodies);
    const double turn = 0.5 * std::numbers::pi / static_cast<double>(std::min(inner, outer));
    std::int64_t index = -1;
    REQUIRE(scene, delam_mesh_add_mortar_interface, scene.mesh(), outer_is_b ? 0 : 1, outer_is_b ? 1 : 0,
            1.5 * 0.25 * turn * turn, &index);
    scene.begin();
    scene.elastic(-1, 10e9, 0.3);
    scene.bonded(0);
    const auto load = scene.pattern("grow", {0.0, 1.0}, {0.0, 1.0});
    const auto exact = [&](std::size_t node, std::size_t c) {
        const double r = std::hypot(nodes[2 * node], nodes[2 * node + 1]);
        return 1e-3 * (4.0 / r - r) / 3.0 * nodes[2 * node + c] / r;
    };
    for (std::size_t c = 0; c < 2; ++c) {
        std::vector<std::int64_t> driven;
        std::vector<double> values;
        for (std::size_t n = 0; n < nodes.size() / 2; ++n) {
            const double r = std::hypot(nodes[2 * n], nodes[2 * n + 1]);
            if (nodes[2 * n + c] != 0.0 && r > 1.0 + 1e-9 && r < 2.0 - 1e-9) continue;
            driven.push_back(static_cast<std::int64_t>(n));
            values.push_back(exact(n, c));
        }
        scene.drive(driven, {c == 0 ? 1.0 : 0.0, c == 0 ? 0.0 : 1.0}, load, values);
    }
    Solver solver(scene, 0.0);
    solver.equilibrate(1.0, {});
    const auto u = solver.field("displacement");
    double error = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) error = std::max(error, std::abs(u[i] - exact(i / 2, i % 2)));
    return error / 1e-3;
}

LOOP_TEST(means_on_arcs, 0, 4) {
    const bool outer_is_b = loop % 2 == 0, inner_is_finer = loop / 2 == 0;
    double before = 0.0;
    std::string table;
    for (const std::int64_t n : {4, 8, 16}) {
        const double error = ring_error(inner_is_finer ? 3 * n : 2 * n, inner_is_finer ? 2 * n : 3 * n, outer_is_b);
        table += " " + std::to_string(error);
        if (before > 0.0) cases::expect(error < before / 3.0, "errors" + table);
        before = error;
    }
    std::printf("arcs, %d:%s\n", loop, table.c_str());
}

// Body a below, b above. In space a node of the coarse side has hundreds of others in its mean.
LOOP_TEST(means, 0, 6) {
    const int d = loop / 3 == 0 ? 2 : 3;
    const char* reduction = std::array{"condensed", "feti", "iterated"}[static_cast<std::size_t>(loop) % 3];
    constexpr std::int64_t most = 20;
    for (const auto& [lower, upper] :
         {std::pair<std::int64_t, std::int64_t>{1, most}, {most, 1}, {3, 4}, {4, 3}, {3, 3}, {5, 2}})
        cases::expect_below(
            stresses(d, lower, upper, reduction, delam_mesh_add_mortar_interface).error, 1e-10,
            std::to_string(d) + "D, " + reduction + ", " + std::to_string(lower) + ":" + std::to_string(upper));
}

}  // namespace
