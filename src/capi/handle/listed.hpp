// SPDX-License-Identifier: BSD-3-Clause
// The statuses in the brackets of the functions in which callbacks of the host run: engines and laws.
//
// What goes wrong in a callback may have any status. guard() returns it only if the function lists it. The test
// abi/contract compares this table with the headers.
#pragma once

#include <cstdint>

#include "delam/delam.h"

namespace delam {

// A set of the statuses of delam.h.
class Listed {
public:
    template <class... Status>
    static constexpr Listed of(Status... statuses) {
        return Listed((0U | ... | bit(statuses)));
    }
    // The list of functions that run no callback with a status.
    static constexpr Listed everything() { return Listed(~0U); }

    // Returns the status that a function may return in the place of this one. Every function may return three of them.
    // If the function does not list the status, it reports an unavailable number (DELAM_ERROR_NUMERICAL), or else a bad
    // scene (DELAM_ERROR_PROBLEM), as for a law whose callback fails; where it lists neither, DELAM_ERROR_INTERNAL is
    // left.
    [[nodiscard]] std::int32_t in_place_of(std::int32_t status) const {
        const bool known = status >= DELAM_ERROR_FILE && status <= DELAM_LIMIT;
        if (status == DELAM_ERROR_HANDLE || status == DELAM_ERROR_MEMORY || status == DELAM_ERROR_INTERNAL)
            return status;
        if (known && has(status)) return status;
        if (has(DELAM_ERROR_NUMERICAL)) return DELAM_ERROR_NUMERICAL;
        return has(DELAM_ERROR_PROBLEM) ? DELAM_ERROR_PROBLEM : DELAM_ERROR_INTERNAL;
    }

private:
    constexpr explicit Listed(std::uint32_t bits) : bits_(bits) {}
    static constexpr std::uint32_t bit(std::int32_t status) {
        return std::uint32_t{1} << static_cast<std::uint32_t>(status - DELAM_ERROR_FILE);
    }
    [[nodiscard]] bool has(std::int32_t status) const { return (bits_ & bit(status)) != 0; }

    std::uint32_t bits_;
};

// clang-format off
namespace listed {
inline constexpr Listed problem_plan =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_MESH, DELAM_ERROR_PROBLEM, DELAM_ERROR_NUMERICAL);
inline constexpr Listed solver_create =
    Listed::of(DELAM_NOT_CONVERGED, DELAM_CANCELLED, DELAM_LIMIT, DELAM_ERROR_ARGUMENT, DELAM_ERROR_MESH,
               DELAM_ERROR_PROBLEM, DELAM_ERROR_NUMERICAL);
inline constexpr Listed solver_create_like =
    Listed::of(DELAM_NOT_CONVERGED, DELAM_CANCELLED, DELAM_LIMIT, DELAM_ERROR_ARGUMENT, DELAM_ERROR_MESH,
               DELAM_ERROR_PROBLEM, DELAM_ERROR_NUMERICAL);
inline constexpr Listed solver_advance =
    Listed::of(DELAM_NOT_CONVERGED, DELAM_CANCELLED, DELAM_LIMIT, DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM,
               DELAM_ERROR_STATE, DELAM_ERROR_NUMERICAL);
inline constexpr Listed solver_commit =
    Listed::of(DELAM_ERROR_PROBLEM, DELAM_ERROR_STATE);
inline constexpr Listed solver_equilibrate =
    Listed::of(DELAM_NOT_CONVERGED, DELAM_CANCELLED, DELAM_LIMIT, DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM,
               DELAM_ERROR_STATE, DELAM_ERROR_NUMERICAL);
inline constexpr Listed solver_value =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM);
inline constexpr Listed solver_record =
    Listed::of(DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM, DELAM_ERROR_STATE);
inline constexpr Listed solver_field =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT);
inline constexpr Listed solver_front_count =
    Listed::of(DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM);
inline constexpr Listed solver_front =
    Listed::of(DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM);
inline constexpr Listed solver_average =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT);
inline constexpr Listed solver_tangent =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE, DELAM_ERROR_NUMERICAL);
inline constexpr Listed solver_step_tangent =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE, DELAM_ERROR_NUMERICAL);
inline constexpr Listed solver_condensed_size =
    Listed::of(DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE);
inline constexpr Listed solver_condensed =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE);
inline constexpr Listed solver_load =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_NUMERICAL, DELAM_ERROR_SNAPSHOT);
inline constexpr Listed solver_load_file =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_NUMERICAL, DELAM_ERROR_SNAPSHOT, DELAM_ERROR_FILE);
inline constexpr Listed experimental_solver_recover =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_NUMERICAL, DELAM_ERROR_STATE);
inline constexpr Listed experimental_solver_eigenstrains =
    Listed::of(DELAM_ERROR_ARGUMENT);
inline constexpr Listed experimental_solver_follow =
    Listed::of(DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE, DELAM_ERROR_NUMERICAL);
inline constexpr Listed experimental_solver_sensitivity =
    Listed::of(DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE);
}  // namespace listed
// clang-format on

}  // namespace delam
