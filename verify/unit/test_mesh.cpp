// SPDX-License-Identifier: BSD-3-Clause
// Meshes and interfaces against counts and integrals known beforehand.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "all_types.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/selection.hpp"
#include "meshes.hpp"
#include "refused.hpp"

using namespace delam;
using namespace unit;

namespace {

// Nodes in a box of n[0] x n[1] (x n[2]) boxes of a block, faces and edges shared.
std::int64_t lattice_nodes(CellType type, std::vector<std::int64_t> n) {
    std::int64_t corners = 1;
    std::int64_t all = 1;
    for (const std::int64_t k : n) {
        corners *= k + 1;
        all *= 2 * k + 1;
    }
    if (type == CellType::pyramid5) return corners + (n.size() == 2 ? 0 : n[0] * n[1] * n[2]);
    if (!quadratic(type)) return corners;
    if (type == CellType::wedge15 && n.size() == 3)  // the levels of the triangles, and those between
        return (n[2] + 1) * (2 * n[0] + 1) * (2 * n[1] + 1) + n[2] * (n[0] + 1) * (n[1] + 1);
    if (type != CellType::quad8 && type != CellType::hex20) return all;
    std::int64_t edges = 0;  // each along one axis, between corners in the other directions
    for (const std::int64_t k : n) edges += corners / (k + 1) * k;
    return corners + edges;
}

void check_frames(const Mesh& mesh, const InterfaceGeometry& i) {
    const std::size_t dim = at(mesh.dimension());
    for (std::size_t p = 0; p < i.node_a.size(); ++p) {
        const double* f = &i.frame[p * dim * dim];
        for (std::size_t r = 0; r < dim; ++r)
            for (std::size_t s = 0; s < dim; ++s) {
                double product = 0.0;
                for (std::size_t k = 0; k < dim; ++k) product += f[r * dim + k] * f[s * dim + k];
                ck_assert(std::abs(product - (r == s ? 1.0 : 0.0)) <= 1e-15 * 4);
            }
        if (dim == 3)
            ck_assert(f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) +
                          f[2] * (f[3] * f[7] - f[4] * f[6]) >
                      0.99);
    }
}

}  // namespace

// The arms of the published ENF and MMF meshes: 120 mm x 3 mm in square cells.
TEST(two_arms) {
    const struct {
        double h;
        std::int64_t along, through;
    } cases[] = {{1e-3, 121, 4}, {0.75e-3, 161, 5}, {0.5e-3, 241, 7}};
    for (const auto& c : cases) {
        Mesh mesh = layers(CellType::quad4, {0.12}, {c.along - 1}, {3e-3, 3e-3}, {c.through - 1, c.through - 1});
        ck_assert_int_eq(mesh.body_count(), 2);
        for (std::int32_t b = 0; b < 2; ++b) ck_assert_uint_eq(mesh.body_nodes(b).size(), at(c.along * c.through));
        ck_assert_int_eq(add_interface(mesh, 0, 1, 0.0), 0);
        const InterfaceGeometry& i = mesh.interfaces()[0];
        ck_assert_int_eq(i.pair_count(), c.along);
        ck_assert_int_eq(i.face_count(), c.along - 1);
        ck_assert_int_eq(i.body_a, 0);
        ck_assert_int_eq(i.body_b, 1);
        ck_assert(std::abs(sum(i.weight) - 0.12) <= 1e-15);
        for (std::size_t p = 0; p < i.weight.size(); ++p) {
            const double expected = p == 0 || p + 1 == i.weight.size() ? c.h / 2.0 : c.h;
            ck_assert(std::abs(i.weight[p] - expected) <= 1e-12 * c.h);
            const double frame[] = {0, 1, 1, 0};
            ck_assert(std::equal(frame, frame + 4, &i.frame[4 * p]));
            ck_assert(std::abs(mesh.node(i.node_a[p])[0] - c.h * static_cast<double>(p)) <= 1e-15);
            ck_assert(mesh.node(i.node_a[p])[1] == 3e-3 && mesh.node(i.node_b[p])[1] == 3e-3);
            ck_assert_int_eq(mesh.node_body(i.node_a[p]), 0);
            ck_assert_int_eq(mesh.node_body(i.node_b[p]), 1);
        }
    }
}

