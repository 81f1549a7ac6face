// SPDX-License-Identifier: BSD-3-Clause
// Points in space and computations with them; in 2D the third component is 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/mesh.hpp"

namespace delam {

inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) { return std::hypot(a[0], a[1], a[2]); }

inline Point position(const Mesh& mesh, std::int64_t node) {
    Point p{};
    std::copy(mesh.node(node).begin(), mesh.node(node).end(), p.begin());
    return p;
}

// Returns the coordinates as text for messages.
inline std::string place(int dimension, const Point& p) {
    return dimension == 2 ? text("(", p[0], ", ", p[1], ")") : text("(", p[0], ", ", p[1], ", ", p[2], ")");
}
inline std::string place(const Mesh& mesh, std::int64_t node) { return place(mesh.dimension(), position(mesh, node)); }

}  // namespace delam
