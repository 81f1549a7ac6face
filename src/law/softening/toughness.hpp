// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace delam {

// Toughness at one mixity (law/mixity.hpp), F/L.
struct Toughness {
    double onset;         // Go, 0 < Go <= Gc
    double total;         // Gc
    double mixity = 0.0;  // B for which they hold: host laws evaluate with it again
};
// Their derivatives by the mixity, F/L.
struct ToughnessSlope {
    double onset;  // dGo/dB
    double total;  // dGc/dB
};

}  // namespace delam