TEST(layered_blocks) {
    for (const CellType type : all_types) {
        const bool plane = topology(type).dimension == 2;
        const Numbers lengths = plane ? Numbers{2.0} : Numbers{2.0, 1.5};
        const Indices divisions = plane ? Indices{5} : Indices{5, 4};
        Mesh mesh = layers(type, lengths, divisions, {0.3, 0.1, 0.2}, {2, 1, 3});
        const std::int64_t boxes = plane ? 5 : 20;
        const auto nodes_of = [&](std::int64_t through) {
            return lattice_nodes(type, plane ? Indices{5, through} : Indices{5, 4, through});
        };
        // Nodes on one level: hex20 has there what quad8 has in the plane, and tet10 a full lattice.
        const std::int64_t level = plane ? (quadratic(type) ? 11 : 6)
                                         : lattice_nodes(type == CellType::hex20 ? CellType::quad8 : type, {5, 4});
        ck_assert_int_eq(mesh.node_count(), nodes_of(2) + nodes_of(1) + nodes_of(3));
        ck_assert_int_eq(mesh.cell_count(), boxes * cells_per_box(type) * (2 + 1 + 3));
        ck_assert_int_eq(mesh.body_count(), 3);
        ck_assert(mesh.size() == 2.0);
        // x fastest, the last axis slowest
        ck_assert(mesh.node(1)[0] == (quadratic(type) ? 0.2 : 0.4) && mesh.node(1)[1] == 0.0);
        const bool centres = type == CellType::pyramid5;
        ck_assert(mesh.node(level)[0] == (centres ? 0.2 : 0.0));
        ck_assert(std::abs(mesh.node(level)[plane ? 1 : 2] - (quadratic(type) || centres ? 0.075 : 0.15)) < 1e-15);
        // Boundary: closed, of the right extent.
        for (std::int32_t b = 0; b < 3; ++b) {
            const Numbers box{2.0, plane ? std::array{0.3, 0.1, 0.2}[at(b)] : 1.5, std::array{0.3, 0.1, 0.2}[at(b)]};
            const double extent =
                plane ? 2.0 * (box[0] + box[1]) : 2.0 * (box[0] * box[1] + box[1] * box[2] + box[2] * box[0]);
            double found = 0.0;
            for (std::size_t axis = 0; axis < lengths.size() + 1; ++axis)
                for (const double sign : {-1.0, 1.0}) {
                    Numbers direction(lengths.size() + 1, 0.0);
                    direction[axis] = sign;
                    found += sum(find_patch(mesh, b, Numbers{-9, -9, -9}, Numbers{9, 9, 9}, direction).weights);
                }
            ck_assert(std::abs(found - extent) <= 1e-14 * extent);
        }
        ck_assert_int_eq(add_interface(mesh, 0, 1, 0.0), 0);
        ck_assert_int_eq(add_interface(mesh, 2, 1, 0.0), 1);
        const InterfaceGeometry& up = mesh.interfaces()[0];
        const InterfaceGeometry& down = mesh.interfaces()[1];
        for (const InterfaceGeometry* i : {&up, &down}) {
            ck_assert_int_eq(i->pair_count(), level);
            ck_assert_int_eq(i->face_count(), triangles(type) ? 2 * boxes : boxes);
            ck_assert_int_eq(i->nodes_per_face, static_cast<int>(topology(type).face[0].nodes));
            ck_assert(std::abs(sum(i->weight) - (plane ? 2.0 : 3.0)) <= 1e-14);
            ck_assert(*std::min_element(i->weight.begin(), i->weight.end()) > 0.0);
            check_frames(mesh, *i);
            for (std::int64_t p = 1; p < level; ++p) {
                const auto x = mesh.node(i->node_a[at(p - 1)]);
                const auto y = mesh.node(i->node_a[at(p)]);
                ck_assert(std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end()));
            }
        }
        // Body 2 lies above body 1, so the normal from 2 to 1 points down.
        ck_assert(up.frame[plane ? 1 : 2] == 1.0 && down.frame[plane ? 1 : 2] == -1.0);
        if (!plane) {
            const double frame[] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
            ck_assert(std::equal(frame, frame + 9, up.frame.begin()));
        }
    }
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "thickness[1]", layers(CellType::quad4, {1}, {1}, {1, 0}, {1, 1}));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "divisions[0] 0", layers(CellType::quad4, {1}, {0}, {1}, {1}));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "3D block",
                      make_layers(3, Numbers{1, 1}, Indices{1, 1}, Numbers{1}, Indices{1}, CellType::quad4));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "nodes: at most",
                      layers(CellType::hex8, {1, 1}, {100000, 100000}, {1}, {1}));
}

