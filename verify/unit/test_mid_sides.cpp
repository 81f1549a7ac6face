// SPDX-License-Identifier: BSD-3-Clause
// Pairs of tet10, hex20 and wedge15: with positive weights, equal tractions of all pairs have the nodal forces of a
// uniform traction, on faces of any shape and at the tip of a seam.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "check.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/rule/mid_sides.hpp"
#include "mesh/shape.hpp"
#include "meshes.hpp"

using namespace delam;
using namespace unit;

namespace {

using Map = std::function<void(std::span<double>)>;

// The forces of pairs whose tractions are their first vectors, on the nodes of both sides.
struct Forces {
    std::map<std::int64_t, std::array<double, 3>> on_a, on_b;
};
Forces pulled(const Mesh& mesh, const InterfaceGeometry& interface) {
    std::map<std::int64_t, std::vector<std::pair<std::int64_t, double>>> tied;
    for (const NodeTie& tie : mesh.ties()) tied[tie.node] = tie.of;
    Forces forces;
    for (std::size_t p = 0; p < interface.weight.size(); ++p)
        for (const bool b : {false, true}) {
            const std::int64_t node = b ? interface.node_b[p] : interface.node_a[p];
            const auto of = tied.contains(node) ? tied[node] : std::vector{std::pair(node, 1.0)};
            for (const auto& [carrier, weight] : of)
                for (std::size_t k = 0; k < 3; ++k)
                    (b ? forces.on_b : forces.on_a)[carrier][k] +=
                        weight * interface.weight[p] * interface.frame[9 * p + k];
        }
    return forces;
}

Mesh blocks(CellType type, std::int64_t n, const Map& map) {
    return rebuilt(layers(type, {1, 1}, {n, n}, {0.5, 0.5}, {1, 1}), 0, map);
}

// The nodal forces of a unit traction along z on the faces at z = 1/2 of a body between vertical walls: those of a
// uniform stress, int dN/dz dx over its cells.
std::map<std::int64_t, double> uniform(const Mesh& mesh, std::int32_t body) {
    std::map<std::int64_t, double> force;
    for (const std::int64_t c : mesh.body_cells(body)) {
        const CellType type = mesh.cell_type(c);
        const std::span<const std::int64_t> nodes = mesh.cell(c);
        std::vector<double> x;
        for (const std::int64_t node : nodes) x.insert(x.end(), mesh.node(node).begin(), mesh.node(node).end());
        const Quadrature& gauss = quadrature(type);
        for (std::size_t q = 0; q < gauss.points.size(); ++q) {
            const PhysicalGradient at = physical_gradient(type, x, gauss.gradients[q]);
            for (std::size_t k = 0; k < nodes.size(); ++k)
                force[nodes[k]] += gauss.weights[q] * at.jacobian * at.gradient[3 * k + 2];
        }
    }
    std::erase_if(force, [&](const auto& f) { return mesh.node(f.first)[2] != 0.5; });
    return force;
}

TEST(plane_faces_of_any_shape) {
    const Map none = {};
    const Map skew = [](std::span<double> x) {
        x[0] += 0.35 * x[1] + 0.1 * x[0] * x[1];
        x[1] -= 0.2 * x[0] * x[1];
    };
    const Map curved = [](std::span<double> x) {
        x[0] += 0.06 * std::sin(5.0 * x[1] + 0.3);
        x[1] += 0.05 * std::sin(4.0 * x[0] + 0.7);
    };
    for (const CellType type : {CellType::tet10, CellType::hex20, CellType::wedge15})
        for (const std::int64_t n : {1, 2, 3})
            for (const Map& map : {none, skew, curved}) {
                Mesh mesh = blocks(type, n, map);
                std::map<std::int64_t, double> exact = uniform(mesh, 0), other = uniform(mesh, 1);
                add_interface(mesh, 0, 1, 0.0);
                const InterfaceGeometry& i = mesh.interfaces()[0];
                ck_assert(*std::min_element(i.weight.begin(), i.weight.end()) > 0.0);
                const Forces forces = pulled(mesh, i);
                for (const auto& [node, f] : forces.on_a) ck_assert(std::abs(f[2] - exact[node]) < 1e-14);
                for (const auto& [node, f] : forces.on_b) ck_assert(std::abs(f[2] + other[node]) < 1e-14);
            }
}

// Where mid-side nodes stand far off the middle, corners would have negative weights with the s of regular faces.
TEST(weights_stay_positive) {
    for (const CellType type : {CellType::tet10, CellType::hex20, CellType::wedge15}) {
        double largest = 0.0;
        for (const double shift : {0.1, 0.2, 0.24}) {
            Mesh mesh = blocks(type, 1, [shift](std::span<double> x) {
                for (std::size_t k = 0; k < 2; ++k)
                    if (x[k] == 0.5) x[k] -= shift;
            });
            std::map<std::int64_t, double> exact = uniform(mesh, 0);
            add_interface(mesh, 0, 1, 0.0);
            const InterfaceGeometry& i = mesh.interfaces()[0];
            ck_assert(*std::min_element(i.weight.begin(), i.weight.end()) > 1e-3);
            for (const auto& [node, f] : pulled(mesh, i).on_a) ck_assert(std::abs(f[2] - exact[node]) < 1e-14);
            for (const NodeTie& tie : mesh.ties())
                for (const auto& [node, weight] : tie.of) largest = std::max(largest, weight);
        }
        std::printf("%s: largest coefficient %.3f\n", topology(type).name, largest);
        ck_assert(largest > (type == CellType::hex20 ? 1.5 : 1.25));
    }
}

// A pair at a mid-side node has the jump of its node where displacements are linear along the side, and the two tied
// nodes lie where their originals do on straight sides. No node penetrates where no pair does.
TEST(what_pairs_compare) {
    for (const CellType type : {CellType::tet10, CellType::hex20, CellType::wedge15}) {
        Mesh mesh = blocks(type, 2, {});
        add_interface(mesh, 0, 1, 0.0);
        const InterfaceGeometry& i = mesh.interfaces()[0];
        std::size_t middles = 0;
        for (const NodeTie& tie : mesh.ties()) {
            double sum = 0.0;
            std::array<double, 3> at{};
            std::size_t negative = 0;
            for (const auto& [node, weight] : tie.of) {
                sum += weight;
                negative += weight < 0.0 ? 1 : 0;
                for (std::size_t k = 0; k < 3; ++k) at[k] += weight * mesh.node(node)[k];
            }
            ck_assert(sum == 1.0 && negative == 2 && tie.of.size() == 3);
            ck_assert_int_eq(mesh.node_body(tie.node), -1);
            const std::int64_t own = node_of_pair(mesh, tie.node);
            ck_assert(own != tie.node && mesh.node_body(own) >= 0);
            ck_assert_int_eq(mesh.node_origin(tie.node), mesh.node_origin(own));
            for (std::size_t k = 0; k < 3; ++k) ck_assert(std::abs(at[k] - mesh.node(own)[k]) < 1e-15);
            ++middles;
        }
        const std::size_t tied = static_cast<std::size_t>(std::count_if(
            i.node_a.begin(), i.node_a.end(), [&](std::int64_t n) { return node_of_pair(mesh, n) != n; }));
        ck_assert_uint_eq(middles, 2 * tied);
    }
}

// A seam that ends inside a block: nodes at its tip are on both sides, and the forces of its pairs are those of a
// uniform traction but at these nodes.
TEST(tips_of_seams) {
    for (const CellType type : {CellType::tet10, CellType::hex20, CellType::wedge15}) {
        const Mesh plain = layers(type, {1, 1}, {2, 2}, {1.0}, {2});
        Mesh mesh(3, plain.nodes());
        for (std::int64_t c = 0; c < plain.cell_count(); ++c)
            mesh.add_cells(plain.cell_type(c), plain.cell(c), Labels{0});
        std::vector<std::int64_t> faces;
        std::size_t per_face = 0;
        for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
            for (std::size_t f = 0; f < topology(type).all_faces().size(); ++f) {
                const BoundaryFace face = face_of(mesh, c, f);
                const bool in = std::all_of(face.all().begin(), face.all().end(), [&](std::int64_t n) {
                    return mesh.node(n)[2] == 0.5 && mesh.node(n)[0] <= 0.5;
                });
                const auto normal = area_vector(mesh, face.all());
                if (!in || normal[2] <= 0.0) continue;
                per_face = face.all().size();
                faces.insert(faces.end(), face.all().begin(), face.all().end());
            }
        ck_assert(cut(mesh, faces, per_face) > 0);
        ck_assert_int_eq(add_seams(mesh, 0.0), 1);
        ck_assert_int_eq(add_seams(mesh, 0.0), 0);
        const InterfaceGeometry& i = mesh.interfaces()[0];
        ck_assert(*std::min_element(i.weight.begin(), i.weight.end()) > 0.0);
        Forces forces = pulled(mesh, i);
        std::map<std::int64_t, double> exact;
        for (const BoundaryFace& face : boundary_faces(mesh, 0)) {
            const auto normal = area_vector(mesh, face.all());
            const bool on = std::all_of(face.all().begin(), face.all().end(),
                                        [&](std::int64_t n) { return mesh.node(n)[2] == 0.5; });
            if (!on) continue;
            const double area = std::abs(normal[2]);
            for (std::size_t k = 0; k < face.all().size(); ++k) {
                const bool corner = k < face.corner().size();
                const double share = face.corner().size() == 3 ? (corner ? 0.0 : 1.0 / 3.0)
                                     : corner                  ? -1.0 / 12.0
                                                               : 1.0 / 3.0;
                exact[face.node[k]] += share * area * (normal[2] > 0.0 ? 1.0 : -1.0);
            }
        }
        std::size_t compared = 0;
        for (const auto* forces_of : {&forces.on_a, &forces.on_b}) {
            const double sign = forces_of == &forces.on_a ? 1.0 : -1.0;
            for (const auto& [node, f] : *forces_of) {
                if (mesh.node(node)[0] > 0.49) continue;  // the tip
                ck_assert(std::abs(f[2] - sign * exact[node]) < 1e-14);
                ++compared;
            }
        }
        ck_assert(compared > 10);
    }
}

}  // namespace
