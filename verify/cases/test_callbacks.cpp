// SPDX-License-Identifier: BSD-3-Clause
// From inside a callback nothing can be done to the running context: calls are refused, destroyed objects live until
// the end of the call, and the call itself ends with the digits that it would have had. Another context may be used
// there.
#include <functional>
#include <string>
#include <vector>

#include "host_bilinear.hpp"
#include "small_analysis.hpp"

namespace {

using reference::Scene;
using reference::Solver;

// Acts once, at the third poll.
struct Watch {
    std::function<void()> act;
    int polls = 0;
    static std::int32_t poll(const char*, std::int64_t, std::int64_t, void* user) {
        auto& w = *static_cast<Watch*>(user);
        if (++w.polls == 3) w.act();
        return 0;
    }
    void listen(const Scene& scene) { REQUIRE(scene, delam_context_set_progress, scene.context(), poll, this); }
};

// Calls that a callback may try; each of them is refused.
void try_everything(const Scene& scene, delam_solver* solver) {
    int asked = 0;
    const auto refused = [&](std::int32_t status, const char* call) {
        ++asked;
        cases::expect(status == DELAM_ERROR_STATE, std::string(call) + ": " + delam_status_name(status));
        cases::expect(std::string(delam_context_message(scene.context())).find("callback") != std::string::npos,
                      "no message");
    };
    double value = 0.0;
    std::int64_t count = 0;
    delam_solver* none = nullptr;
    delam_law* law = nullptr;
    refused(delam_solver_value(solver, "time", &value), "value");
    refused(delam_solver_advance(solver, 2.0), "advance");
    refused(delam_solver_commit(solver), "commit");
    refused(delam_solver_rollback(solver), "rollback");
    refused(delam_solver_save(solver, 0, nullptr, &count), "save");
    refused(delam_solver_create(scene.problem(), 0.0, &none), "create");
    refused(delam_problem_set_number(scene.problem(), "damage_tolerance", 0.5), "set_number");
    refused(delam_mesh_node_origins(scene.mesh(), 0, &count), "origins");
    refused(delam_law_create(scene.context(), "griffith", &law), "law_create");
    refused(delam_context_set_log(scene.context(), nullptr, nullptr), "set_log");
    cases::expect(none == nullptr && law == nullptr && count == 0 && asked == 10, "something was made");
    cases::expect(delam_solver_option(solver, "solution") == nullptr, "a text was given");
}

TEST(in_progress) {
    (void)loop;
    const Scene scene = cases::small_enf(0);
    Solver plain(scene, 0.0), watched(scene, 0.0);
    cases::walk(plain, 1, 6);
    cases::walk(watched, 1, 5);
    Watch watch;
    watch.act = [&] { try_everything(scene, watched.get()); };
    watch.listen(scene);
    watched.step(cases::small_time(6));
    REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
    watched.commit();
    cases::expect(watch.polls >= 3, "nothing was tried");
    cases::expect_same(watched, cases::read_bits(watched), cases::read_bits(plain), "after the step");
    cases::expect(watched.save() == plain.save(), "snapshots differ");
}

// The log receives errors, but not those that it causes itself.
struct Log {
    const Scene* scene = nullptr;
    int lines = 0;
    std::int32_t status = DELAM_OK;
    static void line(std::int32_t, const char*, void* user) {
        auto& log = *static_cast<Log*>(user);
        ++log.lines;
        log.status = delam_problem_set_number(log.scene->problem(), "damage_tolerance", 0.5);
    }
};

TEST(in_the_log) {
    (void)loop;
    Scene scene = cases::small_enf(0);
    Log log{&scene};
    REQUIRE(scene, delam_context_set_log, scene.context(), Log::line, &log);
    cases::expect(delam_problem_set_number(scene.problem(), "no_such_option", 1.0) == DELAM_ERROR_ARGUMENT,
                  "an option that is none");
    cases::expect(log.lines == 1 && log.status == DELAM_ERROR_STATE,
                  std::to_string(log.lines) + " lines, " + delam_status_name(log.status));
    cases::expect(std::string(delam_context_message(scene.context())).find("no_such_option") != std::string::npos,
                  "the message is another one's");
    REQUIRE(scene, delam_context_set_log, scene.context(), nullptr, nullptr);
    scene.number("damage_tolerance", 1e-7);
}

// A host law that calls the solver for which it works.
struct Asking {
    laws::Bilinear law;
    delam_solver* solver = nullptr;
    int refused = 0, other = 0;
    static std::int32_t adhesion(double mixity, double driving, double* zeta, double* slope, void* user) {
        auto& self = *static_cast<Asking*>(user);
        double value = 0.0;
        if (self.solver != nullptr)
            ++(delam_solver_value(self.solver, "time", &value) == DELAM_ERROR_STATE ? self.refused : self.other);
        return laws::adhesion(mixity, driving, zeta, slope, &self.law);
    }
    static std::int32_t dissipation(double mixity, double zeta, double* g, double* slope, double* mixity_slope,
                                    void* user) {
        return laws::dissipation(mixity, zeta, g, slope, mixity_slope, &static_cast<Asking*>(user)->law);
    }
};

TEST(in_a_law) {
    (void)loop;
    const Scene scene = cases::small_enf(0);
    Asking asking;
    delam_law* law = nullptr;
    REQUIRE(scene, delam_law_create_host, scene.context(), "asking", Asking::adhesion, Asking::dissipation, &asking,
            &law);
    const reference::Law owned(law);
    for (const char* key : {"normal_stiffness", "tangential_stiffness"})
        scene.require(delam_law_set(law, key, 1e14), key);
    REQUIRE(scene, delam_problem_set_law, scene.problem(), 0, law);
    Solver solver(scene, 0.0);
    asking.solver = solver.get();
    cases::walk(solver, 1, 6);
    cases::expect(asking.refused > 0 && asking.other == 0,
                  std::to_string(asking.refused) + " refused, " + std::to_string(asking.other) + " not");
}

// A law of another context, which is not running, destroyed by its own callback while a problem copies it.
struct Ending {
    laws::Bilinear law;
    delam_law* handle = nullptr;
    int later = 0;  // calls since it was destroyed
    static std::int32_t dissipation(double mixity, double zeta, double* g, double* slope, double* mixity_slope,
                                    void* user) {
        auto& self = *static_cast<Ending*>(user);
        if (self.handle == nullptr) ++self.later;
        delam_law_destroy(&self.handle);
        return laws::dissipation(mixity, zeta, g, slope, mixity_slope, &self.law);
    }
    static std::int32_t adhesion(double mixity, double driving, double* zeta, double* slope, void* user) {
        return laws::adhesion(mixity, driving, zeta, slope, &static_cast<Ending*>(user)->law);
    }
};

TEST(law_that_ends_itself) {
    (void)loop;
    const Scene scene = cases::small_enf(0), elsewhere = cases::small_enf(0);
    Ending ending;
    REQUIRE(scene, delam_law_create_host, elsewhere.context(), "ending", Ending::adhesion, Ending::dissipation, &ending,
            &ending.handle);
    for (const char* key : {"normal_stiffness", "tangential_stiffness"})
        scene.require(delam_law_set(ending.handle, key, 1e14), key);
    REQUIRE(scene, delam_problem_set_law, scene.problem(), 0, ending.handle);
    cases::expect(ending.handle == nullptr && ending.later > 0, "it has not ended, or was not needed any more");
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, 2);
}

