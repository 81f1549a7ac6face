// SPDX-License-Identifier: BSD-3-Clause
// A law that the host computes: its two callbacks give the adhesion zeta*(B, Y) of a first loading, and the
// dissipated energy g(B, zeta). Onset and total toughness follow: Go = -g'(1), Gc = g(0).
#pragma once

#include <string>

#include "delam/delam.h"
#include "law/softening/law_kind.hpp"
#include "law/softening/toughness.hpp"

namespace delam {

struct HostSoftening {
    static constexpr LawKind kind{"host", "given by callbacks of the host (delam_law_create_host)", Toughnesses::none};

    std::string name;  // for messages, and for the hash of the scene
    delam_adhesion_callback adhesion_callback = nullptr;
    delam_dissipation_callback dissipation_callback = nullptr;
    void* user = nullptr;

    // Relative tolerance for energies and driving energies that the callbacks return.
    static constexpr double close_enough = 1e-6;

    // Results of the callbacks. A failure, or a value that no law can have, throws Error(DELAM_ERROR_PROBLEM) with the
    // name, the place and the value.
    struct Adhesion {
        double value;  // zeta*, in [0,1]
        double slope;  // d zeta*/dY
    };
    Adhesion adhesion(double mixity, double driving) const;
    struct Dissipation {
        double value;         // g
        double slope;         // dg/dzeta; infinite at most at zeta = 0
        double mixity_slope;  // dg/dB
    };
    Dissipation dissipation(double mixity, double zeta) const;

    void hashed(auto&& add) const { add(name); }

    Toughness toughness(double mixity) const;
    ToughnessSlope toughness_slope(double mixity) const;  // of the onset by differences
    double dissipated(const Toughness& t, double zeta) const;
    double driving(const Toughness& t, double zeta) const;
    double driving_slope(const Toughness& t, double zeta) const;
    double minimiser(const Toughness& t, double driving, double zeta_old) const;
    double slope(const Toughness& t, double driving, double zeta_old) const;
};

}  // namespace delam
