// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/condensed_matrices.hpp"

#include <algorithm>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "reduction/condensed/bulk.hpp"

namespace delam {

namespace {

const Bulk& bulk_of(const Solver& solver) {
    const Bulk* bulk = solver.stepper().design().bulk.get();
    if (solver.problem().options.kinematics != "linear")
        fail(DELAM_ERROR_STATE, "with kinematics = ", solver.problem().options.kinematics,
             " there is no condensed operator that would hold in all steps");
    if (bulk == nullptr)
        fail(DELAM_ERROR_STATE,
             "the solver has no condensed operator, because the bodies are reduced by iteration or by FETI: set the "
             "option reduction = condensed");
    return *bulk;
}

void copy_stiffness(const DenseEnergy& energy, double* out) {
    for (std::int64_t j = 0; j < energy.rows(); ++j) {
        poll_cancel("copy", 1 + energy.rows() / 64);
        for (std::int64_t i = j; i < energy.rows(); ++i)
            out[i * energy.rows() + j] = out[j * energy.rows() + i] = energy.stiffness(i, j);
    }
}

void copy_rows(const Bulk& bulk, std::size_t patterns, const CondensedMatrices& out) {
    std::int64_t entry = 0;
    if (out.row_starts != nullptr) out.row_starts[0] = 0;
    for (std::size_t r = 0; r < bulk.rows().size(); ++r) {
        const JumpRow& row = bulk.rows()[r];
        for (const auto& [unknown, value] : row.unknowns) {
            if (out.columns != nullptr) out.columns[entry] = unknown;
            if (out.values != nullptr) out.values[entry] = value;
            ++entry;
        }
        if (out.row_starts != nullptr) out.row_starts[r + 1] = entry;
        for (std::size_t p = 0; p < patterns && out.offset != nullptr; ++p)
            out.offset[r * patterns + p] = row.offset.empty() ? 0.0 : row.offset[p];
    }
}

}  // namespace

CondensedSize condensed_size(const Solver& solver) {
    const Bulk& bulk = bulk_of(solver);
    CondensedSize size{bulk.unknowns(), 0};
    for (const JumpRow& row : bulk.rows()) size.entries += static_cast<std::int64_t>(row.unknowns.size());
    return size;
}

void copy_condensed(const Solver& solver, const CondensedMatrices& out) {
    const Bulk& bulk = bulk_of(solver);
    const std::span<const double> constant = bulk.pattern_stiffness().value;
    if (out.stiffness != nullptr) copy_stiffness(bulk.dense([] { poll_cancel("condense", 1 << 20); }), out.stiffness);
    if (out.load != nullptr) std::copy(bulk.load().value.begin(), bulk.load().value.end(), out.load);
    if (out.constant != nullptr) std::copy(constant.begin(), constant.end(), out.constant);
    copy_rows(bulk, solver.problem().patterns.size(), out);
}

}  // namespace delam
