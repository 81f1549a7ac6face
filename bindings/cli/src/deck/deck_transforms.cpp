// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_transforms.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cli::abaqus {

Transforms::Transforms(const Deck& deck, const Model& model, std::int32_t dimension)
    : deck_(deck), model_(model), dimension_(static_cast<std::size_t>(dimension)) {
    for (const Transform& each : deck.transforms) {
        if (!deck.couplings.empty() || !deck.equations.empty() || !deck.pins.empty())
            throw SceneFailure(each.place, "is not imported together with couplings, *EQUATION or *MPC");
        if (dimension == 2 && std::abs(each.axes[2][2]) < 1 - 1e-9)
            throw SceneFailure(each.place, "axes 1 and 2 of a plane mesh lie in its plane");
        nodes_.emplace_back();
        model.collect_nodes(each.where, nodes_.back());
    }
}

std::optional<std::vector<double>> Transforms::direction(const Entry& where, int dof) const {
    if (deck_.transforms.empty() || dof > 3) return std::nullopt;
    std::set<std::int64_t> nodes;
    model_.collect_nodes(where, nodes);
    std::optional<std::vector<double>> out;
    // The last of several cards for a node counts, as it does in the deck.
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        const auto count =
            std::count_if(nodes.begin(), nodes.end(), [&](std::int64_t node) { return nodes_[i].contains(node); });
        if (count == 0) continue;
        if (count < static_cast<std::ptrdiff_t>(nodes.size()))
            throw SceneFailure(
                where.place, fmt::format("{} of the {} nodes of \"{}\" have a *TRANSFORM: give them sets of their own",
                                         count, nodes.size(), where.text));
        const std::array<double, 3>& axis = deck_.transforms[i].axes[static_cast<std::size_t>(dof - 1)];
        out.emplace(axis.begin(), axis.begin() + static_cast<std::ptrdiff_t>(dimension_));
        break;
    }
    return out;
}

}  // namespace cli::abaqus
