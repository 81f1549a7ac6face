// SPDX-License-Identifier: BSD-3-Clause
// Large arrays in large pages. The kernel clears memory page by page when it is first written, and each page of 4 KiB
// costs an interrupt: on an ENF of 149,000 displacements a tenth of the whole analysis. Linux's default
// (transparent_hugepage = madvise) takes pages of 2 MiB where a program asks for them.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace delam {

// Before the first write. Does nothing for small blocks, or where the system has no such pages.
void prefer_large_pages(void* memory, std::size_t bytes) noexcept;

template <class T>
class LargePages {
public:
    using value_type = T;
    LargePages() = default;
    template <class U>
    LargePages(const LargePages<U>&) noexcept {}
    T* allocate(std::size_t count) {
        T* memory = std::allocator<T>().allocate(count);
        prefer_large_pages(memory, count * sizeof(T));
        return memory;
    }
    void deallocate(T* memory, std::size_t count) noexcept { std::allocator<T>().deallocate(memory, count); }
    friend bool operator==(const LargePages&, const LargePages&) { return true; }
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace delam
