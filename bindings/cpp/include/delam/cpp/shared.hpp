// SPDX-License-Identifier: BSD-3-Clause
// Data that the objects share: handles, their context, exceptions of callbacks. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_SHARED_HPP
#define DELAM_CPP_SHARED_HPP

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "delam/cpp/status.hpp"
#include "delam/delam.h"

namespace delam {

using LogCallback = std::function<void(std::int32_t level, std::string_view text)>;
// false: stop, and the call ends with DELAM_CANCELLED unless it only reads.
using ProgressCallback = std::function<bool(std::string_view stage, std::int64_t done, std::int64_t total)>;

namespace detail {

template <class T, void (*destroy)(T**)>
struct Destroy {
    void operator()(T* handle) const noexcept { destroy(&handle); }
};
template <class T, void (*destroy)(T**)>
using Handle = std::unique_ptr<T, Destroy<T, destroy>>;

// The exception of a callback, until the call that runs it returns: callbacks run on the calling thread.
inline thread_local std::exception_ptr thrown;

// Shared by all objects of a context.
struct Shared {
    Handle<delam_context, delam_context_destroy> handle;
    LogCallback log;
    ProgressCallback progress;

    // The exception has precedence over the status that it caused.
    std::int32_t settle(std::int32_t status) const {
        if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
        if (status < 0) fail(status);
        return status;
    }
    void check(std::int32_t status) const {
        if (settle(status) != DELAM_OK) fail(status);
    }
    [[noreturn]] void fail(std::int32_t status) const {
        const std::string message = delam_context_message(handle.get());
        if (status == DELAM_ERROR_FILE) throw FileError(message);
        throw Error(status, message);
    }
};

inline std::size_t length(std::int64_t count) { return static_cast<std::size_t>(count); }

inline std::string copy(const char* text) { return text == nullptr ? std::string() : std::string(text); }

}  // namespace detail

}  // namespace delam

#endif
