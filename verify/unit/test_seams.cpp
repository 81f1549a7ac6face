// SPDX-License-Identifier: BSD-3-Clause
// Outer faces that lie on each other without an interface are found: within a body, between bodies whose meshes match
// or not; none where pairs join them.
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "all_types.hpp"
#include "check.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/pairing/seams.hpp"
#include "projection.hpp"

using namespace delam;
using namespace unit;

namespace {

// The same blocks as one body.
Mesh as_one(const Mesh& mesh) {
    Mesh one(mesh.dimension(), [&] {
        Numbers nodes;
        for (std::int64_t n = 0; n < mesh.node_count(); ++n)
            nodes.insert(nodes.end(), mesh.node(n).begin(), mesh.node(n).end());
        return nodes;
    }());
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        one.add_cells(mesh.cell_type(c), Indices(mesh.cell(c).begin(), mesh.cell(c).end()), Labels{5});
    return one;
}

TEST(within_and_between) {
    for (const CellType type : all_types) {
        const auto dim = index(topology(type).dimension);
        const bool triangles = topology(type).corners_of(topology(type).face[0]).size() == 3;
        for (const std::int64_t upper : {2, 3}) {
            auto list = stack(type, type, 2, upper);
            if (dim == 3) list[0].divisions[1] = 3, list[1].divisions[1] = upper + 1;
            const Mesh two = blocks(list);
            const std::int64_t faces = dim == 2 ? 2 + upper : (triangles ? 2 : 1) * (2 * 3 + upper * (upper + 1));
            for (const Mesh& mesh : {two, as_one(two)}) {
                const auto seams = find_seams(mesh);
                ck_assert_uint_eq(seams.size(), 1);
                ck_assert_int_eq(seams[0].faces, faces);
                ck_assert_int_eq(seams[0].other - seams[0].body, mesh.body_count() - 1);
                ck_assert(std::abs(seams[0].box.low[dim - 1] - 0.5) < 1e-12 && seams[0].box.low[0] > 0.0 &&
                          seams[0].box.high[0] < 1.0);
            }
            for (const auto& join : {add_projected_interface, add_mortar_interface}) {
                Mesh joined = two;
                join(joined, 0, 1, 0.0);
                ck_assert(find_seams(joined).empty());
            }
        }
    }
}

// Faces apart, faces back to back of a thin body, and bodies that join at a corner are no seams.
TEST(others) {
    auto list = stack(CellType::quad4, CellType::quad4, 2, 2);
    list[1].corner[1] += 1e-4;
    ck_assert(find_seams(blocks(list)).empty());
    list = stack(CellType::quad4, CellType::quad4, 2, 2);
    list[1].corner[0] += 1.0;
    ck_assert(find_seams(blocks(list)).empty());
}

// A seam within a body becomes an interface with the pairs, weights and faces of one between two bodies.
TEST(joined) {
    for (const CellType type : all_types) {
        const auto dim = index(topology(type).dimension);
        auto list = stack(type, type, 2, 2);
        if (dim == 3) list[0].divisions[1] = list[1].divisions[1] = 3;
        Mesh two = blocks(list), one = as_one(two);
        add_interface(two, 0, 1, 0.0);
        ck_assert_int_eq(add_seams(one, 0.0), 1);
        ck_assert_int_eq(add_seams(one, 0.0), 0);
        ck_assert(find_seams(one).empty());
        const InterfaceGeometry &a = two.interfaces()[0], &b = one.interfaces()[0];
        ck_assert_int_eq(b.body_a, b.body_b);
        ck_assert_int_eq(a.pair_count(), b.pair_count());
        ck_assert_int_eq(a.face_count(), b.face_count());
        for (std::size_t p = 0; p < a.weight.size(); ++p) {
            ck_assert(std::abs(a.weight[p] - b.weight[p]) < 1e-14);
            ck_assert_int_eq(a.node_a[p] + a.node_b[p], b.node_a[p] + b.node_b[p]);
            for (std::size_t k = 0; k < dim; ++k) {
                const double turned = a.node_a[p] == b.node_a[p] ? 1.0 : -1.0;
                ck_assert(std::abs(a.frame[p * dim * dim + k] - turned * b.frame[p * dim * dim + k]) < 1e-14);
            }
        }
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "tolerance", add_seams(one, 0.5));
    }
    // A closed seam around a core that a branch divides: a node of one side has two partners. Nodes of cells are
    // doubled wherever cells do not belong together.
    const auto core = [](std::int64_t i, std::int64_t j) {
        return i < 1 || i > 2 || j < 1 || j > 2 ? 0 : j == 1 ? 1 : 2;
    };
    std::map<std::array<std::int64_t, 3>, std::int64_t> number;
    Numbers nodes;
    Indices cells;
    for (std::int64_t j = 0; j < 4; ++j)
        for (std::int64_t i = 0; i < 4; ++i)
            for (const auto& [x, y] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
                const auto [at, added] = number.emplace(std::array{x, y, std::int64_t{core(i, j)}},
                                                        static_cast<std::int64_t>(number.size()));
                if (added) nodes.insert(nodes.end(), {static_cast<double>(x), static_cast<double>(y)});
                cells.push_back(at->second);
            }
    Mesh branched(2, nodes);
    branched.add_cells(CellType::quad4, cells, Labels(16, 7));
    const std::int64_t arms = add_seams(branched, 0.0);
    ck_assert_int_ge(arms, 1);
    double length = 0.0;
    for (const InterfaceGeometry& i : branched.interfaces())
        for (const double weight : i.weight) length += weight;
    ck_assert(std::abs(length - 10.0) < 1e-12);
    ck_assert(find_seams(branched).empty());
    // Three faces at one place.
    auto list = stack(CellType::quad4, CellType::quad4, 2, 2);
    list.push_back(list[1]);
    Mesh thrice = as_one(blocks(list));
    ck_assert_refused(DELAM_ERROR_MESH, "lie on each other", add_seams(thrice, 0.0));
}

