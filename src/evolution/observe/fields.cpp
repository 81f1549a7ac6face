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

// Returns 1 where nothing holds a motion of a body (FreeParts::moves), else 0, [bodies][3 or 6].
std::vector<double> unheld_motions(Observer& observer) {
    const std::int64_t modes = observer.problem().mesh->dimension() == 2 ? 3 : 6;
    std::vector<double> out(index(observer.problem().mesh->body_count() * modes), 0.0);
    const ContactScene& contact = observer.contact();
    if (contact.parts == nullptr) return out;
    const State& state = observer.state();
    const DenseMatrix free =
        free_motions(observer.jump_operator(), contact, spring_stiffness(observer.pairs(), state.adhesion), state.theta,
                     state.closed, state.response);
    const std::vector<std::uint8_t> moves = contact.parts->moves(free);
    std::copy(moves.begin(), moves.end(), out.begin());
    return out;
}

std::vector<double> reactions_of(Observer& o) {
    const Problem& problem = o.problem();
    const std::vector<double> own = o.jump_operator().reaction(o.state().theta, o.state().response);
    std::vector<double> out(index(problem.numbered_constraints()), 0.0);  // 0: it does not hold now
    for (std::size_t c = 0; c < own.size(); ++c) out[index(problem.number_of(c))] = own[c];
    return out;
}

// Tells what a row of a field belongs to.
enum class Of { nodes, cells, pairs, constraints, bodies };

struct FieldRow {
    const char* key;
    Of of;
    std::int64_t columns[2];                                             // in the plane, in space
    std::vector<double> (*read)(Observer&);                              // of everything; null: of pairs
    double (*pair)(const Observer&, std::size_t entry);                  // of pairs: one entry of [pairs][columns]
    std::vector<double> (*one)(Observer&, std::int64_t part) = nullptr;  // of one node; null: of all together only
};

std::vector<double> free_since(Observer& observer) {
    const std::vector<std::int64_t>& step = observer.state().free_since;
    std::vector<double> since(index(observer.problem().mesh->body_count()), -1.0);
    for (std::size_t b = 0; b < step.size(); ++b) since[b] = static_cast<double>(step[b]);
    return since;
}

constexpr FieldRow field_table[] = {
    {"displacement",
     Of::nodes,
     {2, 3},
     [](Observer& o) { return o.displacement(); },
     nullptr,
     [](Observer& o, std::int64_t node) { return o.displacement_of(node); }},
    {"stress", Of::cells, {4, 6}, [](Observer& o) { return o.stress(); }, nullptr},
    {"rotation", Of::cells, {1, 3}, [](Observer& o) { return o.rotation(); }, nullptr},
    {"jump", Of::pairs, {2, 3}, nullptr, [](const Observer& o, std::size_t i) { return o.state().response.jump[i]; }},
    {"traction",
     Of::pairs,
     {2, 3},
     nullptr,
     [](const Observer& o, std::size_t i) {
         return o.state().response.force[i] / o.pairs().weight[i / index(o.problem().mesh->dimension())];
     }},
    {"adhesion", Of::pairs, {1, 1}, nullptr, [](const Observer& o, std::size_t i) { return o.state().adhesion[i]; }},
    {"mixity", Of::pairs, {1, 1}, nullptr, [](const Observer& o, std::size_t i) { return o.state().mixity.shear[i]; }},
    {"contact",
     Of::pairs,
     {1, 1},
     nullptr,
     [](const Observer& o, std::size_t i) { return o.state().closed[i] != 0 ? 1.0 : 0.0; }},
    {"reaction", Of::constraints, {1, 1}, reactions_of, nullptr},
    {"free_since", Of::bodies, {1, 1}, free_since, nullptr},
    {"free_motion", Of::bodies, {3, 6}, unheld_motions, nullptr},
    {"mesh_error", Of::cells, {1, 1}, [](Observer& o) { return o.mesh_error_of_cells(); }, nullptr},
};

const FieldRow& find_field(const std::string& key) {
    std::string known;
    for (const FieldRow& field : field_table) {
        if (key == field.key) return field;
        known += text(known.empty() ? "" : ", ", field.key);
    }
    fail(DELAM_ERROR_ARGUMENT, "unknown field '", key, "'; known: ", known);
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
    const FieldRow& row = find_field(key);
    const Problem& problem = observer.problem();
    const Mesh& mesh = *problem.mesh;
    const auto interfaces = static_cast<std::int64_t>(mesh.interfaces().size());
    const std::int64_t columns = row.columns[mesh.dimension() - 2];
    if (row.of == Of::pairs) {
        if (part < -1 || part >= interfaces)
            fail(DELAM_ERROR_ARGUMENT, "field '", key, "': part ", part, ", allowed: -1 to ", interfaces - 1);
        return {pair_range(observer, part).second, columns};
    }
    if (row.one != nullptr) {
        if (part < -1 || part >= mesh.node_count())
            fail(DELAM_ERROR_ARGUMENT, "field '", key, "': part ", part, ", allowed: -1 to ", mesh.node_count() - 1);
        if (part >= 0) return {1, columns};
    } else if (part != -1)
        fail(DELAM_ERROR_ARGUMENT, "field '", key, "': part ", part, ", allowed: -1");
    switch (row.of) {
        case Of::nodes:
            return {mesh.node_count(), columns};
        case Of::cells:
            return {mesh.cell_count(), columns};
        case Of::bodies:
            return {mesh.body_count(), columns};
        default:
            return {problem.numbered_constraints(), columns};
    }
}

std::vector<double> field(Observer& observer, const std::string& key, std::int64_t part) {
    const FieldShape shape = field_shape(observer, key, part);
    const FieldRow& row = find_field(key);
    if (row.one != nullptr && part >= 0) return row.one(observer, part);
    if (row.read != nullptr) return row.read(observer);
    const std::size_t first = index(pair_range(observer, part).first * shape.columns);
    std::vector<double> out(index(shape.rows * shape.columns));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = row.pair(observer, first + i);
    return out;
}

}  // namespace delam
