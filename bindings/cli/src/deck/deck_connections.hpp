// SPDX-License-Identifier: BSD-3-Clause
// The connections between the bodies of a deck: which law, bond or contact holds which two together, and where.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "deck/cards/deck.hpp"
#include "deck/deck_bodies.hpp"
#include "deck/deck_laws.hpp"
#include "mesh/mesh_data.hpp"

namespace cli::abaqus {

struct Held {
    std::int32_t a = 0, b = 0;
    std::string law;  // empty: contact
    std::string set;  // the faces or nodes that adhere; empty: all
    double gap = 0;   // between the faces; 0: they coincide
    bool matching = true;
    Place place;
    double tolerance = 0;  // at which nodes match, over the shortest edge; 0: that of the scene
    bool open = false;     // surfaces, whose distance counts
    double adjust = 0;
    bool bonded = false;   // tied
    bool shared = false;   // bonded where the bodies share nodes
    std::string joined{};  // the set of these faces and others to which an equal section gives the law; empty: none
    Vector shear_axis{1, 0, 0};  // projected: axis 1 of a law with two stiffnesses in shear
};

class Connections {
public:
    // The arguments must outlive it.
    Connections(const MeshData& mesh, FacePlaces& places) : mesh_(mesh), places_(places) {}

    // Adds a connection to those of its bodies. Laws on sets of faces that do not overlap hold beside each other.
    // Throws SceneFailure where two contradict.
    void add(const Held& held);
    // Returns the first connection of two bodies, or null.
    Held* find(std::int32_t a, std::int32_t b);
    [[nodiscard]] const std::vector<Held>& all() const { return held_; }
    // Returns all connections as [[interfaces]] of a scene.
    [[nodiscard]] std::string text(const DeckLaws& laws) const;
    // Returns a sentence for each two bodies that have several laws.
    [[nodiscard]] std::vector<std::string> said() const;

private:
    [[nodiscard]] std::string body(std::int32_t label) const;
    // True if two connections may hold beside each other, each on its own set.
    bool beside(const Held& one, const Held& other);
    [[nodiscard]] std::string entry(const Held& held, const DeckLaws& laws) const;

    const MeshData& mesh_;
    FacePlaces& places_;
    std::vector<Held> held_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> by_bodies_;
};

}  // namespace cli::abaqus
