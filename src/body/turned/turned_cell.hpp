// SPDX-License-Identifier: BSD-3-Clause
// A cell with small strains and any rotation: its stiffness S acts in a frame R that turns with its nodes.
//
// With reference places Z and present places x of the n nodes, both from their means, A = 1/n sum x Z^T = R U (polar
// decomposition), y = R^T x, d = y - Z, and the energy is 1/2 d^T S d. A motion v = R^T dx of the nodes turns the frame
// by w = J^-1 1/n sum Z x v, J = tr U I - U, in the axes of the frame, so that dd = v - w x y. Force and tangent are
// the exact first and second derivatives: with q = S d, m = sum y x q, a = J^-1 m
//
//     f = R (q - 1/n a x Z),    df = R (dq - 1/n da x Z + w x f).
//
// In the plane all vectors lie in it, and the frame turns about the normal. (C. Felippa, B. Haugen, Comput. Methods
// Appl. Mech. Eng. 194 (2005) 2285-2335, section 4, without the terms that they drop.)
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/points.hpp"

namespace delam {

using Vector3 = Point;
using Matrix3 = std::array<double, 9>;  // row-major

// The factors of A = R U with a rotation R and a positive definite U. False: A turns inside out.
bool polar_decomposition(const Matrix3& a, Matrix3& rotation, Matrix3& stretch);
// (tr U I - U)^-1, which turns the skew part of R^T dA into the rotation of R.
Matrix3 spin_inverse(const Matrix3& stretch);

Vector3 times(const Matrix3& m, const Vector3& v);
Vector3 transposed_times(const Matrix3& m, const Vector3& v);
Matrix3 transposed(const Matrix3& m);
Matrix3 transposed_times(const Matrix3& a, const Matrix3& b);
// Turns a symmetric tensor in place, R s R^T. Its entries are xx, yy, xy or xx, yy, zz, xy in the plane, xx, yy, zz,
// xy, yz, zx in space.
void turn_tensor(const Matrix3& rotation, std::span<double> s);

class TurnedCell {
public:
    // coordinates: [nodes][dimension]; stiffness: S, [size][size] row-major. Both are copied.
    TurnedCell(std::size_t dimension, std::span<const double> coordinates, std::span<const double> stiffness);

    // Moves the nodes to the displacements [nodes][dimension]. False: the cell is inside out, and the rest is not set.
    bool move(std::span<const double> displacement);
    const Matrix3& rotation() const { return rotation_; }
    // Returns the root mean square of the distances of its nodes from their middle, without displacements, L.
    double radius() const { return std::sqrt(size_); }
    std::span<const double> stiffness() const { return stiffness_; }
    double energy() const;
    // Adds the force on the nodes, [nodes][dimension]: that of S d, or that of other forces in the frame.
    void add_force(std::span<double> force) const { add_force(force_, force); }
    void add_force_of(const std::vector<Vector3>& pull, std::span<double> force) const;
    // Returns the work of forces in the frame along d.
    double work(const std::vector<Vector3>& pull) const;
    enum class Stresses { count, left_out };
    // Sets the tangent, [size][size] row-major, exactly symmetric. Without the stresses, whose forces turn, it is
    // semi-definite.
    void tangent(std::span<double> matrix, Stresses stresses = Stresses::count) const {
        tangent(matrix, stresses, pull_);
    }
    // The same with other stresses: the forces S d in the frame.
    void tangent(std::span<double> matrix, Stresses stresses, const std::vector<Vector3>& pull) const;
    // S d, and its change with displacements from here [nodes][dimension], to first order.
    const std::vector<Vector3>& pull() const { return pull_; }
    std::vector<Vector3> pull_along(std::span<const double> displacement) const;
    // Adds to the forces on the nodes those of a couple (global axes) that turns the frame.
    void add_couple(const Vector3& couple, std::span<double> force) const;
    // d, [nodes][dimension]: displacements in the frame.
    std::vector<double> local_displacement() const;

private:
    std::size_t nodes() const { return reference_.size(); }
    // Adds f, turned out of the frame.
    void add_force(const std::vector<Vector3>& of_frame, std::span<double> force) const;
    // a and f of these forces.
    void balance(const std::vector<Vector3>& pull, Vector3& couple, std::vector<Vector3>& force) const;
    void stiffness_times(std::span<const Vector3> d, std::vector<Vector3>& q) const;
    // Parts of the tangent.
    void add_stresses(std::span<const Vector3> turn, const std::vector<Vector3>& pull, std::span<double> matrix) const;
    void turn_blocks(std::span<double> matrix) const;

    std::size_t dimension_;
    std::vector<double> coordinates_, stiffness_;
    std::vector<Vector3> reference_;  // Z
    double size_ = 0.0;               // 1/n sum |Z|^2

    Matrix3 rotation_{}, stretch_{}, inverse_{};  // R, U, J^-1
    std::vector<Vector3> place_, strain_, pull_;  // y, d, q
    std::vector<Vector3> force_;                  // f in the frame
    Vector3 couple_{};                            // a
};

}  // namespace delam
