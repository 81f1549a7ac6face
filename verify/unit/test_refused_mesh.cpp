// SPDX-License-Identifier: BSD-3-Clause
// Cells and interfaces that a mesh refuses, and what it is afterwards.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "all_types.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "meshes.hpp"
#include "refused.hpp"

using namespace delam;
using namespace unit;

TEST(refused_cells) {
    const Numbers square{0, 0, 1, 0, 1, 1, 0, 1, 2, 0, 2, 1};
    Mesh mesh(2, square);
    ck_assert_refused(DELAM_ERROR_MESH, "cell 0 (body 7): smallest Jacobian -",
                      mesh.add_cells(CellType::quad4, Indices{0, 3, 2, 1}, Labels{7}));
    ck_assert_refused(DELAM_ERROR_MESH, "degenerate", mesh.add_cells(CellType::tri3, Indices{0, 1, 4}, {}));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "node 6: must be in 0..5",
                      mesh.add_cells(CellType::tri3, Indices{0, 1, 6}, {}));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "body -2", mesh.add_cells(CellType::tri3, Indices{0, 1, 2}, Labels{-2}));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "3D cells in a 2D mesh",
                      mesh.add_cells(CellType::tet4, Indices{0, 1, 2, 3}, {}));
    ck_assert_refused(DELAM_ERROR_MESH, "node 1 belongs to bodies 3 and 5; each body needs nodes of its own",
                      mesh.add_cells(CellType::quad4, Indices{0, 1, 2, 3, 1, 4, 5, 2}, (Labels{3, 5})));
    // After all that the mesh is as it was.
    ck_assert_int_eq(mesh.cell_count(), 0);
    ck_assert_int_eq(mesh.body_count(), 0);
    for (std::int64_t n = 0; n < 6; ++n) ck_assert_int_eq(mesh.node_body(n), -1);
    mesh.add_cells(CellType::quad4, Indices{0, 1, 2, 3, 1, 4, 5, 2}, Labels{3, 3});
    ck_assert_int_eq(mesh.body_count(), 1);
    ck_assert_int_eq(mesh.body_of_label(3), 0);
    ck_assert_int_eq(mesh.body_of_label(0), -1);
    mesh.add_cells(CellType::tri3, Indices{0, 1, 2}, Labels{3});
    ck_assert_refused(DELAM_ERROR_MESH, "overlap", boundary_faces(mesh, 0));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "not finite", Mesh(2, Numbers{0, std::nan("")}));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "dimension 4", Mesh(4, Numbers{0, 0, 0, 0}));
    // The same cell is as good in metres as in nanometres.
    for (const double unit : {1e-9, 1e9}) {
        Mesh scaled = rebuilt(layers(CellType::tet4, {1, 1}, {1, 1}, {1e-3}, {1}), 0, [&](std::span<double> x) {
            for (double& v : x) v *= unit;
        });
        ck_assert_int_eq(scaled.cell_count(), 6);
    }
}

// Two blocks, the upper one cut and placed arbitrarily.
Mesh two_blocks(CellType type, std::int64_t lower_cells, std::int64_t upper_cells, double length, double shift,
                double gap) {
    const bool plane = topology(type).dimension == 2;
    const auto block = [&](std::int64_t cells, double extent) {
        return layers(type, plane ? Numbers{extent} : Numbers{extent, 1.0}, plane ? Indices{cells} : Indices{cells, 2},
                      {0.5}, {1});
    };
    const Mesh lower = block(lower_cells, 1.0);
    const Mesh upper = block(upper_cells, length);
    Numbers nodes(lower.nodes().begin(), lower.nodes().end());
    for (std::int64_t n = 0; n < upper.node_count(); ++n) {
        Numbers x(upper.node(n).begin(), upper.node(n).end());
        x[0] += shift;
        x.back() += 0.5 + gap;
        nodes.insert(nodes.end(), x.begin(), x.end());
    }
    Mesh mesh(lower.dimension(), nodes);
    for (std::int64_t c = 0; c < lower.cell_count(); ++c) mesh.add_cells(type, lower.cell(c), Labels{0});
    for (std::int64_t c = 0; c < upper.cell_count(); ++c) {
        Indices cell(upper.cell(c).begin(), upper.cell(c).end());
        for (std::int64_t& n : cell) n += lower.node_count();
        mesh.add_cells(type, cell, Labels{1});
    }
    return mesh;
}

