// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/layers.hpp"

#include <cmath>
#include <vector>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// Corners of a box in VTK order, and its division into simplices: in 3D the six tetrahedra around the diagonal 0-6
// (Kuhn 1960), one per order of the axes. Every box is divided in the same way and opposite faces have the same
// diagonal, so that neighbouring boxes match.
constexpr int two_triangles[] = {0, 1, 2, 0, 2, 3};
constexpr int six_tetrahedra[] = {0, 1, 2, 6, 0, 5, 1, 6, 0, 2, 3, 6, 0, 3, 7, 6, 0, 4, 5, 6, 0, 7, 4, 6};
// Wedges stand on the triangles. The six pyramids of a box stand on its faces, with their apex in its centre, number 8.
constexpr int two_wedges[] = {4, 5, 6, 0, 1, 2, 4, 6, 7, 0, 2, 3};
constexpr int six_pyramids[] = {0, 1, 2, 3, 8, 4, 7, 6, 5, 8, 0, 4, 5, 1, 8,
                                1, 5, 6, 2, 8, 2, 6, 7, 3, 8, 3, 7, 4, 0, 8};
constexpr int one_square[] = {0, 1, 2, 3};
constexpr int one_cube[] = {0, 1, 2, 3, 4, 5, 6, 7};

std::span<const int> split(const CellRow& row) {
    const bool plane = row.topology.dimension == 2;
    if (row.reference == ReferenceCell::prism) return two_wedges;
    if (row.reference == ReferenceCell::pyramid) return six_pyramids;
    if (row.simplex()) return plane ? std::span<const int>(two_triangles) : six_tetrahedra;
    return plane ? std::span<const int>(one_square) : one_cube;
}

// Quadratic cells have nodes midway between those of linear ones, on a lattice of half the spacing, of which pyramids
// have the centres of boxes. Serendipity cells have only the points on the edges of boxes, which lie midway in at most
// one direction, and wedges also those on the diagonals of their triangles; the others have all points.
bool on_lattice(const CellRow& row, std::int64_t i, std::int64_t j, std::int64_t k) {
    if (row.reference == ReferenceCell::pyramid) return i % 2 == j % 2 && j % 2 == k % 2;
    if (row.reference == ReferenceCell::prism && !row.linear() && k % 2 == 0) return true;
    return row.interpolation != Interpolation::serendipity || i % 2 + j % 2 + k % 2 <= 1;
}

void check(const char* what, std::size_t place, double value) {
    if (!(value > 0.0 && std::isfinite(value)))
        fail(DELAM_ERROR_ARGUMENT, what, "[", place, "] ", value, ": must be finite and > 0");
}
void check(const char* what, std::size_t place, std::int64_t value) {
    if (value < 1) fail(DELAM_ERROR_ARGUMENT, what, "[", place, "] ", value, ": must be >= 1");
}

// i-th of n+1 even points from 0 to length, the last one exact, so that layers meet bit for bit.
double even(double length, std::int64_t i, std::int64_t n) {
    return length * (static_cast<double>(i) / static_cast<double>(n));
}

// A block of layers with the arguments of make_layers, their checks, and the lattice of nodes of its cells.
struct Block {
    const CellRow& row;
    int dimension;
    std::span<const double> lengths;
    std::span<const std::int64_t> divisions;
    std::span<const double> thickness;
    std::span<const std::int64_t> layer_divisions;

    std::int64_t order() const { return row.linear() && row.reference != ReferenceCell::pyramid ? 1 : 2; }
    // Number of lattice steps along x and y; a plane block is one sheet.
    std::int64_t nx() const { return order() * divisions[0]; }
    std::int64_t ny() const { return dimension == 3 ? order() * divisions[1] : 0; }
    // Strides in the lattice: x, then y in space, then the stacking axis.
    std::int64_t line() const { return nx() + 1; }
    std::int64_t level() const { return line() * (ny() + 1); }
};

double places_along(const Block& block, std::int64_t cells) {
    return static_cast<double>(block.order()) * static_cast<double>(cells) + 1.0;
}

// Returns the number of lattice points, an upper bound of the number of nodes.
double check(const Block& block) {
    const std::size_t across = index(block.dimension) - 1;
    if (block.row.topology.dimension != block.dimension)
        fail(DELAM_ERROR_ARGUMENT, "cell type ", static_cast<std::int32_t>(block.row.type), " in a ", block.dimension,
             "D block");
    if (block.lengths.size() != across || block.divisions.size() != across)
        fail(DELAM_ERROR_ARGUMENT, block.lengths.size(), " lengths and ", block.divisions.size(),
             " divisions: must be ", across);
    if (block.thickness.empty()) fail(DELAM_ERROR_ARGUMENT, "layer_count 0: must be >= 1");
    if (block.layer_divisions.size() != block.thickness.size())
        fail(DELAM_ERROR_ARGUMENT, block.layer_divisions.size(), " layer_divisions for ", block.thickness.size(),
             " layers");
    double total = 0.0;
    double per_level = 1.0;
    for (std::size_t i = 0; i < across; ++i) {
        check("lengths", i, block.lengths[i]);
        check("divisions", i, block.divisions[i]);
        per_level *= places_along(block, block.divisions[i]);
    }
    for (std::size_t l = 0; l < block.thickness.size(); ++l) {
        check("thickness", l, block.thickness[l]);
        check("layer_divisions", l, block.layer_divisions[l]);
        total += per_level * places_along(block, block.layer_divisions[l]);
    }
    if (total > 2e9) fail(DELAM_ERROR_ARGUMENT, total, " nodes: at most 2e9");
    return total;
}

