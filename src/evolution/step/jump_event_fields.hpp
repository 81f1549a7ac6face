// SPDX-License-Identifier: BSD-3-Clause
// The saved members of a jump event (increment/state_fields.hpp).
#pragma once

#include <tuple>

#include "base/archive.hpp"
#include "evolution/step/jump_event.hpp"

namespace delam {

// One row per line.
// clang-format off
template <>
inline constexpr auto saved_fields<JumpEvent> = std::tuple_cat(saved_since(5,
    &JumpEvent::step,
    &JumpEvent::before,
    &JumpEvent::time,
    &JumpEvent::stored,
    &JumpEvent::dissipated,
    &JumpEvent::released,
    &JumpEvent::debonded,
    &JumpEvent::interface,
    &JumpEvent::first_pair,
    &JumpEvent::last_pair),
    saved_since(9,
    &JumpEvent::conjugate_before,
    &JumpEvent::conjugate_after));
// clang-format on

static_assert(complete<JumpEvent>(saved_fields<JumpEvent>), "a member of a jump event has no row");

}  // namespace delam
