// SPDX-License-Identifier: BSD-3-Clause
// What the tests of meshes share: layers of a cell type, lists, sums.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "mesh/layers.hpp"
#include "mesh/mesh.hpp"

namespace unit {

using namespace delam;

using Labels = std::vector<std::int32_t>;
using Indices = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

inline bool quadratic(CellType type) { return topology(type).nodes > topology(type).corners; }
// True if the faces on the levels of a block of layers are triangles.
inline bool triangles(CellType type) { return topology(type).corners_of(topology(type).face[0]).size() == 3; }
inline std::int64_t cells_per_box(CellType type) {
    switch (cell_row(type).reference) {
        case ReferenceCell::simplex:
            return topology(type).dimension == 2 ? 2 : 6;
        case ReferenceCell::prism:
            return 2;
        case ReferenceCell::pyramid:
            return 6;
        case ReferenceCell::box:
            break;
    }
    return 1;
}
inline std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

inline Mesh layers(CellType type, Numbers lengths, Indices divisions, Numbers thickness, Indices layer_divisions) {
    return make_layers(topology(type).dimension, lengths, divisions, thickness, layer_divisions, type);
}

inline double sum(std::span<const double> x) { return std::accumulate(x.begin(), x.end(), 0.0); }

// A mesh with the same cells, its nodes and cells in another order and its nodes mapped.
inline Mesh rebuilt(const Mesh& mesh, unsigned seed, const std::function<void(std::span<double>)>& map = {}) {
    const std::size_t dim = at(mesh.dimension());
    std::mt19937 random(seed);
    Indices place(at(mesh.node_count()));
    std::iota(place.begin(), place.end(), std::int64_t{0});
    Indices order(at(mesh.cell_count()));
    std::iota(order.begin(), order.end(), std::int64_t{0});
    if (seed != 0) {
        std::shuffle(place.begin(), place.end(), random);
        std::shuffle(order.begin(), order.end(), random);
    }
    Numbers nodes(mesh.nodes().size());
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) {
        const std::span<double> target = std::span(nodes).subspan(at(place[at(n)]) * dim, dim);
        std::copy(mesh.node(n).begin(), mesh.node(n).end(), target.begin());
        if (map) map(target);
    }
    Mesh result(mesh.dimension(), nodes);
    for (const std::int64_t c : order) {  // one by one, as a host may do
        Indices cell;
        for (const std::int64_t n : mesh.cell(c)) cell.push_back(place[at(n)]);
        result.add_cells(mesh.cell_type(c), cell, Labels{mesh.body_label(mesh.cell_body(c))});
    }
    return result;
}

}  // namespace unit
