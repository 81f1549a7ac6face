// SPDX-License-Identifier: BSD-3-Clause
// Nodes in boxes, patches, partitions, and the search among boxes.
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

#include "all_types.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "mesh/box_tree.hpp"
#include "mesh/partition.hpp"
#include "mesh/selection.hpp"
#include "meshes.hpp"
#include "partitions.hpp"
#include "refused.hpp"

using namespace delam;
using namespace unit;

TEST(nodes_in_boxes) {
    const Mesh mesh = layers(CellType::quad4, {1.0}, {10}, {0.2, 0.2}, {2, 2});
    ck_assert_uint_eq(find_nodes(mesh, -1, Numbers{0, 0.2}, Numbers{1, 0.2}).size(), 22);
    ck_assert_uint_eq(find_nodes(mesh, 1, Numbers{0, 0.2}, Numbers{1, 0.2}).size(), 11);
    // Rounding: 0.3 is not a sum of tenths.
    ck_assert(find_nodes(mesh, 0, Numbers{0.3, 0.0}, Numbers{0.4, 0.0}) == (Indices{3, 4}));
    ck_assert(find_nodes(mesh, 0, Numbers{0.35, 0.0}, Numbers{0.36, 0.0}).empty());
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "axis 1", find_nodes(mesh, 0, Numbers{0, 1}, Numbers{1, 0}));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "body index 2", find_nodes(mesh, 2, Numbers{0, 0}, Numbers{1, 1}));
}

// Shape functions sum to one and reproduce linear fields: the weights and their first moments are those of the patch,
// wherever the box ends.
TEST(patches) {
    for (const CellType type : all_types) {
        const bool plane = topology(type).dimension == 2;
        const double top = 0.7;
        const Mesh mesh =
            layers(type, plane ? Numbers{2.0} : Numbers{2.0, 1.5}, plane ? Indices{7} : Indices{7, 5}, {top}, {3});
        const Numbers up = plane ? Numbers{0, 3} : Numbers{0, 0, 3};
        std::mt19937 random(2);
        std::uniform_real_distribution<double> point(0.0, 1.0);
        for (int trial = 0; trial < 50; ++trial) {
            Numbers low;
            Numbers high;
            double extent = 1.0;
            for (std::size_t i = 0; i + 1 < up.size(); ++i) {
                const double length = i == 0 ? 2.0 : 1.5;
                const auto [a, b] = std::minmax({point(random) * length, point(random) * length});
                low.push_back(trial == 0 ? -1.0 : a);
                high.push_back(trial == 0 ? 9.0 : b);
                extent *= trial == 0 ? length : b - a;
            }
            low.push_back(trial % 2 == 0 ? top : -5.0);  // a plane, or a box
            high.push_back(trial % 2 == 0 ? top : 5.0);
            const Patch patch = find_patch(mesh, 0, low, high, up);
            ck_assert(std::abs(sum(patch.weights) - extent) <= 1e-13);
            ck_assert(std::is_sorted(patch.nodes.begin(), patch.nodes.end()));
            for (std::size_t axis = 0; axis + 1 < up.size(); ++axis) {
                const double length = axis == 0 ? 2.0 : 1.5;
                const double middle = 0.5 * (std::max(low[axis], 0.0) + std::min(high[axis], length));
                double moment = 0.0;
                for (std::size_t k = 0; k < patch.nodes.size(); ++k)
                    moment += patch.weights[k] * mesh.node(patch.nodes[k])[axis];
                ck_assert(std::abs(moment - middle * extent) <= 1e-13);
            }
            for (std::size_t k = 0; k < patch.nodes.size(); ++k) {
                ck_assert(patch.weights[k] > 0.0 || quadratic(type));
                ck_assert(mesh.node(patch.nodes[k]).back() == top);
            }
        }
        ck_assert(find_patch(mesh, 0, Numbers{-9, -9, 5}, Numbers{9, plane ? -1.0 : 9.0, 9}, up).nodes.empty());
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "direction",
                          find_patch(mesh, 0, Numbers{0, 0, 0}, Numbers{1, 1, 1}, Numbers(up.size(), 0.0)));
        // A box that ends on nodes takes nothing of the faces beyond, whatever the rounding.
        const Patch aligned = find_patch(mesh, 0, Numbers{2.0 * 3 / 7, -1, -1}, Numbers{2.0 * (4.0 / 7), 9, 9}, up);
        for (const std::int64_t n : aligned.nodes) ck_assert(mesh.node(n)[0] > 0.8 && mesh.node(n)[0] < 1.2);
    }
    // On quadrilaterals no corner is preferred: a full square face gives a quarter each.
    const Mesh cube = layers(CellType::hex8, {1, 1}, {1, 1}, {1}, {1});
    const Patch face = find_patch(cube, 0, Numbers{-1, -1, -1}, Numbers{2, 2, 2}, Numbers{0, 0, 1});
    for (const double w : face.weights) ck_assert(std::abs(w - 0.25) <= 1e-15);
    // 45 degrees belong to both directions.
    const Numbers roof{0, 0, 1, 0, 0, 1};
    Mesh triangle(2, roof);
    triangle.add_cells(CellType::tri3, Indices{0, 1, 2}, {});
    for (const Numbers& direction : {Numbers{1, 0}, Numbers{0, 1}})
        ck_assert(std::abs(sum(find_patch(triangle, 0, Numbers{0, 0}, Numbers{1, 1}, direction).weights) -
                           std::sqrt(2.0)) < 1e-14);
    const Patch oblique = find_patch(triangle, 0, Numbers{0.25, 0.0}, Numbers{1.0, 0.5}, Numbers{1, 1});
    ck_assert(std::abs(sum(oblique.weights) - 0.5 * std::sqrt(2.0)) < 1e-14);
}

