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

// The components are xx, yy, zz, xy(, yz, zx).
std::array<double, 9> InitialStress::stress(std::int64_t cell) const {
    const bool plane = mesh_.dimension() == 2;
    const double* s = &stress_[index(cell) * (plane ? 4 : 6)];
    if (plane) return {s[0], s[3], s[3], s[1]};
    return {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]};
}

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

template <class Use>
void InitialStress::each(std::span<const double> displacement, const Use& use) const {
    const std::size_t dim = index(mesh_.dimension());
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
        std::array<double, 9> slope{};
        const double* g = cell.gradient.data();
        for (const std::int64_t n : mesh_.cell(number)) {
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) slope[i * dim + j] += displacement[index(n) * dim + i] * g[j];
            g += dim;
        }
        use(number, cell, slope);
    }
}

std::vector<double> InitialStress::softening(std::span<const double> displacement) const {
    const std::size_t dim = index(mesh_.dimension());
    std::vector<double> force(displacement.size(), 0.0);
    each(displacement, [&](std::int64_t number, const Cell& cell, const std::array<double, 9>& slope) {
        const std::array<double, 9> s = stress(number);
        std::array<double, 9> flux{};  // V H s
        for (std::size_t i = 0; i < dim; ++i)
            for (std::size_t j = 0; j < dim; ++j)
                for (std::size_t k = 0; k < dim; ++k)
                    flux[i * dim + j] += cell.volume * slope[i * dim + k] * s[k * dim + j];
        const double* g = cell.gradient.data();
        for (const std::int64_t n : mesh_.cell(number)) {
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) force[index(n) * dim + i] -= flux[i * dim + j] * g[j];
            g += dim;
        }
    });
    return force;
}

std::vector<double> InitialStress::forces() const {
    const std::size_t dim = index(mesh_.dimension());
    std::vector<double> force(index(mesh_.node_count()) * dim, 0.0);
    each(force, [&](std::int64_t number, const Cell& cell, const std::array<double, 9>&) {
        const std::array<double, 9> s = stress(number);
        const double* g = cell.gradient.data();
        for (const std::int64_t n : mesh_.cell(number)) {
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) force[index(n) * dim + i] += cell.volume * s[i * dim + j] * g[j];
            g += dim;
        }
    });
    return force;
}

double InitialStress::work_on_rotations(std::span<const double> displacement) const {
    const std::size_t dim = index(mesh_.dimension());
    double work = 0.0;
    each(displacement, [&](std::int64_t number, const Cell& cell, const std::array<double, 9>& slope) {
        const std::array<double, 9> s = stress(number);
        const auto skew = [&](std::size_t i, std::size_t j) { return 0.5 * (slope[i * dim + j] - slope[j * dim + i]); };
        for (std::size_t i = 0; i < dim; ++i)
            for (std::size_t j = 0; j < dim; ++j)
                for (std::size_t k = 0; k < dim; ++k)
                    work += 0.5 * cell.volume * s[i * dim + j] * skew(k, i) * skew(k, j);
    });
    return work;
}

}  // namespace delam
