// SPDX-License-Identifier: BSD-3-Clause
// The one way in which toml++ is included, so that all files agree on its configuration. Its assertions hold for no
// text that is not TOML, such as "[^"; behind them stand the errors that say so. Where NDEBUG is set it would even have
// the compiler build on them.
#pragma once

#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
