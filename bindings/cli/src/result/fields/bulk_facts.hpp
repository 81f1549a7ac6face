// SPDX-License-Identifier: BSD-3-Clause
// Facts about an analysis as a whole, which the fields of nodes and cells tell.
#pragma once

#include <cstdint>
#include <limits>

namespace cli {

// The library's estimate of the discretisation error (values mesh_error, mesh_error_fronts, mesh_excess), each a part
// of the elastic energy of the bodies.
struct MeshError {
    double away = std::numeric_limits<double>::quiet_NaN();  // from the fronts of cracks; NaN: not estimated
    double fronts = 0;
    double excess = 0;  // energy that incompatible modes would take off
    std::int64_t step = 0;
    double time = 0;
};

// The energy that small rotations leave out (value rotation_error), in a step before a collapse.
struct RotationError {
    double error = std::numeric_limits<double>::quiet_NaN();  // NaN: not known
    std::int64_t step = 0;
    double time = 0;
};

struct BulkFacts {
    double rotation_max = 0;  // rad, of all steps; 0 if none has displacements
    MeshError mesh_error;     // the largest of the steps in which it was estimated
    RotationError rotations;  // the largest of those before a collapse
};

}  // namespace cli
