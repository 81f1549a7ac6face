// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/abaqus_model.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "deck/abaqus/inp_cards.hpp"

namespace cli::abaqus {

namespace {

template <class Visit>
void for_each_number(const Entry& entry, std::int64_t first, Visit&& visit) {
    visit(first);
    // The last is reached exactly, so that no sum exceeds it.
    for (std::int64_t id = first; entry.by > 0 && id != entry.last;) visit(id += entry.by);
}

}  // namespace

std::vector<const Part*> Model::scopes() const {
    std::vector<const Part*> out{&root};
    for (const auto& instance : instances) out.push_back(instance.get());
    return out;
}

const Part* Model::instance_named(const std::string& name, const Place& place) const {
    const auto found = instance_of.find(upper(name));
    if (found == instance_of.end()) throw SceneFailure(place, "instance \"" + name + "\" is not there");
    return found->second;
}

const Part& Model::owner_of(std::int64_t node) const {
    // They follow each other; one without nodes begins where the next one does.
    const auto after = std::upper_bound(instances.begin(), instances.end(), node,
                                        [](std::int64_t n, const auto& part) { return n < part->first_node; });
    return after == instances.begin() ? root : **std::prev(after);
}

void Model::count_member(const Place& place) const {
    if (++members_ > most_members)
        throw SceneFailure(
            place, fmt::format("with this the sets and surfaces of the mesh have more than {} members", most_members));
}

Entry Model::resolved_scope(const Entry& entry) const {
    const std::size_t dot = entry.text.find('.');
    if (dot == std::string::npos || entry.scope != &root || instances.empty()) return entry;
    return {instance_named(entry.text.substr(0, dot), entry.place), entry.text.substr(dot + 1), entry.place, entry.last,
            entry.by};
}

bool Trail::enter(const Set& set, const Place& place, const char* what) {
    constexpr std::size_t deepest = 22;
    const auto [at, inserted] = open_.emplace(&set, true);
    if (!inserted && at->second) throw SceneFailure(place, fmt::format("{} sets contain each other", what));
    if (inserted && ++depth_ > deepest)
        throw SceneFailure(place, fmt::format("{} sets contain each other more than {} deep", what, deepest));
    return inserted;
}

void Trail::leave(const Set& set) {
    open_[&set] = false;
    --depth_;
}

void Model::collect_elements(const Entry& raw, std::set<ElementAt>& out) const {
    Trail trail;
    collect_elements(raw, out, trail);
}

void Model::collect_nodes(const Entry& raw, std::set<std::int64_t>& out) const {
    Trail trail;
    collect_nodes(raw, out, trail);
}

void Model::collect_set(const Set& set, std::set<std::int64_t>& out) const {
    Trail trail;
    if (!trail.enter(set, set.place, "node")) return;
    collect_set(set, out, trail);
}

void Model::collect_elements(const Entry& raw, std::set<ElementAt>& out, Trail& trail) const {
    const Entry entry = resolved_scope(raw);
    if (const auto first = inp_whole(entry.text)) {
        for_each_number(entry, *first, [&](std::int64_t id) {
            const auto at = entry.scope->element_of.find(id);
            if (at == entry.scope->element_of.end())
                throw SceneFailure(entry.place, fmt::format("element {} is not there", id));
            count_member(entry.place);
            out.insert({entry.scope, at->second});
        });
        return;
    }
    const auto set = entry.scope->element_sets.find(upper(entry.text));
    if (set == entry.scope->element_sets.end())
        throw SceneFailure(entry.place, fmt::format("element set \"{}\" is not there", entry.text));
    if (!trail.enter(set->second, entry.place, "element")) return;
    for (const Entry& part : set->second.entries) collect_elements(part, out, trail);
    trail.leave(set->second);
}

void Model::collect_nodes(const Entry& raw, std::set<std::int64_t>& out, Trail& trail) const {
    const Entry entry = resolved_scope(raw);
    if (const auto first = inp_whole(entry.text)) {
        for_each_number(entry, *first, [&](std::int64_t id) {
            count_member(entry.place);
            out.insert(node_number(*entry.scope, id, entry.place));
        });
        return;
    }
    const auto set = entry.scope->node_sets.find(upper(entry.text));
    if (set == entry.scope->node_sets.end())
        throw SceneFailure(entry.place, fmt::format("node set \"{}\" is not there", entry.text));
    if (!trail.enter(set->second, entry.place, "node")) return;
    collect_set(set->second, out, trail);
    trail.leave(set->second);
}

void Model::collect_set(const Set& set, std::set<std::int64_t>& out, Trail& trail) const {
    for (const Entry& part : set.entries) collect_nodes(part, out, trail);
    for (const Entry& from : set.element_sets) {
        std::set<ElementAt> elements;
        collect_elements(from, elements);
        for (const ElementAt& at : elements) {
            const Element& element = at.scope->elements[at.index];
            for (std::size_t k = 0; k < element.nodes.size(); ++k) out.insert(node_number(*at.scope, element, k));
        }
    }
}

std::int64_t node_number(const Part& scope, std::int64_t id, const Place& place) {
    const auto at = scope.node_of.find(id);
    if (at == scope.node_of.end()) throw SceneFailure(place, fmt::format("node {} is not there", id));
    return scope.first_node + static_cast<std::int64_t>(at->second);
}

std::int64_t node_number(const Part& scope, const Element& element, std::size_t position) {
    const auto at = scope.node_of.find(element.nodes[position]);
    if (at == scope.node_of.end())
        throw SceneFailure(element.place,
                           fmt::format("element {} has node {}, which is not there",
                                       full_name(scope, std::to_string(element.id)), element.nodes[position]));
    return scope.first_node + static_cast<std::int64_t>(at->second);
}

std::string full_name(const Part& scope, const std::string& name) {
    return scope.name.empty() ? name : scope.name + "." + name;
}

std::string surface_set_name(const Part& scope, const Surface& surface) {
    std::string name = surface.name;
    while (scope.node_sets.contains(upper(name)) || (name != surface.name && scope.surfaces.contains(upper(name))))
        name += "-surface";
    return full_name(scope, name);
}

std::array<double, 3> turned_by(const Part& instance, const std::array<double, 3>& direction) {
    std::array<double, 3> out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t a = 0; a < 3; ++a) out[a] += direction[i] * instance.turned[i][a];
    return out;
}

}  // namespace cli::abaqus
