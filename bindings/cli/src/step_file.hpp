// SPDX-License-Identifier: BSD-3-Clause
// The fields of one step as the bytes of a small HDF5 file (group "step"). The file is made in memory, so that only
// this program's own checked writes touch the disk during the analysis.
#pragma once

#include <string>

#include "build.hpp"

namespace cli {

std::string step_bytes(const Model& model, delam_solver* solver, const Scene& scene, std::int64_t step, double time);

}  // namespace cli
