// SPDX-License-Identifier: BSD-3-Clause
// The opaque handles and the one guard that every entry point runs behind.
//
// Objects share the context's innards, so that handles may be destroyed in any order. A magic number at the head of each handle tells a
// foreign or destroyed one as far as that can be seen.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/monitor.hpp"
#include "delam/delam.h"

namespace delam {
struct Law;
class Mesh;
struct Problem;
class Solver;

struct Context {
    Monitor monitor;
    std::string message;
};

inline constexpr std::uint64_t magic_context = 0x64656c616d637478;
inline constexpr std::uint64_t magic_mesh = 0x64656c616d6d6573;
inline constexpr std::uint64_t magic_law = 0x64656c616d6c6177;
inline constexpr std::uint64_t magic_problem = 0x64656c616d70726f;
inline constexpr std::uint64_t magic_solver = 0x64656c616d736f6c;
}  // namespace delam

struct delam_context {
    static constexpr std::uint64_t kind = delam::magic_context;
    std::uint64_t magic = kind;
    std::shared_ptr<delam::Context> context = std::make_shared<delam::Context>();
};

namespace delam {
template <std::uint64_t Magic, class Core>
struct Handle {
    static constexpr std::uint64_t kind = Magic;
    std::uint64_t magic = kind;
    std::shared_ptr<Context> context;
    std::shared_ptr<Core> core;
};
}  // namespace delam

struct delam_mesh : delam::Handle<delam::magic_mesh, delam::Mesh> {};
struct delam_law : delam::Handle<delam::magic_law, delam::Law> {};
struct delam_problem : delam::Handle<delam::magic_problem, delam::Problem> {};
struct delam_solver : delam::Handle<delam::magic_solver, delam::Solver> {};

namespace delam {

template <class H>
bool alive(const H* handle) noexcept {
    return handle != nullptr && handle->magic == H::kind;
}

// Runs body behind the exception barrier; its error text goes into the context of `self`. body returns void or a status.
template <class H, class Body>
std::int32_t guard(const H* self, Body&& body) noexcept {
    if (!alive(self)) return DELAM_ERROR_HANDLE;
    Context& context = *self->context;
    const auto say = [&context](const char* what) noexcept {
        try {
            context.message = what;
        } catch (...) {
            context.message.clear();
        }
    };
    try {
        if constexpr (std::is_void_v<decltype(body())>) {
            body();
            return DELAM_OK;
        } else {
            return body();
        }
    } catch (const Error& e) {
        say(e.what());
        return e.status();
    } catch (const std::bad_alloc&) {
        say("out of memory");
        return DELAM_ERROR_MEMORY;
    } catch (const std::exception& e) {
        say(e.what());
        return DELAM_ERROR_INTERNAL;
    } catch (...) {
        say("unknown exception");
        return DELAM_ERROR_INTERNAL;
    }
}

template <class H>
void destroy(H** handle) noexcept {
    if (handle == nullptr || !alive(*handle)) {
        if (handle != nullptr) *handle = nullptr;
        return;
    }
    (*handle)->magic = 0;
    delete *handle;
    *handle = nullptr;
}

// Argument checks; each throws Error(DELAM_ERROR_ARGUMENT) naming the argument, its value and its range.
void require_pointer(const void* pointer, const char* name);
void require_count(std::int64_t count, const char* name, std::int64_t smallest = 0);
void require_array(const void* pointer, std::int64_t count, const char* name);
void require_finite(const double* values, std::int64_t count, const char* name);
void require_capacity(std::int64_t capacity, std::int64_t needed, const char* name);
void require_base(std::int32_t index_base);

}  // namespace delam
