// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

std::vector<Drives> drives_of(const Scene& scene) {
    std::vector<Drives> out(scene.patterns.size(), Drives::displacement);
    for (const DeadForce& data : scene.forces) out[data.pattern] = Drives::force;
    if (scene.cell)
        for (const CellComponent& component : scene.cell->components)
            for (const Term& term : component.terms)
                if (component.stress) out[term.pattern] = Drives::force;
    for (const EigenstrainData& data : scene.eigenstrains) out[data.pattern] = Drives::strain;
    return out;
}

double law_number(const LawData& law, std::string_view key) {
    for (const auto& [name, value] : law.parameters)
        if (name == key) return value;
    return 0;
}

bool two_shears(const LawData& law) {
    const double second = law_number(law, "second_tangential_stiffness");
    return second > 0 && second != law_number(law, "tangential_stiffness");
}

double law_peak(const LawData& law, const std::string& mode) {
    const double strength = law_number(law, mode + "_strength");
    if (strength > 0) return strength;
    return std::sqrt(2 * law_number(law, mode + "_stiffness") * law_number(law, mode + "_onset"));
}

}  // namespace cli
