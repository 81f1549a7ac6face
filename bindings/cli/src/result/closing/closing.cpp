// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/closing.hpp"

#include "result/closing/estimate.hpp"
#include "result/closing/resolution.hpp"
#include "result/history/concept.hpp"

namespace cli {

namespace {

// True if bisection locates each jump of a step, so that what falls without a jump falls steadily.
bool locates_jumps(const Model& model, const delam_solver* solver) {
    const char* control = delam_problem_option(model.problem.get(), "step_control");
    return control != nullptr && std::string_view(control) == "auto" &&
           option_text(solver, "kinematics") == "corotational";
}

}  // namespace

Closing closing_of(const Model& model, delam_solver* solver, const Scene& scene, std::string_view history,
                   const BulkFacts& bulk, bool of_end) {
    const Rows rows = rows_of(history);
    Closing out;
    out.jumps = jumps_of(model, solver, scene);
    out.balance = balance_of(rows, option_text(solver, "mixity_rule") == "variational");
    out.mixity_error = mixity_error_of(rows);
    out.search = search_limits_of(rows, option_number(solver, "search_tolerance"));
    out.load_drops = load_drops_of(rows, out.jumps, scene);
    out.follows_load = option_text(solver, "step_control") == "load";
    out.locates_jumps = locates_jumps(model, solver);
    out.small = small_rotations_of(model, solver, scene, of_end);
    out.estimate_tolerance = option_number(solver, "backtracking_tolerance");
    out.estimate_violated = violated_steps(rows, out.estimate_tolerance);
    out.estimate_inconclusive = inconclusive_steps(rows);
    out.front_unresolved = unresolved_steps(rows, model, scene);
    out.waiting = waiting_of(rows, model, scene);
    out.pops = pops_of(rows, any_softens(model, scene));
    out.buckled = buckled_steps(rows, scene);
    out.free_bodies = free_bodies_of(model, solver, scene);
    out.bulk = bulk;
    return out;
}

std::vector<std::string> closing_lines(const Closing& closing, const Scene& scene) {
    const double work = closing.balance.work;  // whose unit all energies have
    std::vector<std::string> out = jump_lines(closing.jumps, scene, work);
    out.push_back(buckling_line(closing.buckled, scene, work));
    JumpSum jumps{closing.jumps.size(), 0};
    for (const Jump& jump : closing.jumps) jumps.released += jump.released;
    out.push_back(closing.follows_load ? energies_line(closing.balance, jumps, scene)
                                       : balance_line(closing.balance, scene));
    out.push_back(estimate_line(closing.estimate_violated, closing.estimate_tolerance));
    out.push_back(inconclusive_line(closing.estimate_inconclusive));
    out.push_back(mixity_error_line(closing.mixity_error, scene, work));
    // Along the load, growth and jumps are told apart, too.
    if (!closing.follows_load && !closing.locates_jumps) out.push_back(load_drops_line(closing.load_drops));
    for (std::string& line : search_lines(closing.search, scene, work)) out.push_back(std::move(line));
    for (std::string& line : free_body_lines(closing.free_bodies, scene)) out.push_back(std::move(line));
    out.push_back(unresolved_line(closing.front_unresolved));
    if (closing.front_unresolved.empty()) out.push_back(waiting_line(closing.waiting, scene));
    out.push_back(pops_line(closing.pops));
    out.push_back(mesh_error_line(closing.bulk.mesh_error, scene));
    out.push_back(rotation_line(closing.small, closing.bulk));
    out.push_back(critical_line(closing.small));
    std::erase(out, "");
    return out;
}

}  // namespace cli
