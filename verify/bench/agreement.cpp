// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "lse.hpp"
#include "measure.hpp"

namespace bench {

Json compare(const Analysis& a, const Analysis& b) {
    const std::size_t steps = std::min(a.steps.size(), b.steps.size());
    double reaction_scale = 0.0;
    double energy_scale = 0.0;
    double reaction = 0.0;
    double bulk = 0.0;
    double interface_energy = 0.0;
    double dissipated = 0.0;
    for (std::size_t k = 0; k < steps; ++k) {
        const StepRecord& x = a.steps[k];
        const StepRecord& y = b.steps[k];
        reaction_scale = std::max(reaction_scale, std::abs(x.reaction));
        energy_scale = std::max(energy_scale, x.stored_bulk + x.stored_interface + x.dissipated);
        reaction = std::max(reaction, std::abs(x.reaction - y.reaction));
        bulk = std::max(bulk, std::abs(x.stored_bulk - y.stored_bulk));
        interface_energy = std::max(interface_energy, std::abs(x.stored_interface - y.stored_interface));
        dissipated = std::max(dissipated, std::abs(x.dissipated - y.dissipated));
    }
    return {{"common_steps", steps},
            {"reaction", reaction / reaction_scale},
            {"stored_bulk", bulk / energy_scale},
            {"stored_interface", interface_energy / energy_scale},
            {"dissipated", dissipated / energy_scale}};
}

Json measure_agreement(const std::string& scene, double delta, double cap) {
    Stage stage = make_mesh(find_scene(scene));
    Json result;
    result["scene"] = scene;
    result["delta"] = delta;
    std::vector<std::pair<std::string, Analysis>> analyses;
    for (const Method& method : methods()) {
        progress(scene + ": delta " + std::to_string(delta) + ", " + method.key);
        std::string refusal;
        Analysis analysis;
        if (method.reduction == nullptr) {
            BaselineOptions options;
            options.delta = delta;
            analysis = run_baseline(stage, options, cap);
        } else {
            const auto choice = resolve(stage, method, delta, refusal);
            if (!choice) {
                result["methods"][method.key]["skipped"] = refusal;
                continue;
            }
            analysis = run_library(stage, *choice, cap);
        }
        result["methods"][method.key] = {
            {"capped", analysis.capped}, {"counts", counts(analysis)}, {"history", history(analysis)}};
        for (const auto& [name, other] : analyses) {
            if (!other.steps.empty() && !analysis.steps.empty())
                result["agreement"][name + " / " + method.key] = compare(other, analysis);
        }
        analyses.emplace_back(method.key, std::move(analysis));
    }
    return result;
}

}  // namespace bench
