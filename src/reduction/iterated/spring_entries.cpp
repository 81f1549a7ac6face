// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/iterated/spring_entries.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam {

double row_diagonal(const JumpSystem& system, std::size_t row) {
    double largest = 0.0;
    for (const auto& [i, n] : system.rows()[row].unknowns)
        largest = std::max(largest, n * n * system.diagonal()[index(i)]);
    return largest;
}

std::vector<Triplet> spring_entries(const JumpSystem& system, std::span<const Zone::Coupling> couplings,
                                    std::span<const std::uint8_t> held) {
    std::vector<Triplet> entries;
    const auto add = [&](std::size_t row, std::size_t column, double value) {
        for (const auto& [i, a] : system.rows()[row].unknowns)
            for (const auto& [j, b] : system.rows()[column].unknowns) entries.push_back({i, j, a * b * value});
    };
    for (const Zone::Coupling& c : couplings)
        if (held[index(c.row)] == 0 && held[index(c.column)] == 0) add(index(c.row), index(c.column), c.value);
    for (std::size_t r = 0; r < held.size(); ++r)
        if (held[r] != 0) add(r, r, held_as * row_diagonal(system, r));
    return entries;
}

}  // namespace delam
