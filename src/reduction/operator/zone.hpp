// SPDX-License-Identifier: BSD-3-Clause
// A system of the rows that change, with everything else at its minimum. It has unknowns x of an energy, rows j = N x +
// O theta with springs (or, for Newton's method, coupled 2x2 or 3x3 tangents), and rows that are held at zero.
//
//   minimise  1/2 x^T S x - theta^T L^T x + 1/2 sum_rq j_r C_rq j_q - sum_r h_r j_r      subject to j_r = 0 on held
//   rows
//
// Minimisers that change springs and contact work on it. It is dense and small (dense_zone.hpp), or all bodies, sparse
// (iterated/iterated_zone.hpp), or the bodies about a process zone with the rest at rest (iterated/local_zone.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"

namespace delam {

struct Response;

// Errors that an iteration has left in jumps (L) and forces (F) of rows; 0: no more than rounding.
struct SolveError {
    double jump = 0.0;
    double force = 0.0;
};

class Zone {
public:
    virtual ~Zone() = default;

    struct Coupling {
        std::int64_t row, column;  // of the zone; both (r, q) and (q, r) are given
        double value;
    };
    // Begins a model of the forces about an iterate of Newton's method. The solves up to the next model differ by
    // contact alone, and may leave a part of the residual with which the first of them starts. Before the first model,
    // solves are as exact as their tolerance.
    virtual void begin_model() {}
    // Only the energy of the following solves is needed: a solution may lie above the least energy by this amount, F L;
    // 0: by as little as the tolerance allows. Ends a model.
    virtual void ask_for_energies(double /*allowed*/) {}
    // False: not positive definite.
    virtual bool factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) = 0;

    struct Solution {
        std::vector<double> unknowns;
        std::vector<double>
            multiplier;         // [rows] forces of held rows, at least of those that are no unknown of their own
        bool balanced = true;   // false: a free motion carries a load; the rest is then not set
        bool definite = true;   // false: only the solution has shown that there is no minimum; the rest is not set
        bool converged = true;  // false: an iterative solve did not reach its tolerance; the rest is not set
        std::int64_t iterations = 0;  // of a Krylov method
        double left = 0.0;  // of the residual with which the model began, as a part of it; 0: what the tolerance allows
        SolveError error;
        double energy_error = 0.0;  // above the least energy by about this, F L; 0: no more than the tolerance allows
    };
    // row_force: h, [rows] or empty.
    virtual Solution solve(std::span<const double> theta, std::span<const double> row_force) = 0;

    // A force on one row, F.
    struct RowForce {
        std::int64_t row;
        double value;
    };
    // True if flexibility() has an answer.
    virtual bool offers_flexibility() const { return false; }
    // Returns, for the last factor(), the work of each set of forces on the jumps that each other one causes,
    // [set][set]. Null: it would take a solve of all bodies for each of them.
    virtual std::optional<DenseMatrix> flexibility(std::span<const std::vector<RowForce>> /*forces*/) { return {}; }

    // The operator's jump row of each row, ascending.
    virtual const std::vector<std::int64_t>& jump_rows() const = 0;
    // Unknowns at the jumps of a response of the operator, from which an iteration then starts; and the other way
    // round: jumps apart, what such a response keeps of them for the next solve.
    virtual std::vector<double> unknowns_at(std::span<const double> theta, const Response& response) = 0;
    virtual void keep(std::span<const double> unknowns, Response& response) const = 0;
    // j of all rows.
    virtual std::vector<double> jumps(std::span<const double> theta, std::span<const double> unknowns) const = 0;
    // Forces on all rows: those of rows that are not held are given, and this adds those of held rows.
    virtual void complete_forces(std::span<const double> theta, const Solution& solution,
                                 std::span<double> row_force) const = 0;
    // 1/2 x^T S x - theta^T L^T x, up to what depends on theta alone.
    virtual double energy_of(std::span<const double> theta, std::span<const double> unknowns) = 0;
    // 1/2 d^T S d, by which the energy changes where rows move by d on their own from a minimum of energy and springs;
    // infinite: it is not known, or these rows cannot move on their own.
    virtual double energy_of_moving(std::span<const std::size_t> /*rows*/, std::span<const double> /*d*/) const {
        return std::numeric_limits<double>::infinity();
    }
    // Returns the jumps of rigid motions that nothing outside the zone resists, [rows][motions]; null: there are none.
    virtual const DenseMatrix* motions() const { return nullptr; }
    // Adds a combination of these motions to the unknowns.
    virtual void move(std::span<const double> /*combination*/, std::span<double> /*unknowns*/) const {}
    // Returns the rounding of such energies: differences below this part of them are rounding.
    virtual double energy_rounding() const = 0;
};

}  // namespace delam
