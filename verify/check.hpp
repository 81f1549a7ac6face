// SPDX-License-Identifier: BSD-3-Clause
// Check, as all tests in C++ use it. A test lists itself: its definition is all that it needs. An exception fails it
// and unwinds all destructors before Check jumps out. No note is written of an assertion that holds: Check writes the
// line of each into a file, which costs more than what a loop over thousands of values asserts. A crash is then
// reported at the beginning of its test.
#pragma once

#include <check.h>

#undef fail  // delam::fail()
#undef ck_assert_msg
#define ck_assert_msg(expr, ...) \
    ((expr) ? static_cast<void>(0) : _ck_assert_failed(__FILE__, __LINE__, "Assertion '" #expr "' failed", __VA_ARGS__))

namespace tests {

// A test of this program, run with first <= loop < last.
struct Listed {
    Listed(const TTest& test, int first, int last);
};

// Runs once, before all tests.
struct Before {
    explicit Before(void (*function)());
};

void run_body(void (*body)(int), int loop);
template <void (*body)(int)>
void guarded(int loop) {
    run_body(body, loop);
}

// Returns the exit status. names: the only tests to run; all if there are none.
int run(int count = 0, char** names = nullptr);

}  // namespace tests

#define LOOP_TEST(name, first, last)                                                        \
    static void name##_body(int loop);                                                      \
    static const TTest name##_test{#name, tests::guarded<name##_body>, __FILE__, __LINE__}; \
    static const tests::Listed name##_listed(name##_test, first, static_cast<int>(last));   \
    static void name##_body([[maybe_unused]] int loop)
#define TEST(name) LOOP_TEST(name, 0, 1)
#define BEFORE_TESTS(function) static const tests::Before function##_before(function)
