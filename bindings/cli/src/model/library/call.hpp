// SPDX-License-Identifier: BSD-3-Clause
// Turns the library's statuses into the program's failures.
#pragma once

#include <cstdint>
#include <string>

#include "delam/delam.h"
#include "text/error.hpp"

namespace cli {

inline Exit exit_code(std::int32_t status) {
    switch (status) {
        case DELAM_CANCELLED:
            return exit_interrupted;
        case DELAM_ERROR_ARGUMENT:
        case DELAM_ERROR_MESH:
        case DELAM_ERROR_PROBLEM:
            return exit_scene;
        default:
            return exit_numerical;
    }
}

// Throws for every status but DELAM_OK. The library's message follows the place in the scene.
inline void call(const delam_context* context, std::int32_t status, const Place& place) {
    if (status == DELAM_OK) return;
    if (status == DELAM_CANCELLED) throw Failure(exit_interrupted, "interrupted");
    const std::string text = delam_context_message(context);
    const Exit code = exit_code(status);
    throw Failure(code, place, code == exit_scene ? text : text + " (" + delam_status_name(status) + ")");
}

// Checks the status of a call that, once the scene is accepted, can only fail by a defect or for lack of memory.
inline void call(const delam_context* context, std::int32_t status, const std::string& what) {
    if (status == DELAM_OK) return;
    if (status == DELAM_CANCELLED) throw Failure(exit_interrupted, "interrupted");
    throw Failure(exit_numerical,
                  what + ": " + delam_context_message(context) + " (" + delam_status_name(status) + ")");
}

}  // namespace cli
