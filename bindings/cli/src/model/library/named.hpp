// SPDX-License-Identifier: BSD-3-Clause
// The library uses labels and numbers, a scene names and places.
#pragma once

#include <string>

#include "model/library/model.hpp"

namespace cli {

// `message` with the numbers of bodies, interfaces and control nodes replaced by names, and those of constraints by
// places.
std::string named(const std::string& message, const Scene& scene, const Model& model);

// The message of a failure with the elements of the file in the place of the numbers of cells. place: that of the
// failure; that of the first element where a deck is the scene, whose lines say more than those of the import.
struct OfElements {
    std::string message;
    Place place;
};
OfElements with_elements(const std::string& message, const Place& place, const Scene& scene);

// A line of the log: with the names of interfaces, and words as a scene has them. Asks the library nothing.
std::string said_of_scene(const std::string& message, const Model& model);

}  // namespace cli
