// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/mesh_error.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mesh/cell_shape.hpp"
#include "model/library/call.hpp"
#include "scene/units/labels.hpp"

namespace cli {

namespace {

// Part of the energy from which on a mesh is too coarse. (Measured, as verify/cases/mesh_error/effectivity.py prints
// it: all beams whose loads are wrong by more than 5 % have more, none whose loads are right to 1 %.)
constexpr double too_coarse = 0.03;
// Beyond half of the energy the estimate is no more than a bound.
constexpr double bound = 0.5;

// Says what to change: it names cells of another kind where they would help, else smaller ones.
std::string remedy(const MeshError& error, const Scene& scene) {
    if (error.excess > 0.5 * error.away)
        return fmt::format("formulation = \"incompatible\" takes off {}", percent_text(error.excess));
    std::vector<std::int32_t> types{scene.geometry.cell_type};
    if (scene.mesh) {
        types.clear();
        for (const CellBlock& block : scene.mesh->blocks) types.push_back(block.type);
    }
    for (const std::int32_t type : types)
        if (const CellShape& shape = shape_of(type); shape.locks())
            return fmt::format("use {} instead of {}", instead_of(shape).name, shape.name);
    return "use smaller or less distorted cells";
}

}  // namespace

MeshError mesh_error_of(const Model& model, delam_solver* solver) {
    MeshError error;
    double step = 0;
    const std::pair<const char*, double*> values[] = {{"mesh_error", &error.away},
                                                      {"mesh_error_fronts", &error.fronts},
                                                      {"mesh_excess", &error.excess},
                                                      {"step", &step},
                                                      {"time", &error.time}};
    for (const auto& [key, value] : values)
        call(model.context.get(), delam_solver_value(solver, key, value), std::string(key));
    error.step = static_cast<std::int64_t>(step);
    return error;
}

std::string mesh_error_line(const MeshError& error, const Scene& scene) {
    if (!std::isfinite(error.away)) return "";
    const std::string where = instant_text(error.step, error.time);
    const std::string fronts =
        error.fronts > 0 ? fmt::format("; at the fronts of cracks, {}", percent_text(error.fronts)) : "";
    if (error.away < too_coarse)
        return fmt::format("mesh: error of the stored energy {}{} ({}){}", error.away < 1e-5 ? "" : "about ",
                           percent_text(error.away), where, fronts);
    if (error.away > bound)
        return fmt::format(
            "warning: mesh: at least half of the stiffness is that of the mesh, not of the bodies ({}): {}", where,
            remedy(error, scene));
    return fmt::format("warning: mesh: error of the stored energy about {}, bodies too stiff by about {} ({}){}: {}",
                       percent_text(error.away), percent_text(error.away / (1 - error.away)), where, fronts,
                       remedy(error, scene));
}

}  // namespace cli
