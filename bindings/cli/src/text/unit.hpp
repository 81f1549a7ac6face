// SPDX-License-Identifier: BSD-3-Clause
// Units: what the names of units mean, and in which unit a number is read most easily. The only table of units; pages
// and pictures get theirs with a result (result.json).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// A unit of measurement as a number of SI units, with the powers of its dimensions: N/mm2 is 1e6, force 1, length -2.
struct Unit {
    double si = 1;
    int force = 0;
    int length = 0;
    int temperature = 0;
};

// "mm", "GPa", "N/mm2", "kJ/m^2", "1/K", "ppm/K"; nothing if the name is none of a unit.
std::optional<Unit> unit_named(std::string_view name);

// The quantities that lines, pages and pictures name; `line` is per unit of thickness, as in plane scenes.
enum class Quantity { length, area, force, line_force, energy, line_energy, release_rate, stress };
inline constexpr Quantity all_quantities[] = {Quantity::length,       Quantity::area,   Quantity::force,
                                              Quantity::line_force,   Quantity::energy, Quantity::line_energy,
                                              Quantity::release_rate, Quantity::stress};
// "length", "line_force", ..: the keys of result.json.
const char* quantity_name(Quantity quantity);

// The names that a scene gives to its units; empty: none. Numbers are never converted, only shown with a prefix.
struct UnitNames {
    std::string length;
    std::string force;
};

// A number of the scene times `factor` is a number of `name`.
struct Scale {
    double factor = 1;
    std::string name;
};

// Returns the units in which a quantity can be shown, from the smallest unit to the largest; the one with factor 1 is
// always there. Names that unit_named() does not know get no prefixes; without names the only name is empty.
std::vector<Scale> scales_of(Quantity quantity, const UnitNames& names);

// Returns the scale for numbers up to `largest` in size: that with factor 1 where they are neither tiny nor huge.
const Scale& suiting(const std::vector<Scale>& scales, double largest);

// "5.08 mm" for 0.00508 in a scene in m; in the unit that suits `largest` where numbers up to it stand beside this one.
std::string with_unit(double number, Quantity quantity, const UnitNames& names, double largest = 0);

}  // namespace cli
