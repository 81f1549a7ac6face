// SPDX-License-Identifier: BSD-3-Clause
// All bodies of a mesh with small strains and any rotation, each cell in a frame of its own (turned_cell.hpp): energy,
// forces and tangent at present displacements.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/averages.hpp"
#include "body/eigenstrain.hpp"
#include "body/model.hpp"
#include "body/turned/turned_cell.hpp"
#include "linalg/sparse/sparse.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// Returns all cells as ones whose frames turn with their nodes, [cells]. models: by body index.
std::vector<TurnedCell> turned_cells(const Mesh& mesh, std::span<const BodyModel> models);

class TurnedBodies {
public:
    // models: by body index. `mesh` must outlive it.
    TurnedBodies(const Mesh& mesh, std::span<const BodyModel> models);

    // Moves all nodes, [mesh DOFs]. Error(DELAM_LIMIT) names a cell that is inside out.
    void move(std::span<const double> displacement);
    double energy() const;
    // Returns the forces of the cells on their nodes, [mesh DOFs].
    std::vector<double> force() const;
    // The forces S d of the cells in their frames, which are their stresses; and adds to them their change with
    // displacements of the nodes from here, to first order.
    using Pulls = std::vector<std::vector<Vector3>>;  // [cells][nodes]; of a cell without any: empty
    Pulls pulls() const;
    // Returns the forces on the nodes [mesh DOFs] of such forces in the frames, and their work along d.
    std::vector<double> force_of(const Pulls& pulls) const;
    double work(const Pulls& pulls) const;
    void add_pulls_along(std::span<const double> displacement, Pulls& pulls) const;
    // Sets the tangent of a body over its nodes in ascending order, both triangles, under other stresses. k: empty, or
    // set by this before.
    void set_tangent(std::int32_t body, TurnedCell::Stresses stresses, const Pulls& pulls, SparseMatrix& k) const;
    // Returns the frame of a cell.
    const Matrix3& rotation(std::int64_t cell) const { return cells_[index(cell)].rotation(); }
    double radius(std::int64_t cell) const { return cells_[index(cell)].radius(); }
    // Returns the largest entry of the cells' stiffnesses, F/L.
    double largest_stiffness() const { return largest_stiffness_; }
    // Adds to the forces [mesh DOFs] those of a couple that turns the frame of a cell.
    void add_couple(std::int64_t cell, const Vector3& couple, std::span<double> force) const;
    // Returns the displacements of a cell's nodes in its frame, [nodes][dimension].
    std::vector<double> local_displacement(std::int64_t cell) const { return cells_[index(cell)].local_displacement(); }
    // Returns the rotations of the cells, rad: angles [cells], in space vectors [cells][3] along their axes.
    std::vector<double> rotation_vectors() const;
    // Returns the stresses at the centres of the cells, in global axes (body/assembly.hpp). models, eigenstrains: by
    // body index; none: no body has any.
    std::vector<double> centre_stress(std::span<const BodyModel> models, std::span<const Strain> eigenstrains) const;

    // Returns the means of strain and stress over a body (-1: all), in global axes (body/averages.hpp).
    VolumeAverage average(std::span<const BodyModel> models, std::span<const Strain> eigenstrains,
                          std::int32_t body) const;

private:
    void gather(std::int64_t cell, std::span<const double> of_mesh, std::vector<double>& of_cell) const;
    void scatter(std::int64_t cell, std::span<const double> of_cell, std::span<double> of_mesh) const;

    const Mesh& mesh_;
    std::vector<TurnedCell> cells_;
    double largest_stiffness_ = 0.0;
    std::vector<SparseMatrix> pattern_;           // [bodies] of the tangent
    std::vector<std::vector<std::int64_t>> own_;  // [bodies] cells
    std::vector<std::int64_t> place_;             // [mesh nodes] among the nodes of their body
};

}  // namespace delam
