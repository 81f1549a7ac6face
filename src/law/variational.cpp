// SPDX-License-Identifier: BSD-3-Clause
#include "law/variational.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "law/mixity.hpp"

namespace delam {

double stored_linear_slope(const Law& law, double mixity, double zeta) {
    if (!(zeta > 0.0 && zeta < 1.0)) return 0.0;
    return law.dissipated_slope_mixity(mixity, zeta) - law.toughness_slope(mixity).total * (1.0 - zeta);
}

VariationalPair::Mode VariationalPair::mode(std::span<const double> local_jump) const {
    const Driving y = driving_energy(law, local_jump);
    if (!tells_mixity(law, y, largest)) return {y, mixity_before, false};
    return {y, mode_mixity(y.normal, y.tangential), true};
}

std::pair<Toughness, double> VariationalPair::damaging(std::span<const double> local_jump) const {
    const Mode m = mode(local_jump);
    const Toughness t = law.toughness(m.mixity);
    return {t, m.driving.total() + (t.total - total_before)};
}

double VariationalPair::minimiser(std::span<const double> local_jump, double zeta_old) const {
    const auto [toughness, driving] = damaging(local_jump);
    return law.minimiser(toughness, std::max(0.0, driving), zeta_old);
}

double VariationalPair::energy(std::span<const double> local_jump, double zeta) const {
    const Mode m = mode(local_jump);
    return zeta * (m.driving.total() - total_before) + law.stored_linear(law.toughness(m.mixity), zeta);
}

std::array<double, 3> VariationalPair::force(std::span<const double> local_jump, double zeta) const {
    const Mode m = mode(local_jump);
    std::array<double, 3> t{};
    double normal = zeta, tangential = zeta;
    if (m.known) {
        const double pull = stored_linear_slope(law, m.mixity, zeta) / m.driving.total();
        if (local_jump[0] > 0.0) normal -= m.mixity * pull;
        tangential += (1.0 - m.mixity) * pull;
    }
    for (std::size_t c = 0; c < local_jump.size(); ++c)
        t[c] = (c == 0 ? normal : tangential) * law.stiffness(c) * local_jump[c];
    return t;
}

// Returns the slope of the force. damage(jump) returns the adhesion there.
template <class Damage>
std::array<double, 9> VariationalPair::slope(std::span<const double> local_jump, const Damage& damage) const {
    const std::size_t dim = local_jump.size();
    const double size = std::sqrt(2.0 * driving_energy(law, local_jump).total());
    std::array<double, 9> h{};
    for (std::size_t q = 0; q < dim; ++q) {
        const double step =
            1e-6 * std::max(size, 1e-3 * std::sqrt(2.0 * law.least_onset())) / std::sqrt(law.stiffness(q));
        std::array<std::array<double, 3>, 2> side;
        for (int s = 0; s < 2; ++s) {
            std::array<double, 3> j{};
            std::copy(local_jump.begin(), local_jump.end(), j.begin());
            j[q] += s == 0 ? -step : step;
            const std::span<const double> at(j.data(), dim);
            side[index(s)] = force(at, damage(at));
        }
        for (std::size_t r = 0; r < dim; ++r) h[r * dim + q] = (side[1][r] - side[0][r]) / (2.0 * step);
    }
    for (std::size_t r = 0; r < dim; ++r)
        for (std::size_t q = 0; q < r; ++q) h[r * dim + q] = h[q * dim + r] = 0.5 * (h[r * dim + q] + h[q * dim + r]);
    return h;
}

std::array<double, 9> VariationalPair::tangent(std::span<const double> local_jump, double zeta_old) const {
    return slope(local_jump, [&](std::span<const double> at) { return minimiser(at, zeta_old); });
}

std::array<double, 9> VariationalPair::tangent_held(std::span<const double> local_jump, double zeta) const {
    return slope(local_jump, [&](std::span<const double>) { return zeta; });
}

// B = sin^2 phi:  F' = f_B sin 2phi,  F'' = f_BB sin^2 2phi + 2 f_B cos 2phi.
double VariationalPair::proximal(std::span<const double> local_jump, double zeta) const {
    const Mode m = mode(local_jump);
    if (!m.known || !(zeta > 0.0 && zeta < 1.0)) return 0.0;
    constexpr double step = 1e-5;
    const double low = std::max(0.0, m.mixity - step), high = std::min(1.0, m.mixity + step);
    const double slope = stored_linear_slope(law, m.mixity, zeta);
    const double second = (stored_linear_slope(law, high, zeta) - stored_linear_slope(law, low, zeta)) / (high - low);
    const double sine2 = 4.0 * m.mixity * (1.0 - m.mixity);  // sin^2 2phi
    const double first = slope * std::sqrt(sine2), curvature = second * sine2 + 2.0 * slope * (1.0 - 2.0 * m.mixity);
    return 0.5 * (curvature + std::sqrt(curvature * curvature + 4.0 * first * first)) / (2.0 * m.driving.total());
}

}  // namespace delam
