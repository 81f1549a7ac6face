// SPDX-License-Identifier: BSD-3-Clause
#define TOML_IMPLEMENTATION
#include "scene/table/toml.hpp"
