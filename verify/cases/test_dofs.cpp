// SPDX-License-Identifier: BSD-3-Clause
// The three meshes of the table in Zeman, Kruzik, Gruber (PANM 15, 2010), "Notched flexure tests", have its primal and
// dual DOF counts.
#include "enf.hpp"
#include "support.hpp"

namespace {

struct Row {
    double h;
    std::int64_t primal, dual;
};
constexpr Row table[] = {{1e-3, 1936, 242}, {0.75e-3, 3220, 322}, {0.5e-3, 6748, 482}};

LOOP_TEST(slides_table, 0, 3) {
    const Row& row = table[loop];
    cases::Enf e;
    e.h = row.h;
    const auto scene = cases::make_enf(e);
    std::int64_t primal = 0;
    std::int64_t dual = 0;
    REQUIRE(scene, delam_problem_dofs, scene.problem(), &primal, &dual);
    cases::expect(primal == row.primal, "primal DOFs " + std::to_string(primal));
    cases::expect(dual == row.dual, "dual DOFs " + std::to_string(dual));

    double length = 0.0;
    for (const double w : scene.pairs(0).weight) length += w;
    cases::expect_near(length, cases::enf_length, 1e-14, cases::enf_length, "sum of the pairs' weights");
    REQUIRE(scene, delam_problem_check, scene.problem());
}

}  // namespace
