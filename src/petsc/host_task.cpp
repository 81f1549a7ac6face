// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/host_task.hpp"

#include "delam/delam.h"

namespace delam::petsc {

void HostTask::call(const std::vector<std::uint8_t>& told, int rank) {
    struct During {
        bool& running;
        explicit During(bool& flag) : running(flag) { running = true; }
        ~During() { running = false; }
    } during(running_);
    explained_.clear();
    const std::int32_t status = function_(static_cast<std::int64_t>(told.size()), told.data(), user_);
    if (status == DELAM_OK) return;
    if (!explained_.empty()) fail(status, explained_);
    fail(status, "the task of rank ", rank, " returned ", delam_status_name(status));
}

}  // namespace delam::petsc
