// SPDX-License-Identifier: BSD-3-Clause
// The elasticity of the cells of one body, each in its own orientation. Only the matrices of the last orientation are
// stored: rotating them is cheap compared with computing a cell's stiffness.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/element.hpp"
#include "body/model.hpp"

namespace delam {

class CellElasticity {
public:
    CellElasticity(const BodyModel& model, int dimension);
    // Row-major, 3x3 in the plane, 6x6 in space. Valid until the next call with another cell.
    std::span<const double> matrix(std::int64_t cell);
    // Stresses of a unit dilatation xx = yy = zz = 1.
    Dilatation dilatation(std::int64_t cell);
    // All six strains, also in the plane.
    const SpaceElasticity& space(std::int64_t cell);
    // nullptr: the global axes.
    const Axes* axes(std::int64_t cell) const;

private:
    void turn(std::int64_t cell);

    const BodyModel& model_;
    int dimension_;
    SpaceElasticity material_;
    SpaceElasticity space_;
    std::vector<double> matrix_;
    std::int32_t orientation_ = -1;  // of space_ and matrix_
};

}  // namespace delam