// The host decides the order of nodes and cells: in space the pairs are the same, bit for bit, even where rounding has
// moved the nodes of the two sides a little and the interface is vertical.
TEST(shuffled_nodes) {
    for (const CellType type : all_types) {
        const bool plane = topology(type).dimension == 2;
        const Mesh plain = layers(type, plane ? Numbers{2.0} : Numbers{2.0, 1.5}, plane ? Indices{9} : Indices{5, 4},
                                  {0.3, 0.2}, {2, 1});
        std::mt19937 random(11);
        std::uniform_real_distribution<double> jitter(-1e-9, 1e-9);
        Numbers noise(plain.nodes().size());
        const auto upright = [](std::span<double> x) {
            std::swap(x[0], x.back());
            x[0] = -x[0];
        };
        Mesh first = rebuilt(plain, 0, upright);
        Mesh second = rebuilt(plain, 5, upright);
        Mesh third = rebuilt(plain, 6, [&](std::span<double> x) {
            upright(x);
            for (double& v : x) v += jitter(random);
        });
        for (Mesh* mesh : {&first, &second, &third}) add_interface(*mesh, 0, 1, 0.0);
        const InterfaceGeometry& a = first.interfaces()[0];
        const InterfaceGeometry& b = second.interfaces()[0];
        const InterfaceGeometry& c = third.interfaces()[0];
        ck_assert(a.weight == b.weight && a.frame == b.frame && a.face == b.face);
        ck_assert(a.face == c.face);
        ck_assert_int_eq(c.pair_count(), a.pair_count());
        for (std::size_t p = 0; p < a.node_a.size(); ++p) {
            ck_assert(std::ranges::equal(first.node(a.node_a[p]), second.node(b.node_a[p])));
            ck_assert(std::ranges::equal(first.node(a.node_b[p]), second.node(b.node_b[p])));
            for (std::size_t k = 0; k < at(first.dimension()); ++k) {
                ck_assert(std::abs(first.node(a.node_a[p])[k] - third.node(c.node_a[p])[k]) < 1e-8);
                ck_assert(std::abs(first.node(a.node_b[p])[k] - third.node(c.node_b[p])[k]) < 1e-8);
            }
        }
        check_frames(first, a);
        check_frames(third, c);
        ck_assert(std::abs(a.frame[0] + 1.0) < 1e-14);  // from body 0 at x = -0.3..0 to body 1 at x = -0.5..-0.3
    }
}

