// SPDX-License-Identifier: BSD-3-Clause
// Counts the bytes that the whole program has allocated, including CHOLMOD and LAPACK: include it in one file of a test
// program. Counts nothing without glibc or under a sanitiser that has its own allocator.
#pragma once

#include <atomic>
#include <cerrno>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define UNIT_NO_COUNT
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define UNIT_NO_COUNT
#endif
#endif

namespace unit {
inline std::atomic<long> live_bytes{0}, peak_bytes{0};
#if defined(__GLIBC__) && !defined(UNIT_NO_COUNT)
inline constexpr bool counting = true;
inline void* counted(void* pointer, long bytes) {
    const long now = live_bytes.fetch_add(bytes) + bytes;
    for (long peak = peak_bytes; now > peak && !peak_bytes.compare_exchange_weak(peak, now);) {
    }
    return pointer;
}
#else
inline constexpr bool counting = false;
#endif
}  // namespace unit

#if defined(__GLIBC__) && !defined(UNIT_NO_COUNT)
#include <malloc.h>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t n) {
    void* p = __libc_malloc(n);
    return p == nullptr ? p : unit::counted(p, static_cast<long>(malloc_usable_size(p)));
}
void* calloc(std::size_t n, std::size_t size) {
    void* p = __libc_calloc(n, size);
    return p == nullptr ? p : unit::counted(p, static_cast<long>(malloc_usable_size(p)));
}
void* realloc(void* old, std::size_t n) {
    const long before = old == nullptr ? 0 : static_cast<long>(malloc_usable_size(old));
    void* p = __libc_realloc(old, n);
    if (p == nullptr) {
        if (n == 0) unit::live_bytes -= before;
        return p;
    }
    return unit::counted(p, static_cast<long>(malloc_usable_size(p)) - before);
}
void* memalign(std::size_t alignment, std::size_t n) {
    void* p = __libc_memalign(alignment, n);
    return p == nullptr ? p : unit::counted(p, static_cast<long>(malloc_usable_size(p)));
}
void* aligned_alloc(std::size_t alignment, std::size_t n) { return memalign(alignment, n); }
int posix_memalign(void** out, std::size_t alignment, std::size_t n) {
    *out = memalign(alignment, n);
    return *out == nullptr ? ENOMEM : 0;
}
void free(void* p) {
    if (p != nullptr) unit::live_bytes -= static_cast<long>(malloc_usable_size(p));
    __libc_free(p);
}
}
#endif
