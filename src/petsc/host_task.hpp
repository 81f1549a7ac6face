// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "petsc/base/failure.hpp"

namespace delam::petsc {

// A function of the host that rank 0 has all ranks call (delam_petsc_set_task).
class HostTask {
public:
    using Function = std::int32_t (*)(std::int64_t size, const std::uint8_t* bytes, void* user);
    void set(Function function, void* user) {
        function_ = function;
        user_ = user;
    }
    bool known() const { return function_ != nullptr; }
    bool running() const { return running_; }
    // Sets the explanation of the task that runs, on this rank alone.
    void explain(const char* text) { explained_ = text; }
    // Throws what the task returns, with its explanation or else the rank.
    void call(const std::vector<std::uint8_t>& told, int rank);

private:
    Function function_ = nullptr;
    void* user_ = nullptr;
    std::string explained_;
    bool running_ = false;
};

}  // namespace delam::petsc
