// SPDX-License-Identifier: BSD-3-Clause
// Sparse linear equations, each solved for one of its variables:  sum a_j x_j = b . theta   ->   x_p = sum c_j x_j + d
// . theta.
//
// Rows arrive one after another, and each new row is first reduced by the solved ones; a dependent row reduces to
// nothing. Thousands of rows cost little more than reading them, as long as they are short and loosely coupled.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace delam {

class SparseElimination {
public:
    struct Row {
        std::map<std::int64_t, double> terms;
        std::vector<double> right;  // b, one entry per parameter
    };
    struct Solution {
        std::vector<std::pair<std::int64_t, double>> terms;
        std::vector<double> right;
    };

    // Replaces solved variables by their solutions. Drops terms below 1e-10 of the largest coefficient involved, which
    // are left over from cancellation. Returns the largest magnitude that occurred on the right-hand side, as the scale
    // for what is left there.
    double reduce(Row& row) const;
    // Solves a reduced row for one of its variables.
    void solve(const Row& row, std::int64_t pivot);
    // Expresses all solutions in free variables; to be called after the last row.
    void close();

    bool solved(std::int64_t variable) const { return place_.contains(variable); }
    // Null: the variable is free.
    const Solution* find(std::int64_t variable) const {
        const auto found = place_.find(variable);
        return found == place_.end() ? nullptr : &solution_[found->second];
    }

private:
    std::unordered_map<std::int64_t, std::size_t> place_;
    std::vector<Solution> solution_;
};

}  // namespace delam
