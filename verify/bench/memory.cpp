// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "machine.hpp"
#include "measure.hpp"
#include "monolithic.hpp"

namespace bench {

// The peak counts from the mesh in memory: the kernel's high-water mark is reset before the measured part. For the
// factorisation only the assembled matrix (and the mesh) is kept, so that its assembly does not affect the comparison.
Json measure_memory(const std::string& scene, const std::string& method, double cap) {
    Stage stage = make_mesh(find_scene(scene));
    Json result;
    result["method"] = method;
    if (method == "lse") {
        declare(stage, {});
        UpperMatrix matrix;
        std::vector<double> right;
        {
            Monolithic system(stage.scene);
            const std::vector<std::uint8_t> none(system.jumps(), 0);
            std::vector<double> spring(system.jumps(), stage.data.law.normal_stiffness);
            for (std::size_t i = 0; i < spring.size(); ++i)
                spring[i] *= system.weight()[i / static_cast<std::size_t>(stage.scene.dimension())];
            matrix = system.assemble(spring, none);
            system.right_side(std::vector<double>(system.patterns(), 1.0), none, right);
        }
        result["reset"] = reset_peak_memory();
        result["before_MB"] = 1e-6 * peak_memory();
        std::vector<double> x;
        SparseFactor factor(matrix);
        factor.factorise();
        factor.solve(right, x);
        result["peak_MB"] = 1e-6 * peak_memory();
        result["cholmod_MB"] = 1e-6 * factor.peak_bytes();
        return result;
    }
    const Method& m = find_method(method);
    std::optional<Choice> choice;
    std::string refusal;
    if (m.reduction != nullptr && !(choice = resolve(stage, m, 1e-5, refusal))) return {{"skipped", refusal}};
    result["reset"] = reset_peak_memory();
    result["before_MB"] = 1e-6 * peak_memory();
    // The baseline has reached its largest matrix after a few systems.
    const Analysis analysis = choice ? run_library(stage, *choice, cap) : run_baseline(stage, {}, cap, 3);
    result["peak_MB"] = 1e-6 * peak_memory();
    result["capped"] = analysis.capped && choice.has_value();
    return result;
}

}  // namespace bench
