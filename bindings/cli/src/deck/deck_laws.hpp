// SPDX-License-Identifier: BSD-3-Clause
// Interface laws of a deck as [[laws]] of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "deck/cards/deck.hpp"

namespace cli::abaqus {

// The laws of all interfaces of a deck, each written once and under a name of its own.
class DeckLaws {
public:
    // edge: the shortest of the mesh. Differences between a law of the deck and that of the scene go to deck.changed.
    DeckLaws(Deck& deck, std::int32_t dimension, double edge) : deck_(deck), dimension_(dimension), edge_(edge) {}

    // These return the name of a law.
    std::string of_material(const MaterialCards& material, double thickness);  // of cohesive elements
    std::string of_interaction(const InteractionCards& interaction);           // of surfaces

    // True if the law has other numbers in the second direction of sliding.
    [[nodiscard]] bool has_axes(const std::string& law) const { return with_axes_.contains(law); }
    // All of them, as [[laws]].
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    // stiffness: Knn, Kss, Ktt, force per volume. thickness: by which nominal strains become jumps.
    std::string law(const std::string& of, const std::string& name, const Numbers& stiffness, double thickness,
                    const DamageCards& damage, const Place& place);
    [[nodiscard]] double softest() const;

    Deck& deck_;
    std::int32_t dimension_;
    double edge_;
    std::string text_;
    std::set<std::string> with_axes_;
    std::map<std::string, std::size_t> alike_;                     // numbers of laws of a name
    std::map<std::pair<std::string, double>, std::string> names_;  // by what gives the law, and its thickness
};

}  // namespace cli::abaqus
