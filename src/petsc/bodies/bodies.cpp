// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/numbers.hpp"

namespace delam::petsc {

Bodies::Bodies(const Communicator& comm, const Part& part, const SceneVariables& scene)
    : comm_(comm),
      part_(part),
      numbering_(comm, part.own(), scene.dofs / scene.dimension),
      local_(make_local_variables(comm, part, scene, numbering_)) {
    check(VecCreate(comm.get(), layout_.out()));
    check(VecSetSizes(layout_, local_.owned, PETSC_DETERMINE));
    check(VecSetBlockSize(layout_, local_.dimension));
    check(VecSetType(layout_, VECSTANDARD));
    check(VecCreateSeq(PETSC_COMM_SELF, local_.places(), here_.out()));
    OwnedIs numbers;
    check(ISCreateGeneral(PETSC_COMM_SELF, local_.places(), local_.number.data(), PETSC_COPY_VALUES, numbers.out()));
    check(VecScatterCreate(layout_, numbers, here_, nullptr, fetch_.out()));
    comm.together([&] {
        places_.assign(index(local_.places()), 0.0);
        displacement_.assign(index(local_.dofs), 0.0);
        force_of_part_.assign(index(local_.dofs), 0.0);
    });
    make_diagonal();
    make_loads();
}

OwnedVec Bodies::vector() const {
    OwnedVec v;
    check(VecDuplicate(layout_, v.out()));
    check(VecSet(v, 0.0));
    return v;
}

// Computes the diagonal of T^T K T without forming the product: sum over the DOFs r, s of T_rc K_rs T_sc.
void Bodies::make_diagonal() {
    std::vector<double> sums;
    comm_.together([&] {
        sums.assign(index(local_.places()), 0.0);
        const LocalMatrix &k = part_.stiffness, &t = local_.transform;
        for (std::size_t r = 0; r < index(k.rows); ++r)
            for (auto e = index(k.start[r]); e < index(k.start[r + 1]); ++e)
                for (auto a = index(t.start[r]); a < index(t.start[r + 1]); ++a) {
                    const auto s = index(k.column[e]);
                    const auto first = t.column.begin() + t.start[s], last = t.column.begin() + t.start[s + 1];
                    const auto b = std::lower_bound(first, last, t.column[a]);
                    if (b != last && *b == t.column[a])
                        sums[index(*b)] += t.value[a] * k.value[e] * t.value[index(b - t.column.begin())];
                }
    });
    diagonal_ = vector();
    assemble(sums, diagonal_);
}

void Bodies::apply(Vec v, Vec av) const {
    fetch(v, places_);
    local_.transform.multiply(places_, displacement_);
    const auto rows = index(part_.stiffness.rows);  // orphans, behind these, have no stiffness
    part_.stiffness.multiply(std::span(displacement_).first(rows), std::span(force_of_part_).first(rows));
    std::fill(places_.begin(), places_.end(), 0.0);
    local_.transform.add_multiplied_transposed(force_of_part_, places_);
    assemble(places_, av);
}

void Bodies::make_loads() {
    const std::size_t count = local_.lift.size();
    std::vector<std::vector<double>> stiffness_lift(count);
    for (std::size_t p = 0; p < count; ++p) {
        std::vector<double> places, forces;
        comm_.together([&] {
            std::vector<double> lift(index(local_.dofs), 0.0), force(index(local_.dofs), 0.0);
            for (std::size_t i = 0; i < local_.lift[p].dof.size(); ++i)
                lift[index(local_.lift[p].dof[i])] += local_.lift[p].value[i];
            for (std::size_t i = 0; i < local_.force[p].dof.size(); ++i)
                force[index(local_.force[p].dof[i])] += local_.force[p].value[i];
            stiffness_lift[p] = stiffness_times(lift);
            places.assign(index(local_.places()), 0.0);
            forces.assign(index(local_.places()), 0.0);
            local_.transform.add_multiplied_transposed(stiffness_lift[p], places);
            local_.transform.add_multiplied_transposed(force, forces);
        });
        force_.push_back(vector());
        lifted_.push_back(vector());
        load_.push_back(vector());
        assemble(forces, force_[p]);
        assemble(places, lifted_[p]);
        check(VecWAXPY(load_[p], -1.0, lifted_[p], force_[p]));
    }
    lift_lift_.assign(count * count, 0.0);
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t q = 0; q < count; ++q)
            for (std::size_t i = 0; i < local_.lift[p].dof.size(); ++i)
                lift_lift_[p * count + q] += local_.lift[p].value[i] * stiffness_lift[q][index(local_.lift[p].dof[i])];
    comm_.sum(lift_lift_);
}

