// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/operator.hpp"

#include <cmath>

#include "base/numbers.hpp"

namespace delam::petsc {

namespace {

PetscErrorCode apply_shell(Mat shell, Vec x, Vec y) {
    void* context = nullptr;
    const PetscErrorCode code = MatShellGetContext(shell, &context);
    if (code != 0) return code;
    try {
        static_cast<const Operator*>(context)->apply(x, y);
    } catch (...) {
        return failed_in_callback();
    }
    return 0;
}

}  // namespace

Operator::Operator(const Bodies& bodies, const Visible& visible, const Constraints& constraints)
    : bodies_(bodies),
      visible_(visible),
      constraints_(constraints),
      spread_(bodies.vector()),
      image_(bodies.vector()),
      of_couplings_(bodies.vector()) {
    const PetscInt owned = bodies.local().owned;
    check(MatCreateShell(bodies.comm().get(), owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, this, shell_.out()));
    check(MatShellSetOperation(shell_, MATOP_MULT, reinterpret_cast<void (*)(void)>(apply_shell)));
    check(MatShellSetOperation(shell_, MATOP_MULT_TRANSPOSE, reinterpret_cast<void (*)(void)>(apply_shell)));
    check(MatSetOption(shell_, MAT_SYMMETRIC, PETSC_TRUE));
    set_couplings({});
}

void Operator::set_couplings(const Entries& couplings) {
    std::vector<PetscInt> rows, columns;
    bodies_.comm().together([&] {
        entries_ = couplings;
        for (const std::int64_t place : couplings.rows) rows.push_back(visible_.number(place));
        for (const std::int64_t place : couplings.columns) columns.push_back(visible_.number(place));
    });
    couplings_.set(bodies_, rows, columns, couplings.values);
}

void Operator::apply_couplings(Vec v, Vec cv) const { check(MatMult(couplings_.matrix(), v, cv)); }

void Operator::apply(Vec y, Vec out) const {
    constraints_.spread(y, spread_);
    apply_bodies(spread_, image_);
    apply_couplings(spread_, of_couplings_);
    check(VecAXPY(image_, 1.0, of_couplings_));
    constraints_.gather(image_, out);
    check(VecDot(y, out, &last_curvature_));
}

double Operator::coupled(Vec v) const {
    const std::vector<double> values = visible_.read(v);
    double sum = 0.0;
    for (std::size_t e = 0; e < entries_.values.size(); ++e)
        sum += std::abs(values[index(entries_.rows[e])] * entries_.values[e] * values[index(entries_.columns[e])]);
    bodies_.comm().broadcast(sum);
    return sum;
}

void Operator::add_coupling_sizes(Vec v, Vec out) const {
    const std::vector<double> values = visible_.read(v);
    std::vector<double> sizes(values.size(), 0.0);
    for (std::size_t e = 0; e < entries_.values.size(); ++e)
        sizes[index(entries_.rows[e])] += std::abs(entries_.values[e] * values[index(entries_.columns[e])]);
    visible_.write(sizes, of_couplings_);
    check(VecAXPY(out, 1.0, of_couplings_));
}

}  // namespace delam::petsc
