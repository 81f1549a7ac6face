// SPDX-License-Identifier: BSD-3-Clause
// Finds the units that the numbers of a scene suggest. A modulus of 126e3 is one in MPa, so that lengths are in mm and
// forces in N; together with 126e9 for another material, or with a toughness in J/m2, the scene contradicts itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cli {

// A number of the scene that tells its unit.
struct Magnitude {
    Quantity quantity = Quantity::stress;
    std::string what;  // "modulus"
    std::string path;  // "materials[0].E1"
    double value = 0;
};
// Returns the largest and the smallest of each kind: moduli, peaks of tractions, toughnesses, the extent of the bodies.
std::vector<Magnitude> magnitudes_of(const Scene& scene);

struct UnitsFound {
    std::optional<UnitNames> proposed;  // where the scene names none
    std::string reason;                 // "modulus 126 GPa, extent 60 mm, ..": the numbers in the units proposed
    std::string warning;                // where numbers contradict each other or the names of the scene; else empty
};
UnitsFound units_found(const Scene& scene);

}  // namespace cli
