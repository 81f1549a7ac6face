// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/near_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cli {

namespace {

struct Corner {
    std::array<double, 3> at{};
    std::int32_t body = 0;
};

// Returns the nodes of the cells of each body, ascending along x.
std::vector<Corner> corners_of(const MeshData& mesh) {
    std::vector<std::array<std::int64_t, 2>> nodes;  // node and body
    for (const CellBlock& block : mesh.blocks) {
        const std::size_t each = block.connectivity.size() / std::max<std::size_t>(1, block.bodies.size());
        for (std::size_t i = 0; i < block.connectivity.size(); ++i)
            nodes.push_back({block.connectivity[i], block.bodies[i / each]});
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<Corner> out;
    for (const auto& [node, body] : nodes) {
        Corner corner;
        corner.body = static_cast<std::int32_t>(body);
        std::copy_n(mesh.nodes.begin() + static_cast<std::ptrdiff_t>(node) * mesh.dimension, mesh.dimension,
                    corner.at.begin());
        out.push_back(corner);
    }
    std::sort(out.begin(), out.end(), [](const Corner& a, const Corner& b) { return a.at < b.at; });
    return out;
}

}  // namespace

NearBody nearest_body(const MeshData& mesh, std::int32_t body) {
    const std::vector<Corner> all = corners_of(mesh);
    NearBody out;
    const auto compare = [&](const Corner& own, const Corner& other) {
        if (other.body == body) return;
        const double distance = std::hypot(own.at[0] - other.at[0], own.at[1] - other.at[1], own.at[2] - other.at[2]);
        if (distance < out.distance) out = {other.body, distance};
    };
    // A node is compared outward along x, until that distance alone is too large.
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].body != body) continue;
        for (std::size_t k = i + 1; k < all.size() && all[k].at[0] - all[i].at[0] < out.distance; ++k)
            compare(all[i], all[k]);
        for (std::size_t k = i; k > 0 && all[i].at[0] - all[k - 1].at[0] < out.distance; --k)
            compare(all[i], all[k - 1]);
    }
    return out;
}

}  // namespace cli
