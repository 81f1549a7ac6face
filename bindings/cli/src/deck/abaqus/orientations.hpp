// SPDX-License-Identifier: BSD-3-Clause
// The material axes of *ORIENTATION: of whole sections, or of each element by its place or by a *DISTRIBUTION; and the
// plies of a section, which turn them. The axes of *SYSTEM, which nodes have.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "deck/abaqus/inp_cards.hpp"
#include "mesh/ply_cells.hpp"
#include "text/refusals.hpp"

namespace cli::abaqus {

using Vector = std::array<double, 3>;
using Axes = std::array<Vector, 3>;

struct Orientation {
    std::string name;
    std::string part;  // in which it stands; "": outside
    bool cylindrical = false;
    std::string distribution;    // of the points of each element; "": they are `points`
    std::vector<double> points;  // a and b, then the origin
    int about = 0;               // 0: not said
    double angle = 0;            // degrees
    Place place;
    std::optional<Refusals> refusal{};  // why it cannot be used

    // True if elements of one section may have different axes.
    [[nodiscard]] bool of_each_element() const { return cylindrical || !distribution.empty(); }
    // Returns axes 1, 2, 3 of an element by its points and its centre. Throws SceneFailure at `at` if they give none.
    [[nodiscard]] Axes axes(const std::vector<double>& of_element, const Vector& centre, const Place& at) const;
};

Orientation orientation_of(const InpCard& card);

// The rectangular system of *SYSTEM, in which a deck gives nodes.
struct NodeSystem {
    Vector origin{};
    Axes axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

    // Returns the point in x, y, z.
    [[nodiscard]] Vector global(const Vector& at) const;
};

// Returns none where the card, without lines, ends the system of another one.
std::optional<NodeSystem> node_system_of(const InpCard& card);

// The plies of a section with COMPOSITE, from the side of the first nodes of its elements on.
struct Laminate {
    std::string material;
    Plies plies;

    // True if a ply has another angle than 0.
    [[nodiscard]] bool turns() const;
};
Laminate laminate_of(const InpCard& section);

// Turns axes about one of them, 1 to 3.
void turn(Axes& axes, int about, double degrees);
// Returns axes 1 and 2. Near-zeros of rotations by right angles, which would hide the axes from a reader, are zeros.
std::array<double, 6> first_two(const Axes& axes);

}  // namespace cli::abaqus
