// SPDX-License-Identifier: BSD-3-Clause
// Random arrangements of equal discs in a periodic rectangle, and the two regular ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace cli {

struct PackingRequest {
    std::int64_t count = 1;
    double fraction = 0.5;  // of the rectangle's area
    double gap = 0.0;       // between two discs at least, in radii
    double edge_gap = 0.0;  // between a circle and an edge that it does not cross, and how far it reaches over one
                            // that it does cross; the same of the rectangle's corners; in radii
    double aspect = 1.0;    // height over width
    std::uint64_t seed = 1;
};

// Lengths are in radii of the discs. The rectangle has one corner in the origin and repeats itself in both directions.
struct Packing {
    double width = 0;
    double height = 0;
    std::vector<std::array<double, 2>> centres;  // inside the rectangle
};

// Discs are placed one by one where there is room (random sequential adsorption). Those without room are placed
// anywhere, and overlaps are pushed apart until there are none. The same request gives the same packing on every
// machine that computes in IEEE doubles. Throws std::domain_error with a one-line message that names the key if packing
// fails.
Packing pack_discs(const PackingRequest& request);

// One disc in the middle of a rectangle.
Packing square_packing(double fraction, double aspect);
// Two discs to a rectangle of height sqrt(3) width, one in the middle and one around the corners.
Packing hexagonal_packing(double fraction);

}  // namespace cli
