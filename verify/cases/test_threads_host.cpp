// SPDX-License-Identifier: BSD-3-Clause
// The library as a guest in the host's process: independent contexts in threads, cancel from anywhere, no output, no
// signal handlers, no rand().
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "small_analysis.hpp"

namespace {

using reference::Scene;
using reference::Solver;

constexpr int few = 10;

cases::Bits analyse(std::int64_t subdomains) {
    const Scene scene = cases::small_enf(subdomains);
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, few);
    return cases::read_bits(solver);
}

TEST(two_threads_same_bits) {
    const auto alone = analyse(6);
    cases::Bits in_thread[2];
    std::string failure[2];
    std::thread threads[2];
    for (int t = 0; t < 2; ++t) {
        threads[t] = std::thread([&, t] {
            try {
                in_thread[t] = analyse(6);
            } catch (const std::exception& e) {
                failure[t] = e.what();
            }
        });
    }
    for (auto& thread : threads) thread.join();
    const Scene scene = cases::small_enf(6);
    const Solver names(scene, 0.0);
    for (int t = 0; t < 2; ++t) {
        cases::expect(failure[t].empty(), failure[t]);
        cases::expect_same(names, in_thread[t], alone, "thread " + std::to_string(t));
    }
}

struct Watch {
    int calls = 0;
    int stop_at = -1;
    std::thread::id thread;
    bool other_thread = false;
};

std::int32_t watch(const char* stage, std::int64_t, std::int64_t, void* user) {
    auto& w = *static_cast<Watch*>(user);
    ++w.calls;
    if (stage == nullptr || std::this_thread::get_id() != w.thread) w.other_thread = true;
    return w.stop_at >= 0 && w.calls >= w.stop_at ? 1 : 0;
}

// Cancelled at the first, second, ... call of the progress callback, the solver continues as if the step had never been
// requested.
TEST(cancel_through_progress) {
    const Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, few);
    const auto committed = cases::read_bits(solver);

    Watch w;
    w.thread = std::this_thread::get_id();
    REQUIRE(scene, delam_context_set_progress, scene.context(), watch, &w);
    solver.step(cases::small_time(few + 1));
    const int calls = w.calls;  // those of reading values, below, do not count
    const auto pending = cases::read_bits(solver);
    solver.rollback();
    cases::expect(calls > 0, "progress is reported during a step");
    cases::expect(!w.other_thread, "callbacks come on the caller's thread");

    for (int stop = 1; stop <= calls; stop = stop < 4 ? stop + 1 : 2 * stop) {
        w.calls = 0;
        w.stop_at = stop;
        const std::int32_t status = solver.advance(cases::small_time(few + 1));
        cases::expect(status == DELAM_CANCELLED,
                      "stopped at " + std::to_string(stop) + ": " + delam_status_name(status));
        cases::expect_same(solver, cases::read_bits(solver), committed, "after cancelling");
    }
    w.stop_at = -1;
    solver.step(cases::small_time(few + 1));
    cases::expect_same(solver, cases::read_bits(solver), pending, "the step after all");
    REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
    solver.commit();
    solver.step(cases::small_time(few + 2));
}

// The assembly of large meshes polls every few hundred cells: the time until a cancel takes effect does not grow with
// the mesh.
struct Assembly {
    std::int64_t polls = 0;
    static std::int32_t count(const char* stage, std::int64_t done, std::int64_t, void* user) {
        auto& a = *static_cast<Assembly*>(user);
        ++a.polls;
        const std::string now = stage;
        return now == "analyse" || (now == "condense" && done > 0) ? 1 : 0;  // assembled, of FETI the first subdomain
    }
};

LOOP_TEST(polls_while_assembling, 0, 2) {
    constexpr std::int64_t columns = 48, rows = 24, layers = 4;
    Scene scene(3, {0.48, 0.24}, {columns, rows}, {0.04, 0.04}, {layers, layers}, DELAM_HEX8);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.law(0, {1e12, 1e12, 100.0, 100.0, 200.0, 200.0});
    const auto base = scene.find(0, {0.0, 0.0, 0.0}, {0.48, 0.24, 0.0});
    for (const auto& axis : {std::vector<double>{1, 0, 0}, std::vector<double>{0, 1, 0}, std::vector<double>{0, 0, 1}})
        scene.hold(base, axis);
    scene.text("reduction", loop == 0 ? "condensed" : "feti");
    std::int64_t subdomains = 1;
    if (loop == 1) {
        subdomains = 4;
        scene.number("subdomains", static_cast<double>(subdomains));
    }
    Assembly assembly;
    REQUIRE(scene, delam_context_set_progress, scene.context(), Assembly::count, &assembly);
    delam_solver* solver = nullptr;
    const std::int32_t status = delam_solver_create(scene.problem(), 0.0, &solver);
    cases::expect(status == DELAM_CANCELLED && solver == nullptr, std::string("status ") + delam_status_name(status));
    const std::int64_t cells = 2 * columns * rows * layers / subdomains;
    cases::expect(assembly.polls >= cells / 256,
                  std::to_string(assembly.polls) + " polls while " + std::to_string(cells) + " cells were assembled");
    REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
}

struct Handshake {
    std::atomic<bool> inside{false};
    std::atomic<bool> cancelled{false};
};

// The callback lets the step continue only after the other thread has made its cancel request.
std::int32_t meet(const char*, std::int64_t, std::int64_t, void* user) {
    auto& h = *static_cast<Handshake*>(user);
    h.inside = true;
    while (!h.cancelled) std::this_thread::yield();
    return 0;
}

