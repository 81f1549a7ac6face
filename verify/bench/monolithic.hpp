// SPDX-License-Identifier: BSD-3-Clause
// The whole structure in one sparse matrix, from what the public API exports: bodies, springs, supports.
//
// The unknowns of a node pair are the displacement of its node on face a and the local jump, u_b = u_a + frame^T jump.
// A spring is then one diagonal entry, and a closed contact is one unknown fixed at zero, whose row and column become
// those of the identity. Neither changes the pattern, so one symbolic analysis serves every adhesion and every contact
// set. Prescribed displacements are eliminated: with v the free unknowns and theta the load factors,
//     u = T v + C theta,   K0 = T^T K T,   lift = T^T K C,   dead = T^T F.
#pragma once

#include "exported.hpp"
#include "sparse_factor.hpp"

namespace bench {

class Monolithic {
public:
    // Throws Failure for nodes in several pairs and degrees of freedom in several constraints.
    explicit Monolithic(const reference::Scene& scene);

    std::size_t unknowns() const { return base_.size(); }
    std::size_t jumps() const { return jump_.size(); }
    std::size_t patterns() const { return patterns_; }
    const std::vector<double>& weight() const { return weight_; }  // [pairs]

    // The matrix with springs [jumps], where the jumps in `held` are replaced by the identity; the pattern never
    // changes.
    const UpperMatrix& assemble(const std::vector<double>& spring, const std::vector<std::uint8_t>& held);
    const UpperMatrix& matrix() const { return current_; }

    // Right-hand side at load factors theta; rows of held jumps are zero.
    void right_side(const std::vector<double>& theta, const std::vector<std::uint8_t>& held,
                    std::vector<double>& b) const;
    double jump(std::size_t row, const std::vector<double>& v) const { return v[static_cast<std::size_t>(jump_[row])]; }
    // Force of a held pair, tension positive: minus the out-of-balance force of bodies and loads.
    double held_force(std::size_t row, const std::vector<double>& v, const std::vector<double>& theta) const;

    // dE/dtheta of each pattern, and f . u. Both are valid at solutions only.
    double work_of_dead_loads(const std::vector<double>& v, const std::vector<double>& theta) const;
    std::vector<double> conjugate(const std::vector<double>& v, const std::vector<double>& theta) const;

private:
    struct Crossing {  // an entry in the row or column of a jump, and its other unknown
        std::int32_t at;
        std::int32_t other;
    };
    UpperMatrix base_;     // K0
    UpperMatrix current_;  // K0 with springs and held jumps
    std::size_t patterns_ = 0;
    std::vector<std::int32_t> jump_;  // [jumps] unknown of each row
    std::vector<double> weight_;
    std::vector<std::int32_t> crossing_start_;  // [jumps+1], off-diagonal entries
    std::vector<Crossing> crossing_;
    std::vector<std::vector<double>> lift_, dead_;  // [patterns][unknowns]
    std::vector<double> a_;                         // C^T K C, [patterns][patterns]
    std::vector<double> potential_;                 // F^T C
};

}  // namespace bench
