// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/contact/loose_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/numbers.hpp"

namespace delam {

namespace {

// A motion that moves a row by less than this part of its largest jump does not move it: normals of turned faces are
// known to about 1e-9. (Measured by verify/bench/constants.py on 250 random scenes: from 1e-12 to 1e-8 all do alike.
// A heated film in space that comes off with large rotations runs to its end from 1e-8 to 1e-6, and stops at 1e-10.)
constexpr double not_moved = 1e-8;
// Limits a pull, in roundings of a force, that may be rounding: such a row opens in any case, and holds no part until
// then. (Seed 722 of verify/cases/contact/random_scenes.py pulls by 10; half and twice decide alike on 300 scenes.)
constexpr double slight = 100.0;
// A multiple of all gaps: what does not stop a part before never stops it. (Measured by verify/bench/constants.py on
// 250 random scenes: from a hundredth to a hundred times all decide alike.)
constexpr double farther = 1e3;

}  // namespace

std::vector<std::uint8_t> with_springs(std::vector<std::uint8_t> held, std::span<const double> spring) {
    for (std::size_t r = 0; r < held.size(); ++r)
        if (spring[r] != 0.0) held[r] = 1;
    return held;
}

LooseRows::LooseRows(const ContactRows& contact, std::span<const std::uint8_t> closed, std::span<const double> force,
                     std::uint8_t level, double least_force)
    : contact_(contact) {
    for (std::size_t i = 0; i < contact.row.size(); ++i) {
        const double f = force[contact.row[i]];
        if (closed[i] != 0 ? f >= -least_force && f <= slight * least_force : contact.on(i, level)) rows.push_back(i);
    }
}

std::vector<std::uint8_t> LooseRows::active(std::span<const std::uint8_t> held, std::span<const double> spring) const {
    std::vector<std::uint8_t> active(held.begin(), held.end());
    for (const std::size_t i : rows) active[contact_.row[i]] = 0;
    return with_springs(std::move(active), spring);
}

LeastMotion LooseRows::keep_apart(const DenseMatrix& gram, std::span<const double> pull, const DenseMatrix& jumps,
                                  std::span<const double> jump, double least_jump) const {
    DenseMatrix normals(static_cast<std::int64_t>(rows.size()), jumps.columns);
    std::vector<double> gap;
    for (const std::size_t i : rows) gap.push_back(jump[contact_.row[i]]);
    for (std::int64_t c = 0; c < jumps.columns; ++c) {
        const double rounding = not_moved * max_abs(column(jumps, c));
        for (std::size_t k = 0; k < rows.size(); ++k)
            if (const double n = jumps(static_cast<std::int64_t>(contact_.row[rows[k]]), c); std::abs(n) > rounding)
                normals(static_cast<std::int64_t>(k), c) = n;
    }
    return least_motion(gram, pull, normals, gap, left * least_jump);
}

std::vector<std::size_t> LooseRows::stopping(const DenseMatrix& gram, std::span<const double> pull,
                                             const DenseMatrix& jumps, std::span<const double> jump) const {
    DenseMatrix factor = gram;
    std::vector<double> far(pull.begin(), pull.end()), moved(index(jumps.rows));
    if (!factor_definite(factor)) return {};
    solve_lower(factor, far);
    solve_lower_transposed(factor, far);
    multiply(jumps, far, moved);
    const double size = max_abs(jump), distance = size > 0.0 ? farther * size : 1.0;
    std::vector<double> along(pull.begin(), pull.end());
    for (double& p : along) p *= distance / std::max(max_abs(moved), std::numeric_limits<double>::min());
    const LeastMotion found = keep_apart(gram, along, jumps, jump, 0.0);
    std::vector<std::size_t> stops;
    for (const std::size_t k : found.touched) stops.push_back(rows[k]);
    for (const std::size_t k : found.blocked) stops.push_back(rows[k]);
    std::sort(stops.begin(), stops.end());
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    return stops;
}

std::vector<std::size_t> LooseRows::settled(const LeastMotion& motion, std::vector<std::uint8_t>& closed,
                                            std::span<const double> jump, std::span<double> force,
                                            double least_jump) const {
    std::vector<std::size_t> blocked;
    for (const std::size_t k : motion.blocked) blocked.push_back(rows[k]);
    if (!blocked.empty()) return blocked;
    for (const std::size_t i : rows) {
        const std::size_t r = contact_.row[i];
        if (closed[i] == 0 || !(jump[r] > least_jump)) continue;
        closed[i] = 0;
        force[r] = 0.0;
    }
    return blocked;
}

}  // namespace delam
