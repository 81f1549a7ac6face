// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/displacement_system.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/numbers.hpp"
#include "petsc/part/places.hpp"

namespace delam::petsc {

namespace {

// Diagonal entry, relative to the largest stiffness, of a place to which this rank adds nothing.
constexpr double nothing = 1e-6;

using Springs = std::map<std::pair<PetscInt, PetscInt>, double>;

// Both have ascending columns; a spring may stand where the matrix has no entry.
void add(LocalMatrix& matrix, const Springs& springs) {
    LocalMatrix sum;
    sum.rows = matrix.rows;
    sum.columns = matrix.columns;
    sum.start.reserve(matrix.start.size());
    sum.column.reserve(matrix.column.size() + springs.size());
    sum.value.reserve(matrix.value.size() + springs.size());
    auto spring = springs.begin();
    for (PetscInt r = 0; r < matrix.rows; ++r) {
        auto e = index(matrix.start[index(r)]);
        const auto last = index(matrix.start[index(r) + 1]);
        while (true) {
            const bool springs_left = spring != springs.end() && spring->first.first == r;
            if (!springs_left && e == last) break;
            const PetscInt c = !springs_left ? matrix.column[e]
                               : e == last   ? spring->first.second
                                             : std::min(matrix.column[e], spring->first.second);
            double value = 0.0;
            if (e != last && matrix.column[e] == c) value += matrix.value[e++];
            if (springs_left && spring->first.second == c) value += (spring++)->second;
            sum.column.push_back(c);
            sum.value.push_back(value);
        }
        sum.start.push_back(petsc_int(sum.column.size()));
    }
    matrix = std::move(sum);
}

// Every place needs a diagonal: those without a variable are never used. All rows have an entry there.
void complete_diagonal(LocalMatrix& matrix, const std::vector<std::uint8_t>& is_variable) {
    double largest = 0.0;
    for (const double x : matrix.value) largest = std::max(largest, x);
    for (std::size_t i = 0; i < index(matrix.rows); ++i)
        for (auto e = index(matrix.start[i]); e < index(matrix.start[i + 1]); ++e)
            if (index(matrix.column[e]) == i && matrix.value[e] == 0.0)
                matrix.value[e] = is_variable[i] == 0 ? largest : nothing * largest;
}

}  // namespace

DisplacementSystem::DisplacementSystem(const Bodies& bodies, const Visible& visible, const SceneVariables& scene)
    : bodies_(bodies), jumps_(scene) {
    bodies.comm().together([&] { make_transform(scene); });
    cover_visible(visible, scene);
    number();
    make_expansion(scene);
}

std::int64_t DisplacementSystem::dof_of(std::size_t place) const {
    const auto d = index(bodies_.local().dimension);
    return nodes_[place / d] * static_cast<std::int64_t>(d) + static_cast<std::int64_t>(place % d);
}

void DisplacementSystem::make_transform(const SceneVariables& scene) {
    nodes_ = bodies_.part().nodes;
    Places places(scene.dimension, nodes_);
    LocalMatrix& transform = transform_;
    transform.rows = bodies_.part().stiffness.rows;
    const auto add = [&](std::int64_t home, double coefficient) {
        transform.column.push_back(places.of(home));
        transform.value.push_back(coefficient);
    };
    for (std::size_t i = 0; i < index(transform.rows); ++i) {
        const std::int64_t dof = dof_of(i), row = scene.place(dof);
        if (row < 0 || scene.is_home[index(row)] != 0)
            add(dof, 1.0);
        else
            for (std::int64_t e = scene.start[index(row)]; e < scene.start[index(row) + 1]; ++e)
                for (const auto& [home, value] : jumps_.row(scene.home[index(e)]))
                    add(home, scene.coefficient[index(e)] * value);
        transform.start.push_back(petsc_int(transform.column.size()));
    }
    transform.columns = petsc_int(nodes_.size() * index(scene.dimension));
    transform.sort_rows();
}

// Returns the matrix of this rank alone: the caller agrees with the other ranks.
LocalMatrix DisplacementSystem::stiffness() const {
    // PETSc's arrays have no const.
    LocalMatrix &part = const_cast<LocalMatrix&>(bodies_.part().stiffness),
                &transform = const_cast<LocalMatrix&>(transform_);
    const OwnedMat k = part.borrow(), t = transform.borrow();
    OwnedMat product;
    check(MatPtAP(k, t, MAT_INITIAL_MATRIX, PETSC_DEFAULT, product.out()));
    return with_diagonal(product, std::vector<double>(index(transform.columns), 0.0));
}

// A visible variable that no rank has, with all nodes it consists of, gets these on the rank that owns its home.
void DisplacementSystem::cover_visible(const Visible& visible, const SceneVariables& scene) {
    const Communicator& comm = bodies_.comm();
    std::vector<std::int64_t> homes;
    std::vector<PetscInt> numbers;
    comm.together([&] {
        homes = scene.visible;
        for (std::size_t i = 0; i < homes.size(); ++i) numbers.push_back(visible.number(static_cast<std::int64_t>(i)));
    });
    comm.broadcast(homes);
    comm.broadcast(numbers);
    std::vector<double> having;
    comm.together([&] {
        Places places(scene.dimension, nodes_);
        having.assign(homes.size(), 0.0);
        for (std::size_t i = 0; i < homes.size(); ++i) {
            const JumpExpansion::Row& row = jumps_.row(homes[i]);
            having[i] = std::all_of(row.begin(), row.end(), [&](const auto& term) { return places.has(term.first); });
        }
    });
    std::vector<double> all(having);
    comm.sum(all);
    comm.together([&] {
        Places places(scene.dimension, nodes_);
        const LocalVariables& local = bodies_.local();
        visible_.resize(homes.size());
        for (std::size_t i = 0; i < homes.size(); ++i) {
            const bool owned = numbers[i] >= local.first && numbers[i] < local.first + local.owned;
            if (having[i] == 0.0 && !(all[i] == 0.0 && owned)) continue;
            for (const auto& [home, coefficient] : jumps_.row(homes[i]))
                visible_[i].push_back({places.of(home), coefficient});
        }
        const auto count = nodes_.size() * index(scene.dimension);
        transform_.columns = petsc_int(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t row = scene.place(dof_of(i));
            is_variable_.push_back(row < 0 || scene.is_home[index(row)] != 0 ? 1 : 0);
        }
    });
}

void DisplacementSystem::number() {
    const std::vector<PetscInt> blocks = bodies_.numbering().find(nodes_);
    check(ISLocalToGlobalMappingCreate(bodies_.comm().get(), bodies_.local().dimension,
                                       static_cast<PetscInt>(blocks.size()), blocks.data(), PETSC_COPY_VALUES,
                                       mapping_.out()));
}

void DisplacementSystem::make_expansion(const SceneVariables& scene) {
    const Communicator& comm = bodies_.comm();
    const LocalVariables& local = bodies_.local();
    std::vector<std::int64_t> nodes;
    std::vector<PetscInt> rows, columns;
    std::vector<double> values;
    comm.together([&] {
        Places places(scene.dimension, nodes);
        const auto d = index(scene.dimension);
        for (std::size_t i = 0; i < local.nodes.size() * d; ++i) {
            if (!local.owns(i) || local.is_variable[i] == 0) continue;
            const std::int64_t dof = local.nodes[i / d] * scene.dimension + static_cast<std::int64_t>(i % d);
            for (const auto& [home, coefficient] : jumps_.row(dof)) {
                rows.push_back(local.number[i]);
                columns.push_back(places.of(home));
                values.push_back(coefficient);
            }
        }
    });
    const std::vector<PetscInt> blocks = bodies_.numbering().find(nodes);
    for (PetscInt& c : columns) c = blocks[index(c / local.dimension)] * local.dimension + c % local.dimension;
    check(MatCreate(comm.get(), expansion_.out()));
    check(MatSetSizes(expansion_, local.owned, local.owned, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetType(expansion_, MATAIJ));
    check(MatSetPreallocationCOO(expansion_, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
    check(MatSetValuesCOO(expansion_, values.data(), INSERT_VALUES));
}

OwnedMat DisplacementSystem::local_matrix(LocalMatrix stiffness, const std::vector<std::int64_t>& rows,
                                          const std::vector<std::int64_t>& columns,
                                          const std::vector<double>& values) const {
    const Communicator& comm = bodies_.comm();
    std::vector<std::int64_t> r(rows), c(columns);
    std::vector<double> v(values), having;
    comm.broadcast(r);
    comm.broadcast(c);
    comm.broadcast(v);
    comm.together([&] {
        for (std::size_t e = 0; e < v.size(); ++e)
            having.push_back(visible_[index(r[e])].empty() || visible_[index(c[e])].empty() ? 0.0 : 1.0);
    });
    std::vector<double> all(having);
    comm.sum(all);
    OwnedMat matrix;
    comm.together([&] {
        Springs springs;
        for (std::size_t e = 0; e < v.size(); ++e) {
            if (having[e] == 0.0 || v[e] == 0.0) continue;
            for (const Term& a : visible_[index(r[e])])
                for (const Term& b : visible_[index(c[e])])
                    springs[{a.place, b.place}] += v[e] / all[e] * a.coefficient * b.coefficient;
        }
        add(stiffness, springs);
        complete_diagonal(stiffness, is_variable_);
        check(MatDuplicate(OwnedMat(stiffness.borrow()), MAT_COPY_VALUES, matrix.out()));
        check(MatSetBlockSize(matrix, bodies_.local().dimension));
        check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
        check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
    });
    return matrix;
}

bool DisplacementSystem::is_whole(std::size_t node) const {
    const auto d = static_cast<std::ptrdiff_t>(bodies_.local().dimension);
    const auto first = is_variable_.begin() + static_cast<std::ptrdiff_t>(node) * d;
    return std::all_of(first, first + d, [](std::uint8_t is) { return is != 0; });
}

OwnedIs DisplacementSystem::empty_places() const {
    std::vector<PetscInt> places;
    for (std::size_t i = 0; i < is_variable_.size(); ++i)
        if (is_variable_[i] == 0) places.push_back(petsc_int(i));
    OwnedIs empty;
    check(ISCreateGeneral(PETSC_COMM_SELF, petsc_int(places.size()), places.data(), PETSC_COPY_VALUES, empty.out()));
    return empty;
}

}  // namespace delam::petsc
