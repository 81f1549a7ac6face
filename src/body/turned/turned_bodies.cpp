// SPDX-License-Identifier: BSD-3-Clause
#include "body/turned/turned_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/assembly.hpp"
#include "body/cell_elasticity.hpp"
#include "delam/delam.h"

namespace delam {

std::vector<TurnedCell> turned_cells(const Mesh& mesh, std::span<const BodyModel> models) {
    std::vector<TurnedCell> cells;
    const BodyModel* model = nullptr;
    std::optional<CellElasticity> elasticity;
    std::vector<double> matrix, x;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        poll_cancel("assemble");
        x.clear();
        for (const std::int64_t n : mesh.cell(c)) x.insert(x.end(), mesh.node(n).begin(), mesh.node(n).end());
        if (const BodyModel& next = models[index(mesh.cell_body(c))]; &next != model) {
            model = &next;
            elasticity.emplace(next, mesh.dimension());
        }
        matrix.assign(x.size() * x.size(), 0.0);
        cell_stiffness(mesh.cell_type(c), x, c, model->formulation, *elasticity, matrix);
        cells.emplace_back(index(mesh.dimension()), x, matrix);
    }
    return cells;
}

TurnedBodies::TurnedBodies(const Mesh& mesh, std::span<const BodyModel> models)
    : mesh_(mesh), cells_(turned_cells(mesh, models)), place_(index(mesh.node_count()), -1) {
    for (const TurnedCell& cell : cells_) largest_stiffness_ = std::max(largest_stiffness_, max_abs(cell.stiffness()));
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        const std::vector<std::int64_t> nodes = mesh.body_nodes(body);
        for (std::size_t i = 0; i < nodes.size(); ++i) place_[index(nodes[i])] = static_cast<std::int64_t>(i);
        own_.push_back(mesh.body_cells(body));
        pattern_.push_back(assemble_stiffness(mesh, own_.back(), nodes, models[index(body)]));
        std::fill(pattern_.back().value.begin(), pattern_.back().value.end(), 0.0);
    }
}

void TurnedBodies::gather(std::int64_t cell, std::span<const double> of_mesh, std::vector<double>& of_cell) const {
    const auto dim = index(mesh_.dimension());
    of_cell.clear();
    for (const std::int64_t node : mesh_.cell(cell))
        for (std::size_t k = 0; k < dim; ++k) of_cell.push_back(of_mesh[index(node) * dim + k]);
}

void TurnedBodies::scatter(std::int64_t cell, std::span<const double> of_cell, std::span<double> of_mesh) const {
    const auto dim = index(mesh_.dimension());
    const auto nodes = mesh_.cell(cell);
    for (std::size_t i = 0; i < of_cell.size(); ++i) of_mesh[index(nodes[i / dim]) * dim + i % dim] += of_cell[i];
}

void TurnedBodies::move(std::span<const double> displacement) {
    std::vector<double> u;
    for (std::int64_t c = 0; c < mesh_.cell_count(); ++c) {
        poll_cancel("assemble");
        gather(c, displacement, u);
        if (!cells_[index(c)].move(u))
            fail(DELAM_LIMIT, "cell ", c, " of body ", mesh_.body_label(mesh_.cell_body(c)),
                 " is turned inside out by its displacements: smaller load steps may help");
    }
}

double TurnedBodies::energy() const {
    double sum = 0.0;
    for (const TurnedCell& cell : cells_) sum += cell.energy();
    return sum;
}

std::vector<double> TurnedBodies::force() const {
    std::vector<double> force(index(mesh_.node_count() * mesh_.dimension()), 0.0), own;
    for (std::int64_t c = 0; c < mesh_.cell_count(); ++c) {
        own.assign(mesh_.cell(c).size() * index(mesh_.dimension()), 0.0);
        cells_[index(c)].add_force(own);
        scatter(c, own, force);
    }
    return force;
}

std::vector<double> TurnedBodies::force_of(const Pulls& pulls) const {
    std::vector<double> force(index(mesh_.node_count() * mesh_.dimension()), 0.0), own;
    for (std::int64_t c = 0; c < mesh_.cell_count(); ++c) {
        if (pulls[index(c)].empty()) continue;
        own.assign(mesh_.cell(c).size() * index(mesh_.dimension()), 0.0);
        cells_[index(c)].add_force_of(pulls[index(c)], own);
        scatter(c, own, force);
    }
    return force;
}

double TurnedBodies::work(const Pulls& pulls) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < cells_.size(); ++c)
        if (!pulls[c].empty()) sum += cells_[c].work(pulls[c]);
    return sum;
}

