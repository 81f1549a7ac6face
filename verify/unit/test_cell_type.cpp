// SPDX-License-Identifier: BSD-3-Clause
// The rows of the cell types against geometry that does not come from them, and what happens to a number that is no
// cell type.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "body/element.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "mesh/cell_type.hpp"
#include "mesh/faces.hpp"
#include "mesh/layers.hpp"
#include "mesh/mesh.hpp"
#include "mesh/shape.hpp"
#include "refused.hpp"

using namespace delam;

namespace {

constexpr auto last = static_cast<std::int32_t>(cell_rows.size());
constexpr CellType unknown_types[] = {CellType{0}, CellType{last + 1}, CellType{-1}, CellType{1 << 30}};

void expect_refusal(std::int32_t status, const std::string& part, const std::function<void()>& action) {
    ck_assert_refused(status, part, action());
}

// The reference cell as a mesh of one cell.
Mesh reference_mesh(const CellRow& row) {
    std::vector<double> nodes;
    std::vector<std::int64_t> cell;
    for (const ReferencePoint& p : reference_nodes(row.type)) {
        nodes.insert(nodes.end(), p.begin(), p.begin() + row.topology.dimension);
        cell.push_back(static_cast<std::int64_t>(cell.size()));
    }
    Mesh mesh(row.topology.dimension, nodes);
    mesh.add_cells(row.type, cell, std::vector<std::int32_t>{0});
    return mesh;
}

// All faces are there, their areas point out of the cell and close it.
TEST(faces_close_the_cell) {
    for (const CellRow& row : cell_rows) {
        const Mesh mesh = reference_mesh(row);
        const std::vector<BoundaryFace> faces = boundary_faces(mesh, 0);
        ck_assert_int_eq(static_cast<int>(faces.size()), row.topology.faces);
        const ReferencePoint& middle = centre(row.type);
        std::array<double, 3> sum{};
        for (const BoundaryFace& face : faces) {
            const std::array<double, 3> area = area_vector(mesh, face.all());
            double outward = 0.0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(row.topology.dimension); ++i) {
                sum[i] += area[i];
                outward += area[i] * (mesh.node(face.node[0])[i] - middle[i]);
            }
            ck_assert_msg(outward > 0.0, "%s: a face points inwards", row.topology.name);
        }
        for (const double component : sum) ck_assert_double_eq_tol(component, 0.0, 1e-14);
    }
}

// Triangle and tetrahedron 1/2 and 1/6, square and cube 4 and 8, the triangle times [-1, 1] 1; no node twice.
TEST(quadrature_measures_the_cell) {
    for (const CellRow& row : cell_rows) {
        const bool plane = row.topology.dimension == 2;
        const double exact = row.simplex()                           ? (plane ? 0.5 : 1.0 / 6.0)
                             : row.reference == ReferenceCell::prism ? 1.0
                                                                     : (plane ? 4.0 : 8.0);
        double sum = 0.0;
        for (const double weight : quadrature(row.type).weights) sum += weight;
        ck_assert_double_eq_tol(sum, exact, 1e-14 * exact);
        const auto nodes = reference_nodes(row.type);
        std::vector<ReferencePoint> places(nodes.begin(), nodes.end());
        std::sort(places.begin(), places.end());
        ck_assert(std::adjacent_find(places.begin(), places.end()) == places.end());
    }
}

// N_a is 1 at node a and 0 at the others.
TEST(shape_functions_interpolate) {
    for (const CellRow& row : cell_rows) {
        const auto nodes = reference_nodes(row.type);
        for (std::size_t b = 0; b < nodes.size(); ++b) {
            const ShapeValues value = shape_values(row.type, nodes[b]);
            for (std::size_t a = 0; a < nodes.size(); ++a)
                ck_assert_msg(std::abs(value[a] - (a == b ? 1.0 : 0.0)) < 1e-15, "%s: N_%zu at node %zu is %g",
                              row.topology.name, a, b, value[a]);
        }
    }
}

// Nodes inside faces and cells are of complete interpolations alone.
TEST(interpolation_fits_the_nodes) {
    for (const CellRow& row : cell_rows) {
        const auto nodes = reference_nodes(row.type);
        const auto inside = std::count_if(nodes.begin(), nodes.end(), [&](const ReferencePoint& p) {
            const auto zeros = std::count(p.begin(), p.begin() + row.topology.dimension, 0.0);
            return row.reference == ReferenceCell::box && zeros > 1;
        });
        ck_assert_msg((inside > 0) == (!row.simplex() && row.interpolation == Interpolation::quadratic), "%s",
                      row.topology.name);
    }
}

TEST(unknown_types_are_refused) {
    const std::string part =
        ": must be 1 (tri3) .. " + std::to_string(last) + " (" + cell_rows.back().topology.name + ")";
    std::vector<double> room(3600);
    for (const CellType type : unknown_types) {
        const std::string text = "cell type " + std::to_string(static_cast<std::int32_t>(type)) + part;
        ck_assert_ptr_null(find_cell_row(static_cast<std::int32_t>(type)));
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] { topology(type); });
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] { quadrature(type); });
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] { shape_values(type, {}); });
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] { centre(type); });
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] { smallest_jacobian(type, room); });
        expect_refusal(DELAM_ERROR_ARGUMENT, text,
                       [&] { element_stiffness(type, room, room, Formulation::standard, room); });
        expect_refusal(DELAM_ERROR_ARGUMENT, text,
                       [&] { mean_dilatation_stiffness(type, room, room, Dilatation{}, room); });
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] { dilatation_correction(type, room, room); });
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] { integrate_gradients(type, room, room); });
        const double length = 1.0;
        const std::int64_t one = 1;
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] {
            make_layers(2, {&length, 1}, {&one, 1}, {&length, 1}, {&one, 1}, type);
        });
        Mesh mesh(2, std::vector<double>{0, 0, 1, 0, 0, 1});
        expect_refusal(DELAM_ERROR_ARGUMENT, text, [&] {
            mesh.add_cells(type, std::vector<std::int64_t>{0, 1, 2}, {});
        });
        ck_assert_int_eq(mesh.cell_count(), 0);
    }
}

TEST(unknown_faces_are_refused) {
    for (const int dimension : {2, 3})
        for (std::size_t nodes = 0; nodes < 12; ++nodes) {
            const auto used = [&](const CellRow& row) {
                const auto faces = row.topology.all_faces();
                return row.topology.dimension == dimension &&
                       std::any_of(faces.begin(), faces.end(), [&](const CellFace& f) { return f.nodes == nodes; });
            };
            if (std::any_of(cell_rows.begin(), cell_rows.end(), used)) {
                ck_assert(!face_pieces(dimension, nodes).empty());
                continue;
            }
            ck_assert_ptr_null(find_face_row(dimension, static_cast<std::int64_t>(nodes)));
            expect_refusal(DELAM_ERROR_INTERNAL, "no cell has faces of " + std::to_string(nodes) + " nodes in ",
                           [&] { face_pieces(dimension, nodes); });
        }
    const std::string plane = face_sizes(2), space = face_sizes(3);
    ck_assert_str_eq(plane.c_str(), "2 or 3");
    ck_assert_str_eq(space.c_str(), "3, 4, 6, 8 or 9");
}

}  // namespace
