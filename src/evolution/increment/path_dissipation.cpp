// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/path_dissipation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace delam {

namespace {

// Parts of the path between two states. (Measured by verify/bench/constants.py with verify/cases/search/energetic.py:
// half moves a dissipated energy by 1e-4, twice by 2e-6.)
constexpr int parts = 16;
constexpr int mixity_halvings = 40;  // of an interval of mixities; half and twice change no digit (the same analyses)
// Largest ratio of the steps before and after a state; beyond it, a parabola through three states says nothing. (Half
// moves an energy of the same analyses by 5e-6, twice none.)
constexpr double comparable = 20.0;

// The jump between two states: j(s) = from + s before + s (s + ratio) bend, j(0) = from, j(1) = to, j(-ratio) = last.
class Curve {
public:
    Curve(std::span<const double> last, std::span<const double> from, std::span<const double> to)
        : dimension_(from.size()) {
        double back = 0.0, ahead = 0.0;
        for (std::size_t c = 0; c < dimension_; ++c) {
            from_[c] = from[c];
            along_[c] = to[c] - from[c];
            ahead += along_[c] * along_[c];
            if (!last.empty()) back += (from[c] - last[c]) * (from[c] - last[c]);
        }
        const double ratio = ahead > 0.0 ? std::sqrt(back / ahead) : 0.0;
        if (last.empty() || !(ratio > 1.0 / comparable) || !(ratio < comparable)) return;
        ratio_ = ratio;
        for (std::size_t c = 0; c < dimension_; ++c) {
            const double slope = (from[c] - last[c]) / ratio;
            bend_[c] = (along_[c] - slope) / (1.0 + ratio);
            along_[c] = slope;
        }
    }
    std::span<const double> at(double s) {
        for (std::size_t c = 0; c < dimension_; ++c) jump_[c] = from_[c] + s * (along_[c] + (s + ratio_) * bend_[c]);
        return std::span<const double>(jump_).first(dimension_);
    }

private:
    std::size_t dimension_;
    double ratio_ = 0.0;
    std::array<double, 3> from_{}, along_{}, bend_{}, jump_{};
};

PathEnergy integrate(const PairLaws& pairs, std::size_t pair, const PairPath& path, Curve curve, const Mixity& mixity) {
    const Law& law = *pairs.law[pair];
    const auto toughness_at = [&](const Driving& y) {
        return pairs.toughness(pair, tells_mixity(law, y, 0.0) ? y.mixity() : mixity);
    };
    PathEnergy sum;
    Toughness before = toughness_at(driving_energy(law, curve.at(0.0)));
    double zeta = path.adhesion_from;
    for (int i = 1; i <= parts; ++i) {
        const Driving y = driving_energy(law, curve.at(static_cast<double>(i) / parts));
        const Toughness t = toughness_at(y);
        // A pair that a gradient term couples to others does not follow its own law: its adhesion falls evenly.
        const double even =
            path.adhesion_from + static_cast<double>(i) / parts * (path.adhesion_to - path.adhesion_from);
        const double follows = law.gradient > 0.0 ? even : law.minimiser(t, y.total(), zeta);
        const double next = i == parts ? path.adhesion_to : std::clamp(follows, path.adhesion_to, zeta);
        if (next < zeta) {
            sum.dissipated += 0.5 * (law.dissipated(before, next) - law.dissipated(before, zeta) +
                                     law.dissipated(t, next) - law.dissipated(t, zeta));
            sum.linear += 0.5 * (before.total + t.total) * (zeta - next);
        }
        before = t;
        zeta = next;
    }
    return sum;
}

// Returns the dissipated energy by the mixities of the two states alone.
double of_the_ends(const PairLaws& pairs, std::size_t pair, const PairPath& path, const Mixity& mixity) {
    const Law& law = *pairs.law[pair];
    double sum = 0.0;
    for (const std::span<const double> jump : {path.from, path.to}) {
        const Driving y = driving_energy(law, jump);
        const Toughness t = pairs.toughness(pair, tells_mixity(law, y, 0.0) ? y.mixity() : mixity);
        sum += 0.5 * (law.dissipated(t, path.adhesion_to) - law.dissipated(t, path.adhesion_from));
    }
    return sum;
}

}  // namespace

PathEnergy path_energy(const PairLaws& pairs, std::size_t pair, const PairPath& path, const Mixity& mixity) {
    if (!pairs.mixed(pair)) {
        const Law& law = *pairs.law[pair];
        const Toughness t = pairs.toughness(pair, mixity);
        return {law.dissipated(t, path.adhesion_to) - law.dissipated(t, path.adhesion_from),
                t.total * (path.adhesion_from - path.adhesion_to), 0.0};
    }
    constexpr std::array<double, 3> none{};
    const auto origin = std::span<const double>(none).first(path.from.size());
    PathEnergy straight = integrate(pairs, pair, path, Curve({}, path.from, path.to), mixity);
    if (path.last.empty() && path.adhesion_from < 1.0) {
        straight.error = std::abs(straight.dissipated - of_the_ends(pairs, pair, path, mixity));
        return straight;
    }
    PathEnergy curved =
        integrate(pairs, pair, path, Curve(path.adhesion_from < 1.0 ? path.last : origin, path.from, path.to), mixity);
    curved.error = std::abs(curved.dissipated - straight.dissipated);
    return curved;
}

// Between the mixities of the two jumps the toughness takes every value between theirs.
Mixity path_mixity(const PairLaws& pairs, std::size_t pair, std::span<const double> from, std::span<const double> to,
                   const Mixity& mixity) {
    const Law& law = *pairs.law[pair];
    const auto shown = [&](std::span<const double> jump) {
        const Driving y = driving_energy(law, jump);
        return tells_mixity(law, y, 0.0) ? y.mixity() : mixity;
    };
    Mixity low = shown(from), high = shown(to);
    if (!pairs.mixed(pair) || low == high) return high;
    const double wanted = path_energy(pairs, pair, {{}, from, to, 1.0, 0.0}, mixity).dissipated;
    const auto excess = [&](const Mixity& b) { return pairs.toughness(pair, b).total - wanted; };
    const bool rising = excess(low) < 0.0;
    if (rising == (excess(high) < 0.0)) return std::abs(excess(low)) < std::abs(excess(high)) ? low : high;
    for (int i = 0; i < mixity_halvings; ++i) {
        const Mixity middle = 0.5 * (low + high);
        ((excess(middle) < 0.0) == rising ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace delam
