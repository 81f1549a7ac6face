// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/constraints.hpp"

#include "base/numbers.hpp"

namespace delam::petsc {

Constraints::Constraints(const Bodies& bodies, const Visible& visible)
    : bodies_(bodies), visible_(visible), used_(bodies.vector()), free_(bodies.vector()), work_(bodies.vector()) {
    std::vector<double> ones;
    bodies.comm().together([&] { ones.assign(visible.count(), 1.0); });
    visible.write(ones, used_);
    const LocalVariables& local = bodies.local();
    PetscScalar* used = nullptr;
    const PetscScalar* diagonal = nullptr;
    check(VecGetArray(used_, &used));
    check(VecGetArrayRead(bodies.diagonal(), &diagonal));
    for (std::size_t i = 0; i < local.number.size(); ++i) {
        if (!local.owns(i)) continue;
        const PetscInt own = local.number[i] - local.first;
        if (local.is_variable[i] == 0)
            used[own] = 0.0;
        else if (diagonal[own] != 0.0)
            used[own] = 1.0;
    }
    check(VecRestoreArrayRead(bodies.diagonal(), &diagonal));
    check(VecRestoreArray(used_, &used));
    check(VecCopy(used_, free_));
}

void Constraints::set(const std::vector<std::int64_t>& fixed, const Expressed& expressed) {
    const Communicator& comm = bodies_.comm();
    std::vector<double> bound;
    int any = expressed.pivots.empty() ? 0 : 1;
    comm.together([&] {
        bound.assign(visible_.count(), 0.0);
        for (const std::int64_t place : fixed) bound[index(place)] = 1.0;
        for (const std::int64_t place : expressed.pivots) bound[index(place)] = 1.0;
        pivots_ = expressed.pivots;
    });
    visible_.write(bound, work_);
    check(VecPointwiseMult(work_, work_, used_));
    check(VecWAXPY(free_, -1.0, work_, used_));
    comm.broadcast(any);
    has_pivots_ = any != 0;
    if (!has_pivots_) return;
    std::vector<PetscInt> rows, columns;
    comm.together([&] {
        for (std::size_t e = 0; e < expressed.values.size(); ++e) {
            rows.push_back(visible_.number(expressed.pivots[index(expressed.rows[e])]));
            columns.push_back(visible_.number(expressed.columns[e]));
        }
    });
    masters_.set(bodies_, rows, columns, expressed.values);
}

void Constraints::mask(Vec v) const { check(VecPointwiseMult(v, v, free_)); }

void Constraints::spread(Vec y, Vec v) const {
    check(VecPointwiseMult(v, y, free_));
    if (!has_pivots_) return;
    check(MatMult(masters_.matrix(), v, work_));
    check(VecAXPY(v, 1.0, work_));
}

void Constraints::gather(Vec v, Vec y) const {
    if (has_pivots_) {
        check(MatMultTranspose(masters_.matrix(), v, work_));
        check(VecWAXPY(y, 1.0, work_, v));
        check(VecPointwiseMult(y, y, free_));
    } else {
        check(VecPointwiseMult(y, v, free_));
    }
}

void Constraints::rest(const std::vector<double>& right, Vec r) const {
    std::vector<double> values;
    bodies_.comm().together([&] {
        if (!has_pivots_ || visible_.count() == 0) return;
        values.assign(visible_.count(), 0.0);
        for (std::size_t i = 0; i < pivots_.size(); ++i) values[index(pivots_[i])] = right[i];
    });
    if (has_pivots_)
        visible_.write(values, r);
    else
        check(VecSet(r, 0.0));
}

}  // namespace delam::petsc
