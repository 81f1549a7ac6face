// SPDX-License-Identifier: BSD-3-Clause
// Some cells of a problem with all that their stiffness follows from, as bytes for another process, and the matrix
// there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "body/eigenstrain.hpp"
#include "body/model.hpp"
#include "linalg/sparse/sparse.hpp"
#include "mesh/mesh.hpp"
#include "scene/problem.hpp"

namespace delam {

// Arrays of numbers, as they lie in the bytes.
struct Part {
    std::int32_t dimension = 0;
    std::int32_t plane = 0;                  // of Plane
    std::vector<std::int64_t> nodes;         // of the cells, in the problem's mesh, ascending
    std::vector<double> coordinates;         // [nodes][dimension]
    std::vector<std::int32_t> types;         // [cells] of CellType
    std::vector<std::int32_t> connectivity;  // places in `nodes`, cell after cell
    std::vector<std::int32_t> body;          // [cells] places in `labels`
    std::vector<std::int32_t> labels;        // [bodies] of the bodies in use, ascending
    std::vector<std::int32_t> formulation;   // [bodies] of Formulation
    std::vector<std::int32_t> orthotropic;   // [bodies] 1, or 0: isotropic
    std::vector<double> constants;           // [bodies][9] as in Orthotropic; isotropic: E, nu, then zeros
    std::vector<double> axes;                // [axes][9] as in Axes, those in use
    std::vector<std::int32_t> axes_of_cell;  // [cells] -1: global
};

// cells: ascending, in range. Error(DELAM_ERROR_PROBLEM) names a body whose material is missing, or whose stiffness the
// host has given.
Part part_of(const Problem& problem, std::span<const std::int64_t> cells);

// Magic, version, the arrays, checksum; little-endian.
std::vector<std::uint8_t> save(const Part& part);
// Error(DELAM_ERROR_SNAPSHOT) for bytes that are damaged or of another version. What they say is checked by
// SoundPart.
Part load_part(std::span<const std::uint8_t> bytes);

// A part whose numbers are all in their ranges, over a mesh of its own.
class SoundPart {
public:
    // Error(DELAM_ERROR_SNAPSHOT) if a part says what no problem can.
    explicit SoundPart(const Part& part);

    const Mesh& mesh() const { return mesh_; }
    // Over the DOFs dimension*i + component of the part's nodes i. Cells are added in the order of the part, so that a
    // part with all cells of a body has the bits of Problem::body_stiffness().
    SparseMatrix stiffness(const Poll& poll = {}) const;
    std::int64_t entries() const;  // of the stiffness

    // Return the fields at the centres of the cells, in the order of the part (centre_stress, centre_rotation).
    // displacement: [nodes of the part][dimension]; strain: eigenstrains by body of the part, or none at all.
    std::vector<double> stress(std::span<const double> displacement, std::span<const Strain> strain) const;
    std::vector<double> rotation(std::span<const double> displacement) const;

private:
    void add_cells(const Part& part);
    // Rows of cells of mesh_, in the order of the part.
    std::vector<double> in_order(const std::vector<double>& of_mesh) const;

    Mesh mesh_;
    std::vector<std::int64_t> nodes_;  // of mesh_: all
    std::vector<std::int64_t> cells_;  // of mesh_, in the order of the part
    std::vector<BodyModel> models_;    // by body index of mesh_
};

}  // namespace delam
