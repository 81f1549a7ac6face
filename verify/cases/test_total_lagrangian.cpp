// SPDX-License-Identifier: BSD-3-Clause
// Large rotations against an independent total Lagrangian solver on the same meshes: a double cantilever beam, a
// flexure specimen whose arms slide and press on each other, a lap joint and a plate of two layers in space.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "condensed_scenes.hpp"
#include "small_analysis.hpp"
#include "support.hpp"
#include "total_lagrangian.hpp"

namespace {

using cases::Block;
using reference::Scene;
using reference::Solver;
using reference::TotalLagrangian;

// Blocks of cells with nodes at corners and in the middles of edges; each block is a body.
struct Mesh {
    int dimension;
    std::vector<double> nodes;
    std::vector<std::vector<std::int64_t>> cells;
    std::vector<std::int32_t> bodies;

    Mesh(int d, const std::vector<Block>& blocks) : dimension(d) {
        for (std::size_t b = 0; b < blocks.size(); ++b) add(blocks[b], static_cast<std::int32_t>(b));
    }
    Scene scene() const {
        std::vector<std::int64_t> all;
        for (const auto& cell : cells) all.insert(all.end(), cell.begin(), cell.end());
        return Scene(dimension, nodes, dimension == 2 ? DELAM_QUAD8 : DELAM_HEX20, all, bodies);
    }

private:
    void add(const Block& block, std::int32_t body) {
        std::map<std::array<int, 3>, std::int64_t> known;
        const auto node = [&](const std::array<int, 3>& at) {
            const auto found = known.find(at);
            if (found != known.end()) return found->second;
            const auto added = static_cast<std::int64_t>(nodes.size()) / dimension;
            for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k)
                nodes.push_back(block.lower[k] + (block.upper[k] - block.lower[k]) * at[k] / (2 * block.cells[k]));
            return known[at] = added;
        };
        // Corners of the lower face and of the upper one, middles of their edges, middles of those that join them.
        constexpr std::array<std::array<int, 3>, 20> place{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
                                                            {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
                                                            {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2},
                                                            {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}};
        for (int z = 0; z < (dimension == 3 ? block.cells[2] : 1); ++z)
            for (int y = 0; y < block.cells[1]; ++y)
                for (int x = 0; x < block.cells[0]; ++x) {
                    std::vector<std::int64_t>& cell = cells.emplace_back();
                    for (std::size_t i = 0; i < place.size(); ++i) {
                        if (dimension == 2 && (i >= 12 || (i >= 4 && i < 8))) continue;
                        cell.push_back(node({2 * x + place[i][0], 2 * y + place[i][1], 2 * z + place[i][2]}));
                    }
                    bodies.push_back(body);
                }
    }
};

// Asks both solvers the same: solids, supports and movements.
struct Both {
    Scene scene;
    TotalLagrangian solids;
    std::int64_t load;

    Both(const Mesh& mesh, double young, double poisson, const std::function<void(Scene&)>& join)
        : scene(mesh.scene()), solids(mesh.dimension, mesh.nodes, mesh.cells, young, poisson), load(0) {
        scene.interface(0, 1);
        scene.begin();
        scene.elastic(-1, young, poisson);
        join(scene);
        scene.text("kinematics", "corotational");
        load = scene.pattern("load", {0.0, 1.0}, {0.0, 1.0});
        // Nodes of both bodies at one place, from left to right.
        const auto d = static_cast<std::size_t>(mesh.dimension);
        std::map<std::vector<double>, std::int64_t> below;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
            for (const std::int64_t node : mesh.cells[c]) {
                const auto at = mesh.nodes.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * d);
                const std::vector<double> place(at, at + static_cast<std::ptrdiff_t>(d));
                if (mesh.bodies[c] == 0)
                    below[place] = node;
                else if (const auto found = below.find(place); found != below.end())
                    shared_[place] = {found->second, node};
            }
    }
    // Ties the bodies from `first` along x on. Before it they touch where one presses on the other, or pass by.
    void join(double first, bool touching) {
        std::vector<std::int64_t> face, above;
        for (const auto& [place, pair] : shared_) {
            face.push_back(pair.first);
            if (place[0] > first - 1e-9)
                solids.tie(pair.second, pair.first);
            else
                above.push_back(pair.second);
        }
        if (touching) solids.touch(face, above);
    }
    void cut(double first) {
        const reference::Pairs pairs = scene.pairs(0);
        std::vector<std::int64_t> cut;
        for (std::size_t p = 0; p < pairs.count(); ++p)
            if (scene.coordinate(pairs.node_a[p], 0) < first - 1e-9) cut.push_back(static_cast<std::int64_t>(p));
        scene.adhesion(0, cut, std::vector<double>(cut.size(), 0.0));
    }
    void hold(const std::vector<std::int64_t>& nodes, int component, double value = 0.0) {
        const std::vector<double> e = cases::unit(scene.dimension(), component);
        if (value == 0.0)
            scene.hold(nodes, e);
        else
            scene.drive(nodes, e, load, std::vector<double>(nodes.size(), value));
        for (const std::int64_t node : nodes) solids.prescribe(node, component, value);
    }
    std::vector<std::int64_t> at(std::int32_t body, double x, double y) const {
        return cases::nodes_where(
            scene, body, [&](const double* p) { return std::abs(p[0] - x) < 1e-6 && std::abs(p[1] - y) < 1e-6; });
    }
    void compare(int steps, double least_rotation, const std::string& what, double tolerance = 1e-3) {
        const TotalLagrangian::Result exact = solids.solve(steps);
        Solver solver(scene, 0.0);
        for (int k = 1; k <= steps; ++k) {
            solver.step(static_cast<double>(k) / steps);
            solver.commit();
        }
        std::printf("%s: rotation %.3f, load off by %.1e, energy by %.1e\n", what.c_str(), exact.rotation,
                    solver.value("reaction:load") / exact.conjugate - 1.0,
                    (solver.value("stored_bulk") + solver.value("stored_interface")) / exact.energy - 1.0);
        cases::expect_below(least_rotation, exact.rotation, what + ": rotation");
        cases::expect_near(solver.value("reaction:load"), exact.conjugate, tolerance, exact.conjugate, what + ": load");
        cases::expect_near(solver.value("stored_bulk") + solver.value("stored_interface"), exact.energy, tolerance,
                           exact.energy, what + ": energy");
    }

private:
    std::map<std::vector<double>, std::pair<std::int64_t, std::int64_t>> shared_;
};