// All numbers of parts for each type are in the long tier.
TEST(partitions) {
    std::array<std::int64_t, 2> shares{};  // in space, in the plane
    for (const CellType type : all_types) {
        // Every number in the plane and in space; for each type the small ones and every fourth.
        const std::int64_t share = shares[topology(type).dimension == 2 ? 1 : 0]++ % 4;
        unit::check_partitions(
            type, [&](std::int64_t n) { return n <= 8 || n == 16 || n == 64 || n % 4 == share; },
            [&](std::int64_t n) { return n % 8 == share; });
    }
    // Down to single cells.
    const Mesh tiny = layers(CellType::tri3, {1}, {4}, {1}, {2});
    for (std::int64_t n = 1; n <= tiny.cell_count(); ++n) {
        const Partition parts = partition(tiny, n);
        ck_assert_uint_eq(parts.subdomain_body.size(), at(n));
        unit::check_partition(tiny, unit::cell_faces(tiny), parts);
    }
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "subdomains 17: must be in 0..16", partition(tiny, 17));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "subdomains -1", partition(tiny, -1));
}

// Two squares of one body that share a node, and one far away: at least three subdomains.
TEST(parts_that_touch_in_a_node) {
    const Numbers nodes{0, 0, 1, 0, 1, 1, 0, 1, 2, 1, 2, 2, 1, 2, 5, 5, 6, 5, 6, 6, 5, 6};
    Mesh mesh(2, nodes);
    mesh.add_cells(CellType::quad4, Indices{0, 1, 2, 3, 2, 4, 5, 6, 7, 8, 9, 10}, {});
    const Partition parts = partition(mesh, 1);
    ck_assert_uint_eq(parts.subdomain_body.size(), 3);
    unit::check_partition(mesh, unit::cell_faces(mesh), parts);
}

static void host_handler(int) {}

TEST(host_is_left_alone) {
    const Mesh mesh = layers(CellType::quad4, {4.0}, {60}, {1, 0.5}, {10, 5});
    std::srand(42);
    std::array<int, 12> expected{};
    for (int& r : expected) r = std::rand();
    std::srand(42);
    std::array<int, 12> found{};
    for (std::size_t i = 0; i < 5; ++i) found[i] = std::rand();
    const Partition before = partition(mesh, 12);
    for (std::size_t i = 5; i < 12; ++i) found[i] = std::rand();
    ck_assert(found == expected);
    std::srand(4711);  // the host's random sequence must not affect the partition either
    ck_assert(partition(mesh, 12).cell_subdomain == before.cell_subdomain);

    struct sigaction own {};
    own.sa_handler = host_handler;
    own.sa_flags = SA_RESTART;
    sigemptyset(&own.sa_mask);
    sigaddset(&own.sa_mask, SIGUSR1);
    for (const int signal : {SIGABRT, SIGTERM}) sigaction(signal, &own, nullptr);
    partition(mesh, 12);
    for (const int signal : {SIGABRT, SIGTERM}) {
        struct sigaction now {};
        sigaction(signal, nullptr, &now);
        ck_assert(now.sa_handler == host_handler);
        ck_assert((now.sa_flags & SA_RESTART) != 0 && sigismember(&now.sa_mask, SIGUSR1) == 1);
    }
}

TEST(box_search) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> point(0.0, 1.0);
    const auto draw = [&] { return Point{point(random), point(random), point(random)}; };
    std::vector<Box> boxes;
    for (int i = 0; i < 500; ++i) {
        const Point p = draw();
        boxes.push_back({p, {p[0] + 0.2 * point(random), p[1] + 0.2 * point(random), p[2] + 0.2 * point(random)}});
    }
    const BoxTree tree(boxes);
    for (int i = 0; i < 300; ++i) {
        const Point p = draw();
        std::set<std::int64_t> expected;
        std::pair best{1e9, std::int64_t{-1}};
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            double d[3];
            for (std::size_t a = 0; a < 3; ++a) d[a] = std::max({boxes[k].low[a] - p[a], p[a] - boxes[k].high[a], 0.0});
            const double distance = std::hypot(d[0], d[1], d[2]);
            if (distance == 0.0) expected.insert(static_cast<std::int64_t>(k));
            best = std::min(best, {distance, static_cast<std::int64_t>(k)});
        }
        std::set<std::int64_t> found;
        tree.containing(p, [&](std::int64_t k) { found.insert(k); });
        ck_assert(found == expected);
        const BoxTree::Nearest nearest = tree.nearest(p);
        ck_assert(nearest.index == best.second && nearest.distance == best.first);
        if (best.first > 0.0) ck_assert(tree.nearest(p, 0.99 * best.first).index == -1);
    }
    ck_assert(BoxTree({}).nearest(draw()).index == -1);
}
