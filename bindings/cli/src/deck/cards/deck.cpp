// SPDX-License-Identifier: BSD-3-Clause
#include "deck/cards/deck.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "text/printable.hpp"

namespace cli::abaqus {

int degree_of_freedom(const std::string& field, int most, const Place& place) {
    const std::int64_t value = inp_whole(field, place);
    if (value < 1 || value > most)
        throw SceneFailure(place, fmt::format("degree of freedom {}: 1 to {} are expected", value, most));
    return static_cast<int>(value);
}

SectionIndex::SectionIndex(const Deck& deck, const Model& model, std::vector<Entry> Part::*sections) {
    std::map<std::pair<std::string, int>, const Section*> at;  // by file and line of the card
    for (const Section& section : deck.sections)
        at.emplace(std::pair(section.place.file, section.place.line), &section);
    for (const Part* scope : model.scopes())
        for (const Entry& entry : scope->*sections) {
            const auto section = at.find({entry.place.file, entry.place.line});
            if (section == at.end()) continue;
            const Entry resolved = model.resolved_scope(entry);
            const auto set = resolved.scope->element_sets.find(upper(resolved.text));
            const std::string& own = set == resolved.scope->element_sets.end() ? resolved.text : set->second.name;
            of_.emplace(full_name(*resolved.scope, own), SectionOf{section->second, resolved.scope});
        }
}

SectionOf SectionIndex::of(const std::string& name) const {
    const auto found = of_.find(name);
    return found == of_.end() ? SectionOf{} : found->second;
}

std::string node_set_name(const Model& model, const Entry& raw) {
    const Entry entry = model.resolved_scope(raw);
    const auto set = entry.scope->node_sets.find(upper(entry.text));
    return set == entry.scope->node_sets.end() ? "" : full_name(*entry.scope, set->second.name);
}

std::string surface_name(const Model& model, const Entry& raw) {
    const Entry entry = model.resolved_scope(raw);
    const auto surface = entry.scope->surfaces.find(upper(entry.text));
    if (surface == entry.scope->surfaces.end()) return "";
    surface->second.require_sound();
    return surface_set_name(*entry.scope, surface->second);
}

CohesiveElement cohesive_element(const Model& model, const std::vector<std::int64_t>& lower) {
    for (const Part* scope : model.scopes())
        for (const Element& element : scope->elements) {
            if (!element.type->cohesive() || element.type->face_nodes != lower.size()) continue;
            bool same = true;
            for (std::size_t k = 0; k < lower.size() && same; ++k)
                same = node_number(*scope, element.nodes[k], element.place) == lower[k];
            if (same) return {scope, &element};
        }
    return {};
}

std::string origin_line(const Place& place) {
    return fmt::format("{}{}\t{}\t{}\n", begin_of_origin_line, place.line, one_line(place.path), one_line(place.file));
}

}  // namespace cli::abaqus
