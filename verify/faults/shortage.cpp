// SPDX-License-Identifier: BSD-3-Clause
// fault_shortage: scenes in processes with a limited address space (RLIMIT_AS). Each must end by itself with DELAM_OK
// or DELAM_ERROR_MEMORY and print nothing, whatever libraries are in use.
// fault_shortage blas: the same for processes that begin with the limit and have several threads of the BLAS, which
// need 128 MiB of addresses each and wait for ever where there are none.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <set>
#include <string>
#include <vector>

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

long size_of_process() {
    long pages = 0;
    std::FILE* size = std::fopen("/proc/self/statm", "r");
    if (size == nullptr || std::fscanf(size, "%ld", &pages) != 1) std::_Exit(3);
    std::fclose(size);
    return pages * sysconf(_SC_PAGESIZE);
}

void limit(long room) {
    const auto all = static_cast<rlim_t>(size_of_process() + room);
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
        faults::analyse(host, *strip);
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

// A process of its own under a limit: a scene whose dense factor (300 rows) all threads of the BLAS work on. Its exit
// code: `finished` + threads of the BLAS, 1: out of memory, 2: another failure.
constexpr int finished = 100;
int one_process() {
    alarm(most_seconds);
    faults::Strip strip;
    strip.cells = 150;
    strip.steps = 1;
    // Few factorisations: on busy cores each hand-over between threads of the BLAS waits for a time slice.
    strip.texts = {{"reduction", "condensed"}, {"minimisation", "alternate"}};
    try {
        Modest host;
        faults::analyse(host, strip);
        return finished + delam_blas_threads();
    } catch (const NoMemory&) {
        return 1;
    } catch (const std::bad_alloc&) {
        return 1;
    } catch (const std::exception& e) {
        std::printf("%s\n", e.what());
        return 2;
    }
}

int run_process(const char* program, int threads, long room) {
    std::FILE* words = std::tmpfile();
    if (words == nullptr) return 2;
    const pid_t pid = fork();
    if (pid == 0) {
        dup2(fileno(words), 1);
        dup2(fileno(words), 2);
        setenv("OPENBLAS_NUM_THREADS", std::to_string(threads).c_str(), 1);
        limit(room);
        execl(program, program, "one", nullptr);
        std::_Exit(3);
    }
    int how = 0;
    waitpid(pid, &how, 0);
    char text[300] = "";
    std::rewind(words);
    const std::size_t said = std::fread(text, 1, sizeof text - 1, words);
    std::fclose(words);
    std::printf("%d threads of the BLAS, room for %ld MiB: %s %d, said '%s'\n", threads, room >> 20,
                WIFEXITED(how) ? "exit code" : "signal", WIFEXITED(how) ? WEXITSTATUS(how) : WTERMSIG(how), text);
    const bool words_of_openblas = std::string(text).find("OpenBLAS: malloc failed") == 0;
    return WIFEXITED(how) && (said == 0 || words_of_openblas) ? WEXITSTATUS(how) : 2;
}

// Little room ends in DELAM_ERROR_MEMORY or where OpenBLAS finds no memory for its work queues, which it says, more may
// let the BLAS compute with one thread, and enough with all. Without room for the block of its other thread OpenBLAS
// itself does not let the process end, so there is no less.
int several_threads(const char* program) {
    const int all = run_process(program, 2, 1L << 30);  // fewer threads on one core, or of a serial OpenBLAS
    const std::set<int> allowed{1, finished + 1, all};
    if (all < finished) return EXIT_FAILURE;
    for (const long room : {176L, 208L, 240L, 272L, 304L, 336L, 368L, 432L})
        if (!allowed.contains(run_process(program, 2, room << 20))) return EXIT_FAILURE;
    return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** words) {
    if (shadowed) {
        std::printf("skipped: the sanitizer's own memory would meet the limit\n");
        return 77;
    }
    if (count > 1 && std::string(words[1]) == "one") return one_process();
    if (count > 1) return several_threads(words[0]);
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
