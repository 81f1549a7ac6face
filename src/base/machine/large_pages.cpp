// SPDX-License-Identifier: BSD-3-Clause
#include "base/machine/large_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace delam {

namespace {

constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
constexpr std::size_t enough = 2 * page;  // a block of this size contains a whole page
constexpr std::uintptr_t small_page = std::uintptr_t{1} << 12;
constexpr std::size_t many = 32 * small_page;  // for which one more call of the system is worth it

}  // namespace

void prefer_large_pages(void* memory, std::size_t bytes) noexcept {
    if (memory == nullptr || bytes < enough) return;
#ifdef MADV_HUGEPAGE
    const std::uintptr_t from = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) & ~(page - 1);
    const std::uintptr_t to = (reinterpret_cast<std::uintptr_t>(memory) + bytes) & ~(page - 1);
    (void)madvise(reinterpret_cast<void*>(from), to - from, MADV_HUGEPAGE);  // only advice: an error changes nothing
#endif
}

void take_pages(void* memory, std::size_t bytes) noexcept {
    if (memory == nullptr || bytes < many) return;
#ifdef MADV_POPULATE_WRITE
    const std::uintptr_t from = (reinterpret_cast<std::uintptr_t>(memory) + small_page - 1) & ~(small_page - 1);
    const std::uintptr_t to = (reinterpret_cast<std::uintptr_t>(memory) + bytes) & ~(small_page - 1);
    (void)madvise(reinterpret_cast<void*>(from), to - from, MADV_POPULATE_WRITE);  // an error changes nothing
#endif
}

}  // namespace delam
