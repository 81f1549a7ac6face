// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/mesh_fields.hpp"

#include <algorithm>
#include <numeric>

#include "base/numbers.hpp"

namespace delam::petsc {

MeshFields::MeshFields(const Bodies& bodies, std::int64_t dofs) : bodies_(bodies), field_(bodies.vector()) {
    const PetscInt dimension = bodies.local().dimension;
    std::vector<std::int64_t> nodes;
    bodies.comm().together([&] {
        if (!bodies.comm().root()) return;
        nodes.resize(index(dofs / dimension));
        std::iota(nodes.begin(), nodes.end(), std::int64_t{0});
    });
    const std::vector<PetscInt> blocks = bodies.numbering().find(nodes);
    const auto count = static_cast<PetscInt>(blocks.size());
    OwnedIs numbers;
    check(ISCreateBlock(PETSC_COMM_SELF, dimension, count, blocks.data(), PETSC_COPY_VALUES, numbers.out()));
    check(VecCreateSeq(PETSC_COMM_SELF, count * dimension, array_.out()));
    check(VecScatterCreate(field_, numbers, array_, nullptr, scatter_.out()));
}

void MeshFields::to_root(Vec from, double* out) {
    check(VecScatterBegin(scatter_, from, array_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(scatter_, from, array_, INSERT_VALUES, SCATTER_FORWARD));
    if (!bodies_.comm().root()) return;
    PetscInt count = 0;
    const PetscScalar* array = nullptr;
    check(VecGetLocalSize(array_, &count));
    check(VecGetArrayRead(array_, &array));
    std::copy(array, array + count, out);
    check(VecRestoreArrayRead(array_, &array));
}

void MeshFields::gather(const BodyState& state, double* displacement, double* force) {
    const LocalVariables& local = bodies_.local();
    // Every owner of a DOF has its row of T, and thus u there.
    PetscScalar* array = nullptr;
    check(VecGetArray(field_, &array));
    for (std::size_t i = 0; i < state.displacement.size(); ++i)
        if (local.owns(i)) array[local.number[i] - local.first] = state.displacement[i];
    check(VecRestoreArray(field_, &array));
    to_root(field_, displacement);
    std::vector<double> places;
    bodies_.comm().together([&] {
        places = state.force;
        places.resize(index(local.places()), 0.0);
    });
    bodies_.assemble(places, field_);
    to_root(field_, force);
}

}  // namespace delam::petsc
