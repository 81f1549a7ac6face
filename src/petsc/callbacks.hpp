// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "delam/experimental.h"

namespace delam::petsc {

struct Link;

// The C functions of an engine; their `user` is the link, which the engine's release frees.
delam_experimental_engine make_callbacks(Link* link);

}  // namespace delam::petsc
