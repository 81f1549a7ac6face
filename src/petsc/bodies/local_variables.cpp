// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/local_variables.hpp"

#include "base/numbers.hpp"
#include "petsc/part/places.hpp"

namespace delam::petsc {

namespace {

std::int64_t dof_of(const LocalVariables& local, std::size_t place) {
    const auto d = index(local.dimension);
    return local.nodes[place / d] * local.dimension + static_cast<std::int64_t>(place % d);
}

void fill_transform(const SceneVariables& scene, Places& places, LocalVariables& local) {
    LocalMatrix& t = local.transform;
    t.rows = local.dofs;
    for (std::size_t i = 0; i < index(local.dofs); ++i) {
        const std::int64_t row = scene.place(dof_of(local, i));
        if (row < 0) {
            t.column.push_back(petsc_int(i));
            t.value.push_back(1.0);
        } else {
            for (std::int64_t e = scene.start[index(row)]; e < scene.start[index(row) + 1]; ++e) {
                t.column.push_back(places.of(scene.home[index(e)]));
                t.value.push_back(scene.coefficient[index(e)]);
            }
        }
        t.start.push_back(petsc_int(t.column.size()));
    }
    t.columns = petsc_int(local.nodes.size() * index(local.dimension));
    t.sort_rows();
    for (std::size_t i = 0; i < index(t.columns); ++i) {
        const std::int64_t row = scene.place(dof_of(local, i));
        local.is_variable.push_back(row < 0 || scene.is_home[index(row)] != 0 ? 1 : 0);
        local.is_jump.push_back(row >= 0 && scene.is_home[index(row)] != 0 ? 1 : 0);
    }
}

// Returns the terms at the rows of T; if only_owned, only those that no other rank takes.
LocalVariables::Terms local_terms(const SceneVariables::Terms& all, const LocalVariables& local, Places& places,
                                  bool only_owned) {
    LocalVariables::Terms kept;
    for (std::size_t i = 0; i < all.dof.size(); ++i) {
        if (!places.has(all.dof[i])) continue;
        const PetscInt place = places.of(all.dof[i]);
        if (place >= local.dofs || (only_owned && !local.owns(index(place)))) continue;
        kept.dof.push_back(place);
        kept.value.push_back(all.value[i]);
    }
    return kept;
}

}  // namespace

LocalVariables make_local_variables(const Communicator& comm, const Part& part, const SceneVariables& scene,
                                    const Numbering& numbering) {
    LocalVariables local;
    std::vector<PetscInt> blocks;
    comm.together([&] {
        local.dimension = petsc_int(scene.dimension);
        local.nodes = part.nodes;
        local.nodes.insert(local.nodes.end(), numbering.orphans().begin(), numbering.orphans().end());
        local.dofs = petsc_int(local.nodes.size() * index(scene.dimension));
        local.first = numbering.first() * local.dimension;
        local.owned = numbering.owned() * local.dimension;
    });
    comm.together([&] {
        Places places(scene.dimension, local.nodes);
        fill_transform(scene, places, local);
    });
    blocks = numbering.find(local.nodes);
    comm.together([&] {
        for (const PetscInt block : blocks)
            for (PetscInt c = 0; c < local.dimension; ++c) local.number.push_back(block * local.dimension + c);
        Places places(scene.dimension, local.nodes);
        for (std::size_t p = 0; p < scene.patterns(); ++p) {
            local.lift.push_back(local_terms(scene.lift[p], local, places, false));
            local.force.push_back(local_terms(scene.force[p], local, places, true));
        }
    });
    return local;
}

}  // namespace delam::petsc
