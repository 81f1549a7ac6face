// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_connections.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "deck/abaqus/keywords.hpp"
#include "text/toml_text.hpp"

namespace cli::abaqus {

std::string Connections::body(std::int32_t label) const {
    return toml_text(mesh_.body_names[static_cast<std::size_t>(label)]);
}

Held* Connections::find(std::int32_t a, std::int32_t b) {
    const auto found = by_bodies_.find(std::minmax(a, b));
    return found == by_bodies_.end() ? nullptr : &held_[found->second.front()];
}

bool Connections::beside(const Held& one, const Held& other) {
    if (one.set.empty() || other.set.empty()) return one.set != other.set;  // one of them has the rest
    if (!mesh_.face_sets.contains(one.set) || !mesh_.face_sets.contains(other.set)) return one.set != other.set;
    return places_.coinciding(one.set, other.set) == 0;
}

void Connections::add(const Held& held) {
    std::vector<std::size_t>& known = by_bodies_[std::minmax(held.a, held.b)];
    if (known.empty()) {
        known.push_back(held_.size());
        held_.push_back(held);
        return;
    }
    Held& first = held_[known.front()];
    const auto refuse = [&](const Held& other, const char* why) {
        throw SceneFailure(held.place, fmt::format("{} and {} are held together by {} already{}", body(held.a),
                                                   body(held.b), other.place.text(), why));
    };
    if (held.bonded) {
        if (!first.law.empty()) refuse(first, "");
        first = held;
        return;
    }
    if (first.bonded) return;
    // Contact acts in every interface: a pair that asks for it alone adds nothing to a law.
    if (held.law.empty()) {
        first.gap = std::max(first.gap, held.gap);
        first.adjust = std::max(first.adjust, held.adjust);
        return;
    }
    if (first.law.empty()) {
        first = held;
        return;
    }
    for (const std::size_t i : known) {
        Held& other = held_[i];
        if (other.law == held.law && other.set == held.set) return;
        if (other.law == held.law && !held.joined.empty() && other.joined == held.joined &&
            other.matching == held.matching) {
            other.set = held.joined;
            other.gap = std::max(other.gap, held.gap);
            other.tolerance = std::max(other.tolerance, held.tolerance);
            return;
        }
    }
    for (const std::size_t i : known)
        if (!beside(held_[i], held))
            refuse(held_[i], ": where their faces overlap, an interface has one law; give each law faces of its own");
    if (first.matching != held.matching) refuse(first, ", there by nodes that coincide and here by projection");
    known.push_back(held_.size());
    held_.push_back(held);
    // Interfaces between the same two bodies share one pairing.
    double gap = 0, tolerance = 0;
    for (const std::size_t i : known) {
        gap = std::max(gap, held_[i].gap);
        tolerance = std::max(tolerance, held_[i].tolerance);
    }
    for (const std::size_t i : known) {
        held_[i].gap = gap;
        held_[i].tolerance = tolerance;
    }
}

std::vector<std::string> Connections::said() const {
    std::vector<std::string> out;
    for (const auto& [bodies, known] : by_bodies_)
        if (known.size() > 1)
            out.push_back(
                fmt::format("{} and {} have {} laws between them, each on the faces of its set: pairs at a "
                            "border have the first of them",
                            body(bodies.first), body(bodies.second), known.size()));
    return out;
}

std::string Connections::entry(const Held& held, const DeckLaws& laws) const {
    std::string out =
        fmt::format("{}[[interfaces]]\na = {}\nb = {}\n", origin_line(held.place), body(held.a), body(held.b));
    out += held.bonded        ? "bonded = true\n"
           : held.law.empty() ? "contact = true\n"
                              : fmt::format("law = {}\n", toml_text(held.law));
    if (laws.has_axes(held.law))
        out += fmt::format("shear_axis = {}  # projected: axis 1 of the deck\n",
                           toml_list(std::vector<double>(held.shear_axis.begin(), held.shear_axis.end())));
    if (held.shared) out += "shared = \"bonded\"\n";
    if (!held.matching) out += "projected = true\n";
    if (held.tolerance > 0) out += fmt::format("tolerance = {}\n", toml_number(held.tolerance));
    if (held.gap > 0) out += fmt::format("gap = {}\n", toml_number(held.gap));
    if (held.open && !held.law.empty()) out += "initial_gap = \"open\"\n";
    if (held.open && held.adjust > 0) out += fmt::format("adjust = {}\n", toml_number(held.adjust));
    return out;
}

std::string Connections::text(const DeckLaws& laws) const {
    std::string out;
    for (const Held& held : held_) {
        const std::vector<std::size_t>& known = by_bodies_.at(std::minmax(held.a, held.b));
        const bool only = known.size() == 1;
        out += entry(held, laws);
        if (!held.set.empty())
            out += fmt::format(
                fmt::runtime(only ? "notch = [{{ set = {}, outside = true }}]\n" : "part = [{{ set = {} }}]\n"),
                toml_text(held.set));
        out += "\n";
        const auto has_set = [&](std::size_t i) { return !held_[i].set.empty(); };
        if (only || &held != &held_[known.back()] || !std::all_of(known.begin(), known.end(), has_set)) continue;
        Held rest = held;
        rest.law.clear();
        rest.open = false;
        out += entry(rest, laws) + "\n";
    }
    return out;
}

}  // namespace cli::abaqus
