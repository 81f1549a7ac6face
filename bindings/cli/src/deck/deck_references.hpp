// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a deck that belong to no body, and what ties bodies to them: [[controls]], [[couplings]] and
// [[equations]] of a scene.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deck/cards/deck.hpp"
#include "deck/deck_bodies.hpp"
#include "mesh/mesh_data.hpp"

namespace cli::abaqus {

// A degree of freedom in the scene: the lines of a place, and an axis of it.
struct SceneComponent {
    std::string place;
    std::size_t axis = 0;
    std::size_t control = 0;  // of a control node: its index
};

// A node of a body: its place in the scene.
std::string point_text(const MeshData& mesh, std::int64_t node, std::int32_t body);

class References {
public:
    // mesh: of the model, split into pieces. Throws SceneFailure at couplings that cannot be taken.
    References(const Deck& deck, const Model& model, const MeshData& mesh);

    // True if angles of a rigid coupling, or equations that do not hold for a common displacement of their nodes, tie
    // bodies to control nodes: large rotations do not know them (src/scene/check/kinematics.cpp).
    [[nodiscard]] bool stay_linear() const { return stay_linear_; }
    // The nodes of an entry if all of them belong to no body; empty: they are nodes of bodies.
    [[nodiscard]] const std::vector<std::int64_t>& of(const Entry& where) const;
    // The bodies that a node belongs to.
    [[nodiscard]] const std::vector<std::int32_t>& bodies_at(std::int64_t node) const { return bodies_.of(node); }
    // Returns the component of a node that of() has given. nullopt: nothing moves with this degree of freedom.
    [[nodiscard]] std::optional<SceneComponent> component(std::int64_t node, int dof) const;
    // A load prescribes what component() has given.
    void prescribe(const SceneComponent& component);
    // A force acts there: something else must determine it.
    void push(const SceneComponent& component, const Place& place);

    // Returns the text of the references; to be called at the end, because supports hold what nothing else determines.
    std::string text();

private:
    using Row = std::array<double, 3>;
    struct Control {
        std::string name;
        std::vector<double> at;
        std::vector<Row> determined;  // directions that constraints and loads determine: an orthonormal basis
        std::map<std::size_t, Place> pushed;
    };

    [[nodiscard]] bool of_no_body(std::int64_t node) const { return bodies_.of(node).empty(); }
    [[nodiscard]] std::vector<std::int64_t> nodes_of(const Entry& where) const;
    [[nodiscard]] std::vector<double> position(std::int64_t node) const;
    // Its part or instance, and its number there.
    [[nodiscard]] std::pair<const Part*, std::int64_t> owner_of(std::int64_t node) const;
    [[nodiscard]] std::pair<std::size_t, std::int64_t> label_of(std::int64_t node) const;
    [[nodiscard]] std::string new_name(std::int64_t node, const std::string& ending);
    [[nodiscard]] SceneComponent of_control(std::size_t control, std::size_t axis) const;
    [[nodiscard]] bool unsorted(const Entry& where) const;
    [[nodiscard]] static std::string place_of(const Control& control);
    std::size_t control_of(std::int64_t node);
    std::size_t rotation_of(std::int64_t node);
    std::int64_t reference_of(const Coupling& coupling);
    // The name of the set of nodes that a coupling moves, each of which belongs to a body.
    std::string coupled_set(const Coupling& coupling);
    void couple(const Coupling& coupling);
    void distribute(const Coupling& coupling);
    [[nodiscard]] std::vector<double> weights_of(const std::string& set) const;
    void equate(const std::vector<EquationEntry>& terms);
    std::string term_text(const EquationEntry& term, std::int64_t node);
    std::string held_text(const Control& control) const;

    const Model& model_;
    const MeshData& mesh_;
    std::size_t dimension_;
    NodeBodies bodies_;
    mutable std::map<std::string, std::vector<std::int64_t>> of_;  // by the text of the entry
    std::map<std::int64_t, std::string> set_of_;                   // by node: the first set that consists of it
    std::vector<Control> controls_;                                // in the order of their first use
    bool stay_linear_ = false;
    std::map<std::string, int> names_;                     // of controls: the next number to try
    std::size_t coupled_ = 0;                              // nodes of all couplings
    std::map<std::int64_t, std::size_t> translations_;     // controls by node
    std::map<std::int64_t, std::size_t> rotations_;        // the same
    std::map<std::int64_t, std::int64_t> rotation_nodes_;  // reference nodes by their rotation nodes
    std::string constraints_;
};

}  // namespace cli::abaqus
