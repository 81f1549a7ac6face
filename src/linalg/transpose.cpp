// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse.hpp"

namespace delam {

SparseMatrix transpose(const SparseMatrix& a) {
    SparseMatrix t;
    t.rows = a.columns;
    t.columns = a.rows;
    t.start.assign(static_cast<std::size_t>(a.columns) + 1, 0);
    for (const std::int64_t c : a.column) ++t.start[static_cast<std::size_t>(c) + 1];
    for (std::size_t i = 1; i < t.start.size(); ++i) t.start[i] += t.start[i - 1];
    t.column.resize(a.column.size());
    t.value.resize(a.value.size());
    std::vector<std::int64_t> next(t.start.begin(), t.start.end() - 1);
    for (std::int64_t r = 0; r < a.rows; ++r) {
        for (std::int64_t e = a.start[static_cast<std::size_t>(r)]; e < a.start[static_cast<std::size_t>(r) + 1]; ++e) {
            const auto at = static_cast<std::size_t>(next[static_cast<std::size_t>(a.column[static_cast<std::size_t>(e)])]++);
            t.column[at] = r;
            t.value[at] = a.value[static_cast<std::size_t>(e)];
        }
    }
    return t;
}

}  // namespace delam
