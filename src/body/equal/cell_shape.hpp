// SPDX-License-Identifier: BSD-3-Clause
// The shape of a cell without its place: cells that a translation takes onto each other have equal ones.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "base/numbers.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// The coordinates of a cell's nodes from its first one on, [nodes][dimension], and room for what else tells cells
// apart.
class CellShape {
public:
    // Takes the shape of a cell, and forgets what was added.
    void take(const Mesh& mesh, std::int64_t cell) {
        const auto nodes = mesh.cell(cell);
        const std::span<const double> origin = mesh.node(nodes[0]);
        double* to = row_.data();
        for (const std::int64_t n : nodes) {
            const std::span<const double> x = mesh.node(n);
            for (std::size_t i = 0; i < x.size(); ++i) *to++ = x[i] - origin[i];
        }
        coordinates_ = index(to - row_.data());
        count_ = coordinates_;
        add(static_cast<double>(mesh.cell_type(cell)));
    }
    void add(double value) { row_[count_++] = value; }
    void add(std::span<const double> values) {
        std::copy(values.begin(), values.end(), row_.begin() + static_cast<std::ptrdiff_t>(count_));
        count_ += values.size();
    }
    std::span<const double> coordinates() const { return std::span(row_).first(coordinates_); }
    // Everything that tells it from others.
    std::span<const double> row() const { return std::span(row_).first(count_); }

private:
    static constexpr std::size_t most_besides = 64;  // type, elasticity, dilatation, formulation
    std::array<double, 3 * most_cell_nodes + most_besides> row_;
    std::size_t coordinates_ = 0, count_ = 0;
};

}  // namespace delam
