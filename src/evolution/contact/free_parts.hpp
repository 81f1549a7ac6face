// SPDX-License-Identifier: BSD-3-Clause
// Parts that nothing holds: neither adhesion, nor supports, nor contact that presses. Their rigid motions have no
// energy. A free part keeps the place that it had: of all motions that avoid penetration, the one of least change,
// int |u - u_before|^2 dV over the parts, whatever units or meshes are.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reduction/dense/rigid_jumps.hpp"
#include "scene/problem.hpp"

namespace delam {

struct PlaceChanges {
    std::vector<std::vector<double>> moved;  // [combinations][mesh DOFs]
    DenseMatrix gram;                        // int u_i.u_j dV
};

class FreeParts {
public:
    explicit FreeParts(const Problem& problem);

    // False: the supports hold every part by themselves.
    bool any() const { return motions_.jumps().columns > 0; }
    const RigidMotions& motions() const { return motions_; }
    // True if pairs that hold in all directions join all pieces that could move to one, or to what supports hold.
    // False: only free() can tell. active: [jump rows].
    bool connected(std::span<const std::uint8_t> active) const;
    // Combinations of the motions that no active row resists, [motions][combinations]. active: [jump rows].
    DenseMatrix free(std::span<const std::uint8_t> active) const;
    // Tells how bodies move in these combinations, [bodies][2D: x, y, turning; 3D: x, y, z, turning about x, y, z], 1
    // or 0: translations without a rotation, and rotations about whatever point.
    std::vector<std::uint8_t> moves(const DenseMatrix& free) const;
    // The bodies that move, and how, for messages; moves: as above.
    std::string described(std::span<const std::uint8_t> moves) const;
    const std::string& pattern(std::size_t p) const { return patterns_[p]; }
    // Displacements of combinations of the motions, and the products of each two of them.
    PlaceChanges changes(const DenseMatrix& free) const;
    // int u.v dV over the parts that move.
    double product(std::span<const double> u, std::span<const double> v) const;

private:
    std::int64_t dimension_;
    RigidMotions motions_;
    std::vector<std::int32_t> body_;                      // [pieces]
    std::vector<std::int32_t> label_;                     // [bodies]
    std::vector<std::string> patterns_;                   // names
    std::vector<std::pair<std::int64_t, double>> share_;  // of the volume: nodes of the parts that move
    // Sides of each pair: places of pieces, 0 for all that supports hold, -1 for a node of several pieces or of none.
    std::vector<std::pair<std::int64_t, std::int64_t>> side_;
    std::vector<double> place_;  // [pairs][dimension]
    std::vector<double> size_;   // [places] of the pieces, L
    std::int64_t places_ = 1;
};

}  // namespace delam
