// SPDX-License-Identifier: BSD-3-Clause
// Shared by the files that call CHOLMOD: our matrices in its types, and its errors as ours.
#pragma once

#include <suitesparse/cholmod.h>

#include <cstdint>
#include <new>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "linalg/sparse/sparse.hpp"

namespace delam {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

// A view of our rows as CHOLMOD's columns; the matrix is symmetric, and CHOLMOD reads its upper triangle.
inline cholmod_sparse view(const SparseMatrix& m) {
    cholmod_sparse a{};
    a.nrow = index(m.rows);
    a.ncol = index(m.columns);
    a.nzmax = index(m.entries());
    a.p = const_cast<std::int64_t*>(m.start.data());
    a.i = const_cast<std::int64_t*>(m.column.data());
    a.x = const_cast<double*>(m.value.data());
    a.stype = 1;
    a.itype = CHOLMOD_LONG;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = 1;
    a.packed = 1;
    return a;
}

// stage: what CHOLMOD was asked for. Throws std::bad_alloc, or Error for its other errors; warnings pass.
inline void require_cholmod(const cholmod_common& common, const char* stage) {
    if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common.status == CHOLMOD_TOO_LARGE) fail(DELAM_ERROR_MEMORY, "CHOLMOD ", stage, ": problem too large");
    if (common.status < 0) fail(DELAM_ERROR_INTERNAL, "CHOLMOD ", stage, ": status ", common.status);
}

}  // namespace delam