TEST(cancel_from_another_thread) {
    const Scene scene = cases::small_enf();
    Solver solver(scene, 0.0);
    cases::walk(solver, 1, few);
    const auto committed = cases::read_bits(solver);
    Handshake h;
    REQUIRE(scene, delam_context_set_progress, scene.context(), meet, &h);
    std::atomic<bool> over{false};
    std::thread other([&] {
        while (!h.inside && !over) std::this_thread::yield();
        delam_context_cancel(scene.context());
        h.cancelled = true;
    });
    const std::int32_t status = solver.advance(cases::small_time(few + 1));
    over = true;
    other.join();
    cases::expect(status == DELAM_CANCELLED, std::string("status ") + delam_status_name(status));
    cases::expect_same(solver, cases::read_bits(solver), committed, "after cancelling");
    REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
    solver.step(cases::small_time(few + 1));  // the request was consumed
}

// Runs a scene and provokes errors with both streams redirected to a file; returns what was written.
std::string written_during(void (*work)()) {
    std::fflush(stdout);
    std::fflush(stderr);
    char name[] = "/tmp/delam-output-XXXXXX";
    const int file = mkstemp(name);
    cases::expect(file >= 0, "temporary file");
    const int out = dup(1);
    const int err = dup(2);
    dup2(file, 1);
    dup2(file, 2);
    std::string failure;
    try {
        work();
    } catch (const std::exception& e) {
        failure = e.what();
    }
    std::fflush(stdout);
    std::fflush(stderr);
    dup2(out, 1);
    dup2(err, 2);
    close(out);
    close(err);
    std::string text(static_cast<std::size_t>(lseek(file, 0, SEEK_END)), '\0');
    lseek(file, 0, SEEK_SET);
    const auto got = read(file, text.data(), text.size());
    close(file);
    unlink(name);
    cases::expect(failure.empty(), failure);
    cases::expect(got == static_cast<ssize_t>(text.size()), "reading back");
    return text;
}

void provoke() {
    analyse(8);
    Scene scene(2, {1.0}, {2}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    delam_solver* solver = nullptr;
    cases::expect(delam_solver_create(scene.problem(), 0.0, &solver) < 0, "an empty scene is refused");
    cases::expect(solver == nullptr, "*out is NULL on error");
    cases::expect(delam_problem_set_elastic(scene.problem(), 0, -1.0, 0.3) == DELAM_ERROR_ARGUMENT, "negative modulus");
    cases::expect(delam_problem_set_elastic(scene.problem(), 0, std::nan(""), 0.3) == DELAM_ERROR_ARGUMENT, "NaN");
    cases::expect(delam_problem_set_text(scene.problem(), "no such option", "x") < 0, "unknown option");
    cases::expect(delam_solver_commit(nullptr) == DELAM_ERROR_HANDLE, "NULL handle");
    std::int64_t index = 0;
    cases::expect(delam_mesh_add_interface(scene.mesh(), 0, 7, 0.0, &index) < 0, "unknown body");
}

TEST(nothing_is_printed) {
    const std::string text = written_during(provoke);
    cases::expect(text.empty(), "the library wrote: " + text.substr(0, 200));
}

void host_handler(int, siginfo_t*, void*) {}

// glibc adds SA_RESTORER to every new handler; the host does not choose it.
constexpr int flags_of_the_host = SA_SIGINFO | SA_RESTART | SA_NODEFER | SA_ONSTACK | static_cast<int>(SA_RESETHAND);

bool same_handler(const struct sigaction& a, const struct sigaction& b) {
    if ((a.sa_flags & flags_of_the_host) != (b.sa_flags & flags_of_the_host)) return false;
    if (sigismember(&a.sa_mask, SIGUSR2) != sigismember(&b.sa_mask, SIGUSR2)) return false;
    return (a.sa_flags & SA_SIGINFO) != 0 ? a.sa_sigaction == b.sa_sigaction : a.sa_handler == b.sa_handler;
}

// A host with its own handlers for the signals that libraries tend to use: they keep function, flags and mask.
TEST(signals_are_untouched) {
    constexpr int taken[] = {SIGABRT, SIGTERM, SIGINT, SIGSEGV, SIGFPE};
    struct sigaction original[NSIG] = {};
    struct sigaction before[NSIG] = {};
    for (int s = 1; s < NSIG; ++s) sigaction(s, nullptr, &original[s]);
    for (const int s : taken) {
        struct sigaction own = {};
        own.sa_sigaction = host_handler;
        own.sa_flags = SA_SIGINFO | SA_RESTART;
        sigemptyset(&own.sa_mask);
        sigaddset(&own.sa_mask, SIGUSR2);
        sigaction(s, &own, nullptr);
    }
    for (int s = 1; s < NSIG; ++s) sigaction(s, nullptr, &before[s]);
    provoke();
    int changed = 0;
    for (int s = 1; s < NSIG; ++s) {
        struct sigaction now = {};
        sigaction(s, nullptr, &now);
        if (!same_handler(now, before[s])) changed = s;
    }
    for (const int s : taken) sigaction(s, &original[s], nullptr);
    cases::expect(changed == 0, "handler of signal " + std::to_string(changed) + " changed");
}

TEST(rand_is_untouched) {
    std::srand(20100609);
    int expected[8];
    for (int& r : expected) r = std::rand();
    std::srand(20100609);
    int seen[8];
    for (int i = 0; i < 4; ++i) seen[i] = std::rand();
    provoke();
    for (int i = 4; i < 8; ++i) seen[i] = std::rand();
    for (int i = 0; i < 8; ++i) cases::expect(seen[i] == expected[i], "rand() was used or reseeded");
}

}  // namespace
