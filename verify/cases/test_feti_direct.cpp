// SPDX-License-Identifier: BSD-3-Clause
// FETI against the direct reference: every eighth state of the ductile ENF march, 8 subdomains, every preconditioner but none.
#include <memory>

#include "feti_direct.hpp"
#include "support.hpp"

namespace {

constexpr cases::FetiChoice choices[] = {{8, "lumped", "orthonormal"},
                                         {8, "dirichlet", "orthonormal"},
                                         {8, "series", "orthonormal"},
                                         {8, "series", "redundant"}};
std::unique_ptr<cases::DirectStates> states;
std::string failure;

void make_states() {
    if (states) return;
    try {
        states = std::make_unique<cases::DirectStates>(8);
    } catch (const std::exception& e) {
        failure = e.what();
    }
}

CASE_TEST(same_displacement_step) {
    cases::expect(states != nullptr, failure);
    const auto& choice = choices[loop];
    cases::solve_all(*states, choice, [&](std::size_t i, const reference::Comparison& c, double) {
        const std::string where = choice.text() + ", state " + std::to_string(i) + ": " + c.text();
        cases::expect_below(c.worst(), 1e-8, where);
        cases::expect(c.contacts == 0, where);
    });
}

}  // namespace

int main() {
    Suite* suite = suite_create("feti and direct");
    TCase* tests = tcase_create("ductile enf");
    tcase_add_unchecked_fixture(tests, make_states, nullptr);
    tcase_add_loop_test(tests, same_displacement_step, 0, 4);
    suite_add_tcase(suite, tests);
    const int result = cases::run_suite(suite);
    states.reset();
    return result;
}
