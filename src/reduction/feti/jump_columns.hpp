// SPDX-License-Identifier: BSD-3-Clause
// Response of the jumps to a unit rest jump of one row, at base springs that never change, so that each row costs one
// solve in the life of the operator.
//
// At the base every row of a law has its full stiffness, rows that only touch have that of the bodies, bonded rows are
// held: nothing floats. With S the bodies' stiffness over the rows that have a spring and s their springs, the forces
// that unit rest jumps cause are Lambda = s - s (S + s)^-1 s. Kept is, scaled,
//   W = s^-1/2 Lambda s^-1/2   and   V = I - W = s^1/2 (S + s)^-1 s^1/2,
// W from the forces where the spring is stiffer than the bodies, V from the bodies' jumps where it is softer: neither
// is then a small difference of large numbers. Over any set A of rows, with the others minimised out at the base,
//   S_A = s^1/2 V_A^-1 W_A s^1/2 = s^1/2 (W_A + W_A V_A^-1 W_A) s^1/2.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/dense/dense_energy.hpp"
#include "reduction/feti/dense_dual.hpp"
#include "reduction/feti/dual/dual_loads.hpp"
#include "reduction/feti/dual/dual_operator.hpp"

namespace delam {

class JumpColumns {
public:
    JumpColumns(const Problem& problem, const std::vector<Subdomain>& subdomains, DualOperator& dual,
                const DualLoads& loads, Monitor& monitor);

    const Springs& base() const { return base_; }
    // Rows that have a spring of their own: neither bonded nor prescribed.
    bool has_spring(std::size_t row) const { return root_[row] > 0.0; }
    // Columns are found in groups of consecutive rows, always the same, so that their bits do not depend on when.
    std::size_t groups() const { return column_.size(); }
    std::size_t group_of(std::size_t row) const { return row / width_; }
    std::size_t group_rows() const { return width_; }
    // Bytes of the columns of so many groups.
    double bytes(std::size_t groups) const;
    // The energy of the jumps of these rows, all of it of rows that have springs, with the others at the base's
    // springs. Their groups' columns are found where they are not known. False: they cannot be found well enough, or
    // the rows depend on each other.
    bool energy(std::span<const std::int64_t> rows, DenseEnergy& out);

private:
    bool find(std::size_t group);
    bool find_loads();
    // Forces and jumps at the base: lambda out of `right`, and what is kept of it, [jump rows][columns].
    bool solve(const DenseMatrix& right, const DenseMatrix& resultant, const DenseMatrix& rest, DenseMatrix& kept);

    const Problem& problem_;
    const std::vector<Subdomain>& subdomains_;
    DualOperator& dual_;
    const DualLoads& loads_;
    Monitor& monitor_;
    std::size_t width_;
    Springs base_;
    std::vector<double> root_;         // [jump rows] sqrt(s), 0: has none
    std::vector<std::uint8_t> soft_;   // [jump rows] V is kept, else W
    std::vector<DenseMatrix> column_;  // [groups] of the rows of a group, [jump rows][width]; empty: not known
    DenseMatrix load_;                 // s^1/2 j of the patterns at the base, [jump rows][patterns]
    bool loaded_ = false;
    std::unique_ptr<DenseDual> dense_;  // at the base, where rows are few: the first guess of every column
};

}  // namespace delam
