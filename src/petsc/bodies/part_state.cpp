// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/part_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"
#include "delam/experimental.h"

namespace delam::petsc {

// u is what this rank's rows of T give; K u is the sum of what all ranks have at a node.
void PartState::take(const Bodies& bodies, BodyState state, Eigenstrains eigenstrains) {
    const LocalVariables& local = bodies.local();
    const OwnedVec sum = bodies.vector();
    std::vector<double> places;
    bodies.comm().together([&] {
        places = std::move(state.force);
        places.resize(index(local.places()), 0.0);
    });
    bodies.assemble(places, sum);
    bodies.fetch(sum, places);
    PartState found;
    bodies.comm().together([&] {
        const auto dofs = static_cast<std::ptrdiff_t>(local.dofs);
        found.dimension_ = local.dimension;
        found.part_nodes_ = static_cast<std::int64_t>(bodies.part().nodes.size());
        found.nodes_.assign(local.nodes.begin(), local.nodes.begin() + dofs / local.dimension);
        for (std::size_t i = 0; i < found.nodes_.size(); ++i)
            found.owned_.push_back(local.owns(i * index(local.dimension)) ? 1 : 0);
        found.displacement_ = std::move(state.displacement);
        found.force_.assign(places.begin(), places.begin() + dofs);
        for (const std::vector<double>* field : {&found.displacement_, &found.force_})
            if (!std::all_of(field->begin(), field->end(), [](double v) { return std::isfinite(v); }))
                fail(DELAM_ERROR_NUMERICAL, "the displacements or nodal forces of the state are not finite");
        found.eigenstrains_ = std::move(eigenstrains);
        found.known_ = true;
    });
    *this = std::move(found);
}

void PartState::compute_cells(const PartCells& cells) {
    if (has_cells_) return;
    stress_.assign(cells.cells.size() * (dimension_ == 2 ? 4 : 6), 0.0);
    rotation_.assign(cells.cells.size() * (dimension_ == 2 ? 1 : 3), 0.0);
    if (!cells.cells.empty()) {
        struct Context {
            delam_context* handle = nullptr;
            ~Context() { delam_context_destroy(&handle); }
        } context;
        if (delam_context_create(&context.handle) != DELAM_OK) fail(DELAM_ERROR_MEMORY, "not enough memory");
        const std::int32_t status = delam_experimental_part_fields(
            context.handle, static_cast<std::int64_t>(cells.bytes.size()), cells.bytes.data(), part_nodes_,
            displacement_.data(), static_cast<std::int64_t>(eigenstrains_.bodies.size()), eigenstrains_.bodies.data(),
            eigenstrains_.strains.data(), static_cast<std::int64_t>(cells.cells.size()), stress_.data(),
            rotation_.data());
        if (status != DELAM_OK) fail(status, "delam_experimental_part_fields: ", delam_context_message(context.handle));
    }
    has_cells_ = true;
}

PartState::Field PartState::field(const std::string& key, const PartCells& cells) {
    const bool of_cells = key == "stress" || key == "rotation";
    if (!of_cells && key != "displacement" && key != "force")
        fail(DELAM_ERROR_ARGUMENT, "key = ", key, ": known are displacement, force, stress, rotation");
    if (!known_) fail(DELAM_ERROR_STATE, "no state of these parts has been recovered: delam_petsc_recover comes first");
    const auto nodes = static_cast<std::int64_t>(nodes_.size()), count = static_cast<std::int64_t>(cells.cells.size());
    if (key == "displacement") return {&displacement_, nodes, dimension_};
    if (key == "force") return {&force_, nodes, dimension_};
    if (key == "stress" && !eigenstrains_.known)
        fail(DELAM_ERROR_STATE,
             "the eigenstrains of this state are not known, which delam_petsc_recover sends, other than "
             "delam_experimental_solver_recover");
    compute_cells(cells);
    if (key == "stress") return {&stress_, count, dimension_ == 2 ? 4 : 6};
    return {&rotation_, count, dimension_ == 2 ? 1 : 3};
}

}  // namespace delam::petsc
