// SPDX-License-Identifier: BSD-3-Clause
// Interfaces of unmatched meshes by projection, and obstacles: areas, normals, linear fields, and which input is
// refused at which call.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "all_types.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "mesh/face_point.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/points.hpp"
#include "projection.hpp"

using namespace delam;
using namespace unit;

namespace {

TEST(flat) {
    for (const CellType lower : all_types) {
        for (const CellType upper : all_types) {
            if (topology(lower).dimension != topology(upper).dimension) continue;
            const auto dim = index(topology(lower).dimension);
            const auto list = dim == 2 ? stack(lower, upper, 3, 5) : stack(lower, upper, 2, 3);
            Mesh mesh = blocks(list);
            const std::int64_t before = mesh.node_count();
            ck_assert_int_eq(add_projected_interface(mesh, 0, 1, 0.0), 0);
            const InterfaceGeometry& i = mesh.interfaces()[0];
            expect_ties(mesh, i);
            ck_assert_int_eq(mesh.node_count(), before + static_cast<std::int64_t>(mesh.ties().size()));
            ck_assert(std::abs(area(i) - 1.0) < 1e-13);
            for (std::size_t p = 0; p < i.node_a.size(); ++p) {
                for (std::size_t k = 0; k < dim; ++k)
                    ck_assert(std::abs(mesh.node(i.node_a[p])[k] - mesh.node(i.node_b[p])[k]) < 1e-13);
                ck_assert(std::abs(i.frame[p * dim * dim + dim - 1] - 1.0) < 1e-14);
            }
            // With the two bodies exchanged it is another interface, with the same area and the opposite normal.
            Mesh back = blocks(list);
            add_projected_interface(back, 1, 0, 0.0);
            expect_ties(back, back.interfaces()[0]);
            ck_assert(std::abs(area(back.interfaces()[0]) - 1.0) < 1e-13);
            ck_assert(std::abs(back.interfaces()[0].frame[dim - 1] + 1.0) < 1e-14);
        }
    }
}

// Faces that match: each node is tied to its partner alone, and the interface is that of matched faces.
TEST(matching) {
    for (const CellType type : all_types) {
        Mesh mesh = blocks(stack(type, type, 4, 4));
        if (topology(type).dimension == 3) {
            auto list = stack(type, type, 4, 4);
            list[1].divisions[1] = list[0].divisions[1];
            mesh = blocks(list);
        }
        Mesh matched = mesh;
        add_interface(matched, 0, 1, 0.0);
        add_projected_interface(mesh, 0, 1, 0.0);
        const InterfaceGeometry& i = mesh.interfaces()[0];
        const InterfaceGeometry& m = matched.interfaces()[0];
        ck_assert(i.face.size() == m.face.size() && i.nodes_per_face == m.nodes_per_face);
        for (std::size_t p = 0; p < i.weight.size(); ++p) {
            const NodeTie& tie = mesh.ties()[index(node_of_pair(mesh, i.node_a[p]) - mesh.ties()[0].node)];
            ck_assert_uint_eq(tie.of.size(), 1);
            ck_assert_int_eq(tie.of[0].first, node_of_pair(matched, m.node_a[p]));
            ck_assert_int_eq(node_of_pair(mesh, i.node_b[p]), node_of_pair(matched, m.node_b[p]));
            ck_assert(std::abs(i.weight[p] - m.weight[p]) < 1e-14);
        }
        for (std::size_t k = 0; k < i.frame.size(); ++k) ck_assert(std::abs(i.frame[k] - m.frame[k]) < 1e-13);
        for (std::size_t k = 0; k + 1 < i.face.size(); ++k) ck_assert(i.face[k] >= 0 && i.face[k] < i.pair_count());
    }
}

// Narrow in space; the square cylinder is in the long tier.
TEST(curved) {
    for (const CellType type :
         {CellType::quad4, CellType::quad8, CellType::tri6, CellType::hex8, CellType::hex20, CellType::tet10}) {
        for (const std::int64_t n : {4, 8}) {
            std::vector<Block> rings = stack(type, type, n, 2 * n + 1);
            if (topology(type).dimension == 3) rings[0].divisions[1] = 2, rings[1].divisions[1] = 3;
            expect_curved(type, n, rings);
        }
    }
}

// b may end inside a; beyond a's rim only whole faces of b may lie, side by side with a.
TEST(partly_covered) {
    for (const CellType type : all_types) {
        Mesh within = blocks(stack(type, type, 3, 5, 0.1, 0.7));
        add_projected_interface(within, 0, 1, 0.0);
        ck_assert(std::abs(area(within.interfaces()[0]) - 0.7) < 1e-13);
        expect_ties(within, within.interfaces()[0]);
        Mesh beside = blocks(stack(type, type, 3, 4, 0.5, 1.0));
        add_projected_interface(beside, 0, 1, 0.0);
        ck_assert(std::abs(area(beside.interfaces()[0]) - 0.5) < 1e-13);
        const struct {
            double start, length;
            std::int64_t upper;
        } refused[] = {{0.5, 1.0, 5}, {0.9, 1.0, 2}, {-0.1, 1.2, 3}, {-0.5, 2.0, 1}, {-1.0, 3.0, 1}};
        for (const auto& r : refused) {
            Mesh mesh = blocks(stack(type, type, 4, r.upper, r.start, r.length));
            const std::int64_t before = mesh.node_count();
            ck_assert_refused(DELAM_ERROR_MESH, "only in part", add_projected_interface(mesh, 0, 1, 0.0));
            ck_assert(mesh.interfaces().empty() && mesh.ties().empty() && mesh.node_count() == before);
        }
        Mesh apart = blocks(stack(type, type, 4, 4, 1.25, 1.0));
        ck_assert_refused(DELAM_ERROR_MESH, "come as close as 0.25", add_projected_interface(apart, 0, 1, 0.0));
        Mesh twice = blocks(stack(type, type, 3, 4));
        add_projected_interface(twice, 0, 1, 0.0);
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "already joined by interface 0",
                          add_projected_interface(twice, 1, 0, 0.0));
        ck_assert_int_eq(add_all_interfaces(twice, 0.0), 0);
        for (const double bad : {-1e-3, std::nan(""), HUGE_VAL})
            ck_assert_refused(DELAM_ERROR_ARGUMENT, "gap", add_projected_interface(apart, 0, 1, bad));
    }
    // Tied nodes belong to no cell.
    Mesh mesh = blocks(stack(CellType::quad4, CellType::quad4, 1, 2));
    add_projected_interface(mesh, 0, 1, 0.0);
    const std::int64_t tied = mesh.ties()[0].node;
    ck_assert_refused(DELAM_ERROR_MESH, "is tied", mesh.add_cells(CellType::tri3, Indices{tied, 0, 1}, Labels{7}));
    ck_assert_refused(DELAM_ERROR_MESH, "is tied",
                      mesh.add_conforming_cells(CellType::tri3, Indices{0, 1, tied}, Labels{7}));
    ck_assert_int_eq(mesh.node_body(tied), -1);
}

