// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/base/local_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"
#include "petsc/base/failure.hpp"

namespace delam::petsc {

namespace {

template <class Term>
void each(const LocalMatrix& a, const Term& term) {
    for (std::size_t r = 0; r < index(a.rows); ++r)
        for (auto e = index(a.start[r]); e < index(a.start[r + 1]); ++e) term(r, index(a.column[e]), a.value[e]);
}

}  // namespace

void LocalMatrix::multiply(std::span<const double> x, std::span<double> y) const {
    std::fill(y.begin(), y.end(), 0.0);
    each(*this, [&](std::size_t r, std::size_t c, double v) { y[r] += v * x[c]; });
}

void LocalMatrix::add_multiplied_transposed(std::span<const double> x, std::span<double> y) const {
    each(*this, [&](std::size_t r, std::size_t c, double v) { y[c] += v * x[r]; });
}

void LocalMatrix::multiply_sizes(std::span<const double> x, std::span<double> y) const {
    std::fill(y.begin(), y.end(), 0.0);
    each(*this, [&](std::size_t r, std::size_t c, double v) { y[r] += std::abs(v * x[c]); });
}

void LocalMatrix::add_multiplied_transposed_sizes(std::span<const double> x, std::span<double> y) const {
    each(*this, [&](std::size_t r, std::size_t c, double v) { y[c] += std::abs(v * x[r]); });
}

OwnedMat LocalMatrix::borrow() {
    OwnedMat matrix;
    check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, rows, columns, start.data(), column.data(), value.data(),
                                    matrix.out()));
    return matrix;
}

void LocalMatrix::sort_rows() {
    std::vector<std::pair<PetscInt, double>> row;
    std::size_t end = 0, from = 0;
    for (std::size_t r = 0; r < index(rows); ++r) {
        const std::size_t until = index(start[r + 1]);
        row.clear();
        for (std::size_t e = from; e < until; ++e) row.emplace_back(column[e], value[e]);
        const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
        if (!std::is_sorted(row.begin(), row.end(), before)) std::stable_sort(row.begin(), row.end(), before);
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (i > 0 && row[i].first == row[i - 1].first) {
                value[end - 1] += row[i].second;
                continue;
            }
            column[end] = row[i].first;
            value[end++] = row[i].second;
        }
        from = until;
        start[r + 1] = petsc_int(end);
    }
    column.resize(end);
    value.resize(end);
}

LocalMatrix with_diagonal(Mat matrix, std::span<const double> missing) {
    PetscInt n = 0;
    const PetscInt *start = nullptr, *column = nullptr;
    PetscBool done = PETSC_FALSE;
    const PetscScalar* value = nullptr;
    check(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &column, &done));
    if (done != PETSC_TRUE) fail(DELAM_ERROR_INTERNAL, "PETSc does not show the rows of a matrix");
    check(MatSeqAIJGetArrayRead(matrix, &value));
    LocalMatrix copy;
    copy.rows = copy.columns = n;
    copy.start.reserve(index(n) + 1);
    copy.column.reserve(index(start[n]));
    copy.value.reserve(index(start[n]));
    for (PetscInt r = 0; r < n; ++r) {
        bool present = false;
        const auto add = [&](PetscInt c, double v) {
            copy.column.push_back(c);
            copy.value.push_back(v);
        };
        for (PetscInt e = start[r]; e < start[r + 1]; ++e) {
            if (!present && column[e] >= r) {
                if (column[e] > r) add(r, missing[index(r)]);
                present = true;
            }
            add(column[e], value[e]);
        }
        if (!present) add(r, missing[index(r)]);
        copy.start.push_back(petsc_int(copy.column.size()));
    }
    check(MatSeqAIJRestoreArrayRead(matrix, &value));
    check(MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &column, &done));
    return copy;
}

}  // namespace delam::petsc
