// SPDX-License-Identifier: BSD-3-Clause
// The pairs of an interface between which faces have slid. Points that were a pair and have slid by s along the faces
// lie on each other's faces where pairs were that were apart by s: the chord between them is perpendicular to the mean
// of the normals on the way.
#pragma once

#include <cstddef>
#include <vector>

#include "body/turned/turned_cell.hpp"
#include "mesh/mesh.hpp"

namespace delam {

class SlidePaths {
public:
    SlidePaths(const Mesh& mesh, const InterfaceGeometry& interface);

    // A pair on the way with its part in the mean, and the change of this part with the slide, 1/L.
    struct Part {
        std::size_t pair;
        double weight;
        Vector3 slope;
    };
    // Parts on either side, which add up to 1: points of the second side have slid by this vector against the first
    // side, in the geometry of the mesh. Without a slide they are the pair itself. They change continuously: those
    // around the way count less with their distance from it, up to the spacing of the pairs.
    struct Path {
        std::vector<Part> first, second;
    };
    Path along(std::size_t pair, const Vector3& slide) const;
    // Returns the distance to the nearest other pair, L.
    double spacing(std::size_t pair) const { return spacing_[pair]; }

private:
    std::vector<Part> parts(std::size_t pair, const Vector3& slide, double sign) const;

    std::vector<Vector3> place_;                        // [pairs]
    std::vector<double> weight_, spacing_;              // [pairs]
    std::vector<std::vector<std::size_t>> neighbours_;  // [pairs] that share a face with it
};

}  // namespace delam
