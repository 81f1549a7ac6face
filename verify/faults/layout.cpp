// SPDX-License-Identifier: BSD-3-Clause
// fault_layout [SCENE ...]: the results must have the same bits wherever memory blocks lie. A kernel that treats the
// first entries of an unaligned array separately adds them in another order, so that results would depend on the host's
// earlier allocations. Every block that may do so begins at a random multiple of 16 within 64 bytes.
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "scenes.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define FAULTS_NO_LAYOUT
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define FAULTS_NO_LAYOUT
#endif
#endif

#ifndef FAULTS_NO_LAYOUT
namespace {

// Stored in front of every block.
struct Front {
    void* begin;
    std::size_t size;
};
static_assert(sizeof(Front) == 16);

std::atomic<bool> scattered{false};
std::atomic<long> moved{0};  // blocks that were moved from their usual place
thread_local std::uint64_t seed = 0x9e3779b97f4a7c15;

std::uintptr_t chance() {
    seed ^= seed << 13U;
    seed ^= seed >> 7U;
    seed ^= seed << 17U;
    return static_cast<std::uintptr_t>(seed >> 33U) & 3U;
}

Front* front_of(void* block) { return static_cast<Front*>(block) - 1; }

}  // namespace

#pragma GCC visibility push(default)
extern "C" {
void* __libc_malloc(std::size_t);
void __libc_free(void*);

void* memalign(std::size_t alignment, std::size_t n) {
    if (alignment < 16) alignment = 16;
    const std::size_t room = sizeof(Front) + alignment + 48;
    void* begin = n <= SIZE_MAX - room ? __libc_malloc(n + room) : nullptr;
    if (begin == nullptr) {
        errno = ENOMEM;
        return nullptr;
    }
    std::uintptr_t at = reinterpret_cast<std::uintptr_t>(begin) + sizeof(Front);
    at = (at + alignment - 1) & ~(alignment - 1);
    if (alignment == 16 && scattered) {
        const std::uintptr_t by = chance();
        at += 16 * by;
        if (by > 0) ++moved;
    }
    void* block = reinterpret_cast<void*>(at);
    *front_of(block) = {begin, n};
    return block;
}
void* malloc(std::size_t n) { return memalign(16, n); }
void* aligned_alloc(std::size_t alignment, std::size_t n) { return memalign(alignment, n); }
int posix_memalign(void** out, std::size_t alignment, std::size_t n) {
    void* block = memalign(alignment, n);
    if (block == nullptr) return ENOMEM;
    *out = block;
    return 0;
}
void* calloc(std::size_t n, std::size_t size) {
    if (size > 0 && n > SIZE_MAX / size) return nullptr;
    void* block = malloc(n * size);
    return block != nullptr ? std::memset(block, 0, n * size) : nullptr;
}
void free(void* block) {
    if (block != nullptr) __libc_free(front_of(block)->begin);
}
void* realloc(void* old, std::size_t n) {
    void* block = malloc(n);
    if (old == nullptr || block == nullptr) return block;
    std::memcpy(block, old, std::min(n, front_of(old)->size));
    free(old);
    return block;
}
}
#pragma GCC visibility pop

int main(int argc, char** argv) {
    constexpr int runs = 3;
    int failures = 0;
    for (const faults::Strip& strip : faults::strips()) {
        bool wanted = argc <= 1;
        for (int i = 1; i < argc; ++i) wanted = wanted || strip.name == argv[i];
        if (!wanted) continue;
        try {
            scattered = false;
            faults::Calm calm;
            faults::analyse(calm, strip);
            scattered = true;
            moved = 0;
            for (int run = 0; run < runs; ++run) {
                faults::Calm other;
                faults::analyse(other, strip);
                const std::string difference = calm.transcript.difference(other.transcript);
                faults::expect(difference.empty(), "other places in memory: " + difference);
            }
            faults::expect(moved > 10000, "only " + std::to_string(moved.load()) + " blocks lay at other places");
            std::printf("%-12s %d runs with %ld blocks at other places; %zu results the same\n", strip.name.c_str(),
                        runs, moved.load(), calm.transcript.size());
        } catch (const std::exception& e) {
            std::printf("%-12s failed: %s\n", strip.name.c_str(), e.what());
            ++failures;
        }
    }
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
#else
int main() {
    std::printf("skipped: this build brings an allocator of its own\n");
    return 77;
}
#endif
