// SPDX-License-Identifier: BSD-3-Clause
// The bilinear law as a host would write it for delam_law_create_host; shares no code with the library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace laws {

// Toughnesses after Benzeggagh and Kenane with one exponent.
struct Bilinear {
    double normal_onset = 100.0, tangential_onset = 160.0;
    double normal_toughness = 250.0, tangential_toughness = 700.0;
    double eta = 1.7;
    int failing = 0;  // the callbacks return this beyond a mixity of 0.9
};

// Go and Gc with slopes, of a Bilinear.
struct At {
    double onset, total, onset_slope, total_slope;
};
inline At at(const Bilinear& d, double b) {
    const double share = std::pow(b, d.eta), slope = d.eta * std::pow(b, d.eta - 1.0);
    return {d.normal_onset + (d.tangential_onset - d.normal_onset) * share,
            d.normal_toughness + (d.tangential_toughness - d.normal_toughness) * share,
            (d.tangential_onset - d.normal_onset) * slope, (d.tangential_toughness - d.normal_toughness) * slope};
}

inline std::int32_t adhesion(double mixity, double driving, double* zeta, double* slope, void* user) {
    const auto& data = *static_cast<const Bilinear*>(user);
    if (mixity > 0.9 && data.failing != 0) return data.failing;
    const auto [onset, total, a, b] = at(data, mixity);
    const double rest = (total * std::sqrt(onset / driving) - onset) / (total - onset);
    *zeta = driving <= onset ? 1.0 : std::clamp(rest, 0.0, 1.0);
    *slope = *zeta > 0.0 && *zeta < 1.0 ? -0.5 * total * std::sqrt(onset / driving) / ((total - onset) * driving) : 0.0;
    return 0;
}

inline std::int32_t dissipation(double mixity, double zeta, double* g, double* slope, double* mixity_slope,
                                void* user) {
    const auto& data = *static_cast<const Bilinear*>(user);
    if (mixity > 0.9 && data.failing != 0) return data.failing;
    const auto [onset, total, onset_slope, total_slope] = at(data, mixity);
    const double below = onset + (total - onset) * zeta;
    *g = total * onset * (1.0 - zeta) / below;
    *slope = -onset * (total / below) * (total / below);
    const double share = onset * (1.0 - zeta) / below;  // dg/dGc = share^2, and g has degree one in Go, Gc
    *mixity_slope = share * share * total_slope + (*g - total * share * share) / onset * onset_slope;
    return 0;
}

}  // namespace laws
