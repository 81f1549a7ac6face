// SPDX-License-Identifier: BSD-3-Clause
// Linear constraints by substitution: every variable becomes an affine function of the free ones.
//
// A mean over several nodes makes one of them the master. A row that follows from earlier ones is recognised and
// dropped, so supports may overlap. Variables marked as jumps stay free where there is a choice: expressed through
// others they would be small differences of large numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace reference {

// constant + sum of coefficient * variable
struct Affine {
    std::vector<std::pair<std::int64_t, double>> terms;
    double constant = 0.0;
};

class Elimination {
public:
    explicit Elimination(std::vector<bool> is_jump);

    enum class Outcome { added, redundant, contradictory };
    // row . v = right, where the row's own constant belongs to the left-hand side.
    Outcome add(const Affine& row, double right);

    // To be called after the last row: numbers the free variables and back-substitutes.
    void close();
    std::size_t free_count() const { return free_; }
    // Expresses a row in the numbers of the free variables.
    Affine expand(const Affine& row) const;

private:
    std::vector<bool> is_jump_;
    std::vector<std::int64_t> pivot_of_;  // variable -> index into solved_, -1 free
    std::vector<std::int64_t> variable_;  // of each solved_
    std::vector<Affine> solved_;
    std::vector<std::int64_t> number_;
    std::size_t free_ = 0;
};

}  // namespace reference
