// SPDX-License-Identifier: BSD-3-Clause
// The mesh data of an Abaqus input file in their original form: parts and instances with their nodes, elements, sets
// and surfaces, and the meaning of the entries of sets and surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "deck/abaqus/abaqus_elements.hpp"
#include "text/error.hpp"

namespace cli {
struct InpCard;
}

namespace cli::abaqus {

struct Node {
    std::int64_t id;
    std::array<double, 3> at;
};

struct Element {
    std::int64_t id;
    const ElementType* type;
    std::vector<std::int64_t> nodes;  // ids
    std::string set;                  // of the *ELEMENT line
    Place place;
};

struct Part;

// An entry of a set in its original form: a number, the name of a set, or either after the name of an instance.
struct Entry {
    const Part* scope;
    std::string text;
    Place place;
    // The entry stands for the number and, if by > 0, for all up to `last` in increments. A line may stand for more
    // numbers than memory can hold, but the first one that does not exist ends the reading.
    std::int64_t last = 0;
    std::int64_t by = 0;
};

struct Set {
    std::string name;  // in its first spelling
    std::vector<Entry> entries;
    std::vector<Entry> element_sets;  // of node sets: all nodes of their elements
    bool unsorted = false;            // UNSORTED: the order of its nodes matters to the deck
    Place place;
};

// Stands for the sides of elements that no other element has.
constexpr std::size_t free_sides = static_cast<std::size_t>(-1);

struct Side {
    Entry elements;
    std::size_t side;  // from 0 on, or free_sides
};

struct Surface {
    std::string name;
    std::vector<Side> sides;
    std::vector<Entry> nodes;  // of TYPE=NODE
    bool of_nodes = false;
    Place place;
    std::optional<SceneFailure> refusal{};  // why it cannot be used

    void require_sound() const {
        if (refusal) throw SceneFailure(*refusal);
    }
};

// *TIE: the nodes of one surface move with the other, onto which they are projected.
struct Tie {
    Entry slave, master;
    double tolerance = 0;  // the largest distance of nodes that are tied; 0: not said
    Place place;
};

using CardsByName = std::map<std::string, const InpCard*>;  // by upper case

// A part, an instance of one, or the objects outside of both.
struct Part {
    std::string name;
    std::vector<Node> nodes;
    std::vector<Element> elements;
    std::unordered_map<std::int64_t, std::size_t> node_of;     // by id
    std::unordered_map<std::int64_t, std::size_t> element_of;  // by id
    std::map<std::string, Set> node_sets;                      // by upper case
    std::map<std::string, Set> element_sets;
    std::map<std::string, Surface> surfaces;
    std::vector<Entry> sections;  // their element sets
    std::vector<const InpCard*> section_cards;
    std::vector<Entry> cohesive_sections;
    std::vector<const InpCard*> cohesive_cards;
    CardsByName orientations, distributions, distribution_tables;
    std::array<std::array<double, 3>, 3> turned{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // where an instance has x, y, z
    std::array<double, 3> origin{};                                                  // and their origin
    std::size_t order = 0;        // position among the parts of the mesh
    std::int64_t first_node = 0;  // number in the mesh
};

struct ElementAt {
    const Part* scope;
    std::size_t index;
    [[nodiscard]] const Element& element() const { return scope->elements[index]; }
    [[nodiscard]] const ElementType& type() const { return *element().type; }
    bool operator<(const ElementAt& other) const {
        return std::pair(scope->order, index) < std::pair(other.scope->order, other.index);
    }
};

// The sets met while one is collected: each is followed once, however often others name it.
class Trail {
public:
    // Returns true if the set is new. Throws SceneFailure at `place` if it contains itself or is nested too deeply.
    bool enter(const Set& set, const Place& place, const char* what);
    void leave(const Set& set);

private:
    std::map<const Set*, bool> open_;  // true: its entries are being followed
    std::size_t depth_ = 0;
};

// Everything that a file says about its mesh.
struct Model {
    Place file;
    Part root;
    std::map<std::string, std::unique_ptr<Part>> parts;  // by upper case
    std::vector<std::unique_ptr<Part>> instances;
    std::unordered_map<std::string, const Part*> instance_of;  // by upper case
    std::vector<Tie> ties;
    std::vector<std::string> notes;

    // The parts and instances that make up the mesh.
    [[nodiscard]] std::vector<const Part*> scopes() const;
    // Returns the part that has a node, by its number in the mesh; requires Part::first_node.
    [[nodiscard]] const Part& owner_of(std::int64_t node) const;
    [[nodiscard]] const Part* instance_named(const std::string& name, const Place& place) const;
    // Splits off the instance of "instance.rest".
    [[nodiscard]] Entry resolved_scope(const Entry& entry) const;
    // The elements of an entry: a number or the name of a set.
    void collect_elements(const Entry& raw, std::set<ElementAt>& out) const;
    // Nodes by their numbers in the mesh; requires Part::first_node.
    void collect_nodes(const Entry& raw, std::set<std::int64_t>& out) const;
    void collect_set(const Set& set, std::set<std::int64_t>& out) const;

private:
    // A line may name a set of any size, so that what sets have in all may exceed the file by any factor.
    void count_member(const Place& place) const;
    mutable std::int64_t members_ = 0;

    void collect_elements(const Entry& raw, std::set<ElementAt>& out, Trail& trail) const;
    void collect_nodes(const Entry& raw, std::set<std::int64_t>& out, Trail& trail) const;
    void collect_set(const Set& set, std::set<std::int64_t>& out, Trail& trail) const;
};

// Limits the members of all sets and surfaces that are collected: 8 bytes each.
constexpr std::int64_t most_members = 100000000;
// Limits the nodes, elements and members of sets of all instances: some 100 bytes each.
constexpr std::int64_t most_copies = 20000000;

std::int64_t node_number(const Part& scope, std::int64_t id, const Place& place);
// The node of an element at a position of its line.
std::int64_t node_number(const Part& scope, const Element& element, std::size_t position);
// The name in the scene of an object of a part or an instance.
std::string full_name(const Part& scope, const std::string& name);
// The name of the set of a surface: with an ending where a node set has its name.
std::string surface_set_name(const Part& scope, const Surface& surface);
// A direction of a part as its instance has it.
std::array<double, 3> turned_by(const Part& instance, const std::array<double, 3>& direction);

}  // namespace cli::abaqus
