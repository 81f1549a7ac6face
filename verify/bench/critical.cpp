// SPDX-License-Identifier: BSD-3-Clause
// If the energy has many critical points, methods may end in different ones. Each end state must be critical: the
// displacements satisfy the contact conditions, and one more damage step changes nothing.
#include <algorithm>
#include <cmath>

#include "acceptance.hpp"
#include "measure.hpp"

namespace bench {
namespace {

constexpr std::size_t baseline_limit = 20000;  // unknowns; beyond, the baseline is not run here

// Largest change of adhesion in a damage step at the jump, mixity and adhesion of a state, from `old`.
double damage_defect(const reference::Scene& scene, const delam_law* law, const std::vector<double>& jump,
                     const std::vector<double>& mixity, const std::vector<double>& old,
                     const std::vector<double>& adhesion) {
    const auto d = static_cast<std::size_t>(scene.dimension());
    std::vector<double> open = jump;
    for (std::size_t p = 0; p < old.size(); ++p) open[p * d] = std::max(0.0, open[p * d]);
    std::vector<double> next(old.size());
    REQUIRE(scene, delam_law_respond, law, scene.dimension(), static_cast<std::int64_t>(old.size()), open.data(),
            mixity.data(), old.data(), next.data(), nullptr);
    double change = 0.0;
    for (std::size_t p = 0; p < old.size(); ++p) change = std::max(change, std::abs(next[p] - adhesion[p]));
    return change;
}

Json text_of(const reference::Acceptance& a) {
    return {{"worst", a.worst()},
            {"gap", a.gap},
            {"pressure", a.pressure},
            {"complementarity", a.complementarity},
            {"equilibrium", a.equilibrium},
            {"law", a.law},
            {"text", a.text()}};
}

}  // namespace

Json measure_critical(const std::string& scene, double cap) {
    Stage stage = make_mesh(find_scene(scene));
    declare(stage, {});
    delam_law* raw = nullptr;
    const reference::Scene& s = stage.scene;
    REQUIRE(s, delam_law_create, s.context(), "piecewise-linear", &raw);
    const reference::Law law(raw);
    const auto& data = stage.data.law;
    const std::pair<const char*, double> parameters[] = {
        {"normal_stiffness", data.normal_stiffness}, {"tangential_stiffness", data.tangential_stiffness},
        {"normal_onset", data.normal_onset},         {"tangential_onset", data.tangential_onset},
        {"normal_toughness", data.normal_toughness}, {"tangential_toughness", data.tangential_toughness}};
    for (const auto& [key, value] : parameters) s.require(delam_law_set(raw, key, value), key);
    const reference::Exported exported(s);

    Json result;
    result["scene"] = scene;
    for (const Method& method : methods()) {
        std::vector<double> old = stage.adhesion;
        double worst_defect = 0.0;
        Json defects = Json::array();
        Json end;
        const auto see = [&](const std::vector<double>& jump, const std::vector<double>& mixity,
                             const std::vector<double>& adhesion) {
            const double defect = damage_defect(s, raw, jump, mixity, old, adhesion);
            defects.push_back(defect);
            worst_defect = std::max(worst_defect, defect);
            old = adhesion;
        };
        Json& m = result["methods"][method.key];
        progress(scene + ": critical points, " + method.key);
        if (method.reduction == nullptr && exported.dofs > baseline_limit) {
            m["skipped"] = "too long; its iterates are those of plain alternation";
            continue;
        }
        if (method.reduction == nullptr) {
            // The library checks the baseline's last state by its own displacement step at the baseline's adhesion.
            std::vector<double> last;
            double last_time = 0.0;
            std::vector<double> last_jump;
            const Analysis analysis = run_baseline(stage, {}, cap, 0, nullptr, [&](Baseline& b, int k) {
                see(b.jump(), b.mixity(), b.adhesion());
                last = b.adhesion();
                last_jump = b.jump();
                last_time = step_time(stage.data, k);
            });
            if (last.empty()) continue;
            reference::Solver judge(stage.scene, 0.0);
            const std::int32_t status = delam_solver_equilibrate(judge.get(), last_time, last.data());
            if (status < 0) s.require(status, "delam_solver_equilibrate");
            const auto jump = judge.field("jump");
            double difference = 0.0;
            double largest = 0.0;
            for (std::size_t i = 0; i < jump.size(); ++i) {
                difference = std::max(difference, std::abs(jump[i] - last_jump[i]));
                largest = std::max(largest, std::abs(jump[i]));
            }
            m = {{"capped", analysis.capped},
                 {"steps", analysis.steps.size()},
                 {"jump_against_library", largest > 0.0 ? difference / largest : 0.0},
                 {"damage_fixed_point_worst_of_steps", worst_defect},
                 {"damage_fixed_point_end", defects.back()},
                 {"damage_fixed_point", defects},
                 {"last_damage_change", analysis.steps.back().damage_change},
                 {"counts", counts(analysis)},
                 {"history", history(analysis)}};
            continue;
        }
        std::string refusal;
        const auto choice = resolve(stage, method, 1e-5, refusal);
        if (!choice) {
            m["skipped"] = refusal;
            continue;
        }
        const Analysis analysis = run_library(stage, *choice, cap, [&](reference::Solver& solver, int k) {
            see(solver.field("jump"), solver.field("mixity"), solver.field("adhesion"));
            if (k == stage.data.steps) end = text_of(reference::accept(solver, exported));
        });
        m = {{"capped", analysis.capped},
             {"steps", analysis.steps.size()},
             {"damage_fixed_point_worst_of_steps", worst_defect},
             {"damage_fixed_point_end", defects.empty() ? Json() : defects.back()},
             {"damage_fixed_point", defects},
             {"end_state_kkt", end},
             {"counts", counts(analysis)},
             {"history", history(analysis)}};
    }
    return result;
}

}  // namespace bench
