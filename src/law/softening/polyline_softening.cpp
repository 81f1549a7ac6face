// SPDX-License-Identifier: BSD-3-Clause
#include "law/softening/polyline_softening.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

using Corner = PolylineSoftening::Corner;

// (s_0 x_1 - s_1 x_0) of a segment: all parts >= 0.
double swept(const Corner& from, const Corner& to, double w) {
    return (from.s - to.s) + w * (from.s * to.xi - to.s * from.xi);
}

}  // namespace

void PolylineSoftening::set_corners(std::span<const double> xi, std::span<const double> s) {
    std::vector<Corner> corners;
    double area = 0.0;
    for (std::size_t i = 0; i < xi.size(); ++i) {
        if (i > 0) area += 0.5 * (s[i - 1] + s[i]) * (xi[i] - xi[i - 1]);
        corners.push_back({xi[i], s[i], area});
        if (s[i] == 0.0) break;
    }
    corners_ = std::move(corners);
}

// The segment that leads from zeta to lower values, so at a corner the later one. The ray of slope zeta meets it at
// theta = (s_0 - zeta x_0) / ((s_0 - zeta x_0) + (zeta x_1 - s_1)), both parts >= 0 and not both 0.
PolylineSoftening::Place PolylineSoftening::place_of(const Toughness& t, double zeta) const {
    const double w = scale(t);
    const auto next = std::partition_point(corners_.begin(), corners_.end(),
                                           [&](const Corner& c) { return c.s >= zeta * (1.0 + w * c.xi); });
    const auto segment = std::clamp<std::size_t>(index(next - corners_.begin()), 1, corners_.size() - 1);
    const Corner &from = corners_[segment - 1], &to = corners_[segment];
    const double before = from.s - zeta * (1.0 + w * from.xi), after = zeta * (1.0 + w * to.xi) - to.s;
    return {segment, std::clamp(before / (before + after), 0.0, 1.0), w};
}

double PolylineSoftening::dissipated(const Toughness& t, double zeta) const {
    if (!(zeta > 0.0)) return t.total;
    const auto [segment, share, w] = place_of(t, zeta);
    const Corner& from = corners_[segment - 1];
    const double at_corner = (1.0 - from.s) + w * (2.0 * from.area - from.s * from.xi);
    return t.onset * (at_corner + share * swept(from, corners_[segment], w));
}

double PolylineSoftening::driving(const Toughness& t, double zeta) const {
    const auto [segment, share, w] = place_of(t, zeta);
    const Corner &from = corners_[segment - 1], &to = corners_[segment];
    const double x = 1.0 + w * (from.xi + share * (to.xi - from.xi));
    return t.onset * (x * x);
}

// On a segment s = a + b x the ray gives zeta = b + a/x, a = (s_0 x_1 - s_1 x_0)/(x_1 - x_0).
double PolylineSoftening::driving_slope(const Toughness& t, double zeta) const {
    const auto [segment, share, w] = place_of(t, zeta);
    const Corner &from = corners_[segment - 1], &to = corners_[segment];
    const double x = 1.0 + w * (from.xi + share * (to.xi - from.xi));
    return -2.0 * t.onset * (x * x * x) * (w * (to.xi - from.xi) / swept(from, to, w));
}

// x - 1 = (Y/Go - 1)/(x + 1), whose difference is exact next to the onset.
PolylineSoftening::Place PolylineSoftening::place_at(const Toughness& t, double driving) const {
    const double w = scale(t);
    const double xi = ((driving - t.onset) / t.onset) / (std::sqrt(driving / t.onset) + 1.0) / w;
    if (!(xi < corners_.back().xi)) return {corners_.size(), 0.0, w};  // also where what drives overflows
    const auto to = std::partition_point(corners_.begin(), corners_.end(), [&](const Corner& c) { return c.xi <= xi; });
    const Corner& from = *(to - 1);
    return {index(to - corners_.begin()), (xi - from.xi) / (to->xi - from.xi), w};
}

