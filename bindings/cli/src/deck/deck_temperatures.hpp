// SPDX-License-Identifier: BSD-3-Clause
// Temperatures of bodies, from sets of nodes that have one.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "deck/cards/deck.hpp"
#include "deck/deck_history.hpp"
#include "mesh/mesh_data.hpp"

namespace cli::abaqus {

class Temperatures {
public:
    Temperatures(const Deck& deck, const Model& model, const MeshData& mesh);

    // The bodies whose nodes an entry has. Throws SceneFailure where it has a part of those of a body.
    [[nodiscard]] const std::vector<std::int32_t>& bodies(const Entry& where) const;
    // 0: none is given. Throws SceneFailure where a body has several.
    [[nodiscard]] double initial(std::int32_t body) const;

private:
    [[nodiscard]] std::string label_of(std::int64_t node) const;

    const Deck& deck_;
    const Model& model_;
    const MeshData& mesh_;
    mutable std::vector<std::set<std::int64_t>> nodes_;  // by body; empty: not needed yet
    mutable std::map<std::string, std::vector<std::int32_t>> known_;
};

// The changes of temperature as [[patterns]] and [[thermal]]; "": there are none. temperatures: by body, from the
// initial one on.
std::string thermal_text(const std::map<std::int32_t, Points>& temperatures, const MeshData& mesh);

}  // namespace cli::abaqus
