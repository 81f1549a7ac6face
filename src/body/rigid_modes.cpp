// SPDX-License-Identifier: BSD-3-Clause
#include "body/rigid_modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/faces.hpp"

namespace delam {

// Translations, then the rotations  omega x (x - centroid) / size  about each axis. Modified Gram-Schmidt, run twice,
// makes the columns orthonormal: the second run gives full precision even for a slender body (Giraud, Langou,
// Rozloznik, Comput. Math. Appl. 50, 2005).
std::vector<double> rigid_modes(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    const std::size_t dim = index(mesh.dimension());
    const std::size_t rows = nodes.size() * dim;
    std::array<double, 3> centroid{};
    for (int pass = 0; pass < 2; ++pass) {  // the second pass removes the rounding of a body far from the origin
        std::array<double, 3> off{};
        for (const std::int64_t n : nodes)
            for (std::size_t i = 0; i < dim; ++i) off[i] += mesh.node(n)[i] - centroid[i];
        for (std::size_t i = 0; i < dim; ++i) centroid[i] += off[i] / static_cast<double>(nodes.size());
    }
    double size = 0.0;
    for (const std::int64_t n : nodes)
        for (std::size_t i = 0; i < dim; ++i) size = std::max(size, std::abs(mesh.node(n)[i] - centroid[i]));
    if (!(size > 0.0)) size = 1.0;

    std::vector<std::vector<double>> modes(dim == 2 ? 3 : 6, std::vector<double>(rows, 0.0));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        std::array<double, 3> x{};
        for (std::size_t i = 0; i < dim; ++i) x[i] = (mesh.node(nodes[k])[i] - centroid[i]) / size;
        for (std::size_t i = 0; i < dim; ++i) modes[i][k * dim + i] = 1.0;
        for (std::size_t r = dim; r < modes.size(); ++r) {
            const std::size_t u = dim == 2 ? 0 : (r - dim + 1) % 3;
            const std::size_t v = dim == 2 ? 1 : (r - dim + 2) % 3;
            modes[r][k * dim + u] = -x[v];
            modes[r][k * dim + v] = x[u];
        }
    }

    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    };
    std::vector<double> basis;
    std::vector<std::vector<double>> kept;
    for (std::vector<double>& mode : modes) {
        const double before = std::sqrt(dot(mode, mode));
        for (int pass = 0; pass < 2; ++pass) {
            for (const std::vector<double>& q : kept) {
                const double share = dot(q, mode);
                for (std::size_t i = 0; i < rows; ++i) mode[i] -= share * q[i];
            }
        }
        const double after = std::sqrt(dot(mode, mode));
        if (!(after > 1e-10 * before)) continue;
        for (double& m : mode) m /= after;
        kept.push_back(mode);
        basis.insert(basis.end(), mode.begin(), mode.end());
    }
    return basis;
}

}  // namespace delam
