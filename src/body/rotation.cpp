// SPDX-License-Identifier: BSD-3-Clause
#include "body/rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/cancel_scope.hpp"
#include "mesh/faces.hpp"
#include "mesh/shape.hpp"

namespace delam {

std::vector<double> centre_rotation(const Mesh& mesh, std::span<const double> displacement) {
    const std::size_t dim = index(mesh.dimension());
    std::vector<double> rotation;
    std::array<double, 3 * most_cell_nodes> x;
    rotation.reserve(index(mesh.cell_count()) * (dim == 2 ? 1 : 3));
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        poll_cancel("recover");
        const auto cell = mesh.cell(c);
        auto end = x.begin();
        for (const std::int64_t n : cell) end = std::copy_n(mesh.node(n).begin(), dim, end);
        const PhysicalGradient g =
            physical_gradient(mesh.cell_type(c), {x.begin(), end}, centre_gradient(mesh.cell_type(c)));
        std::array<std::array<double, 3>, 3> slope{};  // du_i/dx_j
        for (std::size_t a = 0; a < cell.size(); ++a)
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j)
                    slope[i][j] += g.gradient[a * dim + j] * displacement[index(cell[a]) * dim + i];
        for (std::size_t axis = dim == 2 ? 2 : 0; axis < 3; ++axis) {
            const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
            rotation.push_back(0.5 * (slope[j][i] - slope[i][j]));
        }
    }
    return rotation;
}

double largest_length(std::span<const double> rotation, std::size_t columns) {
    double largest = 0.0;
    for (std::size_t i = 0; i < rotation.size(); i += columns) {
        double square = 0.0;
        for (std::size_t k = 0; k < columns; ++k) square += rotation[i + k] * rotation[i + k];
        largest = std::max(largest, std::sqrt(square));
    }
    return largest;
}

double largest_rotation(const Mesh& mesh, std::span<const double> displacement) {
    return largest_length(centre_rotation(mesh, displacement), mesh.dimension() == 2 ? 1 : 3);
}

}  // namespace delam
