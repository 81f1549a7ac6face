// SPDX-License-Identifier: BSD-3-Clause
// The context: log, progress, cancelling. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_CONTEXT_HPP
#define DELAM_CPP_CONTEXT_HPP

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "delam/cpp/shared.hpp"
#include "delam/cpp/status.hpp"
#include "delam/delam.h"

namespace delam {

// Messages, log, progress and cancelling of the objects that are made with it; one thread at a time uses them.
class Context {
public:
    Context() : shared_(std::make_shared<detail::Shared>()) {
        delam_context* made = nullptr;
        const std::int32_t status = delam_context_create(&made);
        shared_->handle.reset(made);
        if (status != DELAM_OK) throw Error(status, "no context could be made");
    }
    Context(Context&&) noexcept = default;
    Context& operator=(Context&&) noexcept = default;

    // Returns the handle of C.
    delam_context* get() const noexcept { return shared_->handle.get(); }
    std::string message() const { return delam_context_message(get()); }
    // An empty function switches it off.
    void on_log(LogCallback callback) {
        const bool wanted = static_cast<bool>(callback);
        shared_->check(delam_context_set_log(get(), wanted ? &Context::say : nullptr, shared_.get()));
        shared_->log = std::move(callback);
    }
    void on_progress(ProgressCallback callback) {
        const bool wanted = static_cast<bool>(callback);
        shared_->check(delam_context_set_progress(get(), wanted ? &Context::tell : nullptr, shared_.get()));
        shared_->progress = std::move(callback);
    }
    // From any thread.
    void cancel() const noexcept { delam_context_cancel(get()); }

    // Returns what the other classes of this layer share.
    const std::shared_ptr<detail::Shared>& shared() const noexcept { return shared_; }

private:
    static void say(std::int32_t level, const char* text, void* user) {
        auto& shared = *static_cast<detail::Shared*>(user);
        if (detail::thrown) return;
        try {
            shared.log(level, text);
        } catch (...) {
            detail::thrown = std::current_exception();
        }
    }
    static std::int32_t tell(const char* stage, std::int64_t done, std::int64_t total, void* user) {
        auto& shared = *static_cast<detail::Shared*>(user);
        if (detail::thrown) return 1;
        try {
            return shared.progress(stage, done, total) ? 0 : 1;
        } catch (...) {
            detail::thrown = std::current_exception();
            return 1;
        }
    }

    std::shared_ptr<detail::Shared> shared_;
};

}  // namespace delam

#endif
