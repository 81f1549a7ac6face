// SPDX-License-Identifier: BSD-3-Clause
// The directions of degrees of freedom that *TRANSFORM turns.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "deck/cards/deck.hpp"

namespace cli::abaqus {

class Transforms {
public:
    // Throws SceneFailure where the deck has constraints too, whose degrees of freedom would be turned with them.
    Transforms(const Deck& deck, const Model& model, std::int32_t dimension);

    // The direction of a degree of freedom, 1 to 3, of the nodes of an entry; nothing: it is that of an axis. Throws
    // SceneFailure where the nodes have several.
    [[nodiscard]] std::optional<std::vector<double>> direction(const Entry& where, int dof) const;

private:
    const Deck& deck_;
    const Model& model_;
    std::size_t dimension_;
    std::vector<std::set<std::int64_t>> nodes_;  // by transform
};

}  // namespace cli::abaqus
