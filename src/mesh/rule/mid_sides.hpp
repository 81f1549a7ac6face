// SPDX-License-Identifier: BSD-3-Clause
// Pairs of quadratic faces without a node inside (of tet10, hex20, wedge15).
//
// A rule with the nodes as points that gives a uniform traction its nodal forces has the integrals of the shape
// functions N_k as weights: zero at the corners of a 6-node triangle, negative at those of an 8-node face. But a law
// needs positive ones. The functions
//
//   M_c = N_c + a sum N_m  (over the two sides at corner c),   M_m = (1 - 2a) N_m,   a = s / (1 + 2s)
//
// span the same space, sum to 1 and have positive integrals w for s large enough (A. Popp, B. Wohlmuth, M. Gee, W.
// Wall, SIAM J. Sci. Comput. 34, 2012). Their coefficients are u_c at the corners and
//
//   u_m + s (2 u_m - u_c - u_d)    at the mid-side node m between the corners c and d,
//
// so that  sum w_k [u]_k = int [u]  for all displacements of the face if pairs compare these values. They are those at
// the nodes where the displacement is linear along the side. If none of these jumps is negative, no node penetrates.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interface_geometry.hpp"
#include "mesh/mesh.hpp"
#include "mesh/rule/nodal_rule.hpp"

namespace delam {

// A pair at a mid-side node between corners c and d, with the s above.
struct MidSide {
    std::int64_t pair;
    std::array<std::int64_t, 2> corner;  // pairs; -1: both sides have the same node there
    std::array<std::int64_t, 2> node;    // of the face at these corners
    double share;
};

// An interface whose pairs have nodes of faces, and which of these are to have tied nodes instead.
struct NewInterface {
    InterfaceGeometry geometry;
    std::vector<MidSide> middle;
};

// The sides of the faces of an interface, with the smallest s that leaves all weights positive.
class MidSides {
public:
    explicit MidSides(std::size_t pairs) : side_(pairs, {-1, {-1, -1}, {-1, -1}, 0.0}) {}

    // A face by its nodes and their pairs, -1: both sides have the same node; corners: their number.
    void add(std::span<const std::int64_t> nodes, std::span<const std::int64_t> pairs, std::size_t corners);
    // Returns int M_k of a face, which is that of nodal_rule where no side needs an s.
    NodalRule rule(const Mesh& mesh, std::span<const std::int64_t> nodes, std::span<const std::int64_t> pairs,
                   std::size_t corners) const;
    // Doubles s at corner pairs whose weight is a small part of the area around them, and tells whether there were any.
    bool widen(std::span<const double> weight, std::span<const double> around);
    std::vector<MidSide> list() const;

private:
    std::vector<MidSide> side_;  // [pairs] share 0: no mid-side node of such a face
    int widened_ = 0;
};

// Gives the pairs at mid-side nodes tied nodes, which have the values above, and appends the interface with these and
// the given ones; returns its index. A tied node has the original of the node for which it stands. places: of the given
// tied nodes.
std::int64_t append_interface(Mesh& mesh, NewInterface interface, std::vector<NodeTie> ties = {},
                              std::vector<double> places = {});
// Appends all of them or, on an error, none.
void append_interfaces(Mesh& mesh, std::vector<NewInterface> interfaces);

// Returns the node of a face for which a tied node stands in its pair; any other node itself.
std::int64_t node_of_pair(const Mesh& mesh, std::int64_t node);

}  // namespace delam
