// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/rotations.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "model/library/call.hpp"
#include "result/history/concept.hpp"
#include "scene/units/labels.hpp"

namespace cli {

namespace {

// Errors of loads and energies are .3 to 1.4 times the estimate (kinematics = linear against corotational in
// examples/dcb-elastica, peel and enf): half a per cent is told, as a rotation of 0.1 rad is.
constexpr double told_share = 0.005;
constexpr double large_rotation = 0.1;  // rad
// Below a tenth of the critical stresses, bending grows by at most a tenth, 1 / (1 - ratio).
constexpr double near_critical = 0.1;
// The words of the plan of a scene that keeps its rotations small because large ones do not know a part of it.
constexpr std::string_view not_known = "option kinematics = auto: they do not know";

// Returns what a person can do about it.
const char* remedy(const SmallRotations& small) {
    return small.refused ? "(`delam check` tells why large rotations are not known here)"
                         : "(solver.kinematics = \"corotational\" does not)";
}

}  // namespace

SmallRotations small_rotations_of(const Model& model, delam_solver* solver, const Scene& scene, bool of_end) {
    SmallRotations small;
    small.assumed = option_text(solver, "kinematics") == "linear";
    if (!small.assumed || !of_end) return small;
    const auto value = [&](const char* key, double& to) {
        call(model.context.get(), delam_solver_value(solver, key, &to), std::string(key));
    };
    value("rotation_max", small.rotation);
    value("rotation_error", small.error);
    const bool asked_for = std::any_of(scene.options.begin(), scene.options.end(), [](const SolverOption& option) {
        const auto* word = std::get_if<std::string>(&option.value);
        return option.key == "kinematics" && word != nullptr && *word != "auto";
    });
    if (!asked_for || scene.imported) value("buckling_ratio", small.buckling);
    small.refused = std::string_view(delam_solver_plan(solver)).find(not_known) != std::string_view::npos;
    return small;
}

std::string rotation_line(const SmallRotations& small, const BulkFacts& bulk) {
    if (!small.assumed) return "";
    const double largest = std::max(bulk.rotation_max, small.rotation), of_strains = 0.5 * largest * largest;
    const bool earlier = bulk.rotations.error > std::max(of_strains, small.error > 0 ? small.error : 0.0);
    const double error = earlier ? bulk.rotations.error : small.error > of_strains ? small.error : of_strains;
    if (!(largest > large_rotation) && !(error > told_share)) return "";
    return fmt::format(
        "warning: cells rotate by up to {:.3g} rad: small rotations leave out about {} of the energy{} {}", largest,
        percent_text(error),
        earlier ? fmt::format(" in {}", instant_text(bulk.rotations.step, bulk.rotations.time)) : "", remedy(small));
}

std::string critical_line(const SmallRotations& small) {
    if (!(small.buckling > near_critical)) return "";
    if (small.buckling > 1.0)
        return fmt::format(
            "warning: the stresses at the end are {:.3g} times those at which the bodies buckle: with small rotations "
            "they do not {}",
            small.buckling, small.refused ? remedy(small) : "(with solver.kinematics = \"corotational\" they may)");
    return fmt::format(
        "warning: the stresses at the end are {:.2g} of those at which the bodies buckle, and increase bending by "
        "up to {}, which small rotations leave out {}",
        small.buckling, percent_text(small.buckling / (1.0 - small.buckling)), remedy(small));
}

}  // namespace cli