// A circular interface: normals are radial, weights are those of the polygon.
TEST(curved_interface) {
    const int n = 60;
    Numbers nodes;
    Indices cells;
    Labels labels;
    for (const double radius : {1.0, 1.5, 1.5, 2.0})
        for (int i = 0; i < n; ++i)
            nodes.insert(nodes.end(), {radius * std::cos(2 * M_PI * i / n), radius * std::sin(2 * M_PI * i / n)});
    for (int ring = 0; ring < 2; ++ring)
        for (int i = 0; i < n; ++i) {
            const int j = (i + 1) % n;
            const int base = 2 * n * ring;
            cells.insert(cells.end(), {base + i, base + n + i, base + n + j, base + j});
            labels.push_back(4 - ring);  // labels need not start at 0 or be in order
        }
    Mesh mesh(2, nodes);
    mesh.add_cells(CellType::quad4, cells, labels);
    add_interface(mesh, 4, 3, 0.0);
    const InterfaceGeometry& i = mesh.interfaces()[0];
    ck_assert_int_eq(i.pair_count(), n);
    ck_assert(std::abs(sum(i.weight) - 2 * n * 1.5 * std::sin(M_PI / n)) < 1e-12);
    for (std::size_t p = 0; p < at(n); ++p) {
        const auto x = mesh.node(i.node_a[p]);
        ck_assert(std::abs(i.frame[4 * p] - x[0] / 1.5) < 1e-14);
        ck_assert(std::abs(i.frame[4 * p + 1] - x[1] / 1.5) < 1e-14);
        ck_assert(i.frame[4 * p + 2] == i.frame[4 * p + 1] && i.frame[4 * p + 3] == -i.frame[4 * p]);
    }
}

// A distorted quadrilateral face: the weights are the integrals of its bilinear shape functions, whose sum is the area.
TEST(weights_of_distorted_faces) {
    Mesh plain = layers(CellType::hex8, {2.0, 1.0}, {4, 3}, {0.5, 0.5}, {1, 1});
    Mesh mesh = rebuilt(plain, 0, [](std::span<double> x) {
        const double bump = x[0] * (2.0 - x[0]) * x[1] * (1.0 - x[1]);
        x[0] += 0.3 * bump;
        x[1] -= 0.4 * bump;
    });
    add_interface(mesh, 0, 1, 0.0);
    const InterfaceGeometry& i = mesh.interfaces()[0];
    ck_assert(std::abs(sum(i.weight) - 2.0) < 1e-14);
    ck_assert(*std::min_element(i.weight.begin(), i.weight.end()) > 0.0);
    double moment = 0.0;
    for (std::size_t p = 0; p < i.node_a.size(); ++p) moment += i.weight[p] * mesh.node(i.node_a[p])[1];
    ck_assert(std::abs(moment - 1.0) < 1e-2);  // a nodal rule: near the exact first moment, but not equal
}

// Rings of quadratic cells with their middle nodes on the circle: normals are radial to the fourth order of the cell's
// angle, at middle nodes exactly, weights positive with the length of the circle.
TEST(curved_cells) {
    for (const CellType type : {CellType::quad8, CellType::quad9, CellType::tri6}) {
        const int n = 24;
        Mesh plain = layers(type, {2.0 * M_PI}, {n}, {0.5, 0.5}, {1, 1});
        // Bent by (x, y) -> (1+y)(cos x, -sin x), upper half plane first; the ends meet but are not connected.
        Mesh mesh = rebuilt(plain, 4, [](std::span<double> x) {
            const double radius = 1.0 + x[1];
            const double angle = x[0];
            x[0] = -radius * std::cos(angle);
            x[1] = radius * std::sin(angle);
        });
        add_interface(mesh, 0, 1, 0.0);
        const InterfaceGeometry& i = mesh.interfaces()[0];
        ck_assert_int_eq(i.nodes_per_face, 3);
        ck_assert_int_eq(i.face_count(), n);
        ck_assert(*std::min_element(i.weight.begin(), i.weight.end()) > 0.0);
        ck_assert(std::abs(sum(i.weight) / (3.0 * M_PI) - 1.0) < 1e-5);
        check_frames(mesh, i);
        for (std::size_t p = 0; p < i.node_a.size(); ++p) {
            const auto x = mesh.node(i.node_a[p]);
            ck_assert(std::abs(i.frame[4 * p] - x[0] / 1.5) < 1e-2 && std::abs(i.frame[4 * p + 1] - x[1] / 1.5) < 1e-2);
        }
        for (std::size_t f = 0; f < at(i.face_count()); ++f) {
            const std::size_t middle = at(i.face[3 * f + 2]);
            const auto x = mesh.node(i.node_a[middle]);
            ck_assert(std::abs(i.frame[4 * middle] - x[0] / 1.5) < 1e-13);
            ck_assert(std::abs(i.frame[4 * middle + 1] - x[1] / 1.5) < 1e-13);
        }
    }
}

