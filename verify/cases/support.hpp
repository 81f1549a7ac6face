// SPDX-License-Identifier: BSD-3-Clause
// Check with C++ test bodies: an exception fails the test, and unwinds all destructors before Check jumps out.
#pragma once

#include <check.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>

namespace cases {

inline void expect(bool condition, const std::string& text) {
    if (!condition) throw std::runtime_error(text);
}

// |value - exact| <= tolerance * scale
inline void expect_near(double value, double exact, double tolerance, double scale, const std::string& what) {
    if (std::abs(value - exact) <= tolerance * scale) return;
    char line[300];
    std::snprintf(line, sizeof line, "%s: %.17g instead of %.17g, off by %.2e of %.3g (allowed %.1e)", what.c_str(),
                  value, exact, std::abs(value - exact) / scale, scale, tolerance);
    throw std::runtime_error(line);
}

// value <= limit, NaN fails
inline void expect_below(double value, double limit, const std::string& what) {
    if (value <= limit) return;
    char line[600];
    std::snprintf(line, sizeof line, "%s: %.3e > %.3e", what.c_str(), value, limit);
    throw std::runtime_error(line);
}

inline void run_body(void (*body)(int), int loop) {
    std::string failure;
    try {
        body(loop);
        return;
    } catch (const std::exception& e) {
        failure = e.what();
    }
    // The copy lives outside every destructor, because Check leaves by longjmp or by ending the forked process.
    static char text[1200];
    std::snprintf(text, sizeof text, "%s", failure.c_str());
    failure = std::string();
    ck_abort_msg("%s", text);
}

// In the long tier (case/whole_NAME, see verify/CMakeLists.txt) a test runs everything, in the quick tier what finds
// most in little time.
inline bool whole() { return std::getenv("DELAM_WHOLE") != nullptr; }

inline int run_suite(Suite* suite) {
    SRunner* runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace cases

// The loop index of tcase_add_loop_test is `loop`.
#define CASE_TEST(name)                                    \
    static void name##_body(int loop);                     \
    START_TEST(name) { cases::run_body(name##_body, _i); } \
    END_TEST                                               \
    static void name##_body([[maybe_unused]] int loop)
