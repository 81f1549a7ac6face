// SPDX-License-Identifier: BSD-3-Clause
// Columns of volume averages: strain_xx, stress_xy, ... of all bodies, strain_xx:NAME of one; cell_strain_xx,
// cell_stress_xx, ... of a periodic cell: the strain includes the openings of interfaces, the stress counts voids.
#pragma once

#include <optional>
#include <string>

#include "model/library/model.hpp"

namespace cli {

struct AverageColumn {
    bool stress = false;
    bool cell = false;
    std::size_t component = 0;
    std::int32_t body = -1;
};
// None if the key is no such column, e.g. if there is no body of that name.
std::optional<AverageColumn> average_column(const std::string& key, const Scene& scene);
double average_of(const Model& model, const Scene& scene, delam_solver* solver, const AverageColumn& column);

}  // namespace cli
