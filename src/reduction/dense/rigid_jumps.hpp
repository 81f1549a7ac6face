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

// The motions in which parts float once their interfaces have separated: none if the supports hold every part by
// themselves.
class RigidMotions {
public:
    explicit RigidMotions(const Problem& problem);
    ~RigidMotions();
    RigidMotions(RigidMotions&&) noexcept;
    // Orthonormal columns, [jump rows][motions].
    const DenseMatrix& jumps() const { return jumps_; }
    // [mesh DOFs] of a combination of the motions.
    std::vector<double> displacement(std::span<const double> combination) const;

private:
    struct Piece;
    class Motions;
    struct Impl;
    std::unique_ptr<Impl> impl_;
    DenseMatrix jumps_;
};

// Their jumps alone.
DenseMatrix rigid_jumps(const Problem& problem);

// Combinations of the columns of z (of unit length over rows that include these) that vanish on all active rows, and
// their orthogonal complement: [columns of z][combinations].
struct Combinations {
    DenseMatrix free;
    DenseMatrix held;
};
Combinations split_motions(const DenseMatrix& z, std::span<const std::uint8_t> active);

}  // namespace delam
