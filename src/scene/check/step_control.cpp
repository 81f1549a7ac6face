// SPDX-License-Identifier: BSD-3-Clause
#include "scene/check/step_control.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace delam {

namespace {

// The error of a part grows with the square of its size: single-leg bending leaves 0.68, 0.30 and 0.05 % of the
// dissipated energy open with parts of 0.15, 0.1 and 0.05 of the process zone.
constexpr double usual_accuracy = 3e-3, part_of_zone = 0.1;
constexpr double largest_part = 0.5;

// Returns what following the load needs and these options lack: local minimisers from part to part, whose damage may be
// eliminated. Null: nothing.
const char* lacking(const Options& options) {
    if (options.kinematics != "linear") return "kinematics = linear";
    if (options.solution != "local") return "solution = local";
    if (options.mixity_rule != "converged") return "mixity_rule = converged";
    if (options.minimisation == "alternate") return "an accelerated minimisation (minimisation = auto)";
    if (options.backtracking == "on") return "backtracking = off or auto";
    if (!(options.path_step < 1.0)) return "path_step < 1";
    if (options.jump_tolerance > 0.0 || options.mixity_step_tolerance > 0.0)
        return "jump_tolerance = 0 and mixity_step_tolerance = 0: it locates jumps, and takes parts, by itself";
    return nullptr;
}

}  // namespace

std::string used_step_control(const Options& options) {
    if (options.step_control != "auto") return options.step_control;
    return lacking(options) == nullptr ? "load" : "fixed";
}

double used_path_step(const Options& options) {
    if (options.path_step != Options{}.path_step) return options.path_step;
    const double usual = used_step_control(options) == "load" ? part_of_zone : options.path_step;
    return std::min(largest_part, usual * std::sqrt(options.accuracy / usual_accuracy));
}

void check_step_control(const Problem& problem) {
    if (problem.options.step_control != "load") return;
    if (const char* what = lacking(problem.options)) fail(DELAM_ERROR_PROBLEM, "step_control = load needs ", what);
}

}  // namespace delam
