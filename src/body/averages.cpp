// SPDX-License-Identifier: BSD-3-Clause
#include "body/averages.hpp"

#include <algorithm>
#include <vector>

#include "base/cancel_scope.hpp"
#include "body/cell_elasticity.hpp"
#include "linalg/dense/dense.hpp"
#include "mesh/faces.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

constexpr std::size_t in_plane[] = {0, 1, 3}, out_of_plane[] = {2, 4, 5};  // xx, yy, xy; zz, yz, zx

std::size_t shear(std::size_t i, std::size_t j) { return i + j == 1 ? 3 : i + j == 3 ? 4 : 5; }

// The volume of a cell, and the integrals of the gradients of its nodes' shape functions, [nodes][dimension].
struct CellIntegral {
    double volume = 0.0;
    std::vector<double> gradient;
};

// Returns the integrals of the strains of displacements [nodes][dimension].
std::array<double, 6> integrated_strain(const CellIntegral& cell, std::span<const double> displacement,
                                        std::size_t dim) {
    std::array<double, 6> strain{};
    for (std::size_t k = 0; k < displacement.size(); ++k)
        for (std::size_t j = 0; j < dim; ++j) {
            const std::size_t i = k % dim;
            strain[i == j ? i : shear(i, j)] += cell.gradient[k - i + j] * displacement[k];
        }
    return strain;
}

CellIntegral integrate(const Mesh& mesh, std::int64_t c) {
    const std::size_t dim = index(mesh.dimension());
    const auto cell = mesh.cell(c);
    std::vector<double> x;
    for (const std::int64_t n : cell) x.insert(x.end(), mesh.node(n).begin(), mesh.node(n).end());
    const Quadrature& gauss = quadrature(mesh.cell_type(c));
    CellIntegral out{0.0, std::vector<double>(cell.size() * dim, 0.0)};
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const PhysicalGradient g = physical_gradient(mesh.cell_type(c), x, gauss.gradients[q]);
        const double part = gauss.weights[q] * g.jacobian;
        out.volume += part;
        for (std::size_t i = 0; i < out.gradient.size(); ++i) out.gradient[i] += part * g.gradient[i];
    }
    return out;
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

// The strain less the prescribed one from that of the displacements less it, [6][6]: with the strains out of the plane
// that stresses of zero there leave.
SpaceElasticity elastic_strain(const SpaceElasticity& elasticity, bool free) {
    SpaceElasticity m{};
    for (std::size_t j = 0; j < 6; ++j) {
        std::array<double, 6> strain{};
        strain[j] = 1.0;
        if (free) relax(elasticity, strain);
        for (std::size_t i = 0; i < 6; ++i) m[i * 6 + j] = strain[i];
    }
    return m;
}

SpaceElasticity product(const SpaceElasticity& a, const SpaceElasticity& b) {
    SpaceElasticity m{};
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            for (std::size_t k = 0; k < 6; ++k) m[i * 6 + j] += a[i * 6 + k] * b[k * 6 + j];
    return m;
}

std::array<double, 6> product(const SpaceElasticity& m, const std::array<double, 6>& v) {
    std::array<double, 6> out{};
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) out[i] += m[i * 6 + j] * v[j];
    return out;
}

// Returns stresses turned as rotated_strain() turns strains, whose shear is doubled.
std::array<double, 6> rotated_stress(std::array<double, 6> stress, const std::array<double, 9>& axes) {
    for (std::size_t i = 3; i < 6; ++i) stress[i] *= 2.0;
    stress = rotated_strain(stress, axes);
    for (std::size_t i = 3; i < 6; ++i) stress[i] *= 0.5;
    return stress;
}

// e* in the axes of a cell, from that in material axes, [6][6].
SpaceElasticity turned(const Axes* axes) {
    SpaceElasticity m{};
    for (std::size_t j = 0; j < 6; ++j) {
        Strain unit{};
        unit[j] = 1.0;
        const Strain own = axes == nullptr ? unit : rotated_strain(unit, *axes);
        for (std::size_t i = 0; i < 6; ++i) m[i * 6 + j] = own[i];
    }
    return m;
}

}  // namespace

