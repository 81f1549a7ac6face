// SPDX-License-Identifier: BSD-3-Clause
// Compares a state of the library with the reference's: relative differences, and contacts that disagree.
#pragma once

#include <string>

#include "direct.hpp"

namespace reference {

struct Comparison {
    double jump = 0.0;      // max norm over the interfaces, over the largest jump
    double traction = 0.0;  // max norm over the interfaces, over the largest traction
    double displacement = 0.0;
    double reaction = 0.0;          // of the patterns, over the largest one
    double stored_bulk = 0.0;       // over the reference's value
    double stored_interface = 0.0;  // over the reference's value
    int contacts = 0;  // pairs with another contact flag whose gap or pressure is above `contact_tolerance`

    double worst() const;
    std::string text() const;
};

Comparison compare(const Solver& solver, const State& reference, const Exported& exported, double contact_tolerance);

}  // namespace reference
