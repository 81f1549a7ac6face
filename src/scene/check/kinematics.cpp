// SPDX-License-Identifier: BSD-3-Clause
#include "scene/check/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "scene/carriers.hpp"

namespace delam {

namespace {

// Returns the setting that large rotations do not know; empty: there is none.
std::string unknown_option(const Options& options) {
    if (options.backtracking == "on") return "backtracking = on";
    if (options.mixity_rule == "variational") return "mixity_rule = variational";
    if (options.reduction == "feti") return "reduction = feti";
    if (options.subdomains > 0) return text("subdomains = ", options.subdomains);
    return {};
}

// True if the equation holds for every common displacement of its nodes, as that of a mean, of nodes that move together
// or of places along a straight lever does: it says the same however these turn. That of a rigid body, whose angles are
// displacements of a control node, and that of a periodic cell do not.
bool is_affine(const Constraint& constraint, std::int64_t dim) {
    constexpr double weight_digits = 1e-8;  // of weights that a host adds up to 1
    std::vector<double> sum(index(dim), 0.0);
    for (std::size_t i = 0; i < constraint.dof.size(); ++i)
        sum[index(constraint.dof[i] % dim)] += constraint.coefficient[i];
    return max_abs(sum) <= weight_digits * max_abs(constraint.coefficient);
}

// True if all normals of an obstacle are alike. On a plane a node may slide as far as it likes.
bool is_flat(const InterfaceGeometry& face, std::int64_t dimension) {
    constexpr double digits = 1e-6;  // of unit normals that a host gives
    const std::size_t dim = index(dimension);
    for (std::size_t e = 0; e < face.frame.size(); e += dim * dim)
        for (std::size_t k = 0; k < dim; ++k)
            if (std::abs(face.frame[e + k] - face.frame[k]) > digits) return false;
    return true;
}

// Returns a control node of an equation that is not affine; negative: there is none. What a constraint prescribes of a
// control node alone is left out.
std::int64_t turning_control(const Problem& problem, const Carriers& carriers) {
    const std::int64_t dim = problem.mesh->dimension();
    for (const Constraint& constraint : problem.constraints) {
        const auto control = std::find_if(constraint.dof.begin(), constraint.dof.end(), [&](std::int64_t dof) {
            return carriers.kind(dof / dim) == Carriers::Kind::control;
        });
        const auto of_it = [&](std::int64_t dof) { return dof / dim == *control / dim; };
        if (control == constraint.dof.end() || std::all_of(constraint.dof.begin(), constraint.dof.end(), of_it))
            continue;
        if (!is_affine(constraint, dim)) return *control / dim;
    }
    return -1;
}

}  // namespace

std::string unknown_to_rotations(const Problem& problem) {
    const Mesh& mesh = *problem.mesh;
    if (const std::string option = unknown_option(problem.options); !option.empty())
        return option + ", only mixity_rule = converged or frozen, and reduction = auto, condensed or iterated";
    const std::string instead = ": use kinematics = linear";
    if (problem.engine != nullptr) return "bodies that an engine of the host solves" + instead;
    for (std::int32_t body = 0; body < mesh.body_count(); ++body)
        if (problem.stiffness[index(body)] != nullptr || mesh.host_body(body))
            return text("the stiffness that the host gives, of body ", mesh.body_label(body),
                        ", which says nothing about rotations", instead);
    for (std::size_t i = 0; i < mesh.interfaces().size(); ++i)
        if (const InterfaceGeometry& face = mesh.interfaces()[i]; face.body_a < 0 && !is_flat(face, mesh.dimension()))
            return text("obstacles that are not flat, as that of interface ", i,
                        ": give one obstacle for each plane, or use kinematics = linear");
    const Carriers carriers(problem);
    if (const std::int64_t node = turning_control(problem, carriers); node >= 0)
        return text("equations of a control node, as of node ", node,
                    ", which do not hold for a common displacement of their nodes (rigid couplings, periodic cells): "
                    "they would not ",
                    "turn; ", "prescribe displacements of nodes or means over patches, or use kinematics = linear");
    return {};
}

void check_kinematics(const Problem& problem) {
    if (problem.options.kinematics != "corotational") return;
    if (const std::string what = unknown_to_rotations(problem); !what.empty())
        fail(DELAM_ERROR_PROBLEM, "kinematics = corotational does not know ", what);
}

}  // namespace delam
