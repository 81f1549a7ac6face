// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/linear_buckling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"
#include "reduction/turned/buckling_mode.hpp"

namespace delam {

namespace {

// A ratio is known to a per cent, or to a thousandth where it is small: it says how near the bodies are to buckling.
// (Of examples/mmb, 4enf, enf-ductile and laminate-thermal it is .0606, .0678, .0089, .0068 in 21, 15, 7, 50 solves,
// with half of `least` .0612, .0692, .0098, .0070 in 34, 29, 13, 56, with twice .0597, .0675, .0034, 0 in 14, 11, 3,
// 17, and to all digits .0612, .0692, .0099, .0070.)
constexpr ModeAccuracy enough{1e-2, 0.15};
// A mode presses faces into each other where their jump closes by more than this share of its largest jump: less is
// rounding, or the rim of what opens. (Half and twice give the same ratios of examples/mmb, 4enf, laminate-thermal and
// blister, and verify/cases/test_buckling passes; half and twice of held_as change them by less than 1e-9.)
constexpr double pressed = 1e-3;
// Faces that hold only make a ratio smaller: one below this is known to a thousandth without them, and without another
// factorisation. (`delam run examples/enf/enf.toml --set geometry.h=0.0001 --set time.end=0.75 --set time.steps=15`
// ends with 5.5e-5 without and 5.4e-5 with them. Half and twice do nothing there, nor to the four ratios above, which
// are not between them.)
constexpr double slight = 1e-3;

// True if a mode with either sign presses faces that touch into each other.
bool held_by_faces(std::span<const double> jump, std::span<const std::uint8_t> touching) {
    double opens = 0.0, closes = 0.0, most = 0.0;
    for (std::size_t r = 0; r < jump.size(); ++r) {
        most = std::max(most, std::abs(jump[r]));
        if (touching[r] == 0) continue;
        opens = std::max(opens, jump[r]);
        closes = std::max(closes, -jump[r]);
    }
    return std::min(opens, closes) > pressed * most;
}

}  // namespace

double critical_ratio(const HeldBodies& held, std::span<const std::uint8_t> touching, const InitialStress& stress,
                      const Poll& poll) {
    const auto largest = [&](const HeldBodies& of) {
        return buckling_mode(
            index(of.dofs()), [&](std::span<const double> f) { return of.solve(f); },
            [&](std::span<const double> v) { return stress.softening(v); }, enough);
    };
    const BucklingMode mode = largest(held);
    if (!(mode.factor > 0.0)) return 0.0;
    if (mode.factor < slight || !held_by_faces(held.jump(mode.displacement), touching)) return mode.factor;
    Springs springs = held.springs();
    for (std::size_t r = 0; r < touching.size(); ++r)
        if (touching[r] != 0) springs.held[r] = 1;
    const std::unique_ptr<HeldBodies> all_hold = held.with(std::move(springs), poll);
    return all_hold != nullptr ? std::max(largest(*all_hold).factor, 0.0) : mode.factor;
}

}  // namespace delam
