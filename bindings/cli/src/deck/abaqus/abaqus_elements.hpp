// SPDX-License-Identifier: BSD-3-Clause
// The element types of Abaqus that are read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deck/abaqus/inp_cards.hpp"

namespace cli::abaqus {

struct ElementType {
    std::string_view name;
    std::int32_t cell;  // -1: a cohesive element, which is no cell
    std::string_view plane;
    std::string_view note;
    std::size_t face_nodes =
        0;  // of a cohesive element: nodes of its lower face, which come first, and of its upper one
    std::span<const std::uint8_t> order{};  // node of Abaqus's that each of the cell's nodes is; empty: the same order

    [[nodiscard]] bool cohesive() const { return face_nodes > 0; }
    [[nodiscard]] std::size_t nodes() const;
    [[nodiscard]] std::int32_t dimension() const;
};

// Returns the type that the TYPE of an *ELEMENT card names.
const ElementType& type_named(const InpCard& card);

// Elements of edges and faces that preprocessors, Gmsh among them, write beside the cells of a mesh.
class BoundaryElements {
public:
    explicit BoundaryElements(const std::vector<InpCard>& cards);
    // True for a card of trusses, or of plane elements beside solid ones, whose set no section names: they are no
    // cells.
    [[nodiscard]] bool contains(const InpCard& card) const;

private:
    std::set<std::string> sections_;  // sets of sections, in upper case
    bool solid_ = false;              // there are solid elements
};

}  // namespace cli::abaqus
