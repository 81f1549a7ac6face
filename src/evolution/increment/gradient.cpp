// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/points.hpp"
#include "mesh/rule/mid_sides.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

using Local = std::array<double, most_face_nodes * most_face_nodes>;

// The pairs of a face without padding entries (interface_geometry.hpp): those of a separate element.
std::vector<std::int64_t> unpadded(std::span<const std::int64_t> listed) {
    std::vector<std::int64_t> face;
    for (const std::int64_t pair : listed)
        if (std::find(face.begin(), face.end(), pair) == face.end()) face.push_back(pair);
    return face;
}

// int N_a' N_b' / |x'| dxi, three Gauss points: exact on straight edges with the middle node midway.
Local line_stiffness(std::span<const Point> x) {
    const double outer = std::sqrt(0.6);
    const std::array<double, 3> point{-outer, 0.0, outer}, weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    Local local{};
    for (std::size_t q = 0; q < 3; ++q) {
        const double xi = point[q];
        const std::array<double, 3> g =
            x.size() == 2 ? std::array{-0.5, 0.5, 0.0} : std::array{xi - 0.5, xi + 0.5, -2.0 * xi};
        Point tangent{};
        for (std::size_t a = 0; a < x.size(); ++a)
            for (std::size_t i = 0; i < 3; ++i) tangent[i] += g[a] * (x[a][i] - x[0][i]);
        const double length = std::hypot(tangent[0], tangent[1], tangent[2]);
        for (std::size_t a = 0; a < x.size(); ++a)
            for (std::size_t b = 0; b < x.size(); ++b) local[a * x.size() + b] += weight[q] * g[a] * g[b] / length;
    }
    return local;
}

// int g_a^T G^-1 g_b sqrt(det G) dxi
Local surface_stiffness(CellType type, std::span<const Point> x) {
    const Quadrature& gauss = quadrature(type);
    Local local{};
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const ShapeGradient& g = gauss.gradients[q];
        Point u{}, v{};
        for (std::size_t a = 0; a < x.size(); ++a)
            for (std::size_t i = 0; i < 3; ++i) {
                u[i] += g[2 * a] * (x[a][i] - x[0][i]);
                v[i] += g[2 * a + 1] * (x[a][i] - x[0][i]);
            }
        const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), area = length(cross(u, v));
        for (std::size_t a = 0; a < x.size(); ++a)
            for (std::size_t b = 0; b < x.size(); ++b)
                local[a * x.size() + b] += gauss.weights[q] / area *
                                           (g[2 * a] * (vv * g[2 * b] - uv * g[2 * b + 1]) +
                                            g[2 * a + 1] * (uu * g[2 * b + 1] - uv * g[2 * b]));
    }
    return local;
}

Local stiffness_of(int dimension, std::span<const Point> x) {
    if (dimension == 2) return line_stiffness(x);
    return surface_stiffness(face_row(dimension, x.size()).surface, x);
}

}  // namespace

SparseMatrix surface_stiffness(const Mesh& mesh, const InterfaceGeometry& interface, std::span<const double> adhesion) {
    const auto per_face = index(interface.nodes_per_face);
    std::vector<Triplet> entries;
    for (std::int64_t p = 0; p < interface.pair_count(); ++p) entries.push_back({p, p, 0.0});
    for (std::size_t f = 0; f + per_face <= interface.face.size(); f += per_face) {
        const std::vector<std::int64_t> face = unpadded(std::span(interface.face).subspan(f, per_face));
        if (std::any_of(face.begin(), face.end(), [&](std::int64_t p) { return !(adhesion[index(p)] > 0.0); }))
            continue;
        const std::size_t n = face.size();
        std::vector<Point> x(n, Point{});
        for (std::size_t a = 0; a < n; ++a) {
            const auto node = mesh.node(node_of_pair(mesh, interface.node_a[index(face[a])]));
            std::copy(node.begin(), node.end(), x[a].begin());
        }
        const Local local = stiffness_of(mesh.dimension(), x);
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t b = 0; b < n; ++b)
                entries.push_back({face[a], face[b], 0.5 * (local[a * n + b] + local[b * n + a])});
    }
    return from_triplets(interface.pair_count(), interface.pair_count(), std::move(entries));
}

GradientTerm::GradientTerm(double kappa, const SparseMatrix& stiffness, std::vector<double> weight, std::size_t first)
    : kappa_(kappa),
      matrix_(stiffness),
      weight_(std::move(weight)),
      diagonal_(weight_.size(), 0.0),
      first_(first),
      work_(stiffness),
      factor_(stiffness) {
    if (matrix_.rows != static_cast<std::int64_t>(weight_.size()))
        fail(DELAM_ERROR_INTERNAL, "gradient term: ", weight_.size(), " weights for ", matrix_.rows, " pairs");
    for (double& value : matrix_.value) value *= kappa;
    for (std::size_t r = 0; r < weight_.size(); ++r)
        for (auto e = index(matrix_.start[r]); e < index(matrix_.start[r + 1]); ++e)
            if (matrix_.column[e] == static_cast<std::int64_t>(r)) diagonal_[r] = matrix_.value[e];
}

std::int64_t GradientTerm::coupled_pairs() const {
    return std::count_if(diagonal_.begin(), diagonal_.end(), [](double d) { return d > 0.0; });
}

std::vector<double> GradientTerm::force(std::span<const double> zeta) const {
    std::vector<double> out(zeta.size(), 0.0);
    for (std::size_t r = 0; r < zeta.size(); ++r)
        for (auto e = index(matrix_.start[r]); e < index(matrix_.start[r + 1]); ++e)
            out[r] += matrix_.value[e] * (zeta[index(matrix_.column[e])] - zeta[r]);
    return out;
}

// With rows that sum to zero, z^T A z = -1/2 sum_ij A_ij (z_i - z_j)^2.
double GradientTerm::energy(std::span<const double> zeta) const {
    double sum = 0.0;
    for (std::size_t r = 0; r < zeta.size(); ++r)
        for (auto e = index(matrix_.start[r]); e < index(matrix_.start[r + 1]); ++e) {
            const double difference = zeta[r] - zeta[index(matrix_.column[e])];
            sum -= matrix_.value[e] * difference * difference;
        }
    return 0.25 * sum;
}

bool GradientTerm::solve(std::span<const double> diag, std::span<const std::uint8_t> held, std::span<const double> b,
                         std::span<double> x) const {
    for (std::size_t r = 0; r < diag.size(); ++r)
        for (auto e = index(matrix_.start[r]); e < index(matrix_.start[r + 1]); ++e) {
            const auto c = index(matrix_.column[e]);
            work_.value[e] = r == c                         ? matrix_.value[e] + diag[r]
                             : held[r] != 0 || held[c] != 0 ? 0.0
                                                            : matrix_.value[e];
        }
    if (!factor_.factorise(work_)) return false;
    factor_.solve(b, x);
    return true;
}

}  // namespace delam
