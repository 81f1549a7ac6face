// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/coupled_damage.hpp"

#include <algorithm>
#include <cmath>

namespace delam {

namespace {

constexpr std::int64_t limit = 300;
// Steps with a residual of rounding, for kappa so large that rounding hides the law (beyond some 1e10 times its
// curvature).
constexpr std::int64_t idle_limit = 8;
// Newton's method squares the error: after a whole step this small the next one would only be rounding.
constexpr double small_step = 1e-9;
// A pair counts as pressed against a bound within this fraction of its range, or within the residual if that is less.
constexpr double near_bound = 1e-6;
constexpr double sufficient = 1e-4;  // fraction of the predicted decrease that a step must reach
constexpr double rounding = 1e-14;   // of the energy of all pairs, or of an adhesion
constexpr int halvings = 50;
constexpr double least = 1e-12;  // adhesion below which a law that never debonds completely is not followed
constexpr double tiny = 1e-12;   // of a diagonal entry: keeps the matrix definite where nothing has curvature

class BoundedProblem {
public:
    BoundedProblem(const GradientTerm& term, const Law& law, std::span<const Toughness> toughness,
                   std::span<const double> driving, std::span<const double> lower, std::span<const double> upper)
        : term_(term),
          law_(law),
          toughness_(toughness),
          driving_(driving),
          lower_(lower),
          upper_(upper),
          free_(upper.size(), 0) {
        for (std::size_t i = 0; i < upper.size(); ++i) free_[i] = term.coupled(i) && upper[i] > 0.0 ? 1 : 0;
        for (std::size_t i = 0; i < upper.size(); ++i)
            if (free_[i] != 0) scale_ += term.weight()[i] * (toughness[i].total + upper[i] * driving[i]);
    }

    CoupledDamage solve(std::span<const double> pointwise, std::span<const double> start) const;

private:
    using Values = std::vector<double>;

    double clamped(std::size_t i, double z) const { return std::clamp(z, lower_[i], upper_[i]); }
    // Y(z), finite even where no driving energy suffices to debond completely.
    double resistance(std::size_t i, double z) const {
        const double y = law_.driving(toughness_[i], z);
        return std::isfinite(y) ? y : law_.driving(toughness_[i], least);
    }
    // dF/dz over w, without the gradient term.
    double excess(std::size_t i, double z) const { return driving_[i] - resistance(i, z); }
    Values slope(const Values& z) const;
    // F(to) - F(from), pair by pair: sums of differences, not a difference of sums.
    double change(const Values& from, const Values& to) const;
    double curvature(std::size_t i, double z, double slope) const;
    Values smoothed(std::span<const double> pointwise) const;
    double residual(const Values& z, const Values& slope, const Values& curvature) const;
    bool descend(Values& z, const Values& slope, const Values& step, double& part) const;

    const GradientTerm& term_;
    const Law& law_;
    std::span<const Toughness> toughness_;
    std::span<const double> driving_;
    std::span<const double> lower_, upper_;
    std::vector<std::uint8_t> free_;  // takes part at all
    double scale_ = 0.0;
};

BoundedProblem::Values BoundedProblem::slope(const Values& z) const {
    Values d = term_.force(z);
    for (std::size_t i = 0; i < z.size(); ++i) d[i] = free_[i] != 0 ? d[i] + term_.weight()[i] * excess(i, z[i]) : 0.0;
    return d;
}

double BoundedProblem::change(const Values& from, const Values& to) const {
    double sum = term_.energy(to) - term_.energy(from);
    for (std::size_t i = 0; i < from.size(); ++i)
        if (free_[i] != 0 && to[i] != from[i])
            sum += term_.weight()[i] * ((to[i] - from[i]) * driving_[i] + (law_.dissipated(toughness_[i], to[i]) -
                                                                           law_.dissipated(toughness_[i], from[i])));
    return sum;
}

// w c; slope = dF/dz of the pair, so that -slope/w = Y(z) - q.
double BoundedProblem::curvature(std::size_t i, double z, double slope) const {
    const double weight = term_.weight()[i];
    const double load = resistance(i, z) + slope / weight;
    const double target = law_.minimiser(toughness_[i], std::max(0.0, load), upper_[i]);
    const double secant = -slope / (target - z);
    if (std::abs(target - z) > 1e-8 * upper_[i] && std::isfinite(secant) && secant >= 0.0) return secant;
    return -weight * law_.driving_slope(toughness_[i], std::max(z, least));
}

// The pointwise solution smoothed over the length that balances kappa against the law's own curvature: it lies between
// the bounds nearly everywhere, so that the first Newton steps involve all pairs.
BoundedProblem::Values BoundedProblem::smoothed(std::span<const double> pointwise) const {
    Values diag(pointwise.size(), 0.0), right(pointwise.size(), 0.0), z(pointwise.begin(), pointwise.end());
    std::vector<std::uint8_t> held(pointwise.size(), 1);
    for (std::size_t i = 0; i < diag.size(); ++i) {
        diag[i] = term_.diagonal(i) > 0.0 ? tiny * term_.diagonal(i) : 1.0;
        if (free_[i] == 0) continue;
        held[i] = 0;
        diag[i] += term_.weight()[i] * (std::abs(excess(i, pointwise[i])) / upper_[i] -
                                        law_.driving_slope(toughness_[i], std::max(pointwise[i], least)));
        right[i] = diag[i] * pointwise[i];
    }
    if (!term_.solve(diag, held, right, z)) return {pointwise.begin(), pointwise.end()};
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = free_[i] != 0 ? clamped(i, z[i]) : pointwise[i];
    return z;
}

double BoundedProblem::residual(const Values& z, const Values& slope, const Values& curvature) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i)
        if (free_[i] != 0)
            worst = std::max(worst, std::abs(clamped(i, z[i] - slope[i] / (curvature[i] + term_.diagonal(i))) - z[i]));
    return worst;
}

