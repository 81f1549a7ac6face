// SPDX-License-Identifier: BSD-3-Clause
#include "law/softening/host_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace delam {

namespace {

constexpr int mixities = 8;
constexpr int adhesions = 64;
constexpr int drivings = 96;
constexpr double step = 1e-4;         // of zeta, relative of Y, of B, for difference quotients
constexpr double differences = 1e-2;  // relative accuracy of difference quotients

class Samples {
public:
    Samples(const HostSoftening& law, double mixity) : law_(law), b_(mixity) {}

    void run() {
        total_ = at(0.0).value;
        onset_ = -at(1.0).slope;
        const double at_one = at(1.0).value;
        if (!(std::abs(at_one) <= HostSoftening::close_enough * total_))
            refuse("g(1) must be 0", "zeta", 1.0, at_one, 0.0);
        if (!(onset_ > 0.0)) refuse("the onset -g'(1) must be > 0", "zeta", 1.0, onset_, 0.0);
        if (!(total_ >= onset_ * (1.0 - HostSoftening::close_enough)))
            refuse("the toughness g(0) is below the onset -g'(1)", "zeta", 0.0, total_, onset_);
        for (int i = 0; i < adhesions; ++i) {
            const double low = i / static_cast<double>(adhesions), high = (i + 1) / static_cast<double>(adhesions);
            chord(low, high);
            chord(std::max(low, high - step), high);
        }
        minimisers();
        for (int i = 0; i < adhesions; i += 8) by_mixity(i / static_cast<double>(adhesions));
    }

private:
    HostSoftening::Dissipation at(double zeta) const { return law_.dissipation(b_, zeta); }

    [[noreturn]] void refuse(const char* what, const char* variable, double place, double value, double other) const {
        fail(DELAM_ERROR_PROBLEM, "law '", law_.name, "': ", what, " at mixity B = ", b_, ", ", variable, " = ", place,
             ": ", value, " against ", other);
    }

    // Convex: the slope of a chord lies between those at its ends.
    void chord(double low, double high) const {
        const HostSoftening::Dissipation left = at(low), right = at(high);
        const double slope = (right.value - left.value) / (high - low);
        const double slack = HostSoftening::close_enough * (onset_ - slope) +
                             HostSoftening::close_enough * HostSoftening::close_enough * total_ / (high - low);
        if (slope > slack) refuse("g must not grow with zeta", "zeta", high, right.value, left.value);
        if (slope < left.slope - slack)
            refuse("g is not convex, or its slope is not its derivative", "zeta", low, left.slope, slope);
        if (slope > right.slope + slack)
            refuse("g is not convex, or its slope is not its derivative", "zeta", high, right.slope, slope);
    }

    // -g'(zeta) on either side of zeta encloses Y; beyond the ends there is no bound.
    void minimises(double y) const {
        const double zeta = law_.adhesion(b_, y).value;
        const double slack = HostSoftening::close_enough * y;
        if (zeta < 1.0) {
            const double above = -at(std::min(1.0, zeta + HostSoftening::close_enough)).slope;
            if (above > y + slack) refuse("adhesion is not the minimiser of zeta Y + g: too low", "Y", y, zeta, above);
        }
        if (zeta > 0.0) {
            const double below = -at(std::max(0.0, zeta - HostSoftening::close_enough)).slope;
            if (below < y - slack) refuse("adhesion is not the minimiser of zeta Y + g: too high", "Y", y, zeta, below);
        }
    }

    // Checks minimisers from below the onset to beyond the end: Y(0), or the driving energy at which the adhesion is a
    // thousandth.
    void minimisers() const {
        const double last = std::isfinite(at(0.0).slope) ? -at(0.0).slope : -at(1e-3).slope;
        const double ratio = 2.0 * std::max(1.0, last / onset_);
        double before = 1.0;
        for (int i = 0; i <= drivings; ++i) {
            const double y = 0.5 * onset_ * std::pow(2.0 * ratio, i / static_cast<double>(drivings));
            const HostSoftening::Adhesion here = law_.adhesion(b_, y);
            if (here.value > before) refuse("adhesion must not grow with Y", "Y", y, here.value, before);
            before = here.value;
            minimises(y);
            if (!(here.value > 0.0 && here.value < 1.0)) continue;
            // One-sided quotients agree where there is a derivative.
            const double h = step * (y - onset_ * (1.0 - step));
            const double left = (here.value - law_.adhesion(b_, y - h).value) / h;
            const double right = (law_.adhesion(b_, y + h).value - here.value) / h;
            const double slack = differences * std::abs(here.slope) + 1e-12 / h;
            if (std::abs(left - right) <= slack && std::abs(here.slope - 0.5 * (left + right)) > slack)
                refuse("the slope of the adhesion is not its derivative", "Y", y, here.slope, 0.5 * (left + right));
        }
    }

    void by_mixity(double zeta) const {
        if (b_ - step < 0.0 || b_ + step > 1.0) return;
        const HostSoftening::Dissipation here = at(zeta);
        const double left = (here.value - law_.dissipation(b_ - step, zeta).value) / step;
        const double right = (law_.dissipation(b_ + step, zeta).value - here.value) / step;
        const double slack = differences * (std::abs(here.mixity_slope) + 0.1 * total_);
        if (std::abs(left - right) <= slack && std::abs(here.mixity_slope - 0.5 * (left + right)) > slack)
            refuse("the derivative of g by the mixity is wrong", "zeta", zeta, here.mixity_slope, 0.5 * (left + right));
    }

    const HostSoftening& law_;
    double b_;
    double total_ = 0.0;
    double onset_ = 0.0;
};

}  // namespace

void require_consistent(const HostSoftening& law) {
    for (int i = 0; i <= mixities; ++i) Samples(law, i / static_cast<double>(mixities)).run();
}

}  // namespace delam
