// SPDX-License-Identifier: BSD-3-Clause
#include "stability.hpp"

namespace harness {
void stability_units(Study&) {}
}  // namespace harness