// It gives so little that faces count as one.
constexpr reference::LawData stiff{1e8, 1e8, 1e10, 1e10, 1e11, 1e11, 1.0};

TEST(double_cantilever_beam) {
    const Mesh mesh(2,
                    {{{0.0, 0.0, 0.0}, {40.0, 0.5, 0.0}, {80, 1, 1}}, {{0.0, 0.5, 0.0}, {40.0, 1.0, 0.0}, {80, 1, 1}}});
    Both both(mesh, 135.3e3, 0.3, [](Scene& scene) { scene.law(0, stiff); });
    both.cut(30.0);
    both.join(30.0, false);
    both.hold(both.at(0, 40.0, 0.0), 0);
    both.hold(both.at(0, 40.0, 0.0), 1);
    both.hold(both.at(1, 40.0, 1.0), 1);
    both.hold(both.at(0, 0.0, 0.25), 1, -14.0);
    both.hold(both.at(1, 0.0, 0.75), 1, 14.0);
    both.compare(8, 0.6, "double cantilever beam");
}

TEST(flexure_specimen) {
    const Mesh mesh(
        2, {{{0.0, 0.0, 0.0}, {100.0, 1.0, 0.0}, {50, 1, 1}}, {{0.0, 1.0, 0.0}, {100.0, 2.0, 0.0}, {50, 1, 1}}});
    Both both(mesh, 70e3, 0.3, [](Scene& scene) { scene.law(0, stiff); });
    both.cut(30.0);
    both.join(30.0, true);
    both.hold(both.at(0, 0.0, 1.0), 1);
    both.hold(both.at(0, 100.0, 1.0), 0);
    both.hold(both.at(0, 100.0, 1.0), 1);
    both.hold(both.at(1, 50.0, 1.0), 1, -18.0);
    both.compare(10, 0.5, "flexure specimen");
}

TEST(lap_joint) {
    const Mesh mesh(
        2, {{{0.0, 0.0, 0.0}, {60.0, 1.0, 0.0}, {60, 2, 1}}, {{50.0, 1.0, 0.0}, {110.0, 2.0, 0.0}, {60, 2, 1}}});
    for (const double stretch : {0.01, 0.05}) {
        Both both(mesh, 70e3, 0.3, [](Scene& scene) { scene.bonded(0); });
        both.join(0.0, false);
        both.hold(both.at(0, 0.0, 0.5), 0);
        both.hold(both.at(0, 0.0, 0.5), 1);
        both.hold(both.at(1, 110.0, 1.5), 1);
        both.hold(both.at(1, 110.0, 1.5), 0, stretch);
        both.compare(5, 0.003, "lap joint stretched by " + std::to_string(stretch));
    }
}

// The clamped plate is bent and twisted by a corner.
TEST(plate_in_space) {
    const Mesh mesh(
        3, {{{0.0, 0.0, 0.0}, {20.0, 10.0, 0.5}, {10, 5, 1}}, {{0.0, 0.0, 0.5}, {20.0, 10.0, 1.0}, {10, 5, 1}}});
    Both both(mesh, 70e3, 0.3, [](Scene& scene) { scene.bonded(0); });
    both.join(0.0, false);
    const auto clamped = [&](std::int32_t body) {
        return cases::nodes_where(both.scene, body,
                                  [body](const double* p) { return p[0] < 1e-9 && (body == 0 || p[2] > 0.5 + 1e-9); });
    };
    for (const std::int32_t body : {0, 1})
        for (int k = 0; k < 3; ++k) both.hold(clamped(body), k);
    const auto corner = cases::nodes_where(
        both.scene, 0, [](const double* p) { return p[0] > 20.0 - 1e-9 && p[1] < 1e-9 && p[2] < 1e-9; });
    both.hold(corner, 2, 9.0);
    both.compare(6, 0.5, "plate in space");
}

}  // namespace
