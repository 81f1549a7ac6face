// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "petsc/engine.hpp"

namespace delam::petsc {

// Values of delam_petsc_value: numbers of this handle since it was made.
class Counters {
public:
    explicit Counters(const Communicator& comm);
    // Collective. preconditioner: the present one, or NULL.
    double value(const char* key, const Engine::Counts& counts, const Preconditioner* preconditioner) const;

private:
    const Communicator& comm_;
    double operations_before_, bytes_before_;
    double messages_before_;
};

}  // namespace delam::petsc