// Along the projected path z(a) = P(z + a step), a = 1, 1/2, 1/4 ...
bool BoundedProblem::descend(Values& z, const Values& slope, const Values& step, double& part) const {
    Values to(z.size());
    part = 1.0;
    for (int k = 0; k < halvings; ++k, part *= 0.5) {
        double predicted = 0.0;
        for (std::size_t i = 0; i < z.size(); ++i) {
            to[i] = free_[i] != 0 ? clamped(i, z[i] + part * step[i]) : z[i];
            predicted += slope[i] * (to[i] - z[i]);
        }
        if (!(predicted < 0.0)) continue;
        bool enough = change(z, to) <= sufficient * predicted;
        if (!enough && -predicted < rounding * scale_) {
            const Values after = this->slope(to);
            double ahead = 0.0;
            for (std::size_t i = 0; i < z.size(); ++i) ahead += after[i] * (to[i] - z[i]);
            enough = ahead <= -0.8 * predicted;
        }
        if (!enough) continue;
        z = std::move(to);
        return true;
    }
    return false;
}

CoupledDamage BoundedProblem::solve(std::span<const double> pointwise, std::span<const double> start) const {
    CoupledDamage result;
    const std::size_t n = upper_.size();
    Values z(pointwise.begin(), pointwise.end()), warm = z;
    for (std::size_t i = 0; i < n; ++i)
        if (free_[i] != 0) warm[i] = clamped(i, start[i]);
    for (Values& other : std::vector<Values>{smoothed(pointwise), warm})
        if (change(z, other) < 0.0) z = std::move(other);

    Values curved(n, 0.0), step(n, 0.0), diag(n), right(n);
    std::vector<std::uint8_t> held(n);
    std::int64_t idle = 0;
    while (true) {
        const Values d = slope(z);
        for (std::size_t i = 0; i < n; ++i) curved[i] = free_[i] != 0 ? curvature(i, z[i], d[i]) : 0.0;
        result.residual = residual(z, d, curved);
        result.converged = result.converged || result.residual == 0.0;
        if (result.converged || result.iterations == limit || idle == idle_limit) break;
        if (result.residual <= rounding) ++idle;

        for (std::size_t i = 0; i < n; ++i) {
            const double edge = std::min(near_bound * upper_[i], result.residual);
            held[i] =
                free_[i] == 0 || (z[i] <= lower_[i] + edge && d[i] > 0.0) || (z[i] >= upper_[i] - edge && d[i] < 0.0)
                    ? 1
                    : 0;
            diag[i] = free_[i] != 0 ? curved[i] + tiny * term_.diagonal(i) : term_.diagonal(i) > 0.0 ? 0.0 : 1.0;
            right[i] = -d[i];
        }
        ++result.iterations;
        double part = 1.0;
        const Values before = z;
        bool moved = term_.solve(diag, held, right, step) && descend(z, d, step, part);
        if (!moved) {
            for (std::size_t i = 0; i < n; ++i) step[i] = free_[i] != 0 ? -d[i] / (curved[i] + term_.diagonal(i)) : 0.0;
            moved = descend(z, d, step, part);
            part = 0.0;
        }
        if (!moved) {  // nothing lowers the energy any more: rounding
            result.converged = true;
            break;
        }
        double largest = 0.0;
        for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(z[i] - before[i]));
        result.converged = largest <= small_step && (part == 1.0 || result.residual <= rounding);
    }
    // A pair that is pressed against a bound and nearly there is set exactly to it.
    const Values d = slope(z);
    for (std::size_t i = 0; i < n; ++i) {
        if (free_[i] == 0) continue;
        if (d[i] > 0.0 && z[i] - lower_[i] <= small_step * upper_[i]) z[i] = lower_[i];
        if (d[i] < 0.0 && upper_[i] - z[i] <= small_step * upper_[i]) z[i] = upper_[i];
    }
    result.adhesion = std::move(z);
    return result;
}

}  // namespace

CoupledDamage coupled_damage(const GradientTerm& term, const Law& law, std::span<const Toughness> toughness,
                             std::span<const double> driving, std::span<const double> lower,
                             std::span<const double> adhesion_old, std::span<const double> pointwise,
                             std::span<const double> start) {
    return BoundedProblem(term, law, toughness, driving, lower, adhesion_old).solve(pointwise, start);
}

}  // namespace delam
