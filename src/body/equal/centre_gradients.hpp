// SPDX-License-Identifier: BSD-3-Clause
// Gradients of the shape functions at the centres of cells, once for equal cells, and displacement gradients from them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "body/equal/row_table.hpp"
#include "mesh/mesh.hpp"
#include "mesh/shape.hpp"

namespace delam {

// Displacements that a cell has for itself, [nodes of the cell][dimension], by its index; valid until the next call.
using DisplacementOfCell = std::function<std::span<const double>(std::int64_t cell)>;

class CentreGradients {
public:
    // The mesh must outlive it.
    explicit CentreGradients(const Mesh& mesh);
    // Displacement gradients du_i/dx_j at the centres, [cells][dimension][dimension]. displacement: [mesh
    // nodes][dimension].
    std::vector<double> slopes(std::span<const double> displacement) const;
    std::vector<double> slopes(const DisplacementOfCell& displacement) const;
    // Returns how many different cells are kept.
    std::size_t distinct() const { return gradients_.count(); }

private:
    template <std::size_t dim, class Displacement>
    std::vector<double> slopes_in(const Displacement& displacement) const;

    const Mesh& mesh_;
    ByRow<std::vector<double>> gradients_;  // each [nodes][dimension]
    std::vector<std::int32_t> which_;       // [cells]; -1: not kept
};

}  // namespace delam