// Objects destroyed in the middle of a step live until the step has ended.
TEST(destroyed_at_work) {
    (void)loop;
    for (const bool energetic : {false, true}) {
        Scene scene = cases::small_enf(0);
        if (energetic) scene.text("solution", "energetic");
        delam_solver* solver = nullptr;
        delam_law* law = nullptr;
        REQUIRE(scene, delam_solver_create, scene.problem(), 0.0, &solver);
        REQUIRE(scene, delam_law_create, scene.context(), "griffith", &law);
        Watch watch;
        delam_solver* const at_work = solver;
        watch.act = [&] {
            delam_solver_destroy(&solver);
            delam_law_destroy(&law);
            cases::expect(solver == nullptr && law == nullptr, "handles are not NULL");
            double value = 0.0;
            cases::expect(delam_solver_value(at_work, "time", &value) == DELAM_ERROR_HANDLE,
                          "an ended handle was taken");
        };
        watch.listen(scene);
        REQUIRE(scene, delam_solver_advance, solver, cases::small_time(6));
        cases::expect(watch.polls >= 3 && solver == nullptr, "nothing was destroyed");
        REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
        Solver again(scene, 0.0);
        cases::walk(again, 1, 2);
    }
}

TEST(another_island) {
    (void)loop;
    const Scene scene = cases::small_enf(0), other = cases::small_enf(0);
    Solver solver(scene, 0.0), plain(other, 0.0);
    Watch watch;
    watch.act = [&] { cases::walk(plain, 1, 6); };
    watch.listen(scene);
    cases::walk(solver, 1, 6);
    REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
    cases::expect_same(solver, cases::read_bits(solver), cases::read_bits(plain), "both");
}

}  // namespace
