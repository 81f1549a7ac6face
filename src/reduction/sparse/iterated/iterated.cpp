// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/iterated.hpp"

#include <utility>

#include "base/error.hpp"

namespace delam {

Iterated::Iterated(const Problem& problem, Monitor& monitor)
    : Iterated(problem, assemble_bodies(problem, monitor), monitor) {}

Iterated::Iterated(const Problem& problem, AssembledBodies assembled, Monitor& monitor)
    : SparseOperator(problem, monitor, std::move(assembled.system), [&](const BodySystem& bodies) {
          return std::make_unique<Reanalysis>(bodies, std::move(assembled.transformed), monitor);
      }) {}

Zone* Iterated::part(std::span<const double> theta, const Response& response, std::span<const std::uint8_t> wanted) {
    if (!reanalysis().floating().free().empty()) return nullptr;  // the whole knows how to solve then
    if (part_ == nullptr) part_ = std::make_unique<LocalZone>(reanalysis().system(), problem().mesh->dimension());
    const auto poll = [this] { monitor().progress("patch", 0, 0); };
    return part_->enter(wanted, theta, reanalysis().load(theta), response.multipliers, poll) ? part_.get() : nullptr;
}

IteratedSize Iterated::size() const {
    const WholeFactor& whole = *reanalysis().whole();
    return {static_cast<double>(reanalysis().system().count()),
            static_cast<double>(system()->stiffness().entries()),
            static_cast<double>(reanalysis().system().matrix().entries()),
            whole.size(),
            whole.entries(),
            static_cast<double>(reanalysis().system().rows().equations().size()),
            Reanalysis::keeps_two_factors(problem()) ? 2.0 : 1.0,
            static_cast<double>(problem().softening_count())};
}

std::string Iterated::description() const {
    const WholeFactor& whole = *reanalysis().whole();
    return text("iterated: ", reanalysis().system().count(), " variables, ", reanalysis().system().rows().size(),
                " jump rows, factor of the whole with ", whole.size().entries, " entries");
}

}  // namespace delam