// Walls of one body that face each other at a distance get the interface of two bodies.
TEST(self_contact) {
    for (const CellType type : all_types)
        for (const std::int64_t upper : {2, 3}) {
            const auto dim = index(topology(type).dimension);
            auto list = stack(type, type, 2, upper);
            list[1].corner[dim - 1] += 0.1;
            Mesh two = blocks(list), one = as_one(two);
            ck_assert_int_eq(add_self_contact(one, 0.09), 0);
            ck_assert_int_eq(add_self_contact(one, 0.11), 1);
            ck_assert_int_eq(add_self_contact(one, 0.11), 0);
            add_mortar_interface(two, 0, 1, 0.11);
            const InterfaceGeometry &a = two.interfaces()[0], &b = one.interfaces()[0];
            ck_assert_int_eq(b.body_a, b.body_b);
            ck_assert(a.node_a == b.node_a && a.node_b == b.node_b && a.weight == b.weight && a.frame == b.frame);
            ck_assert(a.reach == b.reach);
            for (std::size_t t = 0; t < two.ties().size(); ++t) ck_assert(two.ties()[t].of == one.ties()[t].of);
        }
    Mesh any = as_one(blocks(stack(CellType::quad4, CellType::quad4, 2, 2)));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "gap = 0", add_self_contact(any, 0.0));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "gap = inf",
                      add_self_contact(any, std::numeric_limits<double>::infinity()));
}

// A body of cells of a grid, its nodes moved by a map.
Mesh of_cells(std::int64_t columns, std::int64_t rows, const std::function<bool(std::int64_t, std::int64_t)>& wanted,
              const std::function<std::array<double, 2>(double, double)>& map) {
    Numbers nodes;
    for (std::int64_t j = 0; j <= rows; ++j)
        for (std::int64_t i = 0; i <= columns; ++i)
            for (const double x : map(static_cast<double>(i), static_cast<double>(j))) nodes.push_back(x);
    Indices cells;
    std::int64_t count = 0;
    for (std::int64_t j = 0; j < rows; ++j)
        for (std::int64_t i = 0; i < columns; ++i) {
            if (!wanted(i, j)) continue;
            const std::int64_t first = j * (columns + 1) + i;
            cells.insert(cells.end(), {first, first + 1, first + columns + 2, first + columns + 1});
            ++count;
        }
    Mesh mesh(2, nodes);
    mesh.add_cells(CellType::quad4, cells, Labels(index(count), 3));
    return mesh;
}

double length_of(const Mesh& mesh) {
    double length = 0.0;
    for (const InterfaceGeometry& i : mesh.interfaces())
        for (const double weight : i.weight) length += weight;
    return length;
}

TEST(walls) {
    const auto same = [](double x, double y) { return std::array{x, y}; };
    // A slot of two cells: its walls face each other, its end nothing.
    const auto slot = [](std::int64_t i, std::int64_t j) { return j != 1 || i < 2; };
    Mesh slotted = of_cells(4, 3, slot, same);
    ck_assert_int_eq(add_self_contact(slotted, 0.99), 0);
    ck_assert_int_eq(add_self_contact(slotted, 1.01), 1);
    ck_assert_double_eq_tol(length_of(slotted), 2.0, 1e-12);
    // Two slots: the tongue between them has two walls.
    Mesh twice = of_cells(
        4, 5, [](std::int64_t i, std::int64_t j) { return j % 2 == 0 || i < 1; }, same);
    ck_assert_int_eq(add_self_contact(twice, 1.01), 2);
    ck_assert_double_eq_tol(length_of(twice), 6.0, 1e-12);
    // A thin strip does not face itself, nor do neighbours around a corner.
    Mesh strip = of_cells(
        6, 1, [](std::int64_t, std::int64_t) { return true; },
        [](double x, double y) {
            return std::array{x, 0.01 * y};
        });
    ck_assert_int_eq(add_self_contact(strip, 0.5), 0);
    // Walls that see each other at their ends alone, at 29 degrees: nothing of one lies on the other.
    auto staggered = stack(CellType::quad4, CellType::quad4, 2, 2);
    staggered[1].corner = {1.055, 0.6};
    Mesh apart = as_one(blocks(staggered));
    ck_assert_int_eq(add_self_contact(apart, 0.2), 0);
    // A ring that is not closed, with its ends before each other.
    constexpr std::int64_t around = 24;
    const auto ring = [](double x, double y) {
        const double phi = 0.05 + x / static_cast<double>(around) * (2.0 * 3.14159265358979 - 0.1), r = 2.0 - 0.5 * y;
        return std::array{r * std::cos(phi), r * std::sin(phi)};
    };
    Mesh open_ring = of_cells(
        around, 1, [](std::int64_t, std::int64_t) { return true; }, ring);
    ck_assert_int_eq(add_self_contact(open_ring, 0.3), 1);
    ck_assert_double_eq_tol(length_of(open_ring), 0.5, 1e-12);
    // A gap as wide as the ring itself: its inner side is one wall, bent back.
    Mesh bent = of_cells(
        around, 1, [](std::int64_t, std::int64_t) { return true; }, ring);
    ck_assert_refused(DELAM_ERROR_MESH, "faces itself", add_self_contact(bent, 3.2));
    ck_assert(bent.interfaces().empty() && bent.ties().empty());
}

}  // namespace
