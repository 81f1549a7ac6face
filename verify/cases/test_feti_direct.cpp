// SPDX-License-Identifier: BSD-3-Clause
// FETI against the direct reference: every eighth state of the ductile ENF analysis, 8 subdomains, every preconditioner
// except "none".
#include "feti_direct.hpp"
#include "support.hpp"

namespace {

constexpr cases::FetiChoice choices[] = {{8, "lumped", "orthonormal"},
                                         {8, "dirichlet", "orthonormal"},
                                         {8, "series", "orthonormal"},
                                         {8, "series", "redundant"}};
// The test itself computes the states, because OpenMP threads of the linear algebra do not survive Check's fork.
TEST(same_displacement_step) {
    const cases::DirectStates states(1e-3, 8);
    for (const auto& choice : choices) {
        cases::solve_all(states, choice, [&](std::size_t i, const reference::Comparison& c, std::int32_t, double) {
            const std::string where = choice.text() + ", state " + std::to_string(i) + ": " + c.text();
            cases::expect_below(c.worst(), 1e-8, where);
            cases::expect(c.contacts == 0, where);
        });
    }
}

}  // namespace