TurnedBodies::Pulls TurnedBodies::pulls() const {
    Pulls pulls;
    pulls.reserve(cells_.size());
    for (const TurnedCell& cell : cells_) pulls.push_back(cell.pull());
    return pulls;
}

void TurnedBodies::add_pulls_along(std::span<const double> displacement, Pulls& pulls) const {
    std::vector<double> u;
    for (std::int64_t c = 0; c < mesh_.cell_count(); ++c) {
        gather(c, displacement, u);
        const std::vector<Vector3> change = cells_[index(c)].pull_along(u);
        std::vector<Vector3>& own = pulls[index(c)];
        for (std::size_t n = 0; n < own.size(); ++n)
            for (std::size_t k = 0; k < 3; ++k) own[n][k] += change[n][k];
    }
}

void TurnedBodies::set_tangent(std::int32_t body, TurnedCell::Stresses stresses, const Pulls& pulls,
                               SparseMatrix& k) const {
    if (k.rows == 0) k = pattern_[index(body)];
    std::fill(k.value.begin(), k.value.end(), 0.0);
    const auto dim = index(mesh_.dimension());
    std::vector<double> own;
    for (const std::int64_t c : own_[index(body)]) {
        poll_cancel("assemble");
        const auto nodes = mesh_.cell(c);
        const std::size_t size = nodes.size() * dim;
        own.resize(size * size);
        cells_[index(c)].tangent(own, stresses, pulls[index(c)]);
        // The rows of a node have the same columns.
        for (std::size_t a = 0; a < nodes.size(); ++a) {
            const auto row = index(place_[index(nodes[a])]) * dim;
            const auto begin = k.column.begin() + k.start[row], end = k.column.begin() + k.start[row + 1];
            for (std::size_t b = 0; b < nodes.size(); ++b) {
                const std::int64_t column = place_[index(nodes[b])] * static_cast<std::int64_t>(dim);
                const auto offset = std::lower_bound(begin, end, column) - begin;
                for (std::size_t i = 0; i < dim; ++i)
                    for (std::size_t j = 0; j < dim; ++j)
                        k.value[index(k.start[row + i] + offset) + j] += own[(a * dim + i) * size + b * dim + j];
            }
        }
    }
}

void TurnedBodies::add_couple(std::int64_t cell, const Vector3& couple, std::span<double> force) const {
    std::vector<double> own(mesh_.cell(cell).size() * index(mesh_.dimension()), 0.0);
    cells_[index(cell)].add_couple(couple, own);
    scatter(cell, own, force);
}

// The skew part of R has the sine of the angle, its trace the cosine.
std::vector<double> TurnedBodies::rotation_vectors() const {
    std::vector<double> rotation;
    for (const TurnedCell& cell : cells_) {
        const Matrix3& r = cell.rotation();
        if (mesh_.dimension() == 2) {
            rotation.push_back(std::atan2(r[3], r[0]));
            continue;
        }
        const Vector3 axis{0.5 * (r[7] - r[5]), 0.5 * (r[2] - r[6]), 0.5 * (r[3] - r[1])};
        const double sine = length(axis), angle = std::atan2(sine, 0.5 * (r[0] + r[4] + r[8] - 1.0));
        for (const double a : axis) rotation.push_back(sine > 0.0 ? a * angle / sine : 0.0);
    }
    return rotation;
}

std::vector<double> TurnedBodies::centre_stress(std::span<const BodyModel> models,
                                                std::span<const Strain> eigenstrains) const {
    std::vector<double> own;
    const auto of_cell = [&](std::int64_t c) {
        own = local_displacement(c);
        return std::span<const double>(own);
    };
    std::vector<double> stress =
        delam::centre_stress(mesh_, models, of_cell, CentreGradients(mesh_).slopes(of_cell), eigenstrains);
    const std::size_t columns = mesh_.dimension() == 2 ? 4 : 6;
    for (std::size_t c = 0; c < cells_.size(); ++c) turn_tensor(cells_[c].rotation(), {&stress[c * columns], columns});
    return stress;
}

VolumeAverage TurnedBodies::average(std::span<const BodyModel> models, std::span<const Strain> eigenstrains,
                                    std::int32_t body) const {
    std::vector<double> own;
    const auto displacement = [&](std::int64_t c) {
        own = local_displacement(c);
        return std::span<const double>(own);
    };
    const auto axes = [&](std::int64_t c) { return transposed(rotation(c)); };
    return volume_average(mesh_, models, displacement, axes, eigenstrains, body);
}

}  // namespace delam
