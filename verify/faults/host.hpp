// SPDX-License-Identifier: BSD-3-Clause
// A host that passes every call of a scene to the code that disturbs it, and keeps the results of the calls.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "delam/delam.h"

namespace faults {

inline void expect(bool condition, const std::string& text) {
    if (!condition) throw std::runtime_error(text);
}

// Bytes, named after the call that returned them, in order.
class Transcript {
public:
    template <class T>
    void add(const std::string& name, const std::vector<T>& values) {
        add(name, values.data(), values.size() * sizeof(T));
    }
    void add(const std::string& name, const void* bytes, std::size_t size);
    void add(const std::string& name, const std::string& text) { add(name, text.data(), text.size()); }
    // Returns "" if both are equal, bit by bit; otherwise the difference.
    std::string difference(const Transcript& other) const;
    std::size_t size() const { return entries_.size(); }

private:
    std::vector<std::pair<std::string, std::string>> entries_;
};

class Host {
public:
    using Call = std::function<std::int32_t()>;
    Host() = default;
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;
    virtual ~Host() = default;

    // Makes one call of the library until it succeeds; only the library allocates inside. undo reverts the effect of
    // the call so that it can be repeated. Without undo, repeating must be harmless, or `once` must be set.
    enum class Repeat { harmless, once, after_undo };
    virtual void call(const std::string& name, Repeat repeat, const Call& call, const Call& undo) = 0;
    void query(const std::string& name, const Call& c) { call(name, Repeat::harmless, c, {}); }
    void change(const std::string& name, const Call& c) { call(name, Repeat::once, c, {}); }
    void create(const std::string& name, const Call& c, const Call& undo) { call(name, Repeat::after_undo, c, undo); }

    // The scene's context, and the solver whose state must not change in a call that fails (null: none).
    virtual void made(delam_context* context) { context_ = context; }
    void watch(delam_solver* solver) { solver_ = solver; }

    Transcript transcript;

protected:
    std::string message() const { return context_ != nullptr ? delam_context_message(context_) : "no context"; }
    delam_context* context_ = nullptr;
    delam_solver* solver_ = nullptr;
};

// A host that disturbs nothing.
class Calm : public Host {
public:
    void call(const std::string& name, Repeat, const Call& call, const Call&) override {
        const std::int32_t status = call();
        expect(status == DELAM_OK, name + ": " + delam_status_name(status) + ": " + message());
    }
};

// The state of a solver, pending step included, without recovering displacements: saved bytes, fields of the pairs,
// ledger. words: include the report of the last search, which stays when a step is rolled back.
Transcript state_of(delam_solver* solver, bool words = true);

}  // namespace faults
