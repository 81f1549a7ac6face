// SPDX-License-Identifier: BSD-3-Clause
#include "base/large_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace delam {

namespace {

constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
constexpr std::size_t enough = 2 * page;  // a block of this size contains a whole page

}  // namespace

void prefer_large_pages(void* memory, std::size_t bytes) noexcept {
    if (memory == nullptr || bytes < enough) return;
#ifdef MADV_HUGEPAGE
    const std::uintptr_t from = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) & ~(page - 1);
    const std::uintptr_t to = (reinterpret_cast<std::uintptr_t>(memory) + bytes) & ~(page - 1);
    (void)madvise(reinterpret_cast<void*>(from), to - from, MADV_HUGEPAGE);  // only advice: an error changes nothing
#endif
}

}  // namespace delam
