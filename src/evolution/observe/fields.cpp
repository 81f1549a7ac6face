// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/fields.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/rotation.hpp"
#include "delam/delam.h"
#include "scene/strain_loads.hpp"

namespace delam {

namespace {

bool of_pairs(const std::string& key) {
    return key == "jump" || key == "traction" || key == "adhesion" || key == "mixity" || key == "contact";
}

// First pair and number of pairs of a part.
std::pair<std::int64_t, std::int64_t> pair_range(const Observer& observer, std::int64_t part) {
    const auto& interfaces = observer.problem().mesh->interfaces();
    std::int64_t first = 0;
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        if (static_cast<std::int64_t>(i) == part) return {first, interfaces[i].pair_count()};
        first += interfaces[i].pair_count();
    }
    return {0, first};
}

}  // namespace

FieldShape field_shape(const Observer& observer, const std::string& key, std::int64_t part) {
    const Mesh& mesh = *observer.problem().mesh;
    const std::int64_t dim = mesh.dimension();
    const auto interfaces = static_cast<std::int64_t>(mesh.interfaces().size());
    if (of_pairs(key)) {
        if (part < -1 || part >= interfaces)
            fail(DELAM_ERROR_ARGUMENT, "field '", key, "': part ", part, ", allowed: -1 to ", interfaces - 1);
        return {pair_range(observer, part).second, key == "jump" || key == "traction" ? dim : 1};
    }
    if (part != -1) fail(DELAM_ERROR_ARGUMENT, "field '", key, "': part ", part, ", allowed: -1");
    if (key == "displacement") return {mesh.node_count(), dim};
    if (key == "stress") return {mesh.cell_count(), dim == 2 ? 4 : 6};
    if (key == "rotation") return {mesh.cell_count(), dim == 2 ? 1 : 3};
    if (key == "free_since") return {mesh.body_count(), 1};
    if (key == "free_motion") return {mesh.body_count(), dim == 2 ? 3 : 6};
    if (key == "reaction") return {static_cast<std::int64_t>(observer.problem().constraints.size()), 1};
    fail(DELAM_ERROR_ARGUMENT, "unknown field '", key,
         "'; known: displacement, stress, rotation, jump, traction, adhesion, mixity, contact, reaction, free_since, "
         "free_motion");
}

std::vector<double> field(Observer& observer, const std::string& key, std::int64_t part) {
    const FieldShape shape = field_shape(observer, key, part);
    const State& state = observer.state();
    const Problem& problem = observer.problem();
    if (key == "displacement") return observer.displacement();
    if (key == "reaction") return observer.reaction();
    if (key == "stress") return observer.stress();
    if (key == "rotation") return centre_rotation(*problem.mesh, observer.displacement());
    if (key == "free_since") {
        std::vector<double> since(index(shape.rows), -1.0);
        for (std::size_t b = 0; b < state.free_since.size(); ++b) since[b] = static_cast<double>(state.free_since[b]);
        return since;
    }
    if (key == "free_motion") return observer.free_motions();
    const auto first = index(pair_range(observer, part).first);
    const auto columns = index(shape.columns);
    const std::size_t count = index(shape.rows) * columns, begin = first * columns;
    std::vector<double> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = begin + i;
        if (key == "jump")
            out[i] = state.response.jump[at];
        else if (key == "traction")
            out[i] = state.response.force[at] / observer.pairs().weight[at / columns];
        else if (key == "adhesion")
            out[i] = state.adhesion[at];
        else if (key == "mixity")
            out[i] = state.mixity[at];
        else
            out[i] = state.closed[at] != 0 ? 1.0 : 0.0;
    }
    return out;
}

}  // namespace delam
