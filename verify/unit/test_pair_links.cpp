// SPDX-License-Identifier: BSD-3-Clause
// Links of pairs on quadratic faces: their sums are int grad f dA, exactly where f is linear, and of a step of f they
// are the length of its front.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "check.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/points.hpp"
#include "mesh/rule/pair_links.hpp"
#include "meshes.hpp"

using namespace delam;
using namespace unit;

namespace {

constexpr CellType quadratic_cells[] = {CellType::tet10, CellType::hex20, CellType::wedge15, CellType::hex27};

Mesh bonded(CellType type, Numbers lengths, Indices divisions, const std::function<void(std::span<double>)>& map = {}) {
    Mesh mesh = rebuilt(layers(type, lengths, divisions, {0.5, 0.5}, {1, 1}), 0, map);
    add_interface(mesh, 0, 1, 0.0);
    return mesh;
}

// int grad f dA by the links.
Point gradient(const Mesh& mesh, const std::function<double(const Point&)>& f) {
    const InterfaceGeometry& i = mesh.interfaces()[0];
    const auto at_pair = [&](std::int64_t p) { return f(position(mesh, i.node_b[at(p)])); };
    Point sum{};
    for (const PairLink& link : pair_links(mesh, i))
        for (std::size_t k = 0; k < 3; ++k) sum[k] += link.area[k] * (at_pair(link.to) - at_pair(link.from));
    return sum;
}

double linear(const Point& x) { return 2.0 * x[0] - 3.0 * x[1] + 1.0; }

TEST(linear_fields_on_quadrilaterals_of_any_shape) {
    const auto skew = [](std::span<double> x) {
        x[0] += 0.35 * x[1] + 0.1 * x[0] * x[1];
        x[1] -= 0.2 * x[0] * x[1];
    };
    const auto curved = [](std::span<double> x) {
        x[0] += 0.06 * std::sin(5.0 * x[1] + 0.3);
        x[1] += 0.05 * std::sin(4.0 * x[0] + 0.7);
    };
    for (const CellType type : {CellType::hex20, CellType::hex27})
        for (const std::int64_t n : {2, 3})
            for (const auto& map : {std::function<void(std::span<double>)>(skew), {curved}}) {
                const Mesh mesh = bonded(type, {1, 1}, {n, n}, map);
                const double area = sum(mesh.interfaces()[0].weight);
                const Point g = gradient(mesh, linear);
                ck_assert(std::abs(g[0] - 2.0 * area) < 1e-13 && std::abs(g[1] + 3.0 * area) < 1e-13);
                ck_assert(std::abs(g[2]) < 1e-13);
            }
}

// A triangle with two sides on the rim has a corner whose links, and a middle of a side whose link, have one direction.
// The sum misses the share of these triangles.
TEST(triangles_at_corners_count_in_one_direction) {
    for (const CellType type : {CellType::tet10, CellType::wedge15}) {
        double before = 0.0;
        for (const std::int64_t n : {3, 6, 12}) {
            const Point g = gradient(bonded(type, {1, 1}, {n, n}), linear);
            const double missed = std::hypot(g[0] - 2.0, g[1] + 3.0);
            std::printf("%s, %d x %d: %.2e missed\n", topology(type).name, int(n), int(n), missed);
            ck_assert(missed < 0.06 * std::hypot(2.0, 3.0) * 9.0 / double(n * n));
            if (before > 0.0) ck_assert(std::abs(before / missed - 4.0) < 1e-6);
            before = missed;
        }
    }
}

// Fronts that are one and a half cells and more from the ends of the interface, where links go to one side only.
TEST(a_step_has_the_length_of_its_front) {
    for (const CellType type : quadratic_cells)
        for (const std::int64_t n : {3, 5})
            for (const double front : {0.55, 0.95, 1.05, 1.3}) {
                const Mesh mesh = bonded(type, {2, 1}, {2 * n, n});
                const Point g = gradient(mesh, [&](const Point& x) { return x[0] < front ? 0.0 : 1.0; });
                ck_assert_msg(std::abs(g[0] - 1.0) < 1e-12, "%s, %d cells, front at %g: %.15g", topology(type).name,
                              int(n), front, g[0]);
                ck_assert(std::abs(g[1]) < 1e-12 && std::abs(g[2]) < 1e-12);
            }
}

TEST(linear_faces_have_none) {
    for (const CellType type : {CellType::hex8, CellType::tet4}) {
        const Mesh mesh = bonded(type, {1, 1}, {2, 2});
        ck_assert(pair_links(mesh, mesh.interfaces()[0]).empty());
    }
}

}  // namespace
