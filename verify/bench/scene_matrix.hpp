// SPDX-License-Identifier: BSD-3-Clause
// The matrix of one linear-solve equivalent of a scene file: that of the direct reference at the undamaged initial
// state, with all constraints eliminated.
#pragma once

#include "scene_file.hpp"
#include "sparse_factor.hpp"

namespace bench {

UpperMatrix undamaged_matrix(const reference::SceneFile& file);

}  // namespace bench
