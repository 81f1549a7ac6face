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

const Orientation& orientation_of(const Deck& deck, const Section& section) {
    for (const std::string& part : {section.part, std::string()})
        if (const auto found = deck.orientations.find({part, upper(section.orientation)});
            found != deck.orientations.end()) {
            if (found->second.refusal) throw Refusals(*found->second.refusal);
            return found->second;
        }
    return named(Catalogue<Orientation>(), section.orientation, "orientation", section.place);
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

FoundElement cohesive_element(const Model& model, const std::vector<std::int64_t>& lower) {
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

FoundElement cell_with(const Model& model, const std::vector<std::int64_t>& nodes) {
    for (const Part* scope : model.scopes())
        for (const Element& element : scope->elements) {
            const auto has = [&](std::int64_t node) {
                for (std::size_t k = 0; k < element.nodes.size(); ++k)
                    if (node_number(*scope, element, k) == node) return true;
                return false;
            };
            if (!element.type->cohesive() && std::all_of(nodes.begin(), nodes.end(), has)) return {scope, &element};
        }
    return {};
}

std::string origin_line(const Place& place) {
    return fmt::format("{}{}\t{}\t{}\n", begin_of_origin_line, place.line, one_line(place.path), one_line(place.file));
}

}  // namespace cli::abaqus
