// SPDX-License-Identifier: BSD-3-Clause
// Numbers with the names of units of the scene, in lines for people. In 2D, energies are per unit thickness.
#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.hpp"

namespace cli {

// "1.98 J/m", in 3D "1.98 J"; with a prefix where the number is tiny or huge, and alone where nothing is named.
// Energies of one run have the prefix of the largest one, its work.
std::string energy_text(double energy, const Scene& scene, double largest);
// A part of an interface: "11.3 mm", in 3D "11.3 mm²".
std::string extent_text(double extent, const Scene& scene);
std::string length_text(double length, const Scene& scene);
std::string release_rate_text(double rate, const Scene& scene);
// Returns the factor of a pattern: "1.6 mm" where it is a displacement itself, else a number alone.
std::string load_text(double load, const Scene& scene, std::size_t pattern);
// Returns a reaction before and after a change, "27.6 to 16.5 N/mm", in 3D "27.6 to 16.5 N". That of dead forces is a
// displacement, and that of strains has no unit.
std::string reaction_text(double before, double after, const Scene& scene, std::size_t pattern);
// Four digits without an exponent: "3.142", "10045".
std::string short_number(double number);
// "0.04 %" for 4e-4.
std::string percent_text(double fraction);
// "step 7, time 0.35".
std::string instant_text(std::int64_t step, double time);

}  // namespace cli
