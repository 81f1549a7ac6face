// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/choose.hpp"

#include "reduction/condensed/condensed.hpp"
#include "reduction/feti/feti.hpp"

namespace delam {

std::unique_ptr<JumpOperator> choose_operator(const Problem& problem, Monitor& monitor) {
    const std::string& wish = problem.options.reduction;
    if (wish == "feti" || (wish == "auto" && problem.options.subdomains > 0)) return std::make_unique<Feti>(problem, monitor);
    auto bulk = std::make_unique<Bulk>(problem, monitor);
    bulk->condense(monitor);
    return std::make_unique<Condensed>(std::move(bulk), problem, monitor);
}

}  // namespace delam
