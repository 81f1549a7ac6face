// SPDX-License-Identifier: BSD-3-Clause
// FETI against the direct reference on all 40 states of the ductile ENF march: 2, 8 and 32 subdomains, every preconditioner, both gluings.
#include <memory>

#include "feti_direct.hpp"
#include "support.hpp"

namespace {

constexpr std::int64_t subdomains[] = {2, 8, 32};
constexpr const char* preconditioners[] = {"none", "lumped", "dirichlet", "series"};
constexpr const char* gluings[] = {"orthonormal", "redundant"};
constexpr int choices = 3 * 4 * 2;
std::unique_ptr<cases::DirectStates> states;
std::string failure;

void make_states() {
    if (states) return;
    try {
        states = std::make_unique<cases::DirectStates>(1);
    } catch (const std::exception& e) {
        failure = e.what();
    }
}

CASE_TEST(same_displacement_step) {
    cases::expect(states != nullptr, failure);
    const cases::FetiChoice choice{subdomains[loop / 8], preconditioners[loop / 2 % 4], gluings[loop % 2]};
    cases::solve_all(*states, choice, [&](std::size_t i, const reference::Comparison& c, double) {
        const std::string where = choice.text() + ", step " + std::to_string(i + 1) + ": " + c.text();
        cases::expect_below(c.worst(), 1e-8, where);
        cases::expect(c.contacts == 0, where);
    });
}

}  // namespace

int main() {
    Suite* suite = suite_create("feti and direct, all states");
    TCase* tests = tcase_create("ductile enf");
    tcase_add_unchecked_fixture(tests, make_states, nullptr);
    tcase_add_loop_test(tests, same_displacement_step, 0, choices);
    suite_add_tcase(suite, tests);
    const int result = cases::run_suite(suite);
    states.reset();
    return result;
}
