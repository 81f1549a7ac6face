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
    // An empty view.
    constexpr View() noexcept = default;
    // Views `size` values from `data` on.
    constexpr View(const T* data, std::size_t size) noexcept : data_(data), size_(size) {}
    // Views a braced list, during the call that it is an argument of.
    View(std::initializer_list<T> list) noexcept : size_(list.size()) {
        data_ = list.begin();  // lives as long as the call's full expression
    }
    // Views whatever has data() and size(), such as a vector or an array.
    template <class Container, class = std::enable_if_t<
                                   std::is_convertible_v<decltype(std::declval<const Container&>().data()), const T*>>>
    View(const Container& container) noexcept : data_(container.data()), size_(container.size()) {}
    // Returns the first value; null where there is none.
    const T* data() const noexcept { return data_; }
    // Returns the number of values.
    std::size_t size() const noexcept { return size_; }
    // Returns the number of values, as delam.h counts.
    std::int64_t count() const noexcept { return static_cast<std::int64_t>(size_); }

private:
    const T* data_ = nullptr;
    std::size_t size_ = 0;
};

// A zero-terminated text owned by the caller.
class Text {
public:
    // Takes a text that outlives the call.
    Text(const char* text) noexcept : text_(text) {}
    // Takes the text of a string that outlives the call.
    Text(const std::string& text) noexcept : text_(text.c_str()) {}
    // Returns the text.
    const char* get() const noexcept { return text_; }

private:
    const char* text_;
};

}  // namespace delam

#endif