// The nearest point of a curved face is the one whose offset is along the normal.
TEST(nearest_points) {
    for (const CellType type : {CellType::quad8, CellType::hex20, CellType::tet10, CellType::hex8}) {
        const std::size_t dim = index(topology(type).dimension);
        const Mesh mesh = blocks({stack(type, type, 2, 2)[0]}, [&](std::span<double> x) {
            const double y = dim == 3 ? x[1] : 0.0;
            x[dim - 1] += 0.1 * x[0] * x[0] + 0.07 * y * (1.0 - x[0]);
        });
        for (const BoundaryFace& face : boundary_faces(mesh, 0)) {
            for (const FacePoint& p : inner_points(mesh, face)) {
                Point x = p.place;
                for (std::size_t i = 0; i < 3; ++i) x[i] += 0.02 * p.normal[i];
                const FacePoint found = closest_point(mesh, face, x);
                ck_assert(length(found.place - p.place) < 1e-12);
                ck_assert(length(found.normal - p.normal) < 1e-11);
                for (std::size_t k = 0; k < most_face_nodes; ++k)
                    ck_assert(std::abs(found.weight[k] - p.weight[k]) < 1e-11);
            }
        }
    }
}

TEST(obstacles) {
    for (const CellType type : all_types) {
        const std::size_t dim = index(topology(type).dimension);
        Mesh mesh = blocks({stack(type, type, 4, 4)[0]}, {}, dim == 2 ? Numbers{0.5, 9.0} : Numbers{0.5, 0.5, 9.0});
        const std::int64_t control = mesh.node_count() - 1;
        Indices top;
        Numbers down;
        for (std::int64_t n = control - 1; n >= 0; --n) {  // in an order chosen by the host
            if (mesh.node(n)[dim - 1] != 0.5 || mesh.node(n)[0] > 0.5) continue;
            top.push_back(n);
            for (std::size_t i = 0; i < dim; ++i) down.push_back(i == dim - 1 ? -3.0 : 0.0);
        }
        ck_assert_int_eq(add_obstacle(mesh, top, down, {}, control), 0);
        const InterfaceGeometry& i = mesh.interfaces()[0];
        ck_assert(i.body_a == -1 && i.body_b == 0 && i.node_b == top);
        ck_assert(std::all_of(i.node_a.begin(), i.node_a.end(), [&](std::int64_t n) { return n == control; }));
        ck_assert(std::abs(area(i) - 0.5) < 1e-14);
        for (std::size_t p = 0; p < top.size(); ++p) ck_assert(i.frame[p * dim * dim + dim - 1] == -1.0);
        ck_assert(i.face_count() > 0);

        // A single node needs a weight.
        const Indices one{top[0]};
        const Numbers normal(down.begin(), down.begin() + static_cast<std::ptrdiff_t>(dim));
        ck_assert_refused(DELAM_ERROR_MESH, "give weights", add_obstacle(mesh, one, normal, {}, control));
        ck_assert_int_eq(add_obstacle(mesh, one, normal, Numbers{0.25}, control), 1);
        ck_assert(mesh.interfaces()[1].weight == Numbers{0.25} && mesh.interfaces()[1].face_count() == 0);

        // A later body changes no index of the obstacle, and the control node belongs to no cell.
        ck_assert_refused(DELAM_ERROR_MESH, "control node",
                          mesh.add_cells(type, Indices(index(topology(type).nodes), control), Labels{3}));
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "length 0",
                          add_obstacle(mesh, one, Numbers(dim, 0.0), Numbers{1.0}, control));
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "weights[0] = 0",
                          add_obstacle(mesh, one, normal, Numbers{0.0}, control));
        ck_assert_refused(DELAM_ERROR_MESH, "belongs to body 0", add_obstacle(mesh, one, normal, Numbers{1.0}, top[0]));
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "belongs to no body",
                          add_obstacle(mesh, Indices{control}, normal, Numbers{1.0}, control));
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "control_node",
                          add_obstacle(mesh, one, normal, Numbers{1.0}, control + 1));
        Numbers both = normal;
        both.insert(both.end(), normal.begin(), normal.end());
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "twice",
                          add_obstacle(mesh, Indices{top[0], top[0]}, both, Numbers{1, 1}, control));
        ck_assert_uint_eq(mesh.interfaces().size(), 2);
    }
    Mesh mesh = blocks(stack(CellType::quad4, CellType::quad4, 2, 2), {}, Numbers{0, 9});
    add_all_interfaces(mesh, 0.0);
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "an obstacle of its own",
                      add_obstacle(mesh, Indices{0, 9}, Numbers{0, 1, 0, 1}, Numbers{1, 1}, mesh.node_count() - 1));
}

}  // namespace
