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
// Steps with large rotations that hold a jump are halved until it lies within this share of them. (A short notch bent
// in 6 steps, `jumps_are_located` of verify/cases/test_rotations.cpp: half and twice tell the jump within half and
// twice as much of the load, with 1.13 and 0.85 times the alternations.)
constexpr double located_share = 0.02;

// Returns what following the load needs and these options lack: local minimisers from part to part, whose damage may be
// eliminated. Null: nothing.
const char* lacking(const Options& options) {
    if (options.solution != "local") return "solution = local";
    if (options.mixity_rule != "converged") return "mixity_rule = converged";
    if (options.minimisation == "alternate") return "an accelerated minimisation (minimisation = auto)";
    if (options.backtracking == "on") return "backtracking = off or auto";
    if (!(options.path_step < 1.0)) return "path_step < 1";
    if (options.jump_tolerance > 0.0 || options.mixity_step_tolerance > 0.0)
        return "jump_tolerance = 0 and mixity_step_tolerance = 0: it locates jumps, and takes parts, by itself";
    return nullptr;
}

// Returns why `auto` takes steps whole; empty: it follows their load.
std::string why_whole(const Problem& problem, const Options& options, const std::string& asked) {
    if (const char* what = lacking(options)) return text("following the load needs ", what);
    if (problem.engine != nullptr) return "the engine of the host solves the bodies";
    const std::vector<InterfaceGeometry>& interfaces = problem.mesh->interfaces();
    for (std::size_t i = 0; i < interfaces.size(); ++i)
        if (problem.interfaces[i].law.has_value() && !problem.interfaces[i].bonded && interfaces[i].face.empty())
            return text("interface ", i, " has pairs without faces, whose fronts are not known");
    return asked;
}

// Steps that nothing follows along their load, because bodies rotate, lose no jump.
double located(const Options& options, bool chosen, const std::string& whole) {
    const bool rotates = options.kinematics != "linear";
    return chosen && rotates && whole.empty() && !controls_steps(options) ? located_share : 0.0;
}

double used_path_step(const Options& options, bool follows) {
    if (options.path_step != Options{}.path_step) return options.path_step;
    const double usual = follows ? part_of_zone : options.path_step;
    return std::min(largest_part, usual * std::sqrt(options.accuracy / usual_accuracy));
}

}  // namespace

StepControl used_step_control(const Problem& problem, const Options& options, const std::string& whole) {
    const bool chosen = options.step_control == "auto";
    const std::string why = chosen ? why_whole(problem, options, whole) : std::string();
    const std::string name = !chosen ? options.step_control : why.empty() ? "load" : "fixed";
    std::string reason = text("option step_control = ", options.step_control, why.empty() ? "" : ": ", why);
    const double share = located(options, chosen || options.step_control == "load", whole);
    if (share > 0.0) reason += text("; jumps are located to ", share, " of a step");
    return {name, reason, used_path_step(options, name == "load"), share};
}

bool controls_steps(const Options& options) {
    return options.jump_tolerance > 0.0 || options.step_control == "adaptive" || options.mixity_step_tolerance > 0.0;
}

void check_step_control(const Problem& problem) {
    if (problem.options.step_control != "load") return;
    if (const char* what = lacking(problem.options)) fail(DELAM_ERROR_PROBLEM, "step_control = load needs ", what);
}

}  // namespace delam
