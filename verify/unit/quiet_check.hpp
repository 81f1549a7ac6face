// SPDX-License-Identifier: BSD-3-Clause
// Check without a note of every assertion that holds: Check writes the line of each into a file, which costs more than
// what a loop over thousands of values asserts. A crash is then reported at the beginning of its test.
// Included last: Check has a macro named fail.
#pragma once

#include <check.h>

#undef ck_assert_msg
#define ck_assert_msg(expr, ...) \
    ((expr) ? static_cast<void>(0) : _ck_assert_failed(__FILE__, __LINE__, "Assertion '" #expr "' failed", __VA_ARGS__))
