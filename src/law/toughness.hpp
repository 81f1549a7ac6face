// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace delam {

// Toughness at one mixity, F/L.
struct Toughness {
    double onset;         // Go, 0 < Go <= Gc
    double total;         // Gc
    double mixity = 0.0;  // B at which they hold: laws given by the host ask again with it
};
// Their derivatives by the mixity, F/L.
struct ToughnessSlope {
    double onset;  // dGo/dB
    double total;  // dGc/dB
};

}  // namespace delam