// Weights of flat faces by hand; those of faces with shifted middle nodes and of warped faces are positive and sum to
// the length, or the area that the nodes span.
TEST(weights_of_quadratic_faces) {
    const auto weights_of = [](CellType type, const std::function<void(std::span<double>)>& map) {
        const bool plane = topology(type).dimension == 2;
        Mesh mesh = rebuilt(
            layers(type, plane ? Numbers{1} : Numbers{1, 1}, plane ? Indices{1} : Indices{1, 1}, {1, 1}, {1, 1}), 0,
            map);
        add_interface(mesh, 0, 1, 0.0);
        check_frames(mesh, mesh.interfaces()[0]);
        return mesh.interfaces()[0];
    };
    for (const CellType type : {CellType::tri6, CellType::quad8, CellType::quad9}) {
        const InterfaceGeometry simpson = weights_of(type, {});
        ck_assert(simpson.face == (Indices{2, 0, 1}) || simpson.face == (Indices{0, 2, 1}));
        const Numbers expected{1.0 / 6, 4.0 / 6, 1.0 / 6};
        for (std::size_t p = 0; p < 3; ++p) ck_assert(std::abs(simpson.weight[p] - expected[p]) < 1e-15);
        // The middle shifted along the edge: x'(-1) = 0.5 + 2 * 0.1, x'(1) = 0.5 - 0.2.
        const InterfaceGeometry shifted = weights_of(type, [](std::span<double> x) {
            if (x[0] == 0.5) x[0] += 0.1;
        });
        const Numbers off{0.7 / 3, 2.0 / 3, 0.3 / 3};
        for (std::size_t p = 0; p < 3; ++p) ck_assert(std::abs(shifted.weight[p] - off[p]) < 1e-15);
        // A parabola of height 0.1 over length 1: its arc in closed form.
        const InterfaceGeometry bent = weights_of(type, [](std::span<double> x) { x[1] += 0.4 * x[0] * (1.0 - x[0]); });
        const double s = 0.4;  // slope at the ends
        const double arc = 0.5 * std::hypot(1.0, s) + std::asinh(s) / (2.0 * s);
        ck_assert(std::abs(sum(bent.weight) - arc) < 2e-8);
        ck_assert(bent.weight[0] > 0.0 && bent.weight[1] > 0.0);
        ck_assert(std::abs(bent.frame[0] + s / std::hypot(1.0, s)) < 1e-14);
    }
    const InterfaceGeometry square = weights_of(CellType::hex20, {});
    ck_assert_int_eq(square.nodes_per_face, 8);
    const Numbers expected{1.0 / 36, 2.0 / 9, 1.0 / 36, 2.0 / 9, 2.0 / 9, 1.0 / 36, 2.0 / 9, 1.0 / 36};
    for (std::size_t p = 0; p < 8; ++p) ck_assert(std::abs(square.weight[p] - expected[p]) < 1e-15);
    const InterfaceGeometry triangle = weights_of(CellType::tet10, {});
    ck_assert_int_eq(triangle.nodes_per_face, 6);
    ck_assert(std::abs(sum(triangle.weight) - 1.0) < 1e-14);
    for (std::size_t p = 0; p < 9; ++p) {  // corners 1/30 of a triangle of area 1/2, middles 2/15; diagonal pairs twice
        const double w = triangle.weight[p] * 30.0;
        ck_assert(std::abs(w - 1) < 1e-13 || std::abs(w - 2) < 1e-13 || std::abs(w - 4) < 1e-13 ||
                  std::abs(w - 8) < 1e-13);
    }
    for (const CellType type : {CellType::tet10, CellType::hex20}) {
        const InterfaceGeometry warped = weights_of(type, [](std::span<double> x) {
            x[2] += 0.2 * std::sin(2.0 * x[0] + x[1]);
            x[0] += 0.05 * std::sin(5.0 * x[1]);
        });
        ck_assert(*std::min_element(warped.weight.begin(), warped.weight.end()) > 0.0);
        ck_assert(sum(warped.weight) > 1.0 && sum(warped.weight) < 1.1);
    }
}

