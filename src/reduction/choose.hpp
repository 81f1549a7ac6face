// SPDX-License-Identifier: BSD-3-Clause
// Which realisation of the jump operator a scene gets.
#pragma once

#include <memory>

#include "base/monitor.hpp"
#include "reduction/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

std::unique_ptr<JumpOperator> choose_operator(const Problem& problem, Monitor& monitor);

}  // namespace delam
