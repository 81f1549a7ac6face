// SPDX-License-Identifier: BSD-3-Clause
// Reading an earlier step changes nothing; a gradient term is counted once where fronts are searched.
#include "mmf.hpp"
#include "small_analysis.hpp"

namespace {

using reference::Solver;

// Read displacements at step 1, commit step 2, read again: the displacements must be those of step 2.
LOOP_TEST(fields_after_a_selected_step, 0, 1) {
    (void)loop;
    auto scene = cases::small_enf(0);
    scene.text("backtracking", "on");
    Solver solver(scene, 0.0), plain(scene, 0.0);
    for (Solver* s : {&solver, &plain}) {
        s->step(cases::small_time(1));
        s->commit();
        s->step(cases::small_time(2));
    }
    REQUIRE(scene, delam_solver_look, solver.get(), 1);
    const auto earlier = solver.field("displacement");
    solver.commit();
    plain.commit();
    const auto now = solver.field("displacement");
    cases::expect(delam::same_bits(now, plain.field("displacement")), "displacements of the committed step");
    cases::expect(!delam::same_bits(now, earlier), "the load has grown");
}

// The margin of a search does not depend on the reduction of the bodies, with a gradient term either.
LOOP_TEST(gradient_term_in_the_search, 0, 2) {
    double margin[2], increment[2];
    for (int feti = 0; feti < 2; ++feti) {
        cases::Enf e;
        e.h = 1.5e-3;
        auto scene = cases::make_enf(e);
        scene.text("solution", "energetic");
        scene.text("reduction", feti != 0 ? "feti" : "condensed");
        delam_law* handle = nullptr;
        REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &handle);
        for (const auto& [key, value] :
             std::initializer_list<std::pair<const char*, double>>{{"normal_stiffness", 125e13},
                                                                   {"tangential_stiffness", 125e13},
                                                                   {"normal_onset", 1.0},
                                                                   {"tangential_onset", 1.0},
                                                                   {"normal_toughness", 25.0},
                                                                   {"tangential_toughness", 25.0},
                                                                   {"gradient", loop == 0 ? 0.0 : 1e-4}})
            scene.require(delam_law_set(handle, key, value), key);
        REQUIRE(scene, delam_problem_set_law, scene.problem(), 0, handle);
        delam_law_destroy(&handle);
        Solver solver(scene, 0.0);
        for (int k = 1; k <= 2; ++k) {
            solver.step(0.04 * k);
            margin[feti] = solver.value("search_margin");
            increment[feti] = solver.value("increment");
            solver.commit();
        }
    }
    cases::expect(margin[0] > -1e-9, "no candidate lies below");
    cases::expect_near(increment[0], increment[1], 1e-6, std::abs(increment[1]), "the state kept");
    cases::expect_near(margin[0], margin[1], 2e-2, std::abs(increment[1]), "margin");
}

}  // namespace
