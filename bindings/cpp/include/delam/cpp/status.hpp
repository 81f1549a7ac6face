// SPDX-License-Identifier: BSD-3-Clause
// Results of a call: errors are thrown, outcomes returned. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_STATUS_HPP
#define DELAM_CPP_STATUS_HPP

#include <cstdint>
#include <stdexcept>
#include <string>

#include "delam/delam.h"

namespace delam {

// A call failed: what() is the message of the context.
class Error : public std::runtime_error {
public:
    // Carries a status and its message.
    Error(std::int32_t status, const std::string& message) : std::runtime_error(message), status_(status) {}
    // Returns the status, one of DELAM_ERROR_*.
    std::int32_t status() const noexcept { return status_; }
    const char* name() const noexcept { return delam_status_name(status_); }

private:
    std::int32_t status_;
};

// A file that cannot be opened, read or written.
class FileError : public Error {
public:
    // Carries the message; the status is DELAM_ERROR_FILE.
    explicit FileError(const std::string& message) : Error(DELAM_ERROR_FILE, message) {}
};

// How a load step ended that did not fail.
enum class Outcome : std::int32_t {
    done = DELAM_OK,
    not_converged = DELAM_NOT_CONVERGED,
    cancelled = DELAM_CANCELLED,
    limit = DELAM_LIMIT
};

namespace detail {

inline void require(bool holds, const char* message) {
    if (!holds) throw Error(DELAM_ERROR_ARGUMENT, message);
}

}  // namespace detail

}  // namespace delam

#endif
