// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/visible.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam::petsc {

Visible::Visible(const Bodies& bodies, const std::vector<std::int64_t>& homes) {
    const Communicator& comm = bodies.comm();
    const PetscInt dimension = bodies.local().dimension;
    std::vector<std::int64_t> nodes;
    comm.together([&] {
        for (const std::int64_t home : homes) nodes.push_back(home / dimension);
    });
    number_ = bodies.numbering().find(nodes);
    for (std::size_t i = 0; i < homes.size(); ++i)
        number_[i] = number_[i] * dimension + static_cast<PetscInt>(homes[i] % dimension);
    const auto count = static_cast<PetscInt>(number_.size());
    check(VecCreateSeq(PETSC_COMM_SELF, count, array_.out()));
    OwnedIs numbers;
    check(ISCreateGeneral(PETSC_COMM_SELF, count, number_.data(), PETSC_COPY_VALUES, numbers.out()));
    check(VecScatterCreate(bodies.diagonal(), numbers, array_, nullptr, scatter_.out()));
}

PetscInt Visible::number(std::int64_t place) const {
    if (place < 0 || place >= static_cast<std::int64_t>(number_.size()))
        fail(DELAM_ERROR_ARGUMENT, "place ", place, " in `visible` is not in [0, ", number_.size(), ")");
    return number_[index(place)];
}

std::vector<double> Visible::read(Vec from) const {
    check(VecScatterBegin(scatter_, from, array_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(scatter_, from, array_, INSERT_VALUES, SCATTER_FORWARD));
    const PetscScalar* array = nullptr;
    check(VecGetArrayRead(array_, &array));
    std::vector<double> values(array, array + number_.size());
    check(VecRestoreArrayRead(array_, &array));
    return values;
}

void Visible::write(std::span<const double> values, Vec out) const {
    PetscScalar* array = nullptr;
    check(VecGetArray(array_, &array));
    std::copy(values.begin(), values.end(), array);
    check(VecRestoreArray(array_, &array));
    check(VecSet(out, 0.0));
    check(VecScatterBegin(scatter_, array_, out, INSERT_VALUES, SCATTER_REVERSE));
    check(VecScatterEnd(scatter_, array_, out, INSERT_VALUES, SCATTER_REVERSE));
}

bool SparseEntries::set(const Bodies& bodies, const std::vector<PetscInt>& rows, const std::vector<PetscInt>& columns,
                        const std::vector<double>& values) {
    const Communicator& comm = bodies.comm();
    int same = matrix_ != nullptr && rows == rows_ && columns == columns_ ? 1 : 0;
    comm.broadcast(same);
    if (same == 0) {
        comm.together([&] {
            rows_ = rows;
            columns_ = columns;
        });
        const PetscInt owned = bodies.local().owned;
        check(MatCreate(comm.get(), matrix_.out()));
        check(MatSetSizes(matrix_, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE));
        check(MatSetType(matrix_, MATAIJ));
        std::vector<PetscInt> i, j;  // PETSc may overwrite them
        comm.together([&] {
            i = rows;
            j = columns;
        });
        check(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(i.size()), i.data(), j.data()));
    }
    check(MatSetValuesCOO(matrix_, values.data(), INSERT_VALUES));
    return same == 0;
}

}  // namespace delam::petsc
