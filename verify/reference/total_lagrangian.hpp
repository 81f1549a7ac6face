// SPDX-License-Identifier: BSD-3-Clause
// Elastic solids with large displacements, total Lagrangian: the material of St. Venant and Kirchhoff in Green's
// strain, cells of 8 nodes in the plane (plane strain) and of 20 in space, Newton's method. It shares nothing with the
// frames that the library turns with its cells, and needs no interface: faces are tied node by node, or touch by a
// penalty. (J. Bonet, R. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2008, chapters 8 and 9.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace reference {

class TotalLagrangian {
public:
    // nodes: [nodes][dimension]; cells: boxes along the axes, whose nodes are corners and middles of edges in any
    // order.
    TotalLagrangian(int dimension, std::vector<double> nodes, std::vector<std::vector<std::int64_t>> cells,
                    double young, double poisson);

    // Lets a node move as another one.
    void tie(std::int64_t node, std::int64_t to);
    void prescribe(std::int64_t node, int component, double value);
    // Faces in the plane that touch without friction: nodes of the lower one from left to right, and nodes above, which
    // slide along it.
    void touch(std::vector<std::int64_t> face, std::vector<std::int64_t> above) {
        face_ = std::move(face);
        above_ = std::move(above);
    }

    struct Result {
        double energy = 0.0;               // F L
        double conjugate = 0.0;            // work of the reactions along what is prescribed, F L
        double rotation = 0.0;             // the largest at a point of integration, rad
        std::vector<double> displacement;  // [nodes][dimension]
    };
    // Takes what is prescribed in so many equal steps. Throws Failure where Newton's method does not converge.
    Result solve(int steps);

private:
    struct Point {
        std::vector<double> slope;  // [nodes][dimension] of the shape functions
        double weight;
    };
    struct System;
    std::vector<Point> points_of(const std::vector<std::int64_t>& cell) const;
    void add_cell(std::size_t cell, System& system) const;
    void add_contact(System& system) const;
    bool iterate(double share, double before);

    std::size_t dim_;
    std::vector<double> nodes_;
    std::vector<std::vector<std::int64_t>> cells_;
    double lame_, shear_;
    std::vector<std::vector<Point>> points_;    // [cells]
    std::vector<std::int64_t> master_;          // [nodes]
    std::map<std::size_t, double> prescribed_;  // of a DOF of a master
    std::vector<std::int64_t> face_, above_;
    std::vector<double> u_;
};

}  // namespace reference
