// SPDX-License-Identifier: BSD-3-Clause
// The main program of the tests: PROGRAM [TEST ...]
#include "check.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace tests {
namespace {

struct Entry {
    const TTest* test;
    int first, last;
};

std::vector<Entry>& listed() {
    static std::vector<Entry> all;
    return all;
}

std::vector<void (*)()>& before() {
    static std::vector<void (*)()> all;
    return all;
}

}  // namespace

Listed::Listed(const TTest& test, int first, int last) { listed().push_back({&test, first, last}); }
Before::Before(void (*function)()) { before().push_back(function); }

void run_body(void (*body)(int), int loop) {
    // The copy lives outside every destructor, because Check leaves by longjmp or by ending the forked process.
    static char text[1200];
    try {
        body(loop);
        return;
    } catch (const std::exception& e) {
        std::snprintf(text, sizeof text, "%s", e.what());
    }
    ck_abort_msg("%s", text);
}

int run(int count, char** names) {
    // Check's own limit is four seconds.
    setenv("CK_DEFAULT_TIMEOUT", "3600", 0);
    Suite* suite = suite_create(program_invocation_short_name);
    TCase* tests = tcase_create("tests");
    for (void (*function)() : before()) tcase_add_unchecked_fixture(tests, function, nullptr);
    int found = 0;
    for (const Entry& e : listed()) {
        const auto asked = std::count(names, names + count, std::string(e.test->name));
        if (asked == 0 && count > 0) continue;
        found += asked > 0 ? 1 : 0;
        tcase_add_loop_test(tests, e.test, e.first, e.last);
    }
    suite_add_tcase(suite, tests);
    SRunner* runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 && found == count ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace tests

// A test with options of its own has another.
__attribute__((weak)) int main(int argc, char** argv) { return tests::run(argc - 1, argv + 1); }
