// SPDX-License-Identifier: BSD-3-Clause
// Checks the promises of every call of the library: a status listed in its comment, a message for each status other
// than DELAM_OK, and an unchanged object after an error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "delam/delam.h"

namespace fuzz {

// Ends the process when a promise is broken.
void expect(bool kept, const char* promise, const char* where);

// Sets of statuses, as listed in a function's contract line.
using Statuses = std::uint32_t;
constexpr Statuses bit(std::int32_t status) {
    return status < 0 ? std::uint32_t{1} << -status : std::uint32_t{1} << (16 + status);
}
namespace may {
constexpr Statuses usual = 0;
constexpr Statuses argument = bit(DELAM_ERROR_ARGUMENT);
constexpr Statuses mesh = bit(DELAM_ERROR_MESH);
constexpr Statuses problem = bit(DELAM_ERROR_PROBLEM);
constexpr Statuses state = bit(DELAM_ERROR_STATE);
constexpr Statuses numerical = bit(DELAM_ERROR_NUMERICAL);
constexpr Statuses snapshot = bit(DELAM_ERROR_SNAPSHOT);
constexpr Statuses internal = bit(DELAM_ERROR_INTERNAL);
constexpr Statuses file = bit(DELAM_ERROR_FILE);
constexpr Statuses not_converged = bit(DELAM_NOT_CONVERGED);
constexpr Statuses cancelled = bit(DELAM_CANCELLED);
constexpr Statuses limit = bit(DELAM_LIMIT);
}  // namespace may

// A context with its callbacks: it receives the library's messages, and cancels at a poll.
class Host {
public:
    Host();
    ~Host();
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    delam_context* context = nullptr;
    bool listens = true;          // the log callback is set
    std::int64_t cancel_in = -1;  // polls until the progress callback cancels; -1: never
    bool cancel_by_call = false;  // in that case by delam_context_cancel from inside the callback

    // No input may run for ever: after this many polls everything is cancelled.
    std::int64_t polls_left = 4000;

    // To be called before a call, and after it with the returned status.
    void begin();
    void settle(const char* call, std::int32_t status, Statuses documented);

private:
    static void log(std::int32_t level, const char* text, void* user);
    static std::int32_t progress(const char* stage, std::int64_t done, std::int64_t total, void* user);
    std::string last_;
    std::int32_t last_level_ = -1;
};

// Everything that can be read from an object, as text: two prints of an object are equal if nothing has changed.
std::string print_of(const delam_mesh* mesh);
std::string print_of(const delam_law* law);
std::string print_of(const delam_problem* problem);
std::string print_of(delam_solver* solver);

std::vector<std::uint8_t> saved(const delam_solver* solver);
// Saved states and parts end with the checksum of what is before it.
std::vector<std::uint8_t> with_checksum(std::vector<std::uint8_t> bytes);

}  // namespace fuzz