// Triangles among quadrilaterals: rows of eight with a collapsed side.
TEST(mixed_faces) {
    const Mesh bricks = layers(CellType::hex20, {1, 1}, {1, 1}, {1, 1}, {1, 1});
    const Mesh tetrahedra = layers(CellType::tet10, {1, 1}, {1, 1}, {1, 1}, {1, 1});
    Numbers nodes(bricks.nodes().begin(), bricks.nodes().end());
    for (std::size_t i = 0; i < tetrahedra.nodes().size(); ++i)
        nodes.push_back(tetrahedra.nodes()[i] + (i % 3 == 0 ? 5.0 : 0.0));
    Mesh mesh(3, nodes);
    for (std::int64_t c = 0; c < bricks.cell_count(); ++c)
        mesh.add_cells(CellType::hex20, bricks.cell(c), Labels{bricks.cell_body(c)});
    for (std::int64_t c = 0; c < tetrahedra.cell_count(); ++c) {
        Indices cell(tetrahedra.cell(c).begin(), tetrahedra.cell(c).end());
        for (std::int64_t& n : cell) n += bricks.node_count();
        mesh.add_cells(CellType::tet10, cell, Labels{tetrahedra.cell_body(c)});
    }
    add_interface(mesh, 0, 1, 0.0);
    const InterfaceGeometry& i = mesh.interfaces()[0];
    ck_assert_int_eq(i.nodes_per_face, 8);
    ck_assert_int_eq(i.face_count(), 3);
    ck_assert(std::abs(sum(i.weight) - 2.0) < 1e-14);
    std::size_t shrunken = 0;
    for (std::size_t f = 0; f < 3; ++f) {
        const std::int64_t* face = &i.face[8 * f];
        const auto x = [&](std::size_t k, std::size_t axis) { return mesh.node(i.node_a[at(face[k])])[axis]; };
        shrunken += face[2] == face[3] ? 1 : 0;
        ck_assert((face[2] == face[3]) == (x(0, 0) >= 5.0));
        for (std::size_t k = 0; k < 4; ++k)  // every middle node lies between its corners, on the collapsed side too
            for (std::size_t axis = 0; axis < 2; ++axis)
                ck_assert(std::abs(x(4 + k, axis) - 0.5 * (x(k, axis) + x((k + 1) % 4, axis))) < 1e-15 * 8);
    }
    ck_assert_uint_eq(shrunken, 2);
}

