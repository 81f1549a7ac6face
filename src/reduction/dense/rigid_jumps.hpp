// SPDX-License-Identifier: BSD-3-Clause
// Jumps without strain: the effect on the interfaces of the rigid motions that the supports leave free.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"
#include "scene/problem.hpp"

namespace delam {

// Work of the dead forces, at factor 1, along rigid motions. Other loads do no work there: prescribed displacements and
// eigenstrains balance within each part.
struct DeadWork {
    DenseMatrix work;        // [patterns][motions]
    DenseMatrix magnitudes;  // the same if all forces acted along the largest displacement of the motion
    // True if a combination of the motions gets no work, but for rounding. added, magnitude: of other forces.
    bool balances(std::span<const double> theta, std::span<const double> combination, double added = 0.0,
                  double magnitude = 0.0) const;
};

// The motions in which parts float once their interfaces have separated: none if the supports hold every part by
// themselves.
class RigidMotions {
public:
    explicit RigidMotions(const Problem& problem);
    ~RigidMotions();
    RigidMotions(RigidMotions&&) noexcept;
    RigidMotions& operator=(RigidMotions&&) noexcept;
    // Orthonormal columns, [jump rows][motions].
    const DenseMatrix& jumps() const { return jumps_; }
    // [mesh DOFs] of a combination of the motions.
    std::vector<double> displacement(std::span<const double> combination) const;
    // Translations of a piece of rigid_pieces(), then its rotations, as displacements at its edge, in a combination of
    // the motions.
    std::vector<double> of_piece(std::size_t piece, std::span<const double> combination) const;
    // True if no motion moves this piece.
    bool holds(std::size_t piece) const;
    // Returns the work of the loads along the motions.
    const DeadWork& dead_work() const { return dead_; }

private:
    struct Piece;
    class Motions;
    struct Impl;
    std::unique_ptr<Impl> impl_;
    DenseMatrix jumps_;
    DeadWork dead_;
};

// Combinations of the columns of z (of unit length over rows that include these) that vanish on all active rows, and
// their orthogonal complement: [columns of z][combinations].
struct Combinations {
    DenseMatrix free;
    DenseMatrix held;
};
Combinations split_motions(const DenseMatrix& z, std::span<const std::uint8_t> active);

}  // namespace delam
