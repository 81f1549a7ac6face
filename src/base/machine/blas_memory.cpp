// SPDX-License-Identifier: BSD-3-Clause
#include "base/machine/blas_memory.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "base/machine/blas_threads.hpp"

// Weak symbols: the process decides at its start which BLAS it has. OpenBLAS' own BLAS and LAPACK libraries take their
// blocks with blas_memory_alloc().
extern "C" {
int openblas_get_num_threads() __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
int openblas_get_parallel() __attribute__((weak));
void* blas_memory_alloc(int) __attribute__((weak));
void blas_memory_free(void*) __attribute__((weak));
void daxpy_(const int*, const double*, const double*, const int*, double*, const int*);
}

namespace delam {

namespace {

// Size of a block in OpenBLAS 0.3.21 on x86-64 (measured); it is smaller on other processors.
constexpr std::size_t block = std::size_t{128} << 20;
// Size of a daxpy that makes OpenBLAS give each thread a part (it does above 10000).
constexpr std::size_t shared_work = 20000;
// Time to wait for threads of the BLAS that the system has started but not yet run.
constexpr std::chrono::milliseconds start_wait{200};

std::mutex mutex;
int prepared = 0;          // threads of the BLAS that have their blocks, 0: not even the caller's is mapped
std::int64_t callers = 0;  // callers for which blocks are mapped

// Returns the number of blocks that the system would grant now, up to `wanted`.
std::int64_t granted(std::int64_t wanted) {
    std::vector<void*> probe;
    probe.reserve(static_cast<std::size_t>(wanted));
    while (static_cast<std::int64_t>(probe.size()) < wanted) {
        void* room = mmap(nullptr, block, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (room == MAP_FAILED) break;
        probe.push_back(room);
    }
    for (void* room : probe) munmap(room, block);
    return static_cast<std::int64_t>(probe.size());
}

// Has blocks mapped for so many callers at once.
void map_blocks(std::int64_t count) {
    std::vector<void*> blocks(static_cast<std::size_t>(count));
    for (void*& b : blocks) b = blas_memory_alloc(0);
    for (void* b : blocks) blas_memory_free(b);
    callers = count;
}

// The other threads take their blocks before their first work, each on its own.
void start_threads() {
    std::vector<double> x(shared_work, 0.0), y(shared_work, 0.0);
    const int size = static_cast<int>(shared_work), one = 1;
    const double a = 1.0;
    daxpy_(&size, &a, x.data(), &one, y.data(), &one);
}

bool is_openblas() {
    return openblas_get_num_threads != nullptr && openblas_set_num_threads != nullptr &&
           openblas_get_parallel != nullptr && blas_memory_alloc != nullptr && blas_memory_free != nullptr;
}

}  // namespace

namespace {

// Threads that have their blocks already are counted all the same: nothing tells.
void prepare_openblas() {
    const std::lock_guard lock(mutex);
    const bool own_threads = openblas_get_parallel() == 1;  // 2: OpenMP's, whose blocks are mapped at the start
    const int threads = own_threads ? blas_threads() : 1;
    if (prepared >= threads) return;
    if (granted(threads) == threads) {
        if (callers == 0) map_blocks(1);
        if (threads > 1) start_threads();
        prepared = threads;
        return;
    }
    // Room for fewer belongs to the others first: one that never gets its block never ends either.
    if (callers == 0) {
        if (threads > 1) std::this_thread::sleep_for(start_wait);
        if (granted(1) == 0) throw std::bad_alloc();
        map_blocks(1);
    }
    if (threads > 1) leave_blas_one_thread();
    prepared = 1;
}

}  // namespace

void prepare_blas() {
    if (!is_openblas()) return;
    prepare_openblas();
    rest_blas_threads();
}

std::int64_t blas_callers(std::int64_t wanted) {
    if (!is_openblas() || wanted <= 1) return std::max<std::int64_t>(wanted, 1);
    const std::lock_guard lock(mutex);
    if (callers >= wanted) return wanted;
    const std::int64_t found = granted(wanted);
    if (found > callers) map_blocks(found);
    return std::clamp<std::int64_t>(callers, 1, wanted);
}

}  // namespace delam
