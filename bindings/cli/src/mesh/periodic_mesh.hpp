// SPDX-License-Identifier: BSD-3-Clause
// Opposite borders of a generated cell, which spans [0, period] along the axis of each of its periods.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mesh/mesh_data.hpp"
#include "text/error.hpp"

namespace cli {

// Points by position. Points within the tolerance are the same; different ones must be at least twice as far apart.
class PointTable {
public:
    explicit PointTable(double tolerance) : tolerance_(tolerance) {}
    void add(const std::array<double, 3>& at, std::int64_t index);
    [[nodiscard]] std::optional<std::int64_t> find(const std::array<double, 3>& at) const;

private:
    struct Entry {
        std::array<double, 3> at;
        std::int64_t index;
    };
    [[nodiscard]] std::array<std::int64_t, 3> slot(const std::array<double, 3>& at) const;
    static std::uint64_t hash(const std::array<std::int64_t, 3>& slot);

    double tolerance_;
    std::unordered_map<std::uint64_t, std::vector<Entry>> entries_;
};

// Moves nodes of a border that agree with those opposite to rounding or to 1e-6 of the largest period exactly there.
// Then x + period is exactly the partner of x. Refuses a node without a partner and gives its position.
void align_borders(MeshData& mesh, const Place& place);

}  // namespace cli
