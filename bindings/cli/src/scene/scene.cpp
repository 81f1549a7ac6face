// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.hpp"

#include <algorithm>

namespace cli {

std::vector<bool> force_patterns(const Scene& scene) {
    std::vector<bool> out(scene.patterns.size(), false);
    for (const DeadForce& data : scene.forces) out[data.pattern] = true;
    if (scene.cell)
        for (const CellComponent& component : scene.cell->components)
            for (const Term& term : component.terms) out[term.pattern] = out[term.pattern] || component.stress;
    return out;
}

}  // namespace cli
