// SPDX-License-Identifier: BSD-3-Clause
#include "body/rotation.hpp"

#include <algorithm>
#include <cmath>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "body/equal/centre_gradients.hpp"

namespace delam {

std::vector<double> rotations(std::span<const double> slopes, std::size_t dimension) {
    const std::size_t entries = dimension * dimension;
    std::vector<double> rotation;
    rotation.reserve(slopes.size() / entries * (dimension == 2 ? 1 : 3));
    for (std::size_t first = 0; first < slopes.size(); first += entries) {
        poll_cancel("recover");
        const double* slope = &slopes[first];
        for (std::size_t axis = dimension == 2 ? 2 : 0; axis < 3; ++axis) {
            const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
            rotation.push_back(0.5 * (slope[j * dimension + i] - slope[i * dimension + j]));
        }
    }
    return rotation;
}

std::vector<double> centre_rotation(const Mesh& mesh, std::span<const double> displacement) {
    return rotations(CentreGradients(mesh).slopes(displacement), index(mesh.dimension()));
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

}  // namespace delam
