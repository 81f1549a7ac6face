// SPDX-License-Identifier: BSD-3-Clause
#include "deck.hpp"

#include <cstdint>

#include <fmt/format.h>

namespace cli::abaqus {

int degree_of_freedom(const std::string& field, int most, const Place& place) {
    const std::int64_t value = inp_whole(field, place);
    if (value < 1 || value > most)
        throw SceneFailure(place, fmt::format("degree of freedom {}: 1 to {} are expected", value, most));
    return static_cast<int>(value);
}

SectionOf section_named(const Deck& deck, const Model& model, std::vector<Entry> Part::*sections,
                        const std::string& name) {
    for (const Part* scope : model.scopes())
        for (const Entry& entry : scope->*sections) {
            const Entry resolved = model.resolved_scope(entry);
            const auto set = resolved.scope->element_sets.find(upper(resolved.text));
            const std::string& own = set == resolved.scope->element_sets.end() ? resolved.text : set->second.name;
            if (full_name(*resolved.scope, own) != name) continue;
            for (const Section& section : deck.sections)
                if (section.place.file == entry.place.file && section.place.line == entry.place.line)
                    return {&section, resolved.scope};
        }
    return {};
}

std::string node_set_name(const Model& model, const Entry& raw) {
    const Entry entry = model.resolved_scope(raw);
    const auto set = entry.scope->node_sets.find(upper(entry.text));
    return set == entry.scope->node_sets.end() ? "" : full_name(*entry.scope, set->second.name);
}

std::string surface_name(const Model& model, const Entry& raw) {
    const Entry entry = model.resolved_scope(raw);
    const auto surface = entry.scope->surfaces.find(upper(entry.text));
    return surface == entry.scope->surfaces.end() ? "" : full_name(*entry.scope, surface->second.name);
}

}  // namespace cli::abaqus