double PolylineSoftening::minimiser(const Toughness& t, double driving, double zeta_old) const {
    if (!(t.total > t.onset)) return driving < t.total ? zeta_old : 0.0;
    if (driving < t.onset) return zeta_old;
    const Place at = place_at(t, driving);
    if (at.segment == corners_.size()) return 0.0;
    const Corner &from = corners_[at.segment - 1], &to = corners_[at.segment];
    return std::min(zeta_old, (from.s + at.share * (to.s - from.s)) / std::sqrt(driving / t.onset));
}

// zeta = s/x:  d zeta/dY = (ds/dx - zeta)/x dx/dY,  dx/dY = x/(2 Y).
double PolylineSoftening::slope(const Toughness& t, double driving, double zeta_old) const {
    const double zeta = minimiser(t, driving, zeta_old);
    if (!(zeta > 0.0 && zeta < zeta_old)) return 0.0;
    const Place at = place_at(t, driving);
    const Corner &from = corners_[at.segment - 1], &to = corners_[at.segment];
    return 0.5 * ((to.s - from.s) / (at.scale * (to.xi - from.xi)) - zeta) / driving;
}

// g is the maximum over x of (energy under the curve up to x) - zeta Y, so its derivative at the same zeta is that of
// the area at the same x: with x = 1 + w xi, (A(xi) - xi s)/A.
double PolylineSoftening::total_share(const Toughness& t, double zeta) const {
    if (!(zeta > 0.0)) return 1.0;
    const Place at = place_of(t, zeta);
    const Corner &from = corners_[at.segment - 1], &to = corners_[at.segment];
    const double step = at.share * (to.xi - from.xi), s = from.s + at.share * (to.s - from.s);
    return (from.area + 0.5 * (from.s + s) * step - (from.xi + step) * s) / corners_.back().area;
}

void TrapezoidalSoftening::set_plateau(double plateau) {
    const double xi[] = {0.0, plateau, 1.0}, s[] = {1.0, 1.0, 0.0};
    set_corners(xi, s);
}

void TabulatedSoftening::set_table(std::span<const double> xi, std::span<const double> s) {
    const std::size_t count = xi.size();
    if (count < 2) fail(DELAM_ERROR_ARGUMENT, "count = ", count, ": a table of softening has at least 2 points");
    for (std::size_t i = 0; i < count; ++i) {
        if (!(xi[i] >= 0.0 && xi[i] <= 1.0)) fail(DELAM_ERROR_ARGUMENT, "xi[", i, "] = ", xi[i], " is outside 0 .. 1");
        if (!(s[i] >= 0.0 && s[i] <= 1.0)) fail(DELAM_ERROR_ARGUMENT, "s[", i, "] = ", s[i], " is outside 0 .. 1");
        if (i == 0) continue;
        if (xi[i] < xi[i - 1])
            fail(DELAM_ERROR_ARGUMENT, "xi[", i, "] = ", xi[i], " < xi[", i - 1, "] = ", xi[i - 1], ": must not fall");
        if (s[i] > s[i - 1])
            fail(DELAM_ERROR_ARGUMENT, "s[", i, "] = ", s[i], " > s[", i - 1, "] = ", s[i - 1], ": must not rise");
    }
    const std::size_t last = count - 1;
    if (xi[0] != 0.0 || s[0] != 1.0)
        fail(DELAM_ERROR_ARGUMENT, "point 0 = (", xi[0], ", ", s[0], "): the onset (0, 1) is expected");
    if (xi[last] != 1.0 || s[last] != 0.0)
        fail(DELAM_ERROR_ARGUMENT, "point ", last, " = (", xi[last], ", ", s[last], "): the end (1, 0) is expected");
    const auto second = std::find_if(xi.begin(), xi.end(), [](double v) { return v > 0.0; }) - xi.begin();
    if (s[index(second) - 1] == 0.0)
        fail(DELAM_ERROR_ARGUMENT, "s falls to 0 at xi = 0, so that the area under the table is 0: use kind griffith");
    set_corners(xi, s);
}

}  // namespace delam
