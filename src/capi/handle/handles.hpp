// SPDX-License-Identifier: BSD-3-Clause
// The opaque handles and guard(), in which every entry point runs.
//
// Objects share the data of their context, so that handles may be destroyed in any order. A magic number at the start
// of each handle identifies foreign and destroyed handles, as long as the memory has not been reused.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/machine/float_environment.hpp"
#include "base/monitor.hpp"
#include "capi/handle/listed.hpp"
#include "delam/delam.h"
#include "evolution/analysis/plan.hpp"
#include "evolution/analysis/stages.hpp"
#include "linalg/sparse/sparse.hpp"

namespace delam {
struct Law;
class Mesh;
struct Problem;
class Solver;

struct Context {
    Monitor monitor;
    std::string message;
    bool busy = false;  // a call is running
    struct Ended {
        void* handle;
        void (*free)(void*);
    };
    std::vector<Ended> ended;  // destroyed by a callback during this call
};

// The duration of one call. Handles that a callback destroys stay alive until its end.
class Busy {
public:
    explicit Busy(Context& context) noexcept : context_(context) { context_.busy = true; }
    ~Busy() {
        context_.busy = false;
        const std::vector<Context::Ended> ended = std::exchange(context_.ended, {});
        for (const Context::Ended& e : ended) e.free(e.handle);
    }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

private:
    Context& context_;
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
struct delam_problem : delam::Handle<delam::magic_problem, delam::Problem> {
    // Names of patterns at stable addresses (delam_problem_pattern_name).
    std::deque<std::string> names;
    // The stiffness requested last, because delam_problem_body_matrix is first called for its sizes; body -1: none.
    struct BodyMatrix {
        std::int32_t body = -1;
        delam::BodyModel model;
        delam::SparseMatrix matrix;
    };
    mutable BodyMatrix assembled;
    // Texts that delam_problem_option, delam_problem_value_info and delam_problem_plan return.
    mutable std::string option, value_key;
    std::string plan_words;
};
struct delam_solver : delam::Handle<delam::magic_solver, delam::Solver> {
    delam::Stages stages;                  // replaces the core where supports begin or end
    std::vector<std::string> value_names;  // texts returned by delam_solver_value_name and delam_solver_plan
    std::vector<delam::PlanItem> plan;     // owns the texts that delam_solver_plan_item returns
    std::vector<std::vector<delam::PlanItem>> earlier_plans;  // the host may still hold their texts
    std::string plan_words;
    mutable std::string option;  // returned by delam_solver_option
};

namespace delam {

template <class H>
bool alive(const H* handle) noexcept {
    return handle != nullptr && handle->magic == H::kind;
}

// Stores the message and passes it to the host's log: level 0 for an error, 1 for an outcome.
inline std::int32_t report(Context& context, std::int32_t status, const char* what) noexcept {
    try {
        context.message = what;
    } catch (...) {
        context.message.clear();
        return status;
    }
    try {
        context.monitor.log(status < 0 ? 0 : 1, what);
        context.message = what;  // again, because a call made by the log callback may have replaced it
    } catch (...) {              // the message says what the log lacks
    }
    return status;
}

// Refuses a call made from inside a callback. Does not write to the log, because the log callback may have made the
// call.
inline std::int32_t refuse_callback(Context& context) noexcept {
    try {
        context.message =
            "called from inside a callback of the same context, or from another thread during a call with this "
            "context: only delam_context_cancel is allowed";
    } catch (...) {
        context.message.clear();
    }
    return DELAM_ERROR_STATE;
}

// Runs body and turns its exceptions into a status; the message goes into the context of `self`. body returns void or a
// status. Of the statuses that callbacks of the host bring about, only those `listed` are returned.
template <class H, class Body>
std::int32_t guard(const H* self, Listed listed, Body&& body) noexcept {
    if (!alive(self)) return DELAM_ERROR_HANDLE;
    const std::shared_ptr<Context> context = self->context;  // outlives a handle that a callback destroys
    if (context->busy) return refuse_callback(*context);
    const Busy busy(*context);
    const DefaultFloats floats;
    const NoCancelScope silence;
    try {
        if constexpr (std::is_void_v<decltype(body())>) {
            body();
            return DELAM_OK;
        } else {
            return body();
        }
    } catch (const Error& e) {
        return report(*context, listed.in_place_of(e.status()), e.what());
    } catch (const std::bad_alloc&) {
        return report(*context, DELAM_ERROR_MEMORY, "out of memory");
    } catch (const std::length_error&) {
        return report(*context, DELAM_ERROR_MEMORY, "out of memory: more entries than an array can have");
    } catch (const std::exception& e) {
        return report(*context, DELAM_ERROR_INTERNAL, e.what());
    } catch (...) {
        return report(*context, DELAM_ERROR_INTERNAL, "unknown exception");
    }
}

template <class H, class Body>
std::int32_t guard(const H* self, Body&& body) noexcept {
    return guard(self, Listed::everything(), body);
}

// Does what guard() does, for calls whose contract lists `cancelled`. CancelScope::Call says what may stop each of the
// three.
template <class H, class Body>
std::int32_t guard_cancellable(const H* self, Listed listed, CancelScope::Call call, Body&& body) noexcept {
    return guard(self, listed, [&] {
        const CancelScope scope(self->context->monitor, call);
        return body();
    });
}
template <class H, class Body>
std::int32_t guard_solve(const H* self, Listed listed, Body&& body) noexcept {
    return guard_cancellable(self, listed, CancelScope::Call::solves, body);
}
template <class H, class Body>
std::int32_t guard_solve(const H* self, Body&& body) noexcept {
    return guard_solve(self, Listed::everything(), body);
}
template <class H, class Body>
std::int32_t guard_build(const H* self, Listed listed, Body&& body) noexcept {
    return guard_cancellable(self, listed, CancelScope::Call::builds, body);
}
template <class H, class Body>
std::int32_t guard_build(const H* self, Body&& body) noexcept {
    return guard_build(self, Listed::everything(), body);
}
template <class H, class Body>
std::int32_t guard_read(const H* self, Listed listed, Body&& body) noexcept {
    return guard_cancellable(self, listed, CancelScope::Call::reads, body);
}
template <class H, class Body>
std::int32_t guard_read(const H* self, Body&& body) noexcept {
    return guard_read(self, Listed::everything(), body);
}

template <class H>
void destroy(H** handle) noexcept {
    if (handle == nullptr || !alive(*handle)) {
        if (handle != nullptr) *handle = nullptr;
        return;
    }
    (*handle)->magic = 0;
    H* const ended = std::exchange(*handle, nullptr);
    if (!ended->context->busy) {
        delete ended;
        return;
    }
    try {
        ended->context->ended.push_back({ended, [](void* h) { delete static_cast<H*>(h); }});
    } catch (...) {  // no memory to remember the handle: a leak is better than freeing it while it is in use
    }
}

// Argument checks; each throws Error(DELAM_ERROR_ARGUMENT) naming the argument, its value and its range.
void require_pointer(const void* pointer, const char* name);
void require_count(std::int64_t count, const char* name, std::int64_t smallest = 0);
// Requires a count of entries, each of which is another one of `largest` things.
void require_count_up_to(std::int64_t count, const char* name, std::int64_t smallest, std::int64_t largest);
void require_array(const void* pointer, std::int64_t count, const char* name);
void require_finite(const double* values, std::int64_t count, const char* name);
// Refuses outputs of one call that share entries.
void require_apart(const double* a, const char* name_a, std::int64_t count_a, const double* b, const char* name_b,
                   std::int64_t count_b);
void require_capacity(std::int64_t capacity, std::int64_t needed, const char* name);
// The same where the caller may leave out the arrays; a negative capacity is refused all the same.
void require_capacity_if(bool wanted, std::int64_t capacity, std::int64_t needed, const char* name);
void require_base(std::int32_t index_base);
// The corners of a box, [dimension] each.
void require_box(int dimension, const double* lower, const double* upper);
// Checks a second handle argument of a call.
template <class H>
void require_handle(const H* handle, const char* name) {
    if (!alive(handle))
        fail(DELAM_ERROR_HANDLE, name, handle == nullptr ? " is NULL" : " is a foreign or destroyed handle");
}
// Returns the index as 0-based, after checking base <= value < base + size. what: "nodes[3]".
std::int64_t require_index(std::int64_t value, std::int64_t size, std::int32_t index_base, const std::string& what);

// Returns `count` indices, 0-based. name: of the argument.
std::vector<std::int64_t> require_indices(const std::int64_t* values, std::int64_t count, std::int64_t size,
                                          std::int32_t index_base, const char* name);

// times and values [count] of a load history, count >= 1, times increasing.
void require_history(std::int64_t count, const double* times, const double* values);

}  // namespace delam
