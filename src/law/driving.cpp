// SPDX-License-Identifier: BSD-3-Clause
#include "law/driving.hpp"

#include <algorithm>

namespace delam {

Driving driving_energy(const Law& law, std::span<const double> local_jump) {
    const double opening = std::max(0.0, local_jump[0]);
    double slip = 0.0;
    for (std::size_t c = 1; c < local_jump.size(); ++c) slip += local_jump[c] * local_jump[c];
    return {0.5 * law.normal_stiffness * opening * opening, 0.5 * law.tangential_stiffness * slip};
}

bool tells_mixity(const Law& law, const Driving& y, double largest) {
    return y.total() > driving_rounding * std::max(largest, law.least_onset());
}

}  // namespace delam
