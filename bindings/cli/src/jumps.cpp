// SPDX-License-Identifier: BSD-3-Clause
#include "jumps.hpp"

#include <fmt/format.h>

#include "call.hpp"
#include "number.hpp"

namespace cli {

bool locates_jumps(const delam_solver* solver) {
    const char* tolerance = delam_solver_option(solver, "jump_tolerance");
    return tolerance != nullptr && number_in(tolerance) > 0;
}

std::string jumps_text(const Model& model, const delam_solver* solver) {
    std::int64_t count = 0;
    call(model.context.get(), delam_solver_jump_count(solver, &count), std::string("number of jumps"));
    std::string out = "step,before,time,stored,dissipated,released,debonded,interface,first_pair,last_pair\n";
    for (std::int64_t i = 0; i < count; ++i) {
        std::int64_t step = 0;
        std::int64_t interface = 0;
        std::int64_t first = 0;
        std::int64_t last = 0;
        double before = 0;
        double time = 0;
        double stored = 0;
        double dissipated = 0;
        double released = 0;
        double debonded = 0;
        call(model.context.get(),
             delam_solver_jump(solver, i, &step, &before, &time, &stored, &dissipated, &released, &debonded, &interface,
                               &first, &last),
             fmt::format("jump {}", i));
        out += fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{},{},{}\n", step, before, time, stored,
                           dissipated, released, debonded, interface, first, last);
    }
    return out;
}

}  // namespace cli
