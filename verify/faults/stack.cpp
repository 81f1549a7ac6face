// SPDX-License-Identifier: BSD-3-Clause
// fault_stack [KIB]: every scene, and one whose dense factors all threads of the BLAS work on, in a thread with the
// least stack that the contract states, or with this one. A stack that is too small ends the process.
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "scenes.hpp"

namespace {

constexpr std::size_t least = 256;  // KiB, src/capi/CONTRACT.md

class Plain : public faults::Host {
public:
    void call(const std::string& name, Repeat, const Call& call, const Call&) override {
        const std::int32_t status = call();
        faults::expect(status == DELAM_OK, name + ": " + delam_status_name(status));
    }
};

void* analyse(void* strip) {
    try {
        Plain host;
        faults::analyse(host, *static_cast<const faults::Strip*>(strip));
        return nullptr;
    } catch (const std::exception& e) {
        std::printf("%s\n", e.what());
        return strip;
    }
}

// Runs in a process of its own; true if it ended well.
bool run(faults::Strip strip, std::size_t kib) {
    std::fflush(stdout);
    const pid_t pid = fork();
    if (pid == 0) {
        pthread_attr_t attributes;
        pthread_t thread;
        void* failed = &strip;
        pthread_attr_init(&attributes);
        if (pthread_attr_setstacksize(&attributes, kib << 10) != 0 ||
            pthread_create(&thread, &attributes, analyse, &strip) != 0)
            std::_Exit(2);
        pthread_join(thread, &failed);
        std::fflush(stdout);
        std::_Exit(failed == nullptr ? 0 : 1);
    }
    int how = 0;
    waitpid(pid, &how, 0);
    const bool fine = WIFEXITED(how) && WEXITSTATUS(how) == 0;
    std::printf("%-12s stack of %zu KiB: %s %d\n", strip.name.c_str(), kib, WIFEXITED(how) ? "exit code" : "signal",
                WIFEXITED(how) ? WEXITSTATUS(how) : WTERMSIG(how));
    return fine;
}

}  // namespace

int main(int count, char** words) {
    const std::size_t kib = count > 1 ? std::strtoul(words[1], nullptr, 10) : least;
    std::vector<faults::Strip> strips;
    for (const faults::Strip& strip : faults::strips())  // with two threads of the BLAS "feti" takes 17 s; so does one
        if (strip.name != "feti") strips.push_back(strip);  // in space, whose stack is as deep, in 0.2 s
    faults::Strip dense;
    dense.name = "dense";
    dense.cells = 150;
    dense.steps = 1;
    dense.texts = {{"reduction", "condensed"}};
    strips.push_back(dense);
    int failed = 0;
    for (const faults::Strip& strip : strips) failed += run(strip, kib) ? 0 : 1;
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
