// SPDX-License-Identifier: BSD-3-Clause
// Sparse linear equations, each solved for one of its variables:  sum a_j x_j = b . theta   ->   x_p = sum c_j x_j + d
// . theta.
//
// Rows come one after another; a new one is first reduced by those that are solved. A row that depends on them reduces
// to nothing. As long as rows are short and do not hang together much, thousands of them cost little more than reading
// them.
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
        std::vector<double> right;  // b, one entry a parameter
    };
    struct Solution {
        std::vector<std::pair<std::int64_t, double>> terms;
        std::vector<double> right;
    };

    // Replaces variables that are solved by what they are solved to. Terms below 1e-10 of the largest coefficient that
    // took part are what is left of a cancellation and go. Returns the largest magnitude that took part on the right,
    // to measure what is left there by.
    double reduce(Row& row) const;
    // Solves a reduced row for one of its variables.
    void solve(const Row& row, std::int64_t pivot);
    // After the last row: all solutions in variables that are not solved themselves.
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