AverageWeights average_weights(const Mesh& mesh, std::span<const BodyModel> models, std::int32_t body) {
    std::vector<CellElasticity> elasticity;
    for (const BodyModel& model : models) elasticity.emplace_back(model, mesh.dimension());
    const std::size_t dim = index(mesh.dimension());
    AverageWeights w;
    w.strain_of_eigenstrain.resize(models.size());
    w.stress_of_eigenstrain.resize(models.size());
    const auto add = [&](std::array<std::vector<double>, 6>& to, const SpaceElasticity& map, std::size_t strain,
                         std::size_t dof, double value) {
        for (std::size_t r = 0; r < 6; ++r) {
            if (map[r * 6 + strain] == 0.0) continue;
            if (to[r].empty()) to[r].assign(index(mesh.node_count()) * dim, 0.0);
            to[r][dof] += map[r * 6 + strain] * value;
        }
    };
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const auto own = index(mesh.cell_body(c));
        if (body >= 0 && mesh.cell_body(c) != body) continue;
        poll_cancel("recover");
        const CellIntegral cell = integrate(mesh, c);
        w.volume += cell.volume;
        const SpaceElasticity& space = elasticity[own].space(c);
        const bool free = mesh.dimension() == 2 && models[own].plane == Plane::stress;
        const SpaceElasticity elastic = elastic_strain(space, free), stress = product(space, elastic);
        const auto nodes = mesh.cell(c);
        for (std::size_t a = 0; a < nodes.size(); ++a)
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) {
                    const std::size_t strain = i == j ? i : shear(i, j), dof = index(nodes[a]) * dim + i;
                    add(w.strain, elastic, strain, dof, cell.gradient[a * dim + j]);
                    add(w.stress, stress, strain, dof, cell.gradient[a * dim + j]);
                }
        // strain = elastic (eps - e*) + e*
        const SpaceElasticity turn = turned(elasticity[own].axes(c)), strain_of = product(elastic, turn),
                              stress_of = product(stress, turn);
        for (std::size_t i = 0; i < 36; ++i) {
            w.strain_of_eigenstrain[own][i] += cell.volume * (turn[i] - strain_of[i]);
            w.stress_of_eigenstrain[own][i] -= cell.volume * stress_of[i];
        }
    }
    if (!(w.volume > 0.0)) return w;
    const auto divide = [&](auto& of) {
        for (double& x : of) x /= w.volume;
    };
    for (auto* const of : {&w.strain, &w.stress}) std::for_each(of->begin(), of->end(), divide);
    for (auto* const of : {&w.strain_of_eigenstrain, &w.stress_of_eigenstrain})
        std::for_each(of->begin(), of->end(), divide);
    return w;
}

VolumeAverage AverageWeights::with(const std::array<double, 6>& strain_of_displacement,
                                   const std::array<double, 6>& stress_of_displacement,
                                   std::span<const Strain> eigenstrain) const {
    VolumeAverage out{volume, strain_of_displacement, stress_of_displacement};
    for (std::size_t b = 0; b < eigenstrain.size(); ++b)
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j) {
                out.strain[i] += strain_of_eigenstrain[b][i * 6 + j] * eigenstrain[b][j];
                out.stress[i] += stress_of_eigenstrain[b][i * 6 + j] * eigenstrain[b][j];
            }
    return out;
}

VolumeAverage volume_average(const Mesh& mesh, std::span<const BodyModel> models, std::span<const double> displacement,
                             std::span<const Strain> eigenstrain, std::int32_t body) {
    const AverageWeights weights = average_weights(mesh, models, body);
    std::array<double, 6> strain{}, stress{};
    for (std::size_t i = 0; i < 6; ++i) {
        strain[i] = dot(weights.strain[i], displacement);
        stress[i] = dot(weights.stress[i], displacement);
    }
    return weights.with(strain, stress, eigenstrain);
}

VolumeAverage volume_average(const Mesh& mesh, std::span<const BodyModel> models,
                             const DisplacementOfCell& displacement, const AxesOfCell& axes,
                             std::span<const Strain> eigenstrain, std::int32_t body) {
    std::vector<CellElasticity> elasticity;
    for (const BodyModel& model : models) elasticity.emplace_back(model, mesh.dimension());
    VolumeAverage out;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const auto own = index(mesh.cell_body(c));
        if (body >= 0 && mesh.cell_body(c) != body) continue;
        poll_cancel("recover");
        const CellIntegral cell = integrate(mesh, c);
        const SpaceElasticity& space = elasticity[own].space(c);
        const bool free = mesh.dimension() == 2 && models[own].plane == Plane::stress;
        std::array<double, 6> prescribed{};
        if (!eigenstrain.empty()) prescribed = product(turned(elasticity[own].axes(c)), eigenstrain[own]);
        std::array<double, 6> strain = integrated_strain(cell, displacement(c), index(mesh.dimension()));
        for (std::size_t i = 0; i < 6; ++i) strain[i] -= cell.volume * prescribed[i];
        strain = product(elastic_strain(space, free), strain);
        const std::array<double, 6> stress = rotated_stress(product(space, strain), axes(c));
        for (std::size_t i = 0; i < 6; ++i) strain[i] += cell.volume * prescribed[i];
        strain = rotated_strain(strain, axes(c));
        out.volume += cell.volume;
        for (std::size_t i = 0; i < 6; ++i) {
            out.strain[i] += strain[i];
            out.stress[i] += stress[i];
        }
    }
    if (!(out.volume > 0.0)) return out;
    for (double& e : out.strain) e /= out.volume;
    for (double& s : out.stress) s /= out.volume;
    return out;
}

}  // namespace delam
