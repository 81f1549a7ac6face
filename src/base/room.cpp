// SPDX-License-Identifier: BSD-3-Clause
#include "base/room.hpp"

#include <sys/mman.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

extern "C" {
int openblas_get_num_threads() __attribute__((weak));
void dsymv_(const char*, const int*, const double*, const double*, const int*, const double*, const int*, const double*,
            double*, const int*);
}

namespace delam {

namespace {

// Size of the mapping that OpenBLAS 0.3.21 makes on its first call (measured on x86-64).
constexpr std::size_t blas_buffer = std::size_t{128} << 20;

}  // namespace

void require_room(std::size_t bytes) { ::operator delete(::operator new(bytes)); }

void require_room(std::size_t bytes, std::size_t part) {
    std::vector<std::unique_ptr<std::byte[]>> parts(bytes / part + 1);
    for (auto& p : parts) p = std::make_unique_for_overwrite<std::byte[]>(part);
}

// OpenBLAS retries for ever a mapping that the system refuses, and never releases one that it got.
void prepare_blas() {
    static std::mutex mutex;
    static bool taken = false;
    if (openblas_get_num_threads == nullptr) return;
    const std::lock_guard lock(mutex);
    if (taken) return;
    void* room = mmap(nullptr, blas_buffer, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) throw std::bad_alloc();
    munmap(room, blas_buffer);
    const int one = 1;
    const double a = 1.0, x = 1.0;
    double y = 0.0;
    dsymv_("L", &one, &a, &a, &one, &x, &one, &a, &y, &one);
    taken = true;
}

}  // namespace delam
