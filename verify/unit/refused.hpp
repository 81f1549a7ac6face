// SPDX-License-Identifier: BSD-3-Clause
// Actions that the library refuses.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "check.hpp"

namespace unit {

// Message of the error of this status in which an action ends; empty if there is none.
template <class Action>
std::string refusal(std::int32_t status, Action&& action) {
    try {
        action();
    } catch (const delam::Error& e) {
        ck_assert_msg(e.status() == status, "status %d: %s", e.status(), e.what());
        return e.what();
    }
    return "";
}

}  // namespace unit

#define ck_assert_refused(status, part, action)                                                                   \
    do {                                                                                                          \
        const std::string said = unit::refusal(status, [&] { static_cast<void>(action); });                       \
        ck_assert_msg(!said.empty() && said.find(part) != std::string::npos, "\"%s\" lacks \"%s\"", said.c_str(), \
                      std::string(part).c_str());                                                                 \
    } while (0)
