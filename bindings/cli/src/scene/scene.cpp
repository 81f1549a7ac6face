// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

constexpr std::string_view second_shear = "second_";  // before the keys of the first shear

}  // namespace

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

bool has_axes(const LawData& law) {
    return std::any_of(law.parameters.begin(), law.parameters.end(), [&](const auto& parameter) {
        const auto& [name, value] = parameter;
        return name.starts_with(second_shear) && value != law_number(law, name.substr(second_shear.size()));
    });
}

LawData with_second_shear(const LawData& law) {
    LawData out = law;
    out.parameters.clear();
    const bool onset =
        law_number(law, "second_tangential_onset") > 0 || law_number(law, "second_tangential_strength") > 0;
    for (const auto& [name, value] : law.parameters) {
        const bool replaced = law_number(law, "second_" + name) > 0 ||
                              (onset && (name == "tangential_onset" || name == "tangential_strength"));
        if (name.starts_with(second_shear))
            out.parameters.emplace_back(name.substr(second_shear.size()), value);
        else if (!replaced)
            out.parameters.emplace_back(name, value);
    }
    return out;
}

double law_peak(const LawData& law, const std::string& mode) {
    const double strength = law_number(law, mode + "_strength");
    if (strength > 0) return strength;
    const double stiffness = law_number(law, mode + "_stiffness");
    return std::sqrt(2 * (stiffness > 0 ? stiffness : law_number(law, "tangential_stiffness")) *
                     law_number(law, mode + "_onset"));
}

}  // namespace cli