// Appends the nodes of a layer between two heights; `count` is the number of nodes, updated. Returns the node at each
// point of the layer's lattice, -1 for none.
std::vector<std::int64_t> add_nodes(const Block& block, std::size_t layer, double base, double top, std::int64_t& count,
                                    std::vector<double>& nodes) {
    const std::int64_t nz = block.order() * block.layer_divisions[layer];
    std::vector<std::int64_t> number;
    for (std::int64_t k = 0; k <= nz; ++k) {
        const double z = k == nz ? top : base + even(block.thickness[layer], k, nz);
        for (std::int64_t j = 0; j <= block.ny(); ++j) {
            for (std::int64_t i = 0; i <= block.nx(); ++i) {
                poll_cancel("mesh");
                const bool there = on_lattice(block.row, i, j, k);
                number.push_back(there ? count++ : -1);
                if (!there) continue;
                nodes.push_back(even(block.lengths[0], i, block.nx()));
                if (block.dimension == 3) nodes.push_back(even(block.lengths[1], j, block.ny()));
                nodes.push_back(z);
            }
        }
    }
    return number;
}

// Appends the cells of a layer, box after box.
void add_cells(const Block& block, std::size_t layer, std::span<const std::int64_t> number,
               std::vector<std::int64_t>& connectivity, std::vector<std::int32_t>& labels) {
    const CellTopology& shape = block.row.topology;
    const std::span<const int> cells = split(block.row);
    const std::int64_t right = block.order();
    const std::int64_t above = block.order() * block.level();
    const std::int64_t back = block.dimension == 3 ? block.order() * block.line() : above;  // second axis of a face
    const std::int64_t nz = block.order() * block.layer_divisions[layer];
    for (std::int64_t k = 0; k < nz; k += block.order()) {
        for (std::int64_t j = 0; j < (block.dimension == 3 ? block.ny() : 1); j += block.order()) {
            for (std::int64_t i = 0; i < block.nx(); i += block.order()) {
                poll_cancel("mesh", static_cast<std::int64_t>(cells.size()) / shape.corners);
                const std::int64_t n = k * block.level() + j * block.line() + i;
                const std::int64_t corner[] = {n,
                                               n + right,
                                               n + right + back,
                                               n + back,
                                               n + above,
                                               n + right + above,
                                               n + right + back + above,
                                               n + back + above,
                                               n + (right + back + above) / 2};
                for (std::size_t c = 0; c < cells.size(); c += index(shape.corners)) {
                    const auto place = [&](int local) { return corner[cells[c + index(local)]]; };
                    for (int a = 0; a < shape.corners; ++a) connectivity.push_back(number[index(place(a))]);
                    for (int m = 0; m < shape.nodes - shape.corners; ++m) {
                        const auto& [a, b] = shape.middle[index(m)];
                        connectivity.push_back(number[index((place(a) + place(b)) / 2)]);
                    }
                    labels.push_back(static_cast<std::int32_t>(layer));
                }
            }
        }
    }
}

}  // namespace

Mesh make_layers(int dimension, std::span<const double> lengths, std::span<const std::int64_t> divisions,
                 std::span<const double> thickness, std::span<const std::int64_t> layer_divisions, CellType type) {
    if (dimension != 2 && dimension != 3) fail(DELAM_ERROR_ARGUMENT, "dimension ", dimension, ": must be 2 or 3");
    const Block block{cell_row(type), dimension, lengths, divisions, thickness, layer_divisions};
    const double places = check(block);
    std::vector<double> nodes;
    std::vector<std::int64_t> connectivity;
    std::vector<std::int32_t> labels;
    nodes.reserve(index(static_cast<std::int64_t>(places) * dimension));
    std::int64_t count = 0;
    double base = 0.0;
    for (std::size_t layer = 0; layer < thickness.size(); ++layer) {
        const double top = base + thickness[layer];
        const std::vector<std::int64_t> number = add_nodes(block, layer, base, top, count, nodes);
        add_cells(block, layer, number, connectivity, labels);
        base = top;
    }
    Mesh mesh(dimension, nodes);
    mesh.add_cells(type, connectivity, labels);
    return mesh;
}

}  // namespace delam
