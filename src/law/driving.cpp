// SPDX-License-Identifier: BSD-3-Clause
#include "law/driving.hpp"

#include <algorithm>

namespace delam {

Driving driving_energy(const Law& law, std::span<const double> local_jump) {
    const double opening = std::max(0.0, local_jump[0]);
    const double normal = 0.5 * law.normal_stiffness * opening * opening;
    double sum = 0.0;
    if (law.two_shears()) {
        for (std::size_t c = 1; c < local_jump.size(); ++c) sum += law.stiffness(c) * local_jump[c] * local_jump[c];
        return {normal, 0.5 * sum};
    }
    for (std::size_t c = 1; c < local_jump.size(); ++c) sum += local_jump[c] * local_jump[c];
    return {normal, 0.5 * law.tangential_stiffness * sum};
}

bool tells_mixity(const Law& law, const Driving& y, double largest) {
    return y.total() > driving_rounding * std::max(largest, law.least_onset());
}

}  // namespace delam
