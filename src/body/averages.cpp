// SPDX-License-Identifier: BSD-3-Clause
#include "body/averages.hpp"

#include <vector>

#include "base/cancel_scope.hpp"
#include "body/cell_elasticity.hpp"
#include "mesh/faces.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

constexpr std::size_t in_plane[] = {0, 1, 3}, out_of_plane[] = {2, 4, 5};  // xx, yy, xy; zz, yz, zx

std::size_t shear(std::size_t i, std::size_t j) { return i + j == 1 ? 3 : i + j == 3 ? 4 : 5; }

// Integral of the strain over a cell, and its volume.
double integrate(const Mesh& mesh, std::int64_t c, std::span<const double> displacement,
                 std::array<double, 6>& strain) {
    const std::size_t dim = index(mesh.dimension());
    const auto cell = mesh.cell(c);
    std::vector<double> x;
    for (const std::int64_t n : cell) x.insert(x.end(), mesh.node(n).begin(), mesh.node(n).end());
    const Quadrature& gauss = quadrature(mesh.cell_type(c));
    double volume = 0.0;
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const PhysicalGradient g = physical_gradient(mesh.cell_type(c), x, gauss.gradients[q]);
        const double part = gauss.weights[q] * g.jacobian;
        volume += part;
        for (std::size_t a = 0; a < cell.size(); ++a)
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j)
                    strain[i == j ? i : shear(i, j)] +=
                        part * g.gradient[a * dim + j] * displacement[index(cell[a]) * dim + i];
    }
    return volume;
}

// Strains out of the plane for which the stresses there vanish: C_oo e_o = -C_oi e_i, by elimination (C_oo is
// definite).
void relax(const SpaceElasticity& c, std::array<double, 6>& strain) {
    double m[3][4];
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) m[r][k] = c[out_of_plane[r] * 6 + out_of_plane[k]];
        m[r][3] = 0.0;
        for (const std::size_t i : in_plane) m[r][3] -= c[out_of_plane[r] * 6 + i] * strain[i];
    }
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t r = p + 1; r < 3; ++r) {
            const double factor = m[r][p] / m[p][p];
            for (std::size_t k = p; k < 4; ++k) m[r][k] -= factor * m[p][k];
        }
    for (std::size_t r = 3; r-- > 0;) {
        double sum = m[r][3];
        for (std::size_t k = r + 1; k < 3; ++k) sum -= m[r][k] * strain[out_of_plane[k]];
        strain[out_of_plane[r]] = sum / m[r][r];
    }
}

}  // namespace

VolumeAverage volume_average(const Mesh& mesh, std::span<const BodyModel> models, std::span<const double> displacement,
                             std::span<const Strain> eigenstrain, std::int32_t body) {
    std::vector<CellElasticity> elasticity;
    for (const BodyModel& model : models) elasticity.emplace_back(model, mesh.dimension());
    VolumeAverage sum;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const std::int32_t own = mesh.cell_body(c);
        if (body >= 0 && own != body) continue;
        poll_cancel("recover");
        std::array<double, 6> strain{};
        const double volume = integrate(mesh, c, displacement, strain);
        sum.volume += volume;
        Strain prescribed{};
        if (!eigenstrain.empty()) {
            const Axes* axes = elasticity[index(own)].axes(c);
            prescribed = axes == nullptr ? eigenstrain[index(own)] : rotated_strain(eigenstrain[index(own)], *axes);
        }
        for (std::size_t i = 0; i < 6; ++i) strain[i] -= volume * prescribed[i];
        const SpaceElasticity& space = elasticity[index(own)].space(c);
        const bool free = mesh.dimension() == 2 && models[index(own)].plane == Plane::stress;
        if (free) relax(space, strain);
        for (std::size_t i = 0; i < 6; ++i) {
            sum.strain[i] += strain[i] + volume * prescribed[i];
            for (std::size_t j = 0; j < 6; ++j) sum.stress[i] += space[i * 6 + j] * strain[j];
        }
    }
    if (!(sum.volume > 0.0)) return sum;
    for (double& s : sum.strain) s /= sum.volume;
    for (double& s : sum.stress) s /= sum.volume;
    return sum;
}

}  // namespace delam
