// SPDX-License-Identifier: BSD-3-Clause
#include "law/adhesion_after.hpp"

#include <cmath>

namespace delam {

namespace {

constexpr double growth = 4.0;      // of the driving energy, to bracket the answer
constexpr int most_growths = 1000;  // beyond all numbers
constexpr int most_halvings = 100;  // of the bracket
constexpr double accurate = 1e-10;  // width of the bracket, relative
// Relative to the share: if less than this is left to dissipate after the share, the pair breaks. A pair with a
// billionth of its adhesion only makes the displacement step ill-conditioned.
constexpr double sliver = 1e-2;

}  // namespace

// The unknown is the logarithm of the driving energy Y, because Y covers many decades and the dissipated energy grows
// with it. The adhesion itself is a bad unknown: that of a softening point of a stiff interface is of the order of
// Go/Gc.
double adhesion_after(const Law& law, const Toughness& t, double zeta_old, double share) {
    const double wanted = law.dissipated(t, zeta_old) + share * t.total;
    if (!(zeta_old > 0.0) || !(wanted < (1.0 - sliver * share) * t.total)) return 0.0;
    // Y in multiples of Go, so that no digit depends on the units.
    const auto after = [&](double multiple) { return law.minimiser(t, multiple * t.onset, zeta_old); };
    const auto enough = [&](double multiple) { return !(law.dissipated(t, after(multiple)) < wanted); };
    double low = 1.0, high = growth;
    for (int i = 0; i < most_growths && !enough(high); ++i) {
        low = high;
        high *= growth;
    }
    for (int i = 0; i < most_halvings && high > (1.0 + accurate) * low; ++i) {
        const double middle = std::sqrt(low) * std::sqrt(high);
        (enough(middle) ? high : low) = middle;
    }
    return after(high);
}

}  // namespace delam
