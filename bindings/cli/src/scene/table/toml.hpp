// SPDX-License-Identifier: BSD-3-Clause
// The only include of toml++, so that all files agree on its configuration. Its assertions fail for texts that are not
// TOML, such as "[^", for which later code reports an error. With NDEBUG it would even let the compiler rely on them.
// toml.cpp compiles the functions of toml++ once for all files.
#pragma once

#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_HEADER_ONLY 0
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
