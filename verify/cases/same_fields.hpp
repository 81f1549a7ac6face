// SPDX-License-Identifier: BSD-3-Clause
// Fields of two solvers at one state.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "api.hpp"
#include "support.hpp"

namespace cases {

inline double largest(const std::vector<double>& v) {
    double m = 0.0;
    for (const double x : v) m = std::max(m, std::abs(x));
    return m;
}

// Fields of two solvers at the same state, over the largest value of the second.
inline void expect_equal(const reference::Solver& a, const reference::Solver& b, const std::vector<const char*>& fields,
                         double tolerance, const std::string& where) {
    for (const char* key : fields) {
        const auto x = a.field(key), y = b.field(key);
        const double scale = largest(y);
        double worst = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(x[i] - y[i]));
        expect(std::isfinite(largest(x)), where + ": " + key + " is not finite");
        if (worst > 0.0) expect_below(worst / scale, tolerance, where + ": " + key);
    }
    const double energy = std::abs(b.value("stored_bulk")) + std::abs(b.value("stored_interface"));
    for (const char* key : {"stored_bulk", "stored_interface", "load_potential"})
        expect_near(a.value(key), b.value(key), tolerance, energy + std::abs(b.value("load_potential")),
                    where + ": " + key);
}

}  // namespace cases
