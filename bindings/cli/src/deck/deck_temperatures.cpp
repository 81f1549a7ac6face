// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_temperatures.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "mesh/cell_shape.hpp"
#include "text/toml_text.hpp"

namespace cli::abaqus {

Temperatures::Temperatures(const Deck& deck, const Model& model, const MeshData& mesh)
    : deck_(deck), model_(model), mesh_(mesh) {}

const std::vector<std::int32_t>& Temperatures::bodies(const Entry& where) const {
    const auto [at, inserted] = known_.try_emplace(where.text);
    if (!inserted) return at->second;
    if (nodes_.empty()) {
        nodes_.resize(mesh_.body_names.size());
        for (const CellBlock& block : mesh_.blocks) {
            const std::size_t count = shape_of(block.type).nodes;
            for (std::size_t i = 0; i < block.connectivity.size(); ++i)
                if (mesh_.has_given(block.connectivity[i]))
                    nodes_[static_cast<std::size_t>(block.bodies[i / count])].insert(block.connectivity[i]);
        }
    }
    std::set<std::int64_t> given, whole;
    model_.collect_nodes(where, given);
    std::vector<std::int32_t> partly;
    for (std::size_t body = 0; body < nodes_.size(); ++body) {
        const std::set<std::int64_t>& own = nodes_[body];
        if (std::includes(given.begin(), given.end(), own.begin(), own.end())) {
            at->second.push_back(static_cast<std::int32_t>(body));
            whole.insert(own.begin(), own.end());
        } else {
            partly.push_back(static_cast<std::int32_t>(body));
        }
    }
    // Bodies that share nodes with one that is meant have these alone.
    for (const std::int32_t body : partly) {
        const std::set<std::int64_t>& own = nodes_[static_cast<std::size_t>(body)];
        const auto of = [&](const std::set<std::int64_t>& all) {
            return std::count_if(own.begin(), own.end(), [&](std::int64_t node) { return all.contains(node); });
        };
        if (of(given) > of(whole))
            throw SceneFailure(
                where.place,
                fmt::format("\"{}\" has {} of the {} nodes of \"{}\", and not node {}: one temperature of a whole body "
                            "is imported; give a set of all of its nodes",
                            where.text, of(given), own.size(), mesh_.body_names[static_cast<std::size_t>(body)],
                            label_of(*std::find_if(own.begin(), own.end(),
                                                   [&](std::int64_t node) { return !given.contains(node); }))));
    }
    return at->second;
}

std::string Temperatures::label_of(std::int64_t node) const {
    const Part& owner = model_.owner_of(node);
    return full_name(owner, std::to_string(owner.nodes[static_cast<std::size_t>(node - owner.first_node)].id));
}

double Temperatures::initial(std::int32_t body) const {
    double out = 0;
    for (const LoadLine& line : deck_.initial_temperatures)
        for (const std::int32_t each : bodies(line.where))
            if (each == body) out = line.magnitude;
    return out;
}

std::string thermal_text(const std::map<std::int32_t, Points>& temperatures, const MeshData& mesh) {
    std::vector<std::pair<Points, std::vector<std::string>>> alike;  // changes, and the bodies that have them
    for (const auto& [body, points] : temperatures) {
        Points changes = points;
        for (auto& [time, value] : changes) value -= points.front().second;
        if (std::all_of(changes.begin(), changes.end(), [](const auto& point) { return point.second == 0; })) continue;
        auto at = std::find_if(alike.begin(), alike.end(), [&](const auto& each) { return each.first == changes; });
        if (at == alike.end()) at = alike.insert(at, {changes, {}});
        at->second.push_back(mesh.body_names[static_cast<std::size_t>(body)]);
    }
    std::string out;
    for (std::size_t i = 0; i < alike.size(); ++i) {
        const std::string name = i == 0 ? "temperature" : fmt::format("temperature-{}", i + 1);
        std::vector<double> times, values;
        for (const auto& [time, value] : alike[i].first) {
            times.push_back(time);
            values.push_back(value);
        }
        out += fmt::format(
            "[[patterns]]\nname = {}\ntimes = {}\nvalues = {}\n\n[[thermal]]\npattern = {}\nbodies = {}\n\n",
            toml_text(name), toml_list(times), toml_list(values), toml_text(name), toml_list(alike[i].second));
    }
    return out;
}

}  // namespace cli::abaqus
