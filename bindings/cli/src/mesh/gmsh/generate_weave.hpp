// SPDX-License-Identifier: BSD-3-Clause
// The periodic cell of a plain weave: two warp and two weft yarns in a block of matrix.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh_data.hpp"
#include "text/error.hpp"

namespace cli {

// Lengths (L). Yarns of one direction are `spacing` apart, so the cell is 2 spacing x 2 spacing x height.
struct WeaveCell {
    double spacing = 1.0;
    double width = 0.8;            // of a yarn, < spacing
    double thickness = 0.2;        // of a yarn, <= width
    double gap = 0.02;             // of matrix between crossing yarns, measured along z
    double height = 0;             // of the cell; 0: the fabric and gap above and below
    std::string section = "lens";  // two circular arcs; or ellipse, whose tips need small cells
    bool stacked = false;          // periodic along z too
    double h = 0.16;               // edge of a cell
    std::int32_t cell = 0;         // of weave_shapes()
    Place place;                   // of the table, for messages
};

// The cell is [0, 2 spacing]^2 x [-height/2, height/2] ([0, height] if stacked). Warp yarns run along x at y =
// spacing/2, 3 spacing/2; weft yarns along y. The centre line of a yarn is z = +- A sin(pi s/spacing), and its sections
// across x (warp) or y (weft) are all equal. A is the smallest amplitude that keeps the gap everywhere. Bodies matrix,
// warp-1, warp-2, weft-1, weft-2. Opposite borders have the same nodes. Node sets left, right (x), front, back (y),
// bottom, top (z), corners, origin. Axis 1 of a yarn is the tangent of its centre line at the cell's centroid, axis 2
// lies in the plane of the fabric; the axes of the matrix are the global ones. Throws SceneFailure.
MeshData generate_weave(const WeaveCell& cell);

// A: the amplitude of the centre lines.
double weave_amplitude(const WeaveCell& cell);

}  // namespace cli
