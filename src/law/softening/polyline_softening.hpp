// SPDX-License-Identifier: BSD-3-Clause
// Traction falls along straight lines after the onset: trapezoids, tables.
//
// With x = sqrt(Y/Go), the jump over that of the onset, and s the traction over its peak, the corners (xi_i, s_i) of
// the table, xi and s in [0,1], stand at
//
//   x_i = 1 + w xi_i,   w = (Gc/Go - 1)/(2 A),   A = area under s over xi,
//
// so that the area under s beyond x = 1 is (Gc/Go - 1)/2 whatever the toughnesses. Adhesion is the slope zeta = s/x of
// the ray from the origin to the point. As it falls, Y = Go x^2, and the dissipated energy grows by twice the triangle
// that the ray sweeps:
//
//   g(corner i) = Go [(1 - s_i) + w (2 A_i - s_i xi_i)],   A_i = area up to xi_i,
//   and from corner 0 to corner 1 of a segment, in proportion to the part of it that is passed, Go (s_0 x_1 - s_1 x_0).
//
// s never grows, so the ray only falls, x(zeta) is one number and nonincreasing, and g is convex. Where s drops at one
// x, Y is the same for a range of zeta, g is straight there, and the pair falls at once, as Griffith's does: w = 0 is
// one such drop.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "law/softening/law_kind.hpp"
#include "law/softening/toughness.hpp"

namespace delam {

class PolylineSoftening {
public:
    struct Corner {
        double xi;
        double s;
        double area;  // under s, from 0 to xi
    };

    double dissipated(const Toughness& t, double zeta) const;
    double driving(const Toughness& t, double zeta) const;
    double driving_slope(const Toughness& t, double zeta) const;
    double minimiser(const Toughness& t, double driving, double zeta_old) const;
    double slope(const Toughness& t, double driving, double zeta_old) const;
    double total_share(const Toughness& t, double zeta) const;  // dg/dGc at the same Go and zeta

    const std::vector<Corner>& corners() const { return corners_; }  // empty: not given yet
    void hashed(auto&& add) const {
        add(static_cast<std::int64_t>(corners_.size()));
        for (const Corner& corner : corners_) {
            add(corner.xi);
            add(corner.s);
        }
    }

protected:
    // xi, s: from (0, 1) to (1, 0), xi nondecreasing, s nonincreasing. Points beyond the first of s = 0 are left out.
    void set_corners(std::span<const double> xi, std::span<const double> s);

private:
    struct Place {
        std::size_t segment;  // leads from corner segment - 1 to corner segment; the number of corners: beyond the end
        double share;         // of the segment that lies behind
        double scale;         // w
    };
    Place place_of(const Toughness& t, double zeta) const;
    // The same on a first loading to driving >= Go, w > 0.
    Place place_at(const Toughness& t, double driving) const;
    double scale(const Toughness& t) const { return 0.5 * ((t.total - t.onset) / t.onset) / corners_.back().area; }

    std::vector<Corner> corners_;
};

// Constant traction over the part `plateau` in [0,1) of the way from the onset to zero, then a straight line: plateau 0
// is the bilinear law, up to rounding.
class TrapezoidalSoftening : public PolylineSoftening {
public:
    void set_plateau(double plateau);
    double plateau() const { return corners().empty() ? -1.0 : corners()[1].xi; }  // -1: not given yet

    static constexpr LawKind kind{
        "trapezoidal",
        "traction stays at its peak on the part `plateau` of the way from onset to end, then falls on a straight line",
        Toughnesses::onset_and_total};
    static constexpr ShapeParameter<TrapezoidalSoftening> parameters[] = {
        {ShapeParameter<TrapezoidalSoftening>::Type::real, "plateau", "-", "", below_one,
         "part of the way from onset to end on which the traction stays at its peak", &TrapezoidalSoftening::plateau,
         &TrapezoidalSoftening::set_plateau}};
};

class TabulatedSoftening : public PolylineSoftening {
public:
    // Throws Error(DELAM_ERROR_ARGUMENT) naming the point that is out of order.
    void set_table(std::span<const double> xi, std::span<const double> s);
    const char* missing() const {
        return corners().empty() ? "softening is missing: a tabulated law needs its table (delam_law_set_table)"
                                 : nullptr;
    }

    static constexpr LawKind kind{"tabulated", "traction follows the points of delam_law_set_table",
                                  Toughnesses::onset_and_total};
    static constexpr ShapeParameter<TabulatedSoftening> parameters[] = {
        {ShapeParameter<TabulatedSoftening>::Type::table,
         "softening",
         "-",
         "",
         {"from (0, 1) to (1, 0), first column not falling, second not rising", 0.0, 1.0, false, false},
         "points (xi, s): jump beyond the onset over its largest, traction over its peak; scaled so that the area is "
         "the toughness"}};
};

}  // namespace delam
