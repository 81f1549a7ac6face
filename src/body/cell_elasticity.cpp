// SPDX-License-Identifier: BSD-3-Clause
#include "body/cell_elasticity.hpp"

#include "base/numbers.hpp"

namespace delam {

namespace {

std::vector<double> reduced(const SpaceElasticity& space, int dimension, Plane plane) {
    if (dimension == 3) return {space.begin(), space.end()};
    const auto in_plane = plane_elasticity(space, plane);
    return {in_plane.begin(), in_plane.end()};
}

}  // namespace

CellElasticity::CellElasticity(const BodyModel& model, int dimension)
    : model_(model), dimension_(dimension), material_(space_elasticity(model.material)), space_(material_) {
    const auto* isotropic = std::get_if<Elastic>(&model.material);
    matrix_ = isotropic != nullptr ? elasticity_matrix(*isotropic, dimension, model.plane)
                                   : reduced(space_, dimension, model.plane);
}

const Axes* CellElasticity::axes(std::int64_t cell) const {
    if (model_.orientation == nullptr) return nullptr;
    const std::int32_t own = model_.orientation->of_cell[index(cell)];
    return own < 0 ? nullptr : &model_.orientation->axes[index(own)];
}

// Isotropic elasticity is the same in all axes, so it keeps the computed digits.
void CellElasticity::turn(std::int64_t cell) {
    if (model_.orientation == nullptr || std::holds_alternative<Elastic>(model_.material)) return;
    const std::int32_t own = model_.orientation->of_cell[index(cell)];
    if (own == orientation_) return;
    orientation_ = own;
    const Axes* axes = this->axes(cell);
    space_ = axes == nullptr ? material_ : rotated(material_, *axes);
    matrix_ = reduced(space_, dimension_, model_.plane);
}

std::span<const double> CellElasticity::matrix(std::int64_t cell) {
    turn(cell);
    return matrix_;
}

Dilatation CellElasticity::dilatation(std::int64_t cell) {
    turn(cell);
    Dilatation d;
    std::array<double, 6> stress{};
    for (std::size_t i = 0; i < 6; ++i) stress[i] = space_[i * 6] + space_[i * 6 + 1] + space_[i * 6 + 2];
    d.bulk = stress[0] + stress[1] + stress[2];
    d.stress = dimension_ == 3 ? stress : std::array<double, 6>{stress[0], stress[1], stress[3]};
    return d;
}

const SpaceElasticity& CellElasticity::space(std::int64_t cell) {
    turn(cell);
    return space_;
}

}  // namespace delam
