// SPDX-License-Identifier: BSD-3-Clause
// fault_environment [LOCALE]: a host with its own locale, floating-point environment, signal handlers and random
// numbers gets the same results, bit by bit, and finds its environment unchanged.
#include <dlfcn.h>
#include <fenv.h>
#include <pthread.h>
#include <sys/time.h>

#include <array>
#include <atomic>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <locale>
#include <map>
#include <thread>

#include "scenes.hpp"

// The declarations of METIS also serve the library, which finds the function below in front of METIS's own.
#pragma GCC visibility push(default)
#include <metis.h>
#pragma GCC visibility pop

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace {

using faults::expect;
using Transcripts = std::map<std::string, faults::Transcript>;

// The library's message when it refuses numbers, with their decimals and digit grouping.
faults::Transcript refusals() {
    faults::Transcript said;
    delam_context* context = nullptr;
    expect(delam_context_create(&context) == DELAM_OK, "delam_context_create");
    const double lengths[] = {-1.5, 12345678.25}, thickness = 1.25;
    const std::int64_t one = 1, many = 1234567;
    delam_mesh* mesh = nullptr;
    delam_law* law = nullptr;
    expect(delam_mesh_create_layers(context, 2, lengths, &one, 1, &thickness, &one, DELAM_QUAD4, &mesh) < 0,
           "a negative length");
    said.add("length", std::string(delam_context_message(context)));
    expect(delam_mesh_create(context, 2, -many, lengths, &mesh) < 0, "a negative count");
    said.add("count", std::string(delam_context_message(context)));
    expect(delam_law_create(context, "piecewise-linear", &law) == DELAM_OK, "delam_law_create");
    expect(delam_law_set(law, "normal_onset", -0.125) < 0, "a negative onset");
    said.add("onset", std::string(delam_context_message(context)));
    delam_law_destroy(&law);
    delam_context_destroy(&context);
    return said;
}

Transcripts all() {
    Transcripts found;
    for (const faults::Strip& strip : faults::strips()) {
        faults::Calm host;
        faults::analyse(host, strip);
        found.emplace(strip.name, std::move(host.transcript));
    }
    found.emplace("refusals", refusals());
    return found;
}

const Transcripts& calm() {
    static const Transcripts found = all();
    return found;
}

void expect_same(const Transcripts& found) {
    for (const auto& [name, transcript] : calm()) {
        const std::string difference = transcript.difference(found.at(name));
        expect(difference.empty(), name + ": " + difference);
    }
}

// ---- locale

std::string locale_name;

void with_locale() {
    expect(std::setlocale(LC_ALL, locale_name.c_str()) != nullptr, "locale " + locale_name);
    const std::locale before = std::locale::global(std::locale(locale_name));
    char number[16];
    std::snprintf(number, sizeof number, "%.1f", 0.5);
    expect(std::strcmp(number, "0,5") == 0, std::string("the locale writes ") + number);
    try {
        expect_same(all());
    } catch (...) {
        std::locale::global(before);
        std::setlocale(LC_ALL, "C");
        throw;
    }
    expect(std::strcmp(std::setlocale(LC_NUMERIC, nullptr), locale_name.c_str()) == 0, "the locale was changed");
    std::locale::global(before);
    std::setlocale(LC_ALL, "C");
}

// ---- floating point

// Sets a special floating-point environment for its calls only.
class Elsewhere : public faults::Host {
public:
    explicit Elsewhere(const std::function<void()>& set) {
        fenv_t before;
        fegetenv(&before);
        set();
        fegetenv(&own_);
        fesetenv(&before);
    }
    void call(const std::string& name, Repeat, const Call& call, const Call&) override {
        fenv_t before;
        fegetenv(&before);
        fesetenv(&own_);
        const auto mine = what_counts();
        const std::int32_t status = call();
        const auto after = what_counts();
        fesetenv(&before);
        expect(status == DELAM_OK, name + ": " + delam_status_name(status) + ": " + message());
        expect(after == mine, name + ": the host's environment was changed");
    }

private:
    // Rounding, traps, flags, and the control word of SSE with its treatment of denormals. (An fenv_t also contains the
    // address of the last x87 instruction.)
    static std::array<unsigned, 4> what_counts() {
        unsigned sse = 0;
#if defined(__SSE2__)
        sse = _mm_getcsr();
#endif
        return {static_cast<unsigned>(fegetround()), static_cast<unsigned>(fegetexcept()),
                static_cast<unsigned>(fetestexcept(FE_ALL_EXCEPT)), sse};
    }
    fenv_t own_;
};

void with_environment(const std::function<void()>& set) {
    for (const faults::Strip& strip : faults::strips()) {
        Elsewhere host(set);
        faults::analyse(host, strip);
        const std::string difference = calm().at(strip.name).difference(host.transcript);
        expect(difference.empty(), strip.name + ": " + difference);
    }
}

void with_flushing() {
#if defined(__SSE2__)
    with_environment([] { _mm_setcsr(_mm_getcsr() | 0x8040u); });
#endif
}
void with_rounding_up() {
    with_environment([] { fesetround(FE_UPWARD); });
}
void with_rounding_to_zero() {
    with_environment([] { fesetround(FE_TOWARDZERO); });
}
void with_traps() {
    with_environment([] { feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW); });
}
// Flags raised before must stay, and the library must raise none.
void with_flags() {
    with_environment([] { feraiseexcept(FE_UNDERFLOW); });
}

// ---- signals and random numbers

std::atomic<long> cuts{0};  // bodies that METIS cut
std::atomic<long> ticks{0};
void tick(int) { ++ticks; }
void own(int, siginfo_t*, void*) {}

