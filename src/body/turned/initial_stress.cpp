// SPDX-License-Identifier: BSD-3-Clause
#include "body/turned/initial_stress.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "body/element.hpp"
#include "body/equal/cell_shape.hpp"

namespace delam {

namespace {

// Returns a stress, [dimension][dimension], from its components xx, yy, zz, xy(, yz, zx).
std::array<double, 9> tensor(const double* s, std::size_t dimension) {
    if (dimension == 2) return {s[0], s[3], s[3], s[1]};
    return {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]};
}

}  // namespace

InitialStress::Cell InitialStress::integrated(CellType type, std::span<const double> coordinates) {
    Cell cell{std::vector<double>(coordinates.size()), 0.0};
    cell.volume = integrate_gradients(type, coordinates, cell.gradient);
    for (double& g : cell.gradient) g /= cell.volume;
    return cell;
}

InitialStress::InitialStress(const Mesh& mesh, std::vector<double> stress) : mesh_(mesh), stress_(std::move(stress)) {
    for (double& s : stress_)
        if (!std::isfinite(s)) s = 0.0;
    CellShape shape;
    which_.reserve(index(mesh.cell_count()));
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        poll_cancel("recover");
        shape.take(mesh, c);
        const auto make = [&] { return integrated(mesh.cell_type(c), shape.coordinates()); };
        which_.push_back(static_cast<std::int32_t>(cells_.number(shape.row(), make)));
    }
}

std::vector<double> InitialStress::softening(std::span<const double> displacement) const {
    const std::size_t dim = index(mesh_.dimension()), columns = dim == 2 ? 4 : 6;
    std::vector<double> force(displacement.size(), 0.0);
    CellShape shape;
    Cell own;
    for (std::size_t c = 0; c < which_.size(); ++c) {
        poll_cancel("recover");
        const auto number = static_cast<std::int64_t>(c);
        if (which_[c] < 0) {
            shape.take(mesh_, number);
            own = integrated(mesh_.cell_type(number), shape.coordinates());
        }
        const Cell& cell = which_[c] < 0 ? own : cells_.at(which_[c]);
        const std::array<double, 9> s = tensor(&stress_[c * columns], dim);
        std::array<double, 9> slope{}, flux{};  // H, V H s
        const double* g = cell.gradient.data();
        for (const std::int64_t n : mesh_.cell(number)) {
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) slope[i * dim + j] += displacement[index(n) * dim + i] * g[j];
            g += dim;
        }
        for (std::size_t i = 0; i < dim; ++i)
            for (std::size_t j = 0; j < dim; ++j)
                for (std::size_t k = 0; k < dim; ++k)
                    flux[i * dim + j] += cell.volume * slope[i * dim + k] * s[k * dim + j];
        g = cell.gradient.data();
        for (const std::int64_t n : mesh_.cell(number)) {
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) force[index(n) * dim + i] -= flux[i * dim + j] * g[j];
            g += dim;
        }
    }
    return force;
}

}  // namespace delam
