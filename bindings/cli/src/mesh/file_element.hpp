// SPDX-License-Identifier: BSD-3-Clause
// An element of a mesh file, as its file names it.
#pragma once

#include <string>

#include "text/error.hpp"

namespace cli {

struct FileElement {
    std::string label;  // its number there; with the name of its instance
    Place place;        // the file, and the line where it has lines
};

}  // namespace cli
