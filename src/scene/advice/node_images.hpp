// SPDX-License-Identifier: BSD-3-Clause
// Reflections and half-turns that map a mesh onto itself, and what becomes of its nodes. Cells tell nodes at one place
// apart: those of the faces of an interface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/points.hpp"

namespace delam {

// x -> centre + R (x - centre), with R^2 = 1 and R = R^T.
class Involution {
public:
    // The reflection in the plane (2D: line) normal to a unit vector; turn: the half-turn about it.
    Involution(const Point& centre, const Point& axis, bool turn);
    const std::array<double, 9>& matrix() const { return matrix_; }  // R, row-major
    Point turned(const Point& direction) const;
    Point moved(const Point& place) const;
    // "the reflection in the line through (0, 1) normal to (1, 0)"
    std::string name(int dimension) const;

private:
    Point centre_, axis_;
    bool turn_;
    std::array<double, 9> matrix_;
};

// Returns those that map the places of the nodes of cells onto themselves if any do: about the mean of the places,
// along the principal axes of the places, along the coordinates and halfway between two of these.
std::vector<Involution> candidates(const Mesh& mesh);

struct NodeImages {
    std::vector<std::int64_t> node;  // [nodes], -1: of no cell
    std::vector<std::int64_t> cell;  // [cells]
};
// Images of nodes and cells. None: the mesh differs from its image. Places are compared to `tolerance`, L.
std::optional<NodeImages> images(const Mesh& mesh, const Involution& involution, double tolerance);

// Places by their position along one direction that no mesh has.
class PlaceIndex {
public:
    explicit PlaceIndex(std::vector<Point> places);
    // Numbers of the places at most `tolerance` away.
    std::vector<std::int64_t> at(const Point& place, double tolerance) const;

private:
    std::vector<Point> places_;
    std::vector<std::pair<double, std::int64_t>> along_;  // ascending
};

}  // namespace delam
