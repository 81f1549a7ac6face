// SPDX-License-Identifier: BSD-3-Clause
// Holds what the generators of periodic cells share: the Gmsh model of a cell [0, size] in each direction, and the
// resulting mesh. In the model's unit of length, parts are about 1, since OpenCASCADE compares lengths with 1e-7.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesh/cell_shape.hpp"
#include "mesh/mesh_data.hpp"
#include "text/error.hpp"

namespace cli {

class GeneratorModel {
public:
    // lower: the corner of the cell, 0 along periodic axes.
    GeneratorModel(int dimension, const std::array<double, 3>& lower, const std::array<double, 3>& upper);

    // Makes the mesh of the upper border along an axis a copy of that of the lower one, for all entities of one
    // dimension less than the cell. Throws std::string if they do not correspond.
    void tie_borders(int axis) const;

    // Removes curves and points that bound nothing, which would otherwise be meshed.
    void drop_loose_parts() const;

    void name_body(const std::vector<int>& entities, const std::string& name) const;
    // left and right (x); bottom and top (y in 2D, z in 3D); front and back (y in 3D); corners; origin, the corner with
    // the smallest coordinates.
    void name_borders() const;

    // Labels as in `names`, which contains all bodies.
    static void order_bodies(MeshData& mesh, const std::vector<std::string>& names);

    // Area or volume of the bodies, by label, including curved sides.
    static std::vector<double> measures(const MeshData& mesh);

private:
    [[nodiscard]] std::vector<int> on_plane(int dimension, int axis, double at) const;

    int dimension_;
    std::array<double, 3> lower_;
    std::array<double, 3> upper_;
};

// Refuses cells that are inverted or flat: relative to a regular cell whose edges are as long as the longest, their
// measure is below `flattest`. The message gives the position of the cell. place: of the parameter to change.
void require_sound_cells(const MeshData& mesh, double flattest, const Place& place);

// The place of a key of the table.
inline Place key_of(const Place& table, const std::string& key) {
    return {table.file, table.path.empty() ? key : table.path + "." + key, table.line};
}

// Throws SceneFailure at the key unless a condition on its value holds.
inline void require(bool holds, const Place& table, const std::string& key, const std::string& text) {
    if (!holds) throw SceneFailure(key_of(table, key), text);
}

// The shape with this number among the named ones; the failure is that of the key `cell`.
const CellShape& required_shape(std::int32_t type, const std::vector<std::string>& allowed, const Place& table);

}  // namespace cli
