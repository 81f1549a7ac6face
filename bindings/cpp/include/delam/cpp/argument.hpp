// SPDX-License-Identifier: BSD-3-Clause
// Argument types for arrays and texts of the caller, which are not copied. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_ARGUMENT_HPP
#define DELAM_CPP_ARGUMENT_HPP

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>

namespace delam {

// Read-only contiguous values owned by the caller.
template <class T>
class View {
public:
    constexpr View() noexcept = default;
    constexpr View(const T* data, std::size_t size) noexcept : data_(data), size_(size) {}
    View(std::initializer_list<T> list) noexcept : size_(list.size()) {
        data_ = list.begin();  // lives as long as the call's full expression
    }
    template <class Container, class = std::enable_if_t<
                                   std::is_convertible_v<decltype(std::declval<const Container&>().data()), const T*>>>
    View(const Container& container) noexcept : data_(container.data()), size_(container.size()) {}
    const T* data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }
    std::int64_t count() const noexcept { return static_cast<std::int64_t>(size_); }

private:
    const T* data_ = nullptr;
    std::size_t size_ = 0;
};

// A zero-terminated text owned by the caller.
class Text {
public:
    Text(const char* text) noexcept : text_(text) {}
    Text(const std::string& text) noexcept : text_(text.c_str()) {}
    const char* get() const noexcept { return text_; }

private:
    const char* text_;
};

}  // namespace delam

#endif
