// SPDX-License-Identifier: BSD-3-Clause
#include "law/driving.hpp"

#include <algorithm>

namespace delam {

namespace {

constexpr double mixity_difference = 1e-6;  // of the derivatives by the mixity

}  // namespace

Driving driving_energy(const Law& law, std::span<const double> local_jump) {
    const double opening = std::max(0.0, local_jump[0]);
    const double normal = 0.5 * law.normal_stiffness * opening * opening;
    const double second = local_jump.size() > 2 && law.two_shear_toughnesses()
                              ? 0.5 * law.stiffness(2) * local_jump[2] * local_jump[2]
                              : 0.0;
    double sum = 0.0;
    if (law.two_shears()) {
        for (std::size_t c = 1; c < local_jump.size(); ++c) sum += law.stiffness(c) * local_jump[c] * local_jump[c];
        return {normal, 0.5 * sum, second};
    }
    for (std::size_t c = 1; c < local_jump.size(); ++c) sum += local_jump[c] * local_jump[c];
    return {normal, 0.5 * law.tangential_stiffness * sum, second};
}

double driving_by_shear(const Law& law, const Mixity& mixity, double zeta, double factor) {
    const auto [b, second] = mixity;
    const double below = std::max(0.0, b - mixity_difference), above = std::min(1.0, b + mixity_difference);
    const double change =
        law.driving(law.toughness({above, second}), zeta) - law.driving(law.toughness({below, second}), zeta);
    return factor * change / (above - below);
}

double driving_by_second(const Law& law, const Mixity& mixity, double zeta, double factor) {
    if (!law.two_shear_toughnesses()) return 0.0;
    const auto [b, second] = mixity;
    const double below = std::max(0.0, second - mixity_difference), above = std::min(1.0, second + mixity_difference);
    const double change = law.driving(law.toughness({b, above}), zeta) - law.driving(law.toughness({b, below}), zeta);
    return factor * change / (above - below);
}

bool tells_mixity(const Law& law, const Driving& y, double largest) {
    return y.total() > driving_rounding * std::max(largest, law.least_onset());
}

}  // namespace delam
