// SPDX-License-Identifier: BSD-3-Clause
// The one way in which toml++ is included, so that all files agree on its configuration.
#pragma once

#include <toml++/toml.h>
