// SPDX-License-Identifier: BSD-3-Clause
// Interfaces of unmatched meshes by means over segments, whichever body is finer: linear fields and uniform tractions
// pass exactly between plane faces of any two cell types.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "all_types.hpp"
#include "check.hpp"
#include "mesh/face_point.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/selection.hpp"
#include "projection.hpp"

using namespace delam;
using namespace unit;

namespace {

// Forces of a uniform traction of 1 on the faces of a body at z = 0.5 (y in the plane).
std::map<std::int64_t, double> uniform(const Mesh& mesh, std::int32_t body) {
    const auto dim = index(mesh.dimension());
    Numbers lower(dim, -1.0), upper(dim, 2.0), direction(dim, 0.0);
    lower[dim - 1] = upper[dim - 1] = 0.5;
    direction[dim - 1] = body == 0 ? 1.0 : -1.0;
    const Patch patch = find_patch(mesh, body, lower, upper, direction);
    std::map<std::int64_t, double> force;
    for (std::size_t i = 0; i < patch.nodes.size(); ++i) force[patch.nodes[i]] = patch.weights[i];
    return force;
}

struct Errors {
    double linear = 0.0;  // of a field that is linear in space
    // Of the force on a node of a, over the largest one, where b gives its own nodal forces, as through a perfect bond.
    double traction = 0.0;
    // Of the forces on nodes of both bodies where the tractions of the pairs are uniform, as through a law.
    double law = 0.0;
};
// first: body a.
Errors errors_of(Mesh mesh, std::int32_t first) {
    const std::map<std::int64_t, double> exact = uniform(mesh, first), given = uniform(mesh, 1 - first);
    ck_assert_int_eq(add_mortar_interface(mesh, first, 1 - first, 0.0), 0);
    const InterfaceGeometry& i = mesh.interfaces()[0];
    ck_assert(std::abs(area(i) - 1.0) < 1e-13);
    std::map<std::int64_t, std::vector<std::pair<std::int64_t, double>>> tied;
    for (const NodeTie& tie : mesh.ties()) tied[tie.node] = tie.of;
    const auto carriers = [&](std::int64_t node) {
        return tied.contains(node) ? tied[node] : std::vector<std::pair<std::int64_t, double>>{{node, 1.0}};
    };
    // The forces of the pairs under b's nodal forces are those, but where its pairs are tied: there they are unique.
    const bool own_nodes = tied.empty() || std::none_of(i.node_b.begin(), i.node_b.end(),
                                                        [&](std::int64_t node) { return tied.contains(node); });
    Errors errors;
    std::map<std::int64_t, double> force, weighted, back;
    for (std::size_t p = 0; p < i.node_b.size(); ++p) {
        double sum = 0.0, value = 0.0;
        for (const auto& [node, weight] : carriers(i.node_a[p])) {
            ck_assert_int_eq(mesh.node_body(node), first);
            sum += weight;
            value += weight * linear(mesh.node(node));
            const auto own = given.find(i.node_b[p]);  // corners of tet10 carry nothing
            force[node] += weight * (!own_nodes ? i.weight[p] : own == given.end() ? 0.0 : own->second);
            weighted[node] += weight * i.weight[p];
        }
        for (const auto& [node, weight] : carriers(i.node_b[p])) {
            ck_assert_int_eq(mesh.node_body(node), 1 - first);
            back[node] += weight * i.weight[p];
        }
        ck_assert(std::abs(sum - 1.0) < 1e-14);
        errors.linear = std::max(errors.linear, std::abs(value - linear(mesh.node(i.node_b[p]))));
    }
    double size = 0.0;
    for (const auto& [node, f] : exact) size = std::max(size, std::abs(f));
    for (const auto& [node, f] : exact) {
        errors.traction = std::max(errors.traction, std::abs(f - force[node]) / size);
        errors.law = std::max(errors.law, std::abs(f - weighted[node]) / size);
    }
    for (auto& [node, f] : back) {
        const auto own = given.find(node);
        errors.law = std::max(errors.law, std::abs(f - (own == given.end() ? 0.0 : own->second)) / size);
    }
    return errors;
}

TEST(plane_faces) {
    for (const CellType lower : all_types)
        for (const CellType upper : all_types) {
            if (topology(lower).dimension != topology(upper).dimension) continue;
            const bool plane = topology(lower).dimension == 2;
            // Wedges and pyramids have faces that cells before them have too.
            const CellType later = std::max(lower, upper);
            const std::int64_t most = plane ? 20 : later < CellType::hex27 ? 5 : later == CellType::hex27 ? 3 : 1;
            std::set<std::int64_t> cells{std::min<std::int64_t>(most, 3)};
            if (lower == upper) cells.insert({1, most});  // the clipping of faces knows their shape alone
            for (const std::int64_t n : cells)
                for (const std::int32_t first : {0, 1}) {
                    const Errors own = errors_of(blocks(stack(lower, upper, 2, n)), first);
                    const std::string what = std::string(topology(lower).name) + " below " + topology(upper).name +
                                             ", 2:" + std::to_string(n) + ", a = " + std::to_string(first) +
                                             ": linear " + std::to_string(own.linear * 1e12) + "e-12, traction " +
                                             std::to_string(own.traction * 1e12) + "e-12, law " +
                                             std::to_string(own.law * 1e12) + "e-12";
                    ck_assert_msg(own.linear < 1e-12 && own.traction < 1e-12 && own.law < 1e-12, "%s", what.c_str());
                }
        }
}

// Quadrilaterals that are no parallelograms, where the integrals are not exact.
TEST(distorted_faces) {
    const Map shift = [](std::span<double> x) {
        const double wave = std::sin(std::numbers::pi * x[0]) * std::sin(std::numbers::pi * x[1]);
        const double size = x.back() > 0.5 ? 0.1 : -0.13;
        x[0] += size * wave;
        x[1] -= 0.7 * size * wave;
    };
    for (const std::int64_t n : {2, 3, 7})
        for (const std::int32_t first : {0, 1}) {
            const Errors own = errors_of(blocks(stack(CellType::hex8, CellType::hex8, 3, n), shift), first);
            double varies = 0.0;
            const Mesh mesh = blocks(stack(CellType::hex8, CellType::hex8, 3, n), shift);
            for (const BoundaryFace& face : boundary_faces(mesh, -1)) varies = std::max(varies, distortion(mesh, face));
            std::printf("distorted hex8 (%.2f), 3:%d, a = %d: linear %.1e, traction %.1e\n", varies,
                        static_cast<int>(n), first, own.linear, own.traction);
            ck_assert(own.linear < 1e-12 && own.traction < 1e-12 && own.law < 1e-12);
        }
}

// Narrow in space. As with projected points, b's nodes are off a's faces by the distance of the chords from the arc.
TEST(curved) {
    for (const CellType type :
         {CellType::quad4, CellType::quad8, CellType::tri6, CellType::hex8, CellType::hex20, CellType::tet10}) {
        for (const std::int64_t n : {4, 8}) {
            std::vector<Block> rings = stack(type, type, n, 2 * n + 1);
            if (topology(type).dimension == 3) rings[0].divisions[1] = 2, rings[1].divisions[1] = 3;
            expect_curved(type, n, rings, add_mortar_interface);
            std::swap(rings[0].divisions, rings[1].divisions);
            expect_curved(type, n, rings, add_mortar_interface);
        }
    }
}

}  // namespace
