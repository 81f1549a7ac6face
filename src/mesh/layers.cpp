// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/layers.hpp"

#include <cmath>
#include <vector>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"

namespace delam {

namespace {

// Corners of a box in VTK order, and how simplices fill it: in 3D the six tetrahedra around the diagonal 0-6 (Kuhn
// 1960), one per order of the axes. Every box is split alike and opposite faces carry the same diagonal, so that
// boxes match each other.
constexpr int two_triangles[] = {0, 1, 2, 0, 2, 3};
constexpr int six_tetrahedra[] = {0, 1, 2, 6, 0, 5, 1, 6, 0, 2, 3, 6, 0, 3, 7, 6, 0, 4, 5, 6, 0, 7, 4, 6};
constexpr int one_square[] = {0, 1, 2, 3};
constexpr int one_cube[] = {0, 1, 2, 3, 4, 5, 6, 7};

std::span<const int> split(CellType type) {
    switch (type) {
        case CellType::tri3:
        case CellType::tri6:
            return two_triangles;
        case CellType::quad4:
        case CellType::quad8:
        case CellType::quad9:
            return one_square;
        case CellType::tet4:
        case CellType::tet10:
            return six_tetrahedra;
        case CellType::hex8:
        case CellType::hex20:
            break;
    }
    return one_cube;
}

// Quadratic cells have nodes midway between those of linear ones, on a lattice of half their size: all of its places
// where simplices cross the boxes or squares have a centre, else only those on the edges of boxes, which lie midway in
// one direction at most.
bool on_lattice(CellType type, std::int64_t i, std::int64_t j, std::int64_t k) {
    if (type != CellType::quad8 && type != CellType::hex20) return true;
    return i % 2 + j % 2 + k % 2 <= 1;
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

}  // namespace

Mesh make_layers(int dimension, std::span<const double> lengths, std::span<const std::int64_t> divisions,
                 std::span<const double> thickness, std::span<const std::int64_t> layer_divisions, CellType type) {
    if (dimension != 2 && dimension != 3) fail(DELAM_ERROR_ARGUMENT, "dimension ", dimension, ": must be 2 or 3");
    if (topology(type).dimension != dimension)
        fail(DELAM_ERROR_ARGUMENT, "cell type ", static_cast<std::int32_t>(type), " in a ", dimension, "D block");
    const std::size_t across = at(dimension) - 1;
    if (lengths.size() != across || divisions.size() != across)
        fail(DELAM_ERROR_ARGUMENT, lengths.size(), " lengths and ", divisions.size(), " divisions: must be ", across);
    if (thickness.empty()) fail(DELAM_ERROR_ARGUMENT, "layer_count 0: must be >= 1");
    if (layer_divisions.size() != thickness.size())
        fail(DELAM_ERROR_ARGUMENT, layer_divisions.size(), " layer_divisions for ", thickness.size(), " layers");
    const std::int64_t order = topology(type).nodes > topology(type).corners ? 2 : 1;
    const auto lattice = [order](std::int64_t cells) {
        return static_cast<double>(order) * static_cast<double>(cells) + 1.0;
    };
    double total = 0.0;
    double per_level = 1.0;
    for (std::size_t i = 0; i < across; ++i) {
        check("lengths", i, lengths[i]);
        check("divisions", i, divisions[i]);
        per_level *= lattice(divisions[i]);
    }
    for (std::size_t l = 0; l < thickness.size(); ++l) {
        check("thickness", l, thickness[l]);
        check("layer_divisions", l, layer_divisions[l]);
        total += per_level * lattice(layer_divisions[l]);
    }
    if (total > 2e9) fail(DELAM_ERROR_ARGUMENT, total, " nodes: at most 2e9");

    // The lattice of nodes: x, then y in space, then the axis of the stack; a plane block is one sheet.
    const std::int64_t nx = order * divisions[0];
    const std::int64_t ny = dimension == 3 ? order * divisions[1] : 0;
    const std::int64_t row = nx + 1;
    const std::int64_t level = row * (ny + 1);
    const CellTopology& shape = topology(type);
    const std::span<const int> cells = split(type);
    std::vector<double> nodes;
    std::vector<std::int64_t> connectivity;
    std::vector<std::int32_t> labels;
    std::vector<std::int64_t> number;  // of the node at each place of a layer's lattice; -1: none
    nodes.reserve(at(static_cast<std::int64_t>(total) * dimension));
    std::int64_t count = 0;
    double base = 0.0;
    for (std::size_t layer = 0; layer < thickness.size(); ++layer) {
        const std::int64_t nz = order * layer_divisions[layer];
        const double top = base + thickness[layer];
        number.clear();
        for (std::int64_t k = 0; k <= nz; ++k) {
            const double z = k == nz ? top : base + even(thickness[layer], k, nz);
            for (std::int64_t j = 0; j <= ny; ++j) {
                for (std::int64_t i = 0; i <= nx; ++i) {
                    poll_cancel("mesh");
                    const bool there = on_lattice(type, i, j, k);
                    number.push_back(there ? count++ : -1);
                    if (!there) continue;
                    nodes.push_back(even(lengths[0], i, nx));
                    if (dimension == 3) nodes.push_back(even(lengths[1], j, ny));
                    nodes.push_back(z);
                }
            }
        }
        const std::int64_t right = order;
        const std::int64_t above = order * level;
        const std::int64_t back = dimension == 3 ? order * row : above;  // the second axis within a VTK face
        for (std::int64_t k = 0; k < nz; k += order) {
            for (std::int64_t j = 0; j < (dimension == 3 ? ny : 1); j += order) {
                for (std::int64_t i = 0; i < nx; i += order) {
                    poll_cancel("mesh", static_cast<std::int64_t>(cells.size()) / shape.corners);
                    const std::int64_t n = k * level + j * row + i;
                    const std::int64_t corner[] = {
                        n,         n + right,         n + right + back,         n + back,
                        n + above, n + right + above, n + right + back + above, n + back + above};
                    for (std::size_t c = 0; c < cells.size(); c += at(shape.corners)) {
                        const auto place = [&](int local) { return corner[cells[c + at(local)]]; };
                        for (int a = 0; a < shape.corners; ++a) connectivity.push_back(number[at(place(a))]);
                        for (int m = 0; m < shape.nodes - shape.corners; ++m) {
                            const auto& [a, b] = shape.middle[at(m)];
                            connectivity.push_back(number[at((place(a) + place(b)) / 2)]);
                        }
                        labels.push_back(static_cast<std::int32_t>(layer));
                    }
                }
            }
        }
        base = top;
    }
    Mesh mesh(dimension, nodes);
    mesh.add_cells(type, connectivity, labels);
    return mesh;
}

}  // namespace delam
