// SPDX-License-Identifier: BSD-3-Clause
#include "scene/check/kinematics.hpp"

#include <string>

#include "base/error.hpp"
#include "scene/carriers.hpp"

namespace delam {

namespace {

// Returns the setting that large rotations do not know; empty: there is none.
std::string unknown_option(const Options& options) {
    if (options.solution != "local") return "solution = " + options.solution;
    if (options.backtracking == "on") return "backtracking = on";
    if (options.step_control == "load") return "step_control = load";
    if (options.mixity_rule == "variational") return "mixity_rule = variational";
    if (options.reduction == "feti") return "reduction = feti";
    if (options.subdomains > 0) return text("subdomains = ", options.subdomains);
    return {};
}

}  // namespace

std::string unknown_to_rotations(const Problem& problem) {
    const Mesh& mesh = *problem.mesh;
    if (const std::string option = unknown_option(problem.options); !option.empty())
        return option +
               ", only local solutions at the ends of steps (solution = local, step_control = fixed, adaptive "
               "or auto, mixity_rule = converged or frozen, reduction = auto, condensed or iterated)";
    const std::string instead = ": use kinematics = linear";
    if (problem.engine != nullptr) return "bodies that an engine of the host solves" + instead;
    for (std::int32_t body = 0; body < mesh.body_count(); ++body)
        if (problem.stiffness[index(body)] != nullptr || mesh.host_body(body))
            return text("the stiffness that the host gives, of body ", mesh.body_label(body),
                        ", which says nothing about rotations", instead);
    for (std::size_t i = 0; i < mesh.interfaces().size(); ++i)
        if (mesh.interfaces()[i].body_a < 0) return text("obstacles, as that of interface ", i, instead);
    const Carriers carriers(problem);
    if (!carriers.controls().empty())
        return text("control nodes, as node ", carriers.controls().front(),
                    ": equations with a control node (periodic cells, levers) would not turn; ",
                    "prescribe displacements of nodes or means over patches, or use kinematics = linear");
    return {};
}

void check_kinematics(const Problem& problem) {
    if (problem.options.kinematics != "corotational") return;
    if (const std::string what = unknown_to_rotations(problem); !what.empty())
        fail(DELAM_ERROR_PROBLEM, "kinematics = corotational does not know ", what);
}

}  // namespace delam
