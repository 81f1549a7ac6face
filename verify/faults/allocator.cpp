// SPDX-License-Identifier: BSD-3-Clause
#include "allocator.hpp"

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FAULTS_NO_ALLOCATOR
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define FAULTS_NO_ALLOCATOR
#endif
#endif

#if defined(__GLIBC__) && !defined(FAULTS_NO_ALLOCATOR)
#include <dlfcn.h>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace {

std::atomic<long> countdown{0}, live{0};
std::atomic<bool> failing{false}, keep_failing{false}, failed{false}, sparing{true};

bool spared(const void* caller) {
    Dl_info where{};
    if (dladdr(caller, &where) == 0 || where.dli_fname == nullptr) return false;
    return std::strstr(where.dli_fname, "libgomp") != nullptr || std::strstr(where.dli_fname, "blas") != nullptr;
}

// caller: the return address of the allocating code.
bool fails(const void* caller) {
    if (!failing.load(std::memory_order_relaxed)) return false;
    if (sparing && spared(caller)) return false;
    const long left = --countdown;
    if (left > 0 || (left < 0 && !keep_failing)) return false;
    failed = true;
    errno = ENOMEM;
    return true;
}

// The C library's own functions, found through the dynamic linker, so that valgrind, which replaces them there, sees
// each block. Resolving them may itself allocate; those allocations are served directly.
struct Real {
    void* (*malloc)(std::size_t) = __libc_malloc;
    void* (*calloc)(std::size_t, std::size_t) = __libc_calloc;
    void* (*realloc)(void*, std::size_t) = __libc_realloc;
    void* (*memalign)(std::size_t, std::size_t) = __libc_memalign;
    void (*free)(void*) = __libc_free;
};
template <class F>
F next(const char* name, F direct) {
    void* found = dlsym(RTLD_NEXT, name);
    return found != nullptr ? reinterpret_cast<F>(found) : direct;
}
Real& real() {
    static constinit Real functions;
    static constinit int state = 0;  // 0 not resolved yet, 1 being resolved, 2 known
    if (state == 0) {
        state = 1;
        const Real found{next("malloc", __libc_malloc), next("calloc", __libc_calloc), next("realloc", __libc_realloc),
                         next("memalign", __libc_memalign), next("free", __libc_free)};
        functions = found;
        state = 2;
    }
    return functions;
}

void* counted(void* p) {
    if (p != nullptr) ++live;
    return p;
}

}  // namespace

// Serves every library in the process, whatever the visibility of this program.
#pragma GCC visibility push(default)
extern "C" {
void* malloc(std::size_t n) { return fails(__builtin_return_address(0)) ? nullptr : counted(real().malloc(n)); }
void* calloc(std::size_t n, std::size_t size) {
    return fails(__builtin_return_address(0)) ? nullptr : counted(real().calloc(n, size));
}
void* realloc(void* old, std::size_t n) {
    if (fails(__builtin_return_address(0))) return nullptr;
    void* p = real().realloc(old, n);
    if (old == nullptr) return counted(p);
    if (p == nullptr && n == 0) --live;
    return p;
}
void* memalign(std::size_t alignment, std::size_t n) {
    return fails(__builtin_return_address(0)) ? nullptr : counted(real().memalign(alignment, n));
}
void* aligned_alloc(std::size_t alignment, std::size_t n) {
    return fails(__builtin_return_address(0)) ? nullptr : counted(real().memalign(alignment, n));
}
int posix_memalign(void** out, std::size_t alignment, std::size_t n) {
    if (fails(__builtin_return_address(0))) return ENOMEM;
    void* p = counted(real().memalign(alignment, n));
    if (p == nullptr) return ENOMEM;
    *out = p;
    return 0;
}
void free(void* p) {
    if (p != nullptr) --live;
    real().free(p);
}
}

void* operator new(std::size_t n) {
    if (void* p = malloc(n > 0 ? n : 1)) return p;
    throw std::bad_alloc();
}
void* operator new[](std::size_t n) { return operator new(n); }
void* operator new(std::size_t n, const std::nothrow_t&) noexcept { return malloc(n > 0 ? n : 1); }
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept { return malloc(n > 0 ? n : 1); }
void operator delete(void* p) noexcept { free(p); }
void operator delete[](void* p) noexcept { free(p); }
void operator delete(void* p, std::size_t) noexcept { free(p); }
void operator delete[](void* p, std::size_t) noexcept { free(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { free(p); }
void operator delete[](void* p, const std::nothrow_t&) noexcept { free(p); }
#pragma GCC visibility pop

namespace faults {

bool can_fail() { return true; }
void fail_at(long k, bool all) {
    failing = false;
    failed = false;
    keep_failing = all;
    countdown = k;
    failing = k > 0;
}
void spare_others(bool yes) { sparing = yes; }
bool stop_failing() {
    failing = false;
    return failed;
}
long live_blocks() { return live; }

}  // namespace faults
#else
namespace faults {
bool can_fail() { return false; }
void fail_at(long, bool) {}
void spare_others(bool) {}
bool stop_failing() { return false; }
long live_blocks() { return 0; }
}  // namespace faults
#endif
