// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/periodic_mesh.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cli {

std::array<std::int64_t, 3> PointTable::slot(const std::array<double, 3>& at) const {
    std::array<std::int64_t, 3> slot{};
    for (std::size_t k = 0; k < 3; ++k) slot[k] = std::llround(at[k] / (4 * tolerance_));
    return slot;
}

std::uint64_t PointTable::hash(const std::array<std::int64_t, 3>& slot) {
    std::uint64_t mixed = 0;
    for (const std::int64_t s : slot) {
        mixed = (mixed ^ static_cast<std::uint64_t>(s)) * 0x9E3779B97F4A7C15ULL;
        mixed ^= mixed >> 29;
    }
    return mixed;
}

void PointTable::add(const std::array<double, 3>& at, std::int64_t index) {
    entries_[hash(slot(at))].push_back({at, index});
}

std::optional<std::int64_t> PointTable::find(const std::array<double, 3>& at) const {
    const std::array<std::int64_t, 3> middle = slot(at);
    for (std::int64_t i = -1; i <= 1; ++i)
        for (std::int64_t j = -1; j <= 1; ++j)
            for (std::int64_t k = -1; k <= 1; ++k) {
                const auto found = entries_.find(hash({middle[0] + i, middle[1] + j, middle[2] + k}));
                if (found == entries_.end()) continue;
                for (const Entry& entry : found->second) {
                    double far = 0;
                    for (std::size_t a = 0; a < 3; ++a) far = std::max(far, std::abs(entry.at[a] - at[a]));
                    if (far <= tolerance_) return entry.index;
                }
            }
    return std::nullopt;
}

void align_borders(MeshData& mesh, const Place& place) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    double largest = 0;
    for (const auto& period : mesh.periods)
        for (const double p : period) largest = std::max(largest, std::abs(p));
    const double tolerance = 1e-6 * largest;
    for (const auto& period : mesh.periods) {
        const auto axis = static_cast<std::size_t>(
            std::find_if(period.begin(), period.end(), [](double p) { return p != 0.0; }) - period.begin());
        PointTable lower(tolerance);
        const auto point = [&](std::size_t node) {
            std::array<double, 3> at{};
            std::copy_n(mesh.nodes.begin() + static_cast<std::ptrdiff_t>(node * dimension), dimension, at.begin());
            return at;
        };
        const std::size_t count = mesh.nodes.size() / dimension;
        std::size_t lower_count = 0;
        for (std::size_t n = 0; n < count; ++n) {
            double& x = mesh.nodes[n * dimension + axis];
            if (std::abs(x) > tolerance) continue;
            x = 0.0;
            lower.add(point(n), static_cast<std::int64_t>(n));
            ++lower_count;
        }
        for (std::size_t n = 0; n < count; ++n) {
            double& x = mesh.nodes[n * dimension + axis];
            if (std::abs(x - period[axis]) > tolerance) continue;
            std::array<double, 3> opposite = point(n);
            opposite[axis] = 0.0;
            const std::optional<std::int64_t> partner = lower.find(opposite);
            if (!partner)
                throw SceneFailure(place, fmt::format("the mesh is not periodic: nothing is opposite to the node at "
                                                      "({}, {}, {}); another h may help",
                                                      opposite[0] + (axis == 0 ? period[0] : 0.0),
                                                      opposite[1] + (axis == 1 ? period[1] : 0.0), opposite[2]));
            for (std::size_t k = 0; k < dimension; ++k)
                mesh.nodes[n * dimension + k] = mesh.nodes[static_cast<std::size_t>(*partner) * dimension + k];
            x = period[axis];
            --lower_count;
        }
        if (lower_count != 0)
            throw SceneFailure(place, fmt::format("the mesh is not periodic: {} nodes at {} = 0 have none opposite; "
                                                  "another h may help",
                                                  lower_count, "xyz"[axis]));
    }
}

}  // namespace cli
