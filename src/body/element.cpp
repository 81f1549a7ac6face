// SPDX-License-Identifier: BSD-3-Clause
#include "body/element.hpp"

#include <array>

namespace delam {

namespace {

// The strain operator B of one node at one point, [strains][components]: u_i,j collected as xx, yy, 2xy in the plane
// and xx, yy, zz, 2xy, 2yz, 2zx in space.
using NodeStrain = std::array<double, 18>;

NodeStrain node_strain(int dimension, const double* g) {
    if (dimension == 2) return {g[0], 0.0, 0.0, g[1], g[1], g[0]};
    return {g[0], 0.0,  0.0,  0.0, g[1], 0.0,  0.0,  0.0,  g[2],
            g[1], g[0], 0.0,  0.0, g[2], g[1], g[2], 0.0,  g[0]};
}

}  // namespace

// K = int B^T D B dx, summed over the Gauss points node by node; the blocks below the diagonal are copied from those
// above, and within a diagonal block likewise, so that K equals its transpose bit for bit.
std::vector<double> element_stiffness(CellType type, std::span<const double> coordinates,
                                      std::span<const double> elasticity) {
    const CellTopology& shape = topology(type);
    const auto nodes = static_cast<std::size_t>(shape.nodes);
    const auto dim = static_cast<std::size_t>(shape.dimension);
    const std::size_t strains = dim == 2 ? 3 : 6;
    const std::size_t size = nodes * dim;
    std::vector<double> k(size * size, 0.0);

    const Quadrature gauss = quadrature(type);
    for (const ReferencePoint& point : gauss.points) {
        const PhysicalGradient at_point = physical_gradient(type, coordinates, point);
        const double volume = gauss.weight * at_point.jacobian;
        for (std::size_t b = 0; b < nodes; ++b) {
            const NodeStrain right = node_strain(shape.dimension, &at_point.gradient[b * dim]);
            NodeStrain stress{};  // D B_b, times the volume
            for (std::size_t s = 0; s < strains; ++s)
                for (std::size_t r = 0; r < strains; ++r)
                    for (std::size_t j = 0; j < dim; ++j)
                        stress[s * dim + j] += volume * elasticity[s * strains + r] * right[r * dim + j];
            for (std::size_t a = 0; a <= b; ++a) {
                const NodeStrain left = node_strain(shape.dimension, &at_point.gradient[a * dim]);
                for (std::size_t i = 0; i < dim; ++i)
                    for (std::size_t j = 0; j < dim; ++j)
                        for (std::size_t s = 0; s < strains; ++s)
                            k[(a * dim + i) * size + b * dim + j] += left[s * dim + i] * stress[s * dim + j];
            }
        }
    }
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < i; ++j) k[i * size + j] = k[j * size + i];
    return k;
}

std::vector<double> centre_strain(CellType type, std::span<const double> coordinates,
                                  std::span<const double> displacement) {
    const CellTopology& shape = topology(type);
    const auto dim = static_cast<std::size_t>(shape.dimension);
    const PhysicalGradient at_centre = physical_gradient(type, coordinates, centre(type));
    std::vector<double> strain(dim == 2 ? 3 : 6, 0.0);
    for (std::size_t a = 0; a < static_cast<std::size_t>(shape.nodes); ++a) {
        const NodeStrain b = node_strain(shape.dimension, &at_centre.gradient[a * dim]);
        for (std::size_t s = 0; s < strain.size(); ++s)
            for (std::size_t i = 0; i < dim; ++i) strain[s] += b[s * dim + i] * displacement[a * dim + i];
    }
    return strain;
}

}  // namespace delam
