// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/engine/engine_operator.hpp"

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "reduction/sparse/engine/engine_solver.hpp"

namespace delam {

EngineOperator::EngineOperator(const Problem& problem, Monitor& monitor)
    : SparseOperator(
          problem, monitor,
          std::make_unique<BodySystem>(
              problem, [&monitor] { monitor.progress("assemble", 0, 0); }, BodySystem::Stiffness::elsewhere),
          [&](const BodySystem& bodies) { return std::make_unique<EngineSolver>(bodies, problem.engine, monitor); }) {}

void EngineOperator::recover_in_engine(std::span<const double> theta, const Response& response) const {
    poll_cancel_now("recover");
    static_cast<EngineSolver&>(solver()).recover_in_engine(theta, response.multipliers);
}

std::string EngineOperator::description() const {
    return text("engine of the host: ", system()->dofs(), " displacements, of which it knows ",
                solver().system().count(), " variables, ", solver().system().rows().size(), " jump rows");
}

}  // namespace delam