struct Process {
    struct sigaction abort_action, term_action;
    sigset_t mask;
    static Process now() {
        Process p;
        sigaction(SIGABRT, nullptr, &p.abort_action);
        sigaction(SIGTERM, nullptr, &p.term_action);
        pthread_sigmask(SIG_SETMASK, nullptr, &p.mask);
        return p;
    }
};
bool same(const struct sigaction& a, const struct sigaction& b) {
    constexpr int flags = SA_SIGINFO | SA_RESTART | SA_NODEFER | SA_ONSTACK;
    return a.sa_sigaction == b.sa_sigaction && (a.sa_flags & flags) == (b.sa_flags & flags);
}
bool same(const sigset_t& a, const sigset_t& b) {
    for (int s = 1; s < NSIG; ++s)
        if (sigismember(&a, s) != sigismember(&b, s)) return false;
    return true;
}

// A host that is interrupted a thousand times a second, blocks a signal, and relies on its handlers and its random
// numbers.
void with_signals() {
    struct sigaction before[NSIG] = {};
    for (const int s : {SIGABRT, SIGTERM, SIGALRM}) sigaction(s, nullptr, &before[s]);
    sigset_t blocked, mask_before;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGUSR2);
    pthread_sigmask(SIG_BLOCK, &blocked, &mask_before);
    struct sigaction handler = {};
    handler.sa_sigaction = own;
    handler.sa_flags = SA_SIGINFO;
    sigaction(SIGABRT, &handler, nullptr);
    sigaction(SIGTERM, &handler, nullptr);
    struct sigaction timer = {};
    timer.sa_handler = tick;
    sigaction(SIGALRM, &timer, nullptr);
    const Process mine = Process::now();
    const itimerval every{{0, 1000}, {0, 1000}}, never{};
    setitimer(ITIMER_REAL, &every, nullptr);

    // Another thread watches the handlers all the time: they must be the host's, except while METIS runs.
    std::atomic<bool> over{false};
    std::atomic<long> polls{0}, foreign{0};
    std::thread watcher([&] {
        sigset_t everything;
        sigfillset(&everything);
        pthread_sigmask(SIG_SETMASK, &everything, nullptr);
        while (!over) {
            ++polls;
            if (!same(Process::now().term_action, mine.term_action)) ++foreign;
        }
    });
    static char state[64];
    initstate(20100609, state, sizeof state);
    long expected[6];
    for (long& r : expected) r = random();
    char* const libraries = initstate(20100609, state, sizeof state);
    static_cast<void>(libraries);
    long seen[6];
    for (int i = 0; i < 3; ++i) seen[i] = random();
    std::string failure;
    Transcripts found;
    cuts = 0;
    try {
        found = all();
    } catch (const std::exception& e) {
        failure = e.what();
    }
    for (int i = 3; i < 6; ++i) seen[i] = random();
    const Process after = Process::now();
    over = true;
    watcher.join();
    setitimer(ITIMER_REAL, &never, nullptr);
    for (const int s : {SIGABRT, SIGTERM, SIGALRM}) sigaction(s, &before[s], nullptr);
    pthread_sigmask(SIG_SETMASK, &mask_before, nullptr);
    expect(failure.empty(), failure);
    expect_same(found);
    expect(same(after.abort_action, mine.abort_action), "the handler of SIGABRT was changed");
    expect(same(after.term_action, mine.term_action), "the handler of SIGTERM was changed");
    expect(same(after.mask, mine.mask), "the mask of signals was changed");
    expect(std::memcmp(expected, seen, sizeof seen) == 0, "the sequence of random() was changed");
    expect(ticks > 0, "the timer did not run");
    expect(cuts > 0, "METIS cut no body: its handlers and random numbers were not there to be put back");
    std::printf(
        "             interrupted %ld times; METIS cut %ld bodies, its handlers were there in %ld of %ld "
        "polls\n",
        ticks.load(), cuts.load(), foreign.load(), polls.load());
}

}  // namespace

// Counts the call and passes it on to METIS.
int METIS_PartGraphKway(idx_t* vertices, idx_t* constraints, idx_t* start, idx_t* neighbour, idx_t* weight, idx_t* size,
                        idx_t* edge_weight, idx_t* parts, real_t* targets, real_t* balance, idx_t* options, idx_t* cut,
                        idx_t* part) {
    static const auto metis = reinterpret_cast<decltype(&METIS_PartGraphKway)>(dlsym(RTLD_NEXT, "METIS_PartGraphKway"));
    const int status = metis(vertices, constraints, start, neighbour, weight, size, edge_weight, parts, targets,
                             balance, options, cut, part);
    if (status == METIS_OK && *parts > 1 && *cut > 0) ++cuts;
    return status;
}

int main(int argc, char** argv) {
    std::vector<std::pair<std::string, std::function<void()>>> tests{{"flush to zero", with_flushing},
                                                                     {"rounding up", with_rounding_up},
                                                                     {"rounding to 0", with_rounding_to_zero},
                                                                     {"traps", with_traps},
                                                                     {"flags", with_flags},
                                                                     {"signals", with_signals}};
    if (argc > 1) {
        locale_name = argv[1];
        tests = {{locale_name, with_locale}};
    }
    int failed = 0;
    for (const auto& [name, test] : tests) {
        try {
            calm();
            test();
            std::printf("%-13s same results\n", name.c_str());
        } catch (const std::exception& e) {
            std::printf("%-13s failed: %s\n", name.c_str(), e.what());
            ++failed;
        }
        std::fflush(stdout);
    }
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
