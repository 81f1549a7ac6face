// SPDX-License-Identifier: BSD-3-Clause
// All jump rows, j = N v + o, and the constraints on many variables, E v = d, in the variables v of a sparse system.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reduction/operator/body_system.hpp"
#include "reduction/operator/jump_row.hpp"

namespace delam {

class JumpRows {
public:
    // first: the variable of jump_variables.hpp with which those of the system begin; count: of these.
    JumpRows(const BodySystem& bodies, std::int64_t first, std::int64_t count);

    std::size_t size() const { return rows_.size(); }
    // Prescribed rows have no variable left; their offset is the jump.
    const JumpRow& operator[](std::size_t row) const { return rows_[row]; }
    std::vector<JumpRow>::const_iterator begin() const { return rows_.begin(); }
    std::vector<JumpRow>::const_iterator end() const { return rows_.end(); }
    std::span<const std::uint8_t> prescribed() const { return prescribed_; }
    // Returns the variable that this row is, -1: none; and the other way round.
    std::int64_t variable_of(std::size_t row) const { return plain_[row]; }
    std::int64_t row_of(std::int64_t variable) const { return row_of_[index(variable)]; }

    // Returns N x of a row.
    double value(std::size_t row, std::span<const double> x) const {
        double sum = 0.0;
        for (const auto& [i, n] : rows_[row].unknowns) sum += n * x[index(i)];
        return sum;
    }
    // Adds the force of a row to those on the variables.
    void add(std::size_t row, double factor, std::span<double> force) const {
        for (const auto& [i, n] : rows_[row].unknowns) force[index(i)] += n * factor;
    }
    // Returns o, [rows].
    std::vector<double> offsets(std::span<const double> theta) const;

    // E, independent. The first variable of each constraint occurs in no other.
    const std::vector<SparseVector>& equations() const { return equations_; }
    // d of a constraint, [patterns]
    const std::vector<double>& equation_right(std::size_t e) const { return equation_right_[e]; }
    std::size_t patterns() const { return patterns_; }

private:
    std::size_t patterns_;
    std::vector<JumpRow> rows_;
    std::vector<std::uint8_t> prescribed_;
    std::vector<std::int64_t> plain_;   // [rows]
    std::vector<std::int64_t> row_of_;  // [variables]
    std::vector<SparseVector> equations_;
    std::vector<std::vector<double>> equation_right_;  // [equations][patterns]
};

}  // namespace delam
