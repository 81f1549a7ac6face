// SPDX-License-Identifier: BSD-3-Clause
#include "analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace harness {
namespace {

double optional_value(const reference::Solver& solver, const char* key) {
    double value = 0.0;
    return delam_solver_value(solver.get(), key, &value) == DELAM_OK ? value : std::numeric_limits<double>::quiet_NaN();
}

// The recorded energies of the solver's current step.
Record read(const reference::Solver& solver) {
    Record r;
    r.stored_bulk = solver.value("stored_bulk");
    r.stored_interface = solver.value("stored_interface");
    r.dissipated = solver.value("dissipated");
    r.work = solver.value("work");
    r.upper = solver.value("upper");
    r.increment = solver.value("increment");
    r.front = solver.value("front");
    r.debonded = solver.value("debonded_length");
    r.am_iterations = solver.value("am_iterations");
    r.newton_solves = solver.value("newton_solves");
    r.displacement_solves = solver.value("displacement_solves");
    r.candidates = optional_value(solver, "search_candidates");
    r.backtracks = solver.value("backtracks");
    r.released = optional_value(solver, "released");
    return r;
}

}  // namespace

double Analysis::defect() const {
    double worst = 0.0;
    for (const Record& r : steps) worst = std::max(worst, std::abs(r.total() - r.work));
    return worst;
}

Analysis run(const reference::Flexure& data, int steps, const Choice& choice) {
    Analysis analysis;
    const reference::FlexureScene flexure = reference::make_flexure(data);
    const reference::Scene& scene = flexure.scene;
    for (const auto& [key, value] : choice.texts) {
        if (delam_problem_set_text(scene.problem(), key.c_str(), value.c_str()) == DELAM_OK) continue;
        analysis.refused = delam_context_message(scene.context());
        return analysis;
    }
    for (const auto& [key, value] : choice.numbers) {
        if (delam_problem_set_number(scene.problem(), key.c_str(), value) == DELAM_OK) continue;
        analysis.refused = delam_context_message(scene.context());
        return analysis;
    }
    reference::Solver solver(scene, 0.0);
    for (int k = 1; k <= steps; ++k) {
        const double time = data.end_time * k / steps;
        const std::int32_t status = solver.advance(time);
        if (status < 0) scene.require(status, "delam_solver_advance");
        solver.commit();
        const Record now = read(solver);
        for (double Record::*count : {&Record::am_iterations, &Record::newton_solves, &Record::displacement_solves,
                                      &Record::candidates, &Record::backtracks})
            analysis.spent.*count += now.*count;
        // Backtracking replaces earlier steps, so they are read again.
        const double revised_from = optional_value(solver, "revised_from");
        const int first = revised_from < k ? static_cast<int>(revised_from) : k;
        analysis.steps.resize(static_cast<std::size_t>(k));
        analysis.steps.back().converged = status == DELAM_OK;
        for (int i = first; i <= k; ++i) {
            if (first < k) REQUIRE(scene, delam_solver_look, solver.get(), i);
            Record& r = analysis.steps[static_cast<std::size_t>(i - 1)];
            const bool converged = r.converged;
            r = read(solver);
            r.converged = converged;
            r.load = data.load(data.end_time * i / steps);
        }
        if (first < k) REQUIRE(scene, delam_solver_look, solver.get(), -1);
    }
    std::int64_t jumps = 0;
    double time = std::numeric_limits<double>::quiet_NaN();
    REQUIRE(scene, delam_solver_jump_count, solver.get(), &jumps);
    if (jumps > 0)
        REQUIRE(scene, delam_solver_jump, solver.get(), 0, nullptr, nullptr, &time, nullptr, nullptr, nullptr, nullptr,
                nullptr, nullptr, nullptr);
    analysis.first_jump = data.load(time);
    return analysis;
}

std::string skipped(const std::string& refused) {
    return std::string("skipped: ").append(refused, 0, refused.find(';'));
}

}  // namespace harness
