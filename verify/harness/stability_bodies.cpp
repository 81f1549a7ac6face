// SPDX-License-Identifier: BSD-3-Clause
#include "stability.hpp"

namespace harness {
void stability_bodies(Study&) {}
}  // namespace harness
