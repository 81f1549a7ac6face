// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace fuzz {

// A host law, computed by callbacks: the bilinear law, until it is made to fail.
struct HostLaw {
    std::int64_t fail_in = -1;  // calls until one fails
    std::int32_t fail_with = 1;
    bool nonsense = false, failed = false;
    bool fails() {
        const bool now = fail_in >= 0 && fail_in-- == 0 && fail_with != 0;
        failed = failed || now;
        return now;
    }
};
inline constexpr double host_onset = 0.01, host_toughness = 0.05;
inline std::int32_t host_adhesion(double, double driving, double* adhesion, double* slope, void* user) {
    HostLaw& law = *static_cast<HostLaw*>(user);
    if (law.fails()) return law.fail_with;
    // zeta* of zeta Y + g with -g'(zeta) = 1/(zeta/sqrt(Go) + (1 - zeta)/sqrt(Ge))^2, sqrt(Go Ge) = Gc
    const double first = std::sqrt(host_onset), last = host_toughness / first, root = std::sqrt(driving);
    const double softening = (1.0 / root - 1.0 / last) / (1.0 / first - 1.0 / last);
    *adhesion = driving <= host_onset ? 1.0 : root >= last ? 0.0 : softening;
    *slope = *adhesion <= 0.0 || *adhesion >= 1.0 ? 0.0 : -0.5 / (root * driving) / (1.0 / first - 1.0 / last);
    if (law.nonsense) *adhesion = std::nan(""), *slope = 1.0;
    return 0;
}
inline std::int32_t host_dissipation(double, double adhesion, double* dissipated, double* slope, double* mixity_slope,
                                     void* user) {
    HostLaw& law = *static_cast<HostLaw*>(user);
    if (law.fails()) return law.fail_with;
    const double a = 1.0 / std::sqrt(host_onset), b = std::sqrt(host_onset) / host_toughness;
    const double root = adhesion * a + (1.0 - adhesion) * b;
    *dissipated = (1.0 / root - 1.0 / a) / (a - b);
    *slope = -1.0 / (root * root);
    *mixity_slope = 0.0;
    if (law.nonsense) *dissipated = -*dissipated;
    return 0;
}

}  // namespace fuzz
