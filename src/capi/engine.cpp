// SPDX-License-Identifier: BSD-3-Clause
// Engines of the host (experimental.h).
#include "scene/engine.hpp"

#include <memory>

#include "capi/handles.hpp"
#include "scene/problem.hpp"

int32_t delam_experimental_problem_set_engine(delam_problem* problem, const delam_experimental_engine* engine) {
    using namespace delam;
    return guard(problem, [&] {
        std::shared_ptr<Engine> own;
        if (engine != nullptr) own = std::make_shared<Engine>(*engine);
        problem->core->engine = std::move(own);
    });
}
