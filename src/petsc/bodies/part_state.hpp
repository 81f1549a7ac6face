// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "petsc/bodies/bodies.hpp"

namespace delam::petsc {

// Source of a part that came from rank 0's scene: its cells, and their bytes for delam_experimental_part_fields.
struct PartCells {
    std::vector<std::int64_t> cells;
    std::vector<std::uint8_t> bytes;
};

// The fields of the state that rank 0 has had recovered last, at the nodes and cells of this rank. Only `take` is
// collective.
class PartState {
public:
    struct Field {
        const std::vector<double>* values;
        std::int64_t rows;
        std::int64_t columns;
    };

    // Eigenstrains of bodies, by label, at a state; unknown where the host's own call of the library's function has
    // recovered it.
    struct Eigenstrains {
        bool known = false;
        std::vector<std::int32_t> bodies;
        std::vector<double> strains;
    };
    void take(const Bodies& bodies, BodyState state, Eigenstrains eigenstrains);
    void clear() { *this = {}; }

    bool known() const { return known_; }
    // Nodes of the part, then, on rank 0, the nodes of the mesh that no part has.
    const std::vector<std::int64_t>& nodes() const { return nodes_; }
    // 1: no lower rank has the node.
    const std::vector<std::int32_t>& owned() const { return owned_; }
    Field field(const std::string& key, const PartCells& cells);

private:
    void compute_cells(const PartCells& cells);

    bool known_ = false;
    std::int64_t dimension_ = 0;
    std::int64_t part_nodes_ = 0;
    std::vector<std::int64_t> nodes_;
    std::vector<std::int32_t> owned_;
    std::vector<double> displacement_, force_;
    Eigenstrains eigenstrains_;
    bool has_cells_ = false;  // stress_ and rotation_ are set
    std::vector<double> stress_, rotation_;
};

}  // namespace delam::petsc
