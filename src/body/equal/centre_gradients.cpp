// SPDX-License-Identifier: BSD-3-Clause
#include "body/equal/centre_gradients.hpp"

#include <array>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "body/equal/cell_shape.hpp"

namespace delam {

namespace {

std::vector<double> gradient_of(CellType type, std::span<const double> coordinates) {
    const PhysicalGradient at = physical_gradient(type, coordinates, centre_gradient(type));
    return {at.gradient.begin(), at.gradient.begin() + static_cast<std::ptrdiff_t>(coordinates.size())};
}

}  // namespace

CentreGradients::CentreGradients(const Mesh& mesh) : mesh_(mesh) {
    CellShape shape;
    which_.reserve(index(mesh.cell_count()));
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        poll_cancel("recover");
        shape.take(mesh, c);
        const auto make = [&] { return gradient_of(mesh.cell_type(c), shape.coordinates()); };
        which_.push_back(static_cast<std::int32_t>(gradients_.number(shape.row(), make)));
    }
}

template <std::size_t dim, class Displacement>
std::vector<double> CentreGradients::slopes_in(const Displacement& displacement) const {
    std::vector<double> slopes(which_.size() * dim * dim);
    CellShape shape;
    std::vector<double> own;
    for (std::size_t c = 0; c < which_.size(); ++c) {
        poll_cancel("recover");
        const auto cell = static_cast<std::int64_t>(c);
        if (which_[c] < 0) {
            shape.take(mesh_, cell);
            own = gradient_of(mesh_.cell_type(cell), shape.coordinates());
        }
        const std::vector<double>& gradient = which_[c] < 0 ? own : gradients_.at(which_[c]);
        std::array<double, dim * dim> sum{};
        const double* at = gradient.data();
        displacement(cell, [&](const double* u) {
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) sum[i * dim + j] += at[j] * u[i];
            at += dim;
        });
        std::copy(sum.begin(), sum.end(), slopes.begin() + static_cast<std::ptrdiff_t>(c * dim * dim));
    }
    return slopes;
}

std::vector<double> CentreGradients::slopes(std::span<const double> displacement) const {
    const std::size_t dim = index(mesh_.dimension());
    const auto each_node = [&](std::int64_t cell, const auto& use) {
        for (const std::int64_t n : mesh_.cell(cell)) use(&displacement[index(n) * dim]);
    };
    return dim == 2 ? slopes_in<2>(each_node) : slopes_in<3>(each_node);
}

std::vector<double> CentreGradients::slopes(const DisplacementOfCell& displacement) const {
    const std::size_t dim = index(mesh_.dimension());
    const auto each_node = [&](std::int64_t cell, const auto& use) {
        const std::span<const double> own = displacement(cell);
        for (std::size_t i = 0; i < own.size(); i += dim) use(&own[i]);
    };
    return dim == 2 ? slopes_in<2>(each_node) : slopes_in<3>(each_node);
}

}  // namespace delam
