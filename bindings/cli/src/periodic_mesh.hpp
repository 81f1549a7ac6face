// SPDX-License-Identifier: BSD-3-Clause
// Opposite borders of a generated cell that spans [0, period] along the axis of each of its periods.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "error.hpp"
#include "mesh_data.hpp"

namespace cli {

// Points by place. Two points are the same within the tolerance; different ones must be further apart than twice that.
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

// Nodes of a border that agree to rounding or to 1e-6 of the largest period with those opposite are put exactly there:
// afterwards borders are exact and x + period is the partner of x. A node without partner is refused with its place.
void align_borders(MeshData& mesh, const Place& place);

}  // namespace cli
