// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/neighbourhood.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam {

std::vector<std::int64_t> rings(const SparseMatrix& matrix, std::span<const std::int64_t> seeds,
                                std::span<const std::uint8_t> barred, std::int64_t margin) {
    std::vector<std::int64_t> ring(index(matrix.rows), margin + 1), front, next;
    for (const std::int64_t i : seeds) {
        if (barred[index(i)] != 0) continue;
        ring[index(i)] = 0;
        front.push_back(i);
    }
    for (std::int64_t r = 1; r <= margin && !front.empty(); ++r) {
        next.clear();
        for (const std::int64_t i : front)
            for (std::int64_t e = matrix.start[index(i)]; e < matrix.start[index(i) + 1]; ++e) {
                const std::int64_t j = matrix.column[index(e)];
                if (ring[index(j)] <= r || barred[index(j)] != 0) continue;
                ring[index(j)] = r;
                next.push_back(j);
            }
        front.swap(next);
    }
    return ring;
}

SparseMatrix submatrix(const SparseMatrix& matrix, std::span<const std::int64_t> variables) {
    SparseMatrix part;
    part.rows = part.columns = static_cast<std::int64_t>(variables.size());
    for (const std::int64_t i : variables) {
        auto from = variables.begin();
        for (std::int64_t e = matrix.start[index(i)]; e < matrix.start[index(i) + 1]; ++e) {
            from = std::lower_bound(from, variables.end(), matrix.column[index(e)]);
            if (from == variables.end()) break;
            if (*from != matrix.column[index(e)]) continue;
            part.column.push_back(from - variables.begin());
            part.value.push_back(matrix.value[index(e)]);
        }
        part.start.push_back(static_cast<std::int64_t>(part.column.size()));
    }
    return part;
}

void add_entries(SparseMatrix& matrix, std::span<const Triplet> entries) {
    for (const Triplet& t : entries) {
        const auto begin = matrix.column.begin() + matrix.start[index(t.row)],
                   end = matrix.column.begin() + matrix.start[index(t.row) + 1];
        matrix.value[index(std::lower_bound(begin, end, t.column) - matrix.column.begin())] += t.value;
    }
}

}  // namespace delam
