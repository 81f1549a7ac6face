// SPDX-License-Identifier: BSD-3-Clause
// fault_shortage: scenes in processes with a limited address space (RLIMIT_AS). Each must end by itself with DELAM_OK
// or DELAM_ERROR_MEMORY and print nothing, whatever libraries are in use.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "scenes.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool shadowed = true;  // a sanitizer maps far more memory than the program
#else
constexpr bool shadowed = false;
#endif

namespace {

constexpr unsigned most_seconds = 60;

struct NoMemory {};

// The first failing call ends the scene.
class Modest : public faults::Host {
public:
    void call(const std::string& name, Repeat, const Call& call, const Call&) override {
        const std::int32_t status = call();
        if (status == DELAM_ERROR_MEMORY) throw NoMemory();
        faults::expect(status == DELAM_OK, name + ": " + delam_status_name(status));
    }
};

void limit(long room) {
    long pages = 0;
    std::FILE* size = std::fopen("/proc/self/statm", "r");
    if (size == nullptr || std::fscanf(size, "%ld", &pages) != 1) std::_Exit(3);
    std::fclose(size);
    const auto all = static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE) + room);
    const rlimit as{all, all};
    if (setrlimit(RLIMIT_AS, &as) != 0) std::_Exit(3);
}

// 0: finished, 1: out of memory, 2: another failure.
int child(const faults::Strip* strip, long room, int words) {
    dup2(words, 1);
    dup2(words, 2);
    alarm(most_seconds);
    delam_context* first = nullptr;
    if (strip != nullptr && delam_context_create(&first) != DELAM_OK) return 2;
    limit(room);
    if (strip == nullptr) {  // not even the BLAS has its memory
        const std::int32_t status = delam_context_create(&first);
        return status == DELAM_OK ? 0 : status == DELAM_ERROR_MEMORY ? 1 : 2;
    }
    try {
        Modest host;
        faults::march(host, *strip);
        return 0;
    } catch (const NoMemory&) {
        return 1;
    } catch (const std::bad_alloc&) {  // in the host's own code
        return 1;
    } catch (const std::exception& e) {
        std::printf("%s\n", e.what());
        std::fflush(stdout);
        return 2;
    }
}

// Runs it and prints how it ended; false: not as required.
bool run(const faults::Strip* strip, long room, int& without) {
    std::FILE* words = std::tmpfile();
    if (words == nullptr) return false;
    std::fflush(stdout);  // not again in the child
    const pid_t pid = fork();
    if (pid == 0) std::_Exit(child(strip, room, fileno(words)));
    int how = 0;
    waitpid(pid, &how, 0);
    std::rewind(words);
    char text[300] = "";
    const std::size_t size = std::fread(text, 1, sizeof text - 1, words);
    text[size] = '\0';
    std::fclose(words);
    const bool fine = WIFEXITED(how) && WEXITSTATUS(how) <= 1 && size == 0;
    if (fine && WEXITSTATUS(how) == 1) ++without;
    if (!fine)
        std::printf("%s with room for %ld KiB: %s %d, and said '%s'\n",
                    strip != nullptr ? strip->name.c_str() : "first context", room / 1024,
                    WIFEXITED(how) ? "exit code" : "signal", WIFEXITED(how) ? WEXITSTATUS(how) : WTERMSIG(how), text);
    return fine;
}

}  // namespace

int main() {
    if (shadowed) {
        std::printf("skipped: the sanitizer's own memory would meet the limit\n");
        return 77;
    }
    int failed = 0;
    for (const faults::Strip& strip : faults::strips()) {
        int without = 0, processes = 0;
        for (long room = 0; room <= 8L << 20; room = room < 256L << 10 ? room + (32L << 10) : room * 5 / 4) {
            failed += run(&strip, room, without) ? 0 : 1;
            ++processes;
        }
        std::printf("%-12s %d processes, %d without enough memory\n", strip.name.c_str(), processes, without);
        if (without == 0) ++failed;
    }
    int without = 0;
    for (const long room : {0L, 1L << 20, 100L << 20, 120L << 20}) failed += run(nullptr, room, without) ? 0 : 1;
    std::printf("first context: refused in %d processes\n", without);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
