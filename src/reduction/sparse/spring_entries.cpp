// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/spring_entries.hpp"

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

std::vector<double> springs_of(const JumpSystem& system) {
    std::vector<double> springs(system.rows().size(), 0.0);
    for (const Zone::Coupling& c : system.couplings())
        if (c.row == c.column) springs[index(c.row)] += c.value;
    for (std::size_t r = 0; r < springs.size(); ++r)
        if (system.held()[r] != 0) springs[r] = held_as * row_diagonal(system, r);
    return springs;
}

std::vector<std::uint8_t> differing_rows(const JumpSystem& system, std::span<const double> springs) {
    const std::vector<double> now = springs_of(system);
    std::vector<std::uint8_t> row(now.size(), 0);
    for (std::size_t r = 0; r < now.size(); ++r) {
        if (system.rows().prescribed()[r] != 0 || now[r] == springs[r]) continue;
        const double body = row_diagonal(system, r), old = body + springs[r], present = body + now[r];
        const double share = now[r] < 0.0 ? system.limits().spring_differs_in_kind : system.limits().spring_differs;
        row[r] = present > (1.0 + share) * old || old > (1.0 + share) * present ? 1 : 0;
    }
    for (const Zone::Coupling& c : system.couplings()) {
        const auto r = index(c.row), q = index(c.column);
        if (r == q || system.rows().prescribed()[r] != 0 || system.rows().prescribed()[q] != 0) continue;
        if (system.held()[r] != 0 || system.held()[q] != 0) continue;
        const double own = (row_diagonal(system, r) + springs[r]) * (row_diagonal(system, q) + springs[q]);
        const double kind = system.limits().spring_differs_in_kind;
        if (c.value * c.value > kind * kind * own) row[r] = row[q] = 1;
    }
    return row;
}

bool any_softer(const JumpSystem& system, std::span<const double> springs) {
    const std::vector<double> now = springs_of(system);
    for (std::size_t r = 0; r < now.size(); ++r) {
        if (system.rows().prescribed()[r] != 0 || now[r] >= springs[r]) continue;
        const double body = row_diagonal(system, r);
        if (body + springs[r] > (1.0 + system.limits().spring_differs) * (body + now[r])) return true;
    }
    return false;
}

}  // namespace delam