// A mid-side node without a partner is named, wherever the partner is missing.
TEST(missing_middle_nodes) {
    for (const CellType type : all_types) {
        if (!quadratic(type)) continue;
        const bool plane = topology(type).dimension == 2;
        const auto block = [&](CellType t) {
            return layers(t, plane ? Numbers{1} : Numbers{1, 1}, plane ? Indices{2} : Indices{2, 2}, {0.5, 0.5},
                          {1, 1});
        };
        // A middle node of the upper block on the interface, moved along an edge.
        const Mesh plain = block(type);
        std::int64_t middle = -1;
        for (std::int64_t c = 0; c < plain.cell_count(); ++c)
            for (std::size_t k = at(topology(type).corners); k < plain.cell(c).size(); ++k) {
                const auto x = plain.node(plain.cell(c)[k]);
                if (plain.cell_body(c) == 1 && x.back() == 0.5 && x[0] == 0.25) middle = plain.cell(c)[k];
            }
        ck_assert(middle >= 0);
        Numbers nodes(plain.nodes().begin(), plain.nodes().end());
        nodes[at(middle) * at(plain.dimension())] += 0.02;
        Mesh moved(plain.dimension(), nodes);
        for (std::int64_t c = 0; c < plain.cell_count(); ++c)
            moved.add_cells(type, plain.cell(c), Labels{plain.cell_body(c)});
        const std::string named = "mid-side node " + std::to_string(middle) + " at (0.27";
        ck_assert_refused(DELAM_ERROR_MESH, named.c_str(), add_interface(moved, 0, 1, 0.0));
        // Linear cells above quadratic ones, and the other way round.
        const CellType other = plane ? (triangles(type) ? CellType::tri3 : CellType::quad4)
                                     : (triangles(type) ? CellType::tet4 : CellType::hex8);
        const Mesh linear = block(other);
        for (const bool swap : {false, true}) {
            const Mesh& first = swap ? linear : plain;
            const Mesh& second = swap ? plain : linear;
            Numbers both(first.nodes().begin(), first.nodes().end());
            both.insert(both.end(), second.nodes().begin(), second.nodes().end());
            Mesh mesh(plain.dimension(), both);
            for (std::int64_t c = 0; c < first.cell_count(); ++c)
                if (first.cell_body(c) == 0) mesh.add_cells(first.cell_type(c), first.cell(c), Labels{0});
            for (std::int64_t c = 0; c < second.cell_count(); ++c) {
                if (second.cell_body(c) == 0) continue;
                Indices cell(second.cell(c).begin(), second.cell(c).end());
                for (std::int64_t& n : cell) n += first.node_count();
                mesh.add_cells(second.cell_type(c), cell, Labels{1});
            }
            ck_assert_refused(DELAM_ERROR_MESH, "has no partner on the other side", add_interface(mesh, 0, 1, 0.0));
        }
    }
    // Two quad8 of one body, side by side; the edge between them has two middle nodes.
    const Numbers nodes{0, 0,   1,   0, 1, 1,   0,   1, 2, 0,   2,   1, 0.5, 0,
                        1, 0.5, 0.5, 1, 0, 0.5, 1.5, 0, 2, 0.5, 1.5, 1, 1,   0.5};
    Mesh mesh(2, nodes);
    mesh.add_cells(CellType::quad8, Indices{0, 1, 2, 3, 6, 7, 8, 9, 1, 4, 5, 2, 10, 11, 12, 13}, {});
    ck_assert_refused(DELAM_ERROR_MESH, "not its mid-side nodes", boundary_faces(mesh, 0));
}

// The integrals of the shape functions over whole faces, known by hand: 1/6, 2/3, 1/6 of an edge; nothing of a corner
// and a third of a middle node on a triangle; -1/12 and 1/3 on an 8-node face.
TEST(patches_of_quadratic_faces) {
    const Mesh plane = layers(CellType::quad8, {1}, {1}, {1}, {1});
    const Patch edge = find_patch(plane, 0, Numbers{-1, 1}, Numbers{2, 1}, Numbers{0, 1});
    ck_assert_uint_eq(edge.nodes.size(), 3);
    for (std::size_t k = 0; k < 3; ++k)
        ck_assert(std::abs(edge.weights[k] - (plane.node(edge.nodes[k])[0] == 0.5 ? 4.0 : 1.0) / 6.0) < 1e-15);
    const Mesh cube = layers(CellType::hex20, {1, 1}, {1, 1}, {1}, {1});
    const Patch face = find_patch(cube, 0, Numbers{-1, -1, 1}, Numbers{2, 2, 1}, Numbers{0, 0, 1});
    ck_assert_uint_eq(face.nodes.size(), 8);
    for (std::size_t k = 0; k < 8; ++k) {
        const auto x = cube.node(face.nodes[k]);
        ck_assert(std::abs(face.weights[k] - (x[0] == 0.5 || x[1] == 0.5 ? 1.0 / 3.0 : -1.0 / 12.0)) < 1e-15);
    }
    const Mesh tetrahedra = layers(CellType::tet10, {1, 1}, {1, 1}, {1}, {1});
    const Patch middles = find_patch(tetrahedra, 0, Numbers{-1, -1, 1}, Numbers{2, 2, 1}, Numbers{0, 0, 1});
    ck_assert_uint_eq(middles.nodes.size(), 5);  // corners have no share
    for (std::size_t k = 0; k < 5; ++k) {
        const auto x = tetrahedra.node(middles.nodes[k]);
        ck_assert(std::abs(middles.weights[k] - (x[0] == 0.5 && x[1] == 0.5 ? 1.0 : 0.5) / 3.0) < 1e-15);
    }
}
