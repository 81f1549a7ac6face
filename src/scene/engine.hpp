// SPDX-License-Identifier: BSD-3-Clause
// An engine of the host (delam/experimental.h), shared by the problems and solvers that use it.
#pragma once

#include <string>

#include "delam/experimental.h"

namespace delam {

class Engine {
public:
    // Error(DELAM_ERROR_ARGUMENT) names what is missing.
    explicit Engine(const delam_experimental_engine& functions);
    ~Engine();
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    const delam_experimental_engine& functions() const { return functions_; }
    // Answers that it keeps.
    static constexpr std::int64_t kept = 8;
    // Throws unless a function of it has returned DELAM_OK, with its message: a status that an engine may have, or
    // DELAM_ERROR_NUMERICAL in the place of any other number. what: the function.
    void require(std::int32_t status, const char* what) const;

    // Whose variables it has at the moment. It has room for those of one operator.
    const void* owner = nullptr;

private:
    delam_experimental_engine functions_;
};

}  // namespace delam