std::vector<double> Bodies::stiffness_times(std::span<const double> displacement) const {
    std::vector<double> force(displacement.size(), 0.0);
    const auto rows = index(part_.stiffness.rows);
    part_.stiffness.multiply(displacement.first(rows), std::span(force).first(rows));
    return force;
}

void Bodies::add_loads(std::span<const double> theta, Vec out) const {
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (theta[p] != 0.0) check(VecAXPY(out, theta[p], load_[p]));
}

double Bodies::stored(std::span<const double> theta, Vec v, Vec av) const {
    PetscScalar sum = 0.0;
    check(VecDot(v, av, &sum));
    for (std::size_t p = 0; p < theta.size(); ++p) {
        if (theta[p] == 0.0) continue;
        PetscScalar with_lift = 0.0;
        check(VecDot(v, lifted_[p], &with_lift));
        sum += 2.0 * theta[p] * with_lift;
        for (std::size_t q = 0; q < theta.size(); ++q) sum += theta[p] * theta[q] * lift_lift_[p * theta.size() + q];
    }
    return sum;
}

BodyState Bodies::state(std::span<const double> theta, Vec v) const {
    BodyState state;
    std::vector<double> places, sums;
    fetch(v, places);
    comm_.together([&] {
        std::vector<double>& u = state.displacement;
        u.resize(index(local_.dofs));
        local_.transform.multiply(places, u);
        for (std::size_t p = 0; p < theta.size(); ++p)
            for (std::size_t i = 0; i < local_.lift[p].dof.size(); ++i)
                u[index(local_.lift[p].dof[i])] += theta[p] * local_.lift[p].value[i];
        state.force = stiffness_times(u);
        sums.push_back(std::inner_product(u.begin(), u.end(), state.force.begin(), 0.0));
        for (std::size_t p = 0; p < theta.size(); ++p) {
            double work = 0.0, lifted = 0.0;
            for (std::size_t i = 0; i < local_.force[p].dof.size(); ++i)
                work += local_.force[p].value[i] * u[index(local_.force[p].dof[i])];
            for (std::size_t i = 0; i < local_.lift[p].dof.size(); ++i)
                lifted += local_.lift[p].value[i] * state.force[index(local_.lift[p].dof[i])];
            sums.push_back(work);
            sums.push_back(lifted);
        }
    });
    comm_.sum(sums);
    state.stored = sums[0];
    for (std::size_t p = 0; p < theta.size(); ++p) {
        state.work.push_back(sums[1 + 2 * p]);
        state.lifted.push_back(sums[2 + 2 * p]);
    }
    return state;
}

void Bodies::forces(const BodyState& state, Vec out) const {
    std::vector<double> places;
    comm_.together([&] {
        places.assign(index(local_.places()), 0.0);
        local_.transform.add_multiplied_transposed(state.force, places);
    });
    assemble(places, out);
}

void Bodies::add_nodal_forces(std::span<const double> theta, Vec out) const {
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (theta[p] != 0.0) check(VecAXPY(out, theta[p], force_[p]));
}

void Bodies::sizes(const BodyState& state, Vec out) const {
    std::vector<double> places;
    comm_.together([&] {
        std::vector<double> force(state.displacement.size(), 0.0);
        const auto rows = index(part_.stiffness.rows);
        part_.stiffness.multiply_sizes(std::span(state.displacement).first(rows), std::span(force).first(rows));
        places.assign(index(local_.places()), 0.0);
        local_.transform.add_multiplied_transposed_sizes(force, places);
    });
    assemble(places, out);
}

void Bodies::assemble(std::span<const double> places, Vec out) const {
    PetscScalar* array = nullptr;
    check(VecGetArray(here_, &array));
    std::copy(places.begin(), places.end(), array);
    check(VecRestoreArray(here_, &array));
    check(VecSet(out, 0.0));
    check(VecScatterBegin(fetch_, here_, out, ADD_VALUES, SCATTER_REVERSE));
    check(VecScatterEnd(fetch_, here_, out, ADD_VALUES, SCATTER_REVERSE));
}

void Bodies::fetch(Vec from, std::vector<double>& places) const {
    check(VecScatterBegin(fetch_, from, here_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(fetch_, from, here_, INSERT_VALUES, SCATTER_FORWARD));
    const PetscScalar* array = nullptr;
    check(VecGetArrayRead(here_, &array));
    places.assign(array, array + local_.places());
    check(VecRestoreArrayRead(here_, &array));
}

}  // namespace delam::petsc
