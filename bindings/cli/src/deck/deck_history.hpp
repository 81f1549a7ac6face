// SPDX-License-Identifier: BSD-3-Clause
// Histories: values over time as points with straight lines between them, and what the lines of a deck prescribe at a
// place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "deck/cards/deck.hpp"
#include "text/toml_text.hpp"

namespace cli::abaqus {

using Points = std::vector<std::pair<double, double>>;  // instants and values

// Returns the value at an instant; constant before the first point and after the last.
double between(const Points& points, double x);
// Returns the values of an amplitude as straight lines; a SMOOTH STEP, whose parts are polynomials of fifth order, in
// 16 each.
Points lines_of(const Amplitude& amplitude);

// When a support holds (SCENE.md); nothing: from the first instant, or to the last.
struct Times {
    std::optional<double> from, reached, until, released;

    [[nodiscard]] std::string text() const {
        std::string out;
        for (const auto& [key, time] :
             {std::pair("from", from), {"reached", reached}, {"until", until}, {"released", released}})
            if (time) out += fmt::format("{} = {}\n", key, toml_number(*time));
        return out;
    }
};

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
    Times times{};                      // of a displacement

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

// Tells histories apart: lines of the deck with one key go on with one.
struct HistoryKey {
    std::string place;
    int dof;
    std::string distributed;
    int part = 0;  // a support that has ended and begins again is another one
    bool operator<(const HistoryKey& other) const {
        return std::tie(place, dof, distributed, part) <
               std::tie(other.place, other.dof, other.distributed, other.part);
    }
};

// Made of points whose largest is 1, which the factor multiplies by `peak`.
struct Pattern {
    std::string name;
    double peak;
};

}  // namespace cli::abaqus
