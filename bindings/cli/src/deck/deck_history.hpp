// SPDX-License-Identifier: BSD-3-Clause
// The history of a place: its values over time, as the lines of a deck prescribe them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "deck/cards/deck.hpp"
#include "deck/deck_points.hpp"

namespace cli::abaqus {

// Holds what one line of the deck prescribes, over all steps. Behind its last point it is constant.
struct History {
    LoadLine line;  // the first of its kind
    int dof = 0;
    bool force = false;
    std::size_t number = 0;  // in the order of the deck
    Points points{{0.0, 0.0}};
    const LoadLine* follows = nullptr;  // the last line that prescribed it
    std::size_t before = 1;             // points of the steps before this one
    std::size_t given = 0;              // the last step that has a line for it

    void hold_until(double time) {
        if (points.back().first < time) points.emplace_back(time, points.back().second);
    }

    [[nodiscard]] double peak() const {
        double out = 0;
        for (const auto& [time, value] : points)
            if (std::abs(value) > std::abs(out)) out = value;
        return out;
    }
};

// Supports hold to the end of the analysis: OP=NEW at `place` must give again in this step what would end.
inline void require_held(const std::map<std::size_t, History*>& ending, std::size_t step, const Place& place) {
    constexpr std::size_t most_named = 4;
    std::vector<std::string> freed;
    for (const auto& [number, history] : ending) {
        if (history->force || history->given == step) continue;
        const double value = history->points.back().second;
        freed.push_back(fmt::format("{}, {}", history->line.where.text, history->dof));
        if (value != 0) freed.back() += fmt::format(", {}, {}", history->dof, value);
    }
    if (freed.empty()) return;
    const std::size_t count = freed.size();
    freed.resize(std::min(count, most_named));
    throw SceneFailure(place, fmt::format("OP=NEW frees what steps before have prescribed: supports that end are not "
                                          "imported; to keep them, write below this line \"{}\"{}, or end the analysis "
                                          "with the step before",
                                          fmt::join(freed, "\", \""),
                                          count > most_named ? fmt::format(" and {} more", count - most_named) : ""));
}

}  // namespace cli::abaqus
