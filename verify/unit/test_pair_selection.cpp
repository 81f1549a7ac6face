// SPDX-License-Identifier: BSD-3-Clause
// Pairs in a box against a rule for blocks, which knows where the interface ends and uses no face.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include "all_types.hpp"
#include "check.hpp"
#include "mesh/layers.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/selection.hpp"

using namespace delam;

namespace {

using Numbers = std::vector<double>;
using Indices = std::vector<std::int64_t>;

constexpr double length = 2.0, width = 1.5, height = 0.4;

Mesh block(CellType type, std::int64_t nx, std::int64_t ny) {
    const int dimension = topology(type).dimension;
    const Numbers lengths = dimension == 2 ? Numbers{length} : Numbers{length, width};
    const Indices divisions = dimension == 2 ? Indices{nx} : Indices{nx, ny};
    const Numbers thickness{height, height};
    const Indices through{1, 1};
    Mesh mesh = make_layers(dimension, lengths, divisions, thickness, through, type);
    add_interface(mesh, 0, 1, 0.0);
    return mesh;
}

double place(const Mesh& mesh, std::int64_t pair, std::size_t axis) {
    return mesh.node(mesh.interfaces()[0].node_b[static_cast<std::size_t>(pair)])[axis];
}

bool in_block(double x, double lower, double upper, double end) {
    constexpr double slack = 1e-9;
    const bool from = lower <= slack ? x >= lower - slack : x > lower + slack;
    const bool to = upper >= end - slack ? x <= upper + slack : x < upper - slack;
    return from && to;
}

// Ends at pairs and elsewhere, within the interface and beyond it; boxes high, low and flat.
TEST(boxes_of_blocks) {
    std::mt19937 random(5);
    std::size_t found = 0, at_tips = 0;
    for (const CellType type : all_types) {
        const Mesh mesh = block(type, 7, 5);
        const auto axes = static_cast<std::size_t>(topology(type).dimension) - 1;
        const Numbers ends{length, width}, cells{7.0, 5.0};
        std::uniform_int_distribution<int> step(-2, 16);
        for (int trial = 0; trial < 200; ++trial) {
            Numbers lower, upper;
            for (std::size_t axis = 0; axis < axes; ++axis) {
                // Half cells: pairs of quadratic cells lie there as well, of linear ones between.
                int a = step(random), b = step(random);
                if (a > b) std::swap(a, b);
                lower.push_back(ends[axis] / cells[axis] * 0.5 * a);
                upper.push_back(ends[axis] / cells[axis] * 0.5 * b);
            }
            const double off = trial % 3 == 0 ? 0.0 : 0.1 * trial;
            lower.push_back(height - off);
            upper.push_back(height + off);
            Indices expected;
            for (std::int64_t p = 0; p < mesh.interfaces()[0].pair_count(); ++p) {
                bool in = true;
                for (std::size_t axis = 0; axis < axes; ++axis) {
                    in = in && in_block(place(mesh, p, axis), lower[axis], upper[axis], ends[axis]);
                    if (std::abs(place(mesh, p, axis) - upper[axis]) < 1e-9 && upper[axis] < ends[axis] - 1e-9)
                        ++at_tips;
                }
                if (in) expected.push_back(p);
            }
            const PairsInBox box = find_pairs(mesh, 0, lower, upper);
            ck_assert(box.pairs == expected);
            found += expected.size();
        }
    }
    ck_assert(found > 10000 && at_tips > 1000);
}

// The pairs beyond the ends of a box: none where the ends lie on pairs or beyond the interface, else the next pair
// outside.
TEST(ends_between_pairs) {
    for (const CellType type : {CellType::quad4, CellType::quad8}) {
        const Mesh mesh = block(type, 8, 0);  // pairs at multiples of 0.25, or 0.125
        const double spacing = type == CellType::quad4 ? 0.25 : 0.125;
        ck_assert(find_pairs(mesh, 0, Numbers{0.5, 0.0}, Numbers{1.0, 1.0}).moved.empty());
        ck_assert(find_pairs(mesh, 0, Numbers{-1.0, 0.0}, Numbers{9.0, 1.0}).moved.empty());
        ck_assert(find_pairs(mesh, 0, Numbers{0.0, 5.0}, Numbers{0.6, 6.0}).moved.empty());
        const auto moved = find_pairs(mesh, 0, Numbers{0.45, 0.0}, Numbers{1.05, 1.0}).moved;
        ck_assert_uint_eq(moved.size(), 2);
        ck_assert(!moved[0].upper && moved[0].axis == 0 && moved[0].end == 0.45);
        ck_assert_double_eq_tol(moved[0].next, 0.5 - spacing, 1e-12);
        ck_assert(moved[1].upper && moved[1].axis == 0 && moved[1].end == 1.05);
        ck_assert_double_eq_tol(moved[1].next, 1.0 + spacing, 1e-12);
    }
    const Mesh plate = block(CellType::hex8, 8, 3);
    const auto moved = find_pairs(plate, 0, Numbers{0.0, 0.0, 0.0}, Numbers{0.5, 0.7, 1.0}).moved;
    ck_assert_uint_eq(moved.size(), 1);
    ck_assert(moved[0].upper && moved[0].axis == 1);
    ck_assert_double_eq_tol(moved[0].next, 1.0, 1e-12);
}

// Without faces the ends of the interface are those of all its pairs.
TEST(pairs_without_faces) {
    const Numbers nodes{0, 0, 1, 0, 2, 0, 3, 0, 0, 0, 1, 0, 2, 0, 3, 0};
    Mesh mesh(2, nodes);
    const Indices a{0, 1, 2, 3}, b{4, 5, 6, 7};
    mesh.add_host_body(0, a);
    mesh.add_host_body(1, b);
    add_pairs(mesh, 0, 1, a, b, Numbers{0, 1, 0, 1, 0, 1, 0, 1}, Numbers{0.5, 1, 1, 0.5}, 0, {});
    ck_assert(find_pairs(mesh, 0, Numbers{0, 0}, Numbers{2, 0}).pairs == (Indices{0, 1}));
    ck_assert(find_pairs(mesh, 0, Numbers{1, -1}, Numbers{3, 1}).pairs == (Indices{2, 3}));
    ck_assert(find_pairs(mesh, 0, Numbers{0, -1}, Numbers{3, 0}).pairs == (Indices{0, 1, 2, 3}));
}

}  // namespace