TEST(refused_interfaces) {
    for (const CellType type : all_types) {
        // Half the cells, shifted cells, cells that share corners only at one end, a sliver of overlap.
        const struct {
            std::int64_t lower, upper;
            double length, shift;
        } unmatched[] = {{4, 2, 1.0, 0.0}, {2, 4, 1.0, 0.0},  {4, 4, 1.0, 0.1},
                         {4, 3, 0.9, 0.0}, {1, 1, 1.0, 0.99}, {4, 1, 0.3, 0.0}};
        for (const auto& u : unmatched) {
            Mesh mesh = two_blocks(type, u.lower, u.upper, u.length, u.shift, 0.0);
            ck_assert_refused(DELAM_ERROR_MESH, "do not match", add_interface(mesh, 0, 1, 0.0));
            ck_assert_uint_eq(mesh.interfaces().size(), 0);
        }
        Mesh apart = two_blocks(type, 4, 4, 1.0, 0.0, 0.125);
        ck_assert_refused(DELAM_ERROR_MESH, "as close as 0.125", add_interface(apart, 0, 1, 0.0));
        Mesh corner = two_blocks(type, 4, 4, 1.0, 1.0, 0.0);
        ck_assert_refused(DELAM_ERROR_MESH, "as close as 0", add_interface(corner, 0, 1, 0.0));
        // A shorter body on a longer one is accepted, and so is one that overhangs by whole cells.
        Mesh shorter = two_blocks(type, 4, 2, 0.5, 0.25, 0.0);
        add_interface(shorter, 0, 1, 0.0);
        ck_assert(std::abs(sum(shorter.interfaces()[0].weight) - 0.5) < 1e-14);
        Mesh overhanging = two_blocks(type, 4, 4, 1.0, 0.25, 0.0);
        add_interface(overhanging, 0, 1, 0.0);
        ck_assert(std::abs(sum(overhanging.interfaces()[0].weight) - 0.75) < 1e-14);
        // Tolerance is relative to the shortest edge, 1/4 or, from corner to middle, 1/8.
        Mesh near = two_blocks(type, 4, 4, 1.0, 0.0, quadratic(type) ? 0.012 : 0.024);
        ck_assert_refused(DELAM_ERROR_MESH, quadratic(type) ? "as close as 0.012" : "as close as 0.024",
                          add_interface(near, 0, 1, 0.09));
        add_interface(near, 0, 1, 0.1);
        // One inside the other.
        Mesh inside = two_blocks(type, 4, 4, 1.0, 0.0, -0.5);
        ck_assert_refused(DELAM_ERROR_MESH, "overlap", add_interface(inside, 0, 1, 0.0));
    }
    Mesh mesh = two_blocks(CellType::quad4, 4, 4, 1.0, 0.0, 0.0);
    for (const double bad : {-0.1, 0.5, std::nan("")})
        ck_assert_refused(DELAM_ERROR_ARGUMENT, "[0, 0.5)", add_interface(mesh, 0, 1, bad));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "body_b 3", add_interface(mesh, 0, 3, 0.0));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "both 1", add_interface(mesh, 1, 1, 0.0));
    add_interface(mesh, 0, 1, 0.0);
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "already joined by interface 0", add_interface(mesh, 0, 1, 0.0));
    ck_assert_refused(DELAM_ERROR_ARGUMENT, "already joined by interface 0", add_interface(mesh, 1, 0, 0.0));
    ck_assert_refused(DELAM_ERROR_STATE, "has an interface already",
                      mesh.add_cells(CellType::tri3, Indices{0, 1, 5}, Labels{1}));
}

// A later body with a label in between moves the indices of the others; interfaces follow.
TEST(late_bodies) {
    const Numbers nodes{0, 0, 1, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 2, 0, 2, 5, 5, 6, 5, 6, 6, 5, 6};
    Mesh mesh(2, nodes);
    mesh.add_cells(CellType::quad4, Indices{0, 1, 2, 3, 4, 5, 6, 7}, Labels{2, 9});
    add_interface(mesh, 9, 2, 0.0);
    ck_assert_int_eq(mesh.interfaces()[0].body_a, 1);
    mesh.add_cells(CellType::quad4, Indices{8, 9, 10, 11}, Labels{4});
    ck_assert_int_eq(mesh.body_label(mesh.interfaces()[0].body_a), 9);
    ck_assert_int_eq(mesh.body_label(mesh.interfaces()[0].body_b), 2);
    ck_assert_int_eq(mesh.interfaces()[0].body_a, 2);
}

// Wedges in the order of Abaqus and Gmsh, and a pyramid whose apex is below its base or in it.
TEST(inverted_wedges_and_pyramids) {
    Mesh wedge(3, Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1});
    ck_assert_refused(DELAM_ERROR_MESH, "Abaqus and Gmsh list 345 first",
                      wedge.add_cells(CellType::wedge6, Indices{0, 1, 2, 3, 4, 5}, {}));
    wedge.add_cells(CellType::wedge6, Indices{3, 4, 5, 0, 1, 2}, {});
    for (const double apex : {-1.0, 0.0, 1.0}) {
        Mesh pyramid(3, Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.3, 0.4, apex});
        const Indices nodes{0, 1, 2, 3, 4};
        if (apex > 0.0)
            pyramid.add_cells(CellType::pyramid5, nodes, {});
        else
            ck_assert_refused(DELAM_ERROR_MESH, "inverted or degenerate",
                              pyramid.add_cells(CellType::pyramid5, nodes, {}));
    }
    // A base that is no convex quadrilateral, though the pyramid has a volume.
    Mesh reflex(3, Numbers{0, 0, 0, 1, 0, 0, 0.2, 0.2, 0, 0, 1, 0, 0.3, 0.3, 1});
    ck_assert_refused(DELAM_ERROR_MESH, "inverted or degenerate",
                      reflex.add_cells(CellType::pyramid5, Indices{0, 1, 2, 3, 4}, {}));
}
