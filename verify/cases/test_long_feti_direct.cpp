// SPDX-License-Identifier: BSD-3-Clause
// FETI against the direct reference on all 40 states of the ductile ENF analysis: 2, 8 and 32 subdomains, every
// preconditioner, both gluings.
#include "feti_direct.hpp"
#include "support.hpp"

namespace {

constexpr std::int64_t subdomains[] = {2, 8, 32};
constexpr const char* preconditioners[] = {"none", "lumped", "dirichlet", "series"};
constexpr const char* gluings[] = {"orthonormal", "redundant"};
// The test itself computes the states, because OpenMP threads of the linear algebra do not survive Check's fork.
LOOP_TEST(same_displacement_step, 0, 4) {
    const cases::DirectStates states(0.5e-3, 1);
    for (const std::int64_t n : subdomains) {
        for (const char* gluing : gluings) {
            const cases::FetiChoice choice{n, preconditioners[loop], gluing};
            cases::solve_all(states, choice, [&](std::size_t i, const reference::Comparison& c, std::int32_t, double) {
                const std::string where = choice.text() + ", step " + std::to_string(i + 1) + ": " + c.text();
                cases::expect_below(c.worst(), 1e-8, where);
                cases::expect(c.contacts == 0, where);
            });
        }
    }
}

}  // namespace
