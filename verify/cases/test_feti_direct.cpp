// SPDX-License-Identifier: BSD-3-Clause
// FETI against the direct reference: every eighth state of the ductile ENF analysis, 8 subdomains, every preconditioner
// except "none"; in the long tier all 40 states of a finer one, 2, 8 and 32 subdomains, every preconditioner and both
// gluings.
#include "feti_direct.hpp"
#include "support.hpp"

namespace {

std::vector<cases::FetiChoice> choices_of(const char* preconditioner) {
    std::vector<cases::FetiChoice> choices;
    for (const std::int64_t n : {2, 8, 32})
        for (const char* gluing : {"orthonormal", "redundant"}) choices.push_back({n, preconditioner, gluing});
    return choices;
}

// loop: 0 for the quick tier, then a preconditioner. The test itself computes the states, because OpenMP threads of the
// linear algebra do not survive Check's fork.
LOOP_TEST(same_displacement_step, 0, 5) {
    constexpr const char* preconditioners[] = {"none", "lumped", "dirichlet", "series"};
    if (loop > 0 && !cases::whole()) return;
    const cases::DirectStates states(loop == 0 ? 1e-3 : 0.5e-3, loop == 0 ? 8 : 1);
    const auto choices = loop > 0 ? choices_of(preconditioners[loop - 1])
                                  : std::vector<cases::FetiChoice>{{8, "lumped", "orthonormal"},
                                                                   {8, "dirichlet", "orthonormal"},
                                                                   {8, "series", "orthonormal"},
                                                                   {8, "series", "redundant"}};
    for (const auto& choice : choices)
        cases::solve_all(states, choice, [&](std::size_t i, const reference::Comparison& c, std::int32_t, double) {
            const std::string where = choice.text() + ", state " + std::to_string(i) + ": " + c.text();
            cases::expect_below(c.worst(), 1e-8, where);
            cases::expect(c.contacts == 0, where);
        });
}

}  // namespace
