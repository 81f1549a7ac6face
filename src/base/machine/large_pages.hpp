// SPDX-License-Identifier: BSD-3-Clause
// Large arrays in large pages. The kernel clears memory page by page when it is first written, and each page of 4 KiB
// costs an interrupt: on an ENF of 149,000 displacements a tenth of the whole analysis. Linux's default
// (transparent_hugepage = madvise) takes pages of 2 MiB where a program asks for them. Smaller arrays can ask for all
// of their pages at once.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace delam {

// Asks for large pages; to be called before the first write. Does nothing for small blocks, or where the system has no
// such pages.
void prefer_large_pages(void* memory, std::size_t bytes) noexcept;
// Takes all pages of a new block at once, before the block is written as a whole. (Measured in a virtual machine: 3 us
// a page, 13 us one by one.) Does nothing for small blocks, or where the system cannot.
void take_pages(void* memory, std::size_t bytes) noexcept;

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
    // Numbers without a value are not set.
    template <class U>
    void construct(U* at) noexcept {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... From>
    void construct(U* at, From&&... from) {
        ::new (static_cast<void*>(at)) U(std::forward<From>(from)...);
    }
    friend bool operator==(const LargePages&, const LargePages&) { return true; }
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

// Room for so many elements, which will all be written soon.
template <class T>
void make_room(LargeVector<T>& list, std::size_t count) {
    if (list.capacity() >= count) return;
    list.reserve(count);
    take_pages(list.data() + list.size(), (count - list.size()) * sizeof(T));
}

}  // namespace delam
