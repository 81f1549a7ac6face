// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/path/within_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace delam {

namespace {

// Least release of unstable growth, relative to the dissipated energy; a part of the path that releases less may be
// steady growth.
constexpr double unstable = 1e-3;

// Energy per square of the load.
double quadratic(const PathPoint& p) { return p.energy - p.gradient; }

// a_c of the part between two states; 0: it needs no load, 1: the load of the end does not drive it.
double critical(const PathPoint& from, const PathPoint& to) {
    const double need = to.dissipated - from.dissipated + to.gradient - from.gradient;
    const double gives = quadratic(from) - quadratic(to);
    if (!(need > 0.0)) return 0.0;
    return gives > need ? std::sqrt(need / gives) : 1.0;
}

std::vector<double> at_load(double load, std::vector<double> conjugate) {
    for (double& q : conjugate) q *= load;
    return conjugate;
}

// Sets how much the interfaces have debonded between two states.
void compare(JumpWithin& jump, const PathPoint& from, const PathPoint& to) {
    jump.debonded = 0.0;
    double longest = 0.0;
    for (std::size_t i = 0; i < to.debonded.size(); ++i) {
        const double advance = to.debonded[i] - from.debonded[i];
        jump.debonded += advance;
        if (jump.interface >= 0 && !(advance > longest)) continue;
        longest = advance;
        jump.interface = static_cast<std::int64_t>(i);
    }
    jump.drop = quadratic(from) > 0.0 ? 1.0 - quadratic(to) / quadratic(from) : 0.0;
    jump.conjugate_before = at_load(jump.load, from.conjugate);
    jump.conjugate_after = at_load(jump.load, to.conjugate);
}

}  // namespace

WithinStep within_step(std::span<const PathPoint> points, double begin, bool elsewhere) {
    WithinStep within;
    JumpWithin now;
    double load = begin;
    std::size_t first = 0;  // state from which the present jump starts
    for (std::size_t i = 1; i < points.size(); ++i) {
        const PathPoint &from = points[i - 1], &to = points[i];
        const double needed = critical(from, to);
        if (needed > load) {
            within.work += quadratic(from) * (needed * needed - load * load);
            load = needed;
            now = {};
            first = i - 1;
        }
        const double released = load * load * (quadratic(from) - quadratic(to)) + from.gradient - to.gradient -
                                (to.dissipated - from.dissipated);
        within.released += std::max(0.0, released);
        now.load = load;
        now.released += std::max(0.0, released);
        now.interface = -1;
        compare(now, points[first], to);
        const bool jumps =
            now.released > unstable * (to.dissipated - points[first].dissipated) || (elsewhere && first == 0);
        if (jumps && now.debonded > within.jump.debonded) within.jump = now;
    }
    within.work += quadratic(points.back()) * (1.0 - load * load);
    return within;
}

}  // namespace delam
