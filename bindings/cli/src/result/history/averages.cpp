// SPDX-License-Identifier: BSD-3-Clause
#include "result/history/averages.hpp"

#include <algorithm>
#include <array>

#include "model/build_constraints.hpp"
#include "model/library/call.hpp"

namespace cli {

namespace {

// The strain along an axis without a period is undefined, but the average of a stress is not.
bool of_cell(const CellData& cell, std::size_t component, bool stress) {
    constexpr std::array<std::array<std::size_t, 2>, 6> axes{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
    return stress || std::all_of(axes[component].begin(), axes[component].end(), [&](std::size_t axis) {
               return std::find(cell.axes.begin(), cell.axes.end(), axis) != cell.axes.end();
           });
}

}  // namespace

std::optional<AverageColumn> average_column(const std::string& key, const Scene& scene) {
    AverageColumn column;
    const std::size_t colon = key.find(':');
    if (colon != std::string::npos) {
        for (std::size_t i = 0; i < scene.layers.size(); ++i)
            if (scene.layers[i].name == key.substr(colon + 1)) column.body = static_cast<std::int32_t>(i);
        if (column.body < 0) return std::nullopt;
    }
    std::string name = key.substr(0, colon);
    const std::string cell = "cell_";
    if (scene.cell && column.body < 0 && name.rfind(cell, 0) == 0) {
        column.cell = true;
        name.erase(0, cell.size());
    }
    constexpr std::array components{"xx", "yy", "zz", "xy", "yz", "zx"};
    for (const bool stress : {false, true})
        for (std::size_t i = 0; i < components.size(); ++i) {
            column.stress = stress;
            column.component = i;
            if (name != std::string(stress ? "stress_" : "strain_") + components[i]) continue;
            if (column.cell && !of_cell(*scene.cell, i, stress)) return std::nullopt;
            return column;
        }
    return std::nullopt;
}

double average_of(const Model& model, const Scene& scene, delam_solver* solver, const AverageColumn& column) {
    if (column.cell && !column.stress) return cell_strain(model, scene, solver)[column.component];
    std::array<double, 6> values{};
    double volume = 0;
    call(model.context.get(),
         delam_solver_average(solver, column.body, &volume, column.stress ? nullptr : values.data(),
                              column.stress ? values.data() : nullptr),
         std::string("volume average"));
    // Tractions across interfaces balance: the stress of the cell is the integral over its bodies.
    const double share = column.cell ? volume / cell_volume(model, scene) : 1.0;
    return share * values[column.component];
}

}  // namespace cli
